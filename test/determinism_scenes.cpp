// Program: plays the scenes of determinism and prints what they were like.
#include "determinism_scenes.h"

#include <iostream>

int main()
{
  for (const cloth::SceneMoment& moment : cloth::playScenes())
  {
    std::cout << moment.line() << "\n";
  }
}
