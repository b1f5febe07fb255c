#pragma once

#include <cstdint>
#include <vector>

#include "inslab/foundation/fields/field.hpp"

namespace inslab {
inline namespace samples {

/// How rough the air is, by the words of MIL-F-8785C.
enum class Turbulence : std::uint32_t { None, Light, Moderate, Severe };

template <>
struct EnumNames<Turbulence> {
  static constexpr std::string_view type = "Turbulence";
  static constexpr std::string_view prefix = "TURBULENCE_";
  static constexpr std::array<std::string_view, 4> values{"none", "light", "moderate", "severe"};
};

/// The mean wind at one height.
struct WindLevel {
  double height_m = 10.0;
  Vector3 wind_ned_m_per_s = Vector3::Zero();

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("height_m", "above the ground").in(0.1, 1e5).required(), self.height_m);
    visit(Field("wind_ned_m_per_s", "where the air moves to: a wind from the west is positive east")
              .in(-200.0, 200.0)
              .required(),
          self.wind_ned_m_per_s);
  }
};

/// How the air moves over the ground, a part of a profile; the law stands in models/air_data/mean_wind.hpp and
/// dryden_gusts.hpp.
struct WindField {
  double ground_height_m = 0.0;
  std::vector<WindLevel> levels;
  double power_law_exponent = 0.0;
  Turbulence turbulence = Turbulence::None;
  double turbulence_scale = 1.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("ground_height_m", "of the ground above the ellipsoid, from which heights count").in(-500.0, 9000.0),
          self.ground_height_m);
    visit(Field("levels", "the mean wind, from the ground up: straight lines between them; empty: none").at_most(32),
          self.levels);
    visit(Field("power_law_exponent",
                "below the lowest level the wind goes with this power of the height, with one level at every height; "
                "0: it stays, 1/7 is that of open land")
              .in(0.0, 1.0),
          self.power_law_exponent);
    visit(Field("turbulence", "Dryden gusts of MIL-F-8785C"), self.turbulence);
    visit(Field("turbulence_scale", "of their standard deviations").in(0.0, 10.0), self.turbulence_scale);
  }
};

}  // namespace samples
}  // namespace inslab
