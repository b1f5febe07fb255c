#include "inslab/formats/novatel/novatel_scale.hpp"

#include <algorithm>

#include "inslab/foundation/units/units.hpp"

namespace inslab::novatel {

namespace {

constexpr double power_of_two(int exponent) { return exponent == 0 ? 1.0 : power_of_two(exponent + 1) / 2.0; }

constexpr double kFoot = 0.3048;       // m, exactly
constexpr double kG = 9.80665;         // m/s^2, standard gravity
constexpr double kMilliG = 1e-3 * kG;  // m/s^2

constexpr double kRad33 = power_of_two(-33);
constexpr double kFeet27 = power_of_two(-27) * kFoot;
constexpr double kFeet26 = power_of_two(-26) * kFoot;
constexpr double kTenthArcsecond256 = 0.1 * power_of_two(-8) * units::kArcsec;
constexpr double kKvhGyro = 0.1 / (3600.0 * 256.0);
constexpr double kKvhAccel = 0.05 * power_of_two(-15);

// Epson's counts are rates, here brought to increments at the rate of the type.
constexpr double epson_gyro(double deg_per_s, double rate_hz) {
  return deg_per_s * power_of_two(-16) * units::kDeg / rate_hz;
}
constexpr double epson_accel(double milli_g, double rate_hz) { return milli_g * power_of_two(-16) * kMilliG / rate_hz; }

}  // namespace

const std::vector<NovatelImuType>& novatel_imu_types() {
  // Source: the published scale factors as in NovAtel's open driver novatel_oem7_driver (MIT licence, revision 0c0e135,
  // src/oem7_imu.cpp); rates: OEM7 commands and logs reference manual, log RAWIMUSX.
  static const std::vector<NovatelImuType> types{
      {1, "HG1700_AG11", kRad33, kFeet27, 100.0},
      {4, "HG1700_AG17", kRad33, kFeet26, 100.0},
      {5, "HG1900_CA29", kRad33, kFeet27, 100.0},
      {8, "LN200", power_of_two(-19), power_of_two(-14), 200.0},
      {11, "HG1700_AG58", kRad33, kFeet27, 100.0},
      {12, "HG1700_AG62", kRad33, kFeet26, 100.0},
      {13, "IMAR_FSAS", kTenthArcsecond256, kKvhAccel, 200.0},
      {16, "KVH_COTS", kKvhGyro, kKvhAccel, 100.0},
      {20, "HG1930_AA99", kRad33, kFeet27, 100.0},
      {26, "ISA100C", 1e-9, 2e-8, 200.0},
      {27, "HG1900_CA50", kRad33, kFeet27, 100.0},
      {28, "HG1930_CA50", kRad33, kFeet27, 100.0},
      {31, "ADIS16488", 720.0 * power_of_two(-31) * units::kDeg, 200.0 * power_of_two(-31), 200.0},
      {32, "STIM300", power_of_two(-21) * units::kDeg, power_of_two(-22), 125.0},
      {33, "KVH_1750", kKvhGyro, kKvhAccel, 200.0},
      {41, "EPSON_G320N", epson_gyro(0.008, 125.0), epson_accel(0.2, 125.0), 125.0},
      {52, "LITEF_uIMU", 1e-9, 2e-8, 200.0},
      {56, "STIM300D", power_of_two(-21) * units::kDeg, power_of_two(-22), 125.0},
      {58, "HG4930_AN01", kRad33, power_of_two(-29), 100.0},
      {61, "EPSON_G370N", epson_gyro(0.0151515, 200.0), epson_accel(0.4, 200.0), 200.0},
      {62, "EPSON_G320N_200HZ", epson_gyro(0.008, 200.0), epson_accel(0.2, 200.0), 200.0},
      {68, "HG4930_AN04", kRad33, power_of_two(-29), 100.0}};
  return types;
}

const NovatelImuType* find_novatel_imu_type(std::uint32_t type) {
  const auto& types = novatel_imu_types();
  const auto found = std::find_if(types.begin(), types.end(), [type](const auto& known) { return known.type == type; });
  return found == types.end() ? nullptr : &*found;
}

}  // namespace inslab::novatel
