// Program: steps a hung cloth of 30 x 30 so often that what a step costs can be counted.
//
// step_cost xpbd|force_springs STEPS. Says which loops it used.
#include <cstdlib>
#include <iostream>
#include <string>

#include "cloth_tearing/core/kernels.h"
#include "scenes.h"

int main(int argc, char** argv)
{
  const std::string solver = argc == 3 ? argv[1] : "";
  if (solver != "xpbd" && solver != "force_springs")
  {
    std::cerr << "usage: step_cost xpbd|force_springs STEPS\n";
    return 2;
  }
  const cloth::ClothModel flat = cloth::sheet(1.0, 1.0, 30, 30);
  cloth::SimulationParams params = cloth::tearable(
      solver == "xpbd" ? cloth::SolverKind::XPBD : cloth::SolverKind::FORCE_SPRINGS);
  params.threads = 1;
  cloth::Simulation simulation(cloth::upright(flat), cloth::edgeOf(flat, "top"), params);
  for (int i = std::atoi(argv[2]); i > 0; --i)
  {
    const std::string fault = simulation.step().fault;
    if (!fault.empty())
    {
      std::cerr << fault << "\n";
      return 1;
    }
  }
  std::cout << "loops: " << cloth::kernels::best().name << "\n";
  return 0;
}
