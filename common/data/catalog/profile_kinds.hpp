#pragma once

#include "inslab/data/profiles/air_data_error_profile.hpp"
#include "inslab/data/profiles/barometer_error_profile.hpp"
#include "inslab/data/profiles/fault_profile.hpp"
#include "inslab/data/profiles/gnss_error_profile.hpp"
#include "inslab/data/profiles/heading_error_profile.hpp"
#include "inslab/data/profiles/imu_error_profile.hpp"
#include "inslab/data/profiles/installation_profile.hpp"
#include "inslab/data/profiles/magnetometer_error_profile.hpp"
#include "inslab/data/profiles/odometer_error_profile.hpp"
#include "inslab/data/profiles/vibration_profile.hpp"
#include "inslab/foundation/fields/types.hpp"

/// The kinds of profile that there are. Topics, log channels, words on the command line, schemas, IDL and the pages
/// that follow from them are made for each of this list.
namespace inslab::catalog {

/// In the order of ProfileKind, whose enumerators have the names.
using ProfileKinds = Types<ImuErrorProfile, VibrationProfile, InstallationProfile, GnssErrorProfile, FaultProfile,
                           MagnetometerErrorProfile, BarometerErrorProfile, OdometerErrorProfile, HeadingErrorProfile,
                           AirDataErrorProfile>;

/// What a kind of profile is called besides its name.
struct ProfileWords {
  std::string_view word;      ///< on the command line, beside the name
  std::string_view title;     ///< of its section in docs/parameters.md
  std::string_view document;  ///< a file of it, without an article: "IMU error profile"
  std::string_view article;
  std::string_view folder;   ///< below config/profiles
  std::string_view meaning;  ///< for the IDL
};

namespace detail {
template <class Profile>
constexpr ProfileWords no_words_for();  // every kind of profile has words of its own
}
template <class Profile>
inline constexpr ProfileWords kWords = detail::no_words_for<Profile>();

template <>
inline constexpr ProfileWords kWords<ImuErrorProfile>{"imu", "IMU errors", "IMU error profile",
                                                      "an",  "imu",        "how one IMU errs"};
template <>
inline constexpr ProfileWords kWords<VibrationProfile>{"vibration", "Vibration", "vibration profile",
                                                       "a",         "vibration", "what shakes one IMU"};
template <>
inline constexpr ProfileWords kWords<InstallationProfile>{"installation", "Installation", "installation profile",
                                                          "an",           "installation", "where a sensor truly sits"};
template <>
inline constexpr ProfileWords kWords<GnssErrorProfile>{"gnss", "GNSS errors", "GNSS error profile",
                                                       "a",    "gnss",        "how one GNSS receiver errs"};
template <>
inline constexpr ProfileWords kWords<FaultProfile>{"fault", "Fault", "fault profile",
                                                   "a",     "fault", "faults of one sensor"};

template <>
inline constexpr ProfileWords kWords<MagnetometerErrorProfile>{
    "magnetometer", "Magnetometer errors",      "magnetometer error profile", "a",
    "magnetometer", "how one magnetometer errs"};

template <>
inline constexpr ProfileWords kWords<BarometerErrorProfile>{"barometer", "Barometer errors", "barometer error profile",
                                                            "a",         "barometer",        "how one barometer errs"};

template <>
inline constexpr ProfileWords kWords<OdometerErrorProfile>{"odometer", "Odometer errors", "odometer error profile",
                                                           "an",       "odometer",        "how one odometer errs"};

template <>
inline constexpr ProfileWords kWords<HeadingErrorProfile>{"heading",
                                                          "Two-antenna heading errors",
                                                          "heading error profile",
                                                          "a",
                                                          "heading",
                                                          "how one receiver with two antennas errs"};

template <>
inline constexpr ProfileWords kWords<AirDataErrorProfile>{"air_data", "Air data errors", "air data error profile",
                                                          "an",       "air_data",        "how one air data probe errs"};

namespace detail {
template <class... Profile>
constexpr bool stand_in_the_order_of_their_enumeration(Types<Profile...>) {
  std::size_t place = 0;
  return ((static_cast<std::size_t>(Profile::kind) == place++) && ...) &&
         place == EnumNames<ProfileKind>::values.size();
}
}  // namespace detail
static_assert(detail::stand_in_the_order_of_their_enumeration(ProfileKinds{}));

/// Calls `visit` with the Tag of the profile's type.
template <class Visit>
void with_profile(ProfileKind kind, const Visit& visit) {
  for_each(ProfileKinds{}, [&](auto profile) {
    if (decltype(profile)::type::kind == kind) visit(profile);
  });
}

}  // namespace inslab::catalog
