#pragma once

#include <string>

#include "inslab/foundation/fields/field.hpp"

/// What a scenario says of the sensors that help an INS beside GNSS and that need no more than their profiles.
namespace inslab::scenario {

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

}  // namespace inslab::scenario
