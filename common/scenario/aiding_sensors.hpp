#pragma once

#include <string>
#include <vector>

#include "inslab/data/samples/outage.hpp"

/// What a scenario says of the sensors that help an INS beside GNSS.
namespace inslab::scenario {

/// The model of the Earth's magnetic field, and whether its five years bind.
enum class MagneticModel : std::uint32_t { Wmm2025, Wmm2025Extrapolated };

/// One magnetometer of the unit. Without an error profile it is ideal.
struct MagnetometerSensor {
  std::uint32_t number = 0;
  double rate_hz = 100.0;
  std::string error_profile;
  std::string installation_profile;
  std::string nominal_installation_profile;
  MagneticModel field = MagneticModel::Wmm2025;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("number", "the N of inslab/magnetometer/N").in(0.0, 63.0), self.number);
    visit(Field("rate_hz", "of its samples").in(1e-3, 1e4).required(), self.rate_hz);
    visit(Field("error_profile", "file; absent: an ideal magnetometer").at_most(4096), self.error_profile);
    visit(Field("installation_profile", "file; absent: at the vehicle's reference point").at_most(4096),
          self.installation_profile);
    visit(Field("nominal_installation_profile", "file: what the app is told; absent: the true one").at_most(4096),
          self.nominal_installation_profile);
    visit(
        Field("field",
              "the Earth's: the World Magnetic Model 2025 from 2025 to the end of 2029, or in its straight line at any "
              "date"),
        self.field);
  }
};

/// One barometer of the unit. Without an error profile it is ideal.
struct BarometerSensor {
  std::uint32_t number = 0;
  double rate_hz = 50.0;
  std::string error_profile;
  std::string installation_profile;
  std::string nominal_installation_profile;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("number", "the N of inslab/barometer/N").in(0.0, 63.0), self.number);
    visit(Field("rate_hz", "of its samples").in(1e-3, 1e4).required(), self.rate_hz);
    visit(Field("error_profile", "file; absent: an ideal barometer").at_most(4096), self.error_profile);
    visit(Field("installation_profile", "file; absent: at the vehicle's reference point").at_most(4096),
          self.installation_profile);
    visit(Field("nominal_installation_profile", "file: what the app is told; absent: the true one").at_most(4096),
          self.nominal_installation_profile);
  }
};

/// One odometer of the unit. Without an error profile it is ideal.
struct OdometerSensor {
  std::uint32_t number = 0;
  double rate_hz = 100.0;
  std::string error_profile;
  std::string installation_profile;
  std::string nominal_installation_profile;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("number", "the N of inslab/odometer/N").in(0.0, 63.0), self.number);
    visit(Field("rate_hz", "of its samples").in(1e-3, 1e4).required(), self.rate_hz);
    visit(Field("error_profile", "file; absent: an ideal odometer").at_most(4096), self.error_profile);
    visit(Field("installation_profile", "file; absent: the wheel stands under the vehicle's reference point")
              .at_most(4096),
          self.installation_profile);
    visit(Field("nominal_installation_profile", "file: what the app is told; absent: the true one").at_most(4096),
          self.nominal_installation_profile);
  }
};

/// One receiver with two antennas of the unit. Without an error profile it is ideal.
struct HeadingSensor {
  std::uint32_t number = 0;
  double rate_hz = 10.0;
  std::string error_profile;
  std::string installation_profile;
  std::string nominal_installation_profile;
  std::vector<Outage> outages;
  std::vector<OutageArea> outage_areas;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("number", "the N of inslab/heading/N").in(0.0, 63.0), self.number);
    visit(Field("rate_hz", "of its samples").in(1e-3, 1e4).required(), self.rate_hz);
    visit(Field("error_profile", "file; absent: an ideal receiver").at_most(4096), self.error_profile);
    visit(Field("installation_profile", "file: where the two antennas stand").at_most(4096).required(),
          self.installation_profile);
    visit(Field("nominal_installation_profile", "file: what the app is told; absent: the true one").at_most(4096),
          self.nominal_installation_profile);
    visit(Field("outages", "no signals in these").at_most(10000), self.outages);
    visit(Field("outage_areas", "no signals while the first antenna is in these").at_most(1000), self.outage_areas);
  }
};

/// One air data probe of the unit. Without an error profile it is ideal, and the air is still.
struct AirDataSensor {
  std::uint32_t number = 0;
  double rate_hz = 100.0;
  std::string error_profile;
  std::string installation_profile;
  std::string nominal_installation_profile;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("number", "the N of inslab/air_data/N").in(0.0, 63.0), self.number);
    visit(Field("rate_hz", "of its samples").in(1e-3, 1e4).required(), self.rate_hz);
    visit(Field("error_profile", "file; absent: an ideal probe in still air").at_most(4096), self.error_profile);
    visit(Field("installation_profile", "file; absent: at the vehicle's reference point").at_most(4096),
          self.installation_profile);
    visit(Field("nominal_installation_profile", "file: what the app is told; absent: the true one").at_most(4096),
          self.nominal_installation_profile);
  }
};

}  // namespace inslab::scenario

namespace inslab {

template <>
struct EnumNames<scenario::MagneticModel> {
  static constexpr std::string_view type = "MagneticModel";
  static constexpr std::string_view prefix = "MAGNETIC_MODEL_";
  static constexpr std::array<std::string_view, 2> values{"wmm2025", "wmm2025_extrapolated"};
};

}  // namespace inslab
