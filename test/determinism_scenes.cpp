// Program: plays the scenes of determinism and prints what they were like, after the loops in use.
#include "determinism_scenes.h"

#include <iostream>

#include "cloth_tearing/core/kernels.h"

int main(int argc, char** argv)
{
  const bool small_only = argc > 1 && std::string(argv[1]) == "--small";
  std::cout << "loops: " << cloth::kernels::best().name << "\n";
  std::vector<cloth::SceneMoment> moments = cloth::playScenes();
  if (!small_only)
  {
    for (const cloth::SceneMoment& moment : cloth::playLargeScenes(cloth::MOST_SCENE_THREADS))
    {
      moments.push_back(moment);
    }
  }
  for (const cloth::SceneMoment& moment : moments)
  {
    std::cout << moment.line() << "\n";
  }
}
