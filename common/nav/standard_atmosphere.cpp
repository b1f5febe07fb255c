#include "inslab/nav/standard_atmosphere.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace inslab::nav::standard_atmosphere {
namespace {

/// ISO 2533, table 4.
struct Layer {
  double base_m;
  double base_temperature_k;
  double lapse_k_per_m;
};
constexpr std::array<Layer, 8> kLayers{{{0.0, 288.15, -6.5e-3},
                                        {11000.0, 216.65, 0.0},
                                        {20000.0, 216.65, 1.0e-3},
                                        {32000.0, 228.65, 2.8e-3},
                                        {47000.0, 270.65, 0.0},
                                        {51000.0, 270.65, -2.8e-3},
                                        {71000.0, 214.65, -2.0e-3},
                                        {80000.0, 196.65, 0.0}}};
constexpr double kKPerM = kGMPerS2 / kGasConstantJPerKgK;

/// Pressure at `above_m` over the base of a layer, in parts of that at its base: ISO 2533, (12) and (13).
double pressure_ratio(const Layer& layer, double above_m, double deviation_k) {
  const double base_k = layer.base_temperature_k + deviation_k;
  if (layer.lapse_k_per_m == 0.0) return std::exp(-kKPerM * above_m / base_k);
  return std::pow(1.0 + layer.lapse_k_per_m * above_m / base_k, -kKPerM / layer.lapse_k_per_m);
}

bool is_the_last(std::size_t i) { return i + 1 == kLayers.size(); }

/// Pressure at the bases of the layers in the standard itself.
const std::array<double, kLayers.size()>& base_pressures_pa() {
  static const std::array<double, kLayers.size()> pressures = [] {
    std::array<double, kLayers.size()> out{kSeaLevelPressurePa};
    for (std::size_t i = 1; i < out.size(); ++i) {
      out[i] = out[i - 1] * pressure_ratio(kLayers[i - 1], kLayers[i].base_m - kLayers[i - 1].base_m, 0.0);
    }
    return out;
  }();
  return pressures;
}

}  // namespace

Air air_at(double geopotential_height_m, double sea_level_pressure_pa, double deviation_k) {
  double pressure_pa = sea_level_pressure_pa;
  std::size_t i = 0;
  for (; !is_the_last(i) && geopotential_height_m >= kLayers[i + 1].base_m; ++i) {
    pressure_pa *= pressure_ratio(kLayers[i], kLayers[i + 1].base_m - kLayers[i].base_m, deviation_k);
  }
  const double above_m = geopotential_height_m - kLayers[i].base_m;
  return {pressure_pa * pressure_ratio(kLayers[i], above_m, deviation_k),
          kLayers[i].base_temperature_k + deviation_k + kLayers[i].lapse_k_per_m * above_m};
}

double pressure_altitude_m(double pressure_pa) {
  if (!(pressure_pa > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  const auto& bases_pa = base_pressures_pa();
  std::size_t i = 0;
  while (!is_the_last(i) && pressure_pa <= bases_pa[i + 1]) ++i;
  const Layer& layer = kLayers[i];
  const double ratio = pressure_pa / bases_pa[i];
  if (layer.lapse_k_per_m == 0.0) return layer.base_m - layer.base_temperature_k / kKPerM * std::log(ratio);
  return layer.base_m +
         layer.base_temperature_k / layer.lapse_k_per_m * (std::pow(ratio, -layer.lapse_k_per_m / kKPerM) - 1.0);
}

}  // namespace inslab::nav::standard_atmosphere
