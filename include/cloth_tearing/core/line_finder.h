// Lines of springs that run through a cloth.
#pragma once

#include <vector>

#include "cloth_tearing/core/spring_table.h"
#include "cloth_tearing/core/vec3_array.h"

namespace cloth
{

/// Structural springs one after the other: springs[i] joins particles[i] and particles[i + 1]. No
/// particle is there twice.
struct SpringLine
{
  std::vector<int> particles;
  std::vector<int> springs;  ///< by SpringId
};

/// Joins structural springs into lines: at each particle the straightest pair goes on into each
/// other first, none that turns by more than about 70 degrees. Each spring that carries something
/// is in one line at most.
/// @param places of the particles [m]
/// @return lines of at least a few springs, the longest first
std::vector<SpringLine> findLines(const SpringTable& springs, const Vec3Array& places);

/// How much of the springs' stiffness is not that of lines [-], 0 to 1: of their ends, the mean of
/// the squared sine of the turn there, 1 where no line goes on, unless the cloth ends there. A line
/// that turns gives way where the springs that brace it do.
double unbraced(const std::vector<SpringLine>& lines, const SpringTable& springs,
                const Vec3Array& places);

/// Shares lines out so that those of one share have no particle in common: early ones first, into
/// as few shares as come out so. Lines for which there is no room are left out.
std::vector<std::vector<SpringLine>> apart(const std::vector<SpringLine>& lines, int particles);

}  // namespace cloth
