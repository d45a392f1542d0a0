// Springs that obstacles have pushed.
#pragma once

#include <vector>

#include "cloth_tearing/core/cloth.h"
#include "cloth_tearing/core/worker_pool.h"

namespace cloth
{

/// Finds springs that were stretched by pushes after the solver had measured them.
class PushedSprings
{
public:
  /// @param noted springs that are known to be stretched
  /// @param pushed particles that were pushed since then
  /// @return `noted`, and with them the structural springs at `pushed` that are stretched by more
  /// than `strain` [-], and maybe others that are; ascending, each once. A NaN counts as stretched.
  const std::vector<int>& find(const Cloth& cloth, const std::vector<int>& noted,
                               const std::vector<int>& pushed, double strain, WorkerPool* workers);

private:
  void addAt(const Cloth& cloth, const std::vector<int>& pushed, Real limit);
  void addOfAll(const Cloth& cloth, Real limit, WorkerPool* workers);

  std::vector<int> springs_;
  std::vector<std::vector<int>> found_;  ///< by stretch of springs, scratch
};

}  // namespace cloth
