#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "inslab/data/catalog/profile_rules.hpp"
#include "inslab/data/json/json_reader.hpp"

/// The profiles that come with the product: each is read strictly, breaks no rule, and bears its file's name.
namespace inslab::scenario {
namespace profile_files_test {

std::filesystem::path folder(const std::string& kind) {
  return std::filesystem::path(INSLAB_SOURCE_DIR) / "config" / "profiles" / kind;
}

/// Files of an installation begin with a word of the kind of sensor that they are for; others are for any.
SensorKind wearer_of(const std::string& name, SensorKind usual) {
  SensorKind kind = usual;
  for_each(catalog::SensorKinds{}, [&](auto tag) {
    using Kind = typename decltype(tag)::type;
    if (name.rfind(Kind::mountings, 0) == 0) kind = Kind::kind;
  });
  return kind;
}

template <class Profile>
void check_files(const std::string& kind, const std::set<std::string>& expected) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder(kind))) {
    auto profile = json::read_file<Profile>(entry.path());
    if (Profile::kind == ProfileKind::Installation) {
      profile.target.kind = wearer_of(entry.path().stem().string(), profile.target.kind);
    }
    const auto broken = catalog::violation(profile);
    EXPECT_FALSE(broken.has_value()) << entry.path() << ": " << broken->path << ' ' << broken->reason;
    EXPECT_EQ(profile.name, entry.path().stem().string());
    EXPECT_FALSE(profile.source.empty()) << entry.path();
    names.insert(profile.name);
  }
  for (const std::string& name : expected) EXPECT_EQ(names.count(name), 1U) << kind << '/' << name;
}

TEST(ProfileFiles, ImuProfilesAreValid) {
  check_files<ImuErrorProfile>(
      "imu", {"ideal", "pos830", "stim300", "adis16488", "mems_automotive", "grade_marine", "grade_aviation",
              "grade_intermediate", "grade_tactical", "grade_automotive", "span100c", "every_term", "pos830_thesis",
              "stim300_thesis", "adis16488_thesis", "pos830_full", "stim300_full", "adis16488_full"});
}

TEST(ProfileFiles, VibrationProfilesAreValid) {
  check_files<VibrationProfile>("vibration",
                                {"none", "car", "car_rough_road", "rotorcraft", "fixed_wing", "ship_engine", "launch"});
}

TEST(ProfileFiles, InstallationProfilesAreValid) {
  check_files<InstallationProfile>(
      "installation", {"centre", "imu_trunk", "antenna_roof", "antenna_trunk", "imu_avionics_bay", "antenna_fuselage",
                       "heading_roof", "heading_across"});
}

TEST(ProfileFiles, GnssProfilesAreValid) {
  check_files<GnssErrorProfile>(
      "gnss", {"rtk", "rtk_white", "rtk_coloured", "ppp", "dgnss", "single_point", "degraded_urban", "rtk_pulses"});
}

TEST(ProfileFiles, AirDataProfilesAreValid) {
  check_files<AirDataErrorProfile>("air_data", {"ms4525do", "sdp33_rough_air"});
}

TEST(ProfileFiles, HeadingProfilesAreValid) {
  check_files<HeadingErrorProfile>("heading", {"mosaic_h", "zed_f9p_moving_base"});
}

/// Grows where a term is declared that the example leaves out.
struct NumbersAtZero {
  std::vector<std::string> names;

  template <class T>
  void operator()(const Field& field, const T& value) {
    if constexpr (std::is_same_v<T, double>) {
      if (value == 0.0) names.emplace_back(field.name);
    } else if constexpr (std::is_same_v<T, Vector3> || std::is_same_v<T, Vector6> || std::is_same_v<T, Vector9>) {
      if (value.isZero(0.0)) names.emplace_back(field.name);
    }
  }
};

TEST(ProfileFiles, TheExampleOfEveryTermHasEveryTerm) {
  const auto profile = json::read_file<ImuErrorProfile>(folder("imu") / "every_term.json");
  NumbersAtZero zeros;
  GyroErrors::fields(profile.gyro, zeros);
  AccelErrors::fields(profile.accel, zeros);
  ImuErrorProfile::fields(profile, zeros);
  EXPECT_EQ(zeros.names, std::vector<std::string>());
  EXPECT_FALSE(profile.temperature.empty());
}

TEST(ProfileFiles, AScalarMeansAllThreeAxes) {
  const auto stim300 = json::read_file<ImuErrorProfile>(folder("imu") / "stim300.json");
  EXPECT_EQ(stim300.gyro.bias_gm_sigma_deg_per_h, Vector3::Constant(0.5));
  EXPECT_EQ(stim300.accel.vrw_m_per_s_per_sqrt_h, Vector3::Constant(0.07));
}

}  // namespace profile_files_test
}  // namespace inslab::scenario
