// thesis_experiments texture: torn cloth that is put back shows the texture it had (3.3).
#include <cstdio>

#include "cloth_tearing/core/checks.h"
#include "cloth_tearing/experiments/texture_experiment.h"
#include "experiment_commands.h"
#include "experiment_output.h"

namespace cloth
{
namespace
{

void print(const char* what, const TextureFit& fit, bool ok)
{
  std::printf("  %-20s %d points, %d uncovered, %d covered twice, deviation %.2g, area %+.2g  %s\n",
              what, fit.points, fit.uncovered, fit.covered_twice, fit.deviation,
              fit.area_after / fit.area_before - 1.0, ok ? "ok" : "NOT AS IT MUST BE");
}

Row columns(const Setting& setting, const Simulation& torn, const TextureFit& fit,
            const TextureFit& swapped)
{
  Row row = settingColumns(setting);
  row.insert(row.end(), { { "tears", std::to_string(torn.revision()) },
                          { "pieces", std::to_string(torn.cloth().damage.pieces) },
                          { "points", std::to_string(fit.points) },
                          { "uncovered", std::to_string(fit.uncovered) },
                          { "covered_twice", std::to_string(fit.covered_twice) },
                          { "deviation", text(fit.deviation) },
                          { "area_change", text(fit.areaChange()) },
                          { "deviation_swapped", text(swapped.deviation) } });
  return row;
}

bool textureOn(const Setting& setting, Output& output)
{
  const Simulation hung = hungCloth(setting);
  Simulation torn = hung;
  tearBadly(torn);
  const auto untorn = texturedTriangles(hung.cloth());
  const auto put_back = putBack(torn.cloth(), hung.cloth());

  const TextureFit fit = compareTexture(untorn, put_back);
  const TextureFit swapped = compareTexture(untorn, withSwappedCorners(put_back));

  const bool several = torn.cloth().damage.pieces > 1;
  std::printf("%s: %d tears, %d of them across a spring, %d pieces%s\n", clothName(setting).c_str(),
              static_cast<int>(torn.revision()), static_cast<int>(torn.summary().tears[0]),
              torn.cloth().damage.pieces, several ? "" : ": NO PIECE CAME OFF");
  print("put back", fit, fit.fits());
  print("two corners swapped", swapped, !swapped.fits());
  output.row(columns(setting, torn, fit, swapped));
  output.snapshot("texture_" + fileName(setting) + "_torn.obj", torn);
  putBackSlowly(torn, hung.cloth(), [](const Simulation&, const StepReport&) {});
  output.snapshot("texture_" + fileName(setting) + "_put_back.obj", torn);
  return fit.fits() && !swapped.fits() && several;
}

}  // namespace

bool texture(const Options& options)
{
  Output output(options.output, "texture.csv");
  bool hold = true;
  for (const Setting& setting : options.settings({ 30 }, ALL_MESHES, { 1 }))
  {
    hold = textureOn(setting, output) && hold;
  }
  return hold;
}

}  // namespace cloth
