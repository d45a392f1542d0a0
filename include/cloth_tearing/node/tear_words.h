// A tear in words.
#pragma once

#include <cloth_tearing/TearEvent.h>

#include <string>

namespace cloth_tearing
{

/// One line for people, without its end: number, kind, place [m], strain, force [N], cause, pieces.
std::string inWords(const TearEvent& event);

}  // namespace cloth_tearing
