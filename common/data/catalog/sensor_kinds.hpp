#pragma once

#include <optional>
#include <string>
#include <tuple>

#include "inslab/data/catalog/profile_kinds.hpp"
#include "inslab/data/samples/air_pressure.hpp"
#include "inslab/data/samples/airflow.hpp"
#include "inslab/data/samples/airflow_truth.hpp"
#include "inslab/data/samples/baseline_heading.hpp"
#include "inslab/data/samples/gnss_fix.hpp"
#include "inslab/data/samples/imu_sample.hpp"
#include "inslab/data/samples/imu_truth.hpp"
#include "inslab/data/samples/magnetic_field.hpp"
#include "inslab/data/samples/pulse_per_second.hpp"
#include "inslab/data/samples/wheel_travel.hpp"

/// The kinds of sensor that there are. What is done for every kind is made for each of SensorKinds: topics, log
/// channels, the services of a set and what they may do, offline and live run, the words of commands.
namespace inslab::catalog {

/// Who may read a stream besides the logger and the operator.
enum class Audience {
  App,      ///< the app under test
  Referee,  ///< nobody: it holds the truth
};

/// What a sensor puts out; the topic of sensor N is inslab/<name>/N.
template <class Sample>
struct Stream {
  const char* name;
  Audience audience;
  double nominal_rate_hz;  ///< sizes the histories of who does not know better
};

struct Imu {
  static constexpr SensorKind kind = SensorKind::Imu;
  static constexpr std::string_view name = "imu";  ///< in scenarios, metadata and messages
  static constexpr const char* singular = "IMU";
  static constexpr const char* plural = "IMUs";
  static constexpr const char* service = "inslab-imu-injector";
  static constexpr const char* service_title = "IMU error injector";
  static constexpr const char* purpose = "Turns the truth into what one IMU puts out";
  static constexpr std::tuple streams{Stream<ImuSample>{"imu", Audience::App, 200.0},
                                      Stream<ImuTruth>{"imu_truth", Audience::Referee, 200.0}};
  using Profiles = Types<ImuErrorProfile, VibrationProfile, InstallationProfile, FaultProfile>;
  static constexpr bool has_axes = true;            ///< its mounting has angles, not only a lever arm
  static constexpr bool sets_the_pace = true;       ///< an app answers each of its samples
  static constexpr bool in_every_set = true;        ///< missed where no scenario says which sensors there are
  static constexpr const char* mountings = "imu_";  ///< how files of config/profiles/installation for it begin
};

struct Gnss {
  static constexpr SensorKind kind = SensorKind::Gnss;
  static constexpr std::string_view name = "gnss";
  static constexpr const char* singular = "GNSS receiver";
  static constexpr const char* plural = "GNSS receivers";
  static constexpr const char* service = "inslab-gnss-emulator";
  static constexpr const char* service_title = "GNSS emulator";
  static constexpr const char* purpose = "Turns the truth into what one GNSS receiver reports";
  static constexpr std::tuple streams{Stream<GnssFix>{"gnss", Audience::App, 10.0},
                                      Stream<PulsePerSecond>{"gnss_pps", Audience::App, 1.0},
                                      Stream<PulseTruth>{"gnss_pps_truth", Audience::Referee, 1.0}};
  using Profiles = Types<GnssErrorProfile, InstallationProfile, FaultProfile>;
  static constexpr bool has_axes = false;
  static constexpr bool sets_the_pace = false;
  static constexpr bool in_every_set = true;
  static constexpr const char* mountings = "antenna_";
};

struct Magnetometer {
  static constexpr SensorKind kind = SensorKind::Magnetometer;
  static constexpr std::string_view name = "magnetometer";
  static constexpr const char* singular = "magnetometer";
  static constexpr const char* plural = "magnetometers";
  static constexpr const char* service = "inslab-magnetometer";
  static constexpr const char* service_title = "magnetometer";
  static constexpr const char* purpose = "Turns the truth into what one magnetometer puts out";
  static constexpr std::tuple streams{Stream<MagneticField>{"magnetometer", Audience::App, 100.0}};
  using Profiles = Types<MagnetometerErrorProfile, InstallationProfile, FaultProfile>;
  static constexpr bool has_axes = true;
  static constexpr bool sets_the_pace = false;
  static constexpr bool in_every_set = false;
  static constexpr const char* mountings = "magnetometer_";
};

struct Barometer {
  static constexpr SensorKind kind = SensorKind::Barometer;
  static constexpr std::string_view name = "barometer";
  static constexpr const char* singular = "barometer";
  static constexpr const char* plural = "barometers";
  static constexpr const char* service = "inslab-barometer";
  static constexpr const char* service_title = "barometer";
  static constexpr const char* purpose = "Turns the truth into what one barometer puts out";
  static constexpr std::tuple streams{Stream<AirPressure>{"barometer", Audience::App, 50.0}};
  using Profiles = Types<BarometerErrorProfile, InstallationProfile, FaultProfile>;
  static constexpr bool has_axes = false;
  static constexpr bool sets_the_pace = false;
  static constexpr bool in_every_set = false;
  static constexpr const char* mountings = "barometer_";
};

struct Odometer {
  static constexpr SensorKind kind = SensorKind::Odometer;
  static constexpr std::string_view name = "odometer";
  static constexpr const char* singular = "odometer";
  static constexpr const char* plural = "odometers";
  static constexpr const char* service = "inslab-odometer";
  static constexpr const char* service_title = "odometer";
  static constexpr const char* purpose = "Turns the truth into what one odometer puts out";
  static constexpr std::tuple streams{Stream<WheelTravel>{"odometer", Audience::App, 100.0}};
  using Profiles = Types<OdometerErrorProfile, InstallationProfile, FaultProfile>;
  static constexpr bool has_axes = true;
  static constexpr bool sets_the_pace = false;
  static constexpr bool in_every_set = false;
  static constexpr const char* mountings = "odometer_";
};

struct Heading {
  static constexpr SensorKind kind = SensorKind::Heading;
  static constexpr std::string_view name = "heading";
  static constexpr const char* singular = "two-antenna heading";
  static constexpr const char* plural = "two-antenna headings";
  static constexpr const char* service = "inslab-heading";
  static constexpr const char* service_title = "two-antenna heading";
  static constexpr const char* purpose = "Turns the truth into what one receiver with two antennas says of its heading";
  static constexpr std::tuple streams{Stream<BaselineHeading>{"heading", Audience::App, 10.0}};
  using Profiles = Types<HeadingErrorProfile, InstallationProfile, FaultProfile>;
  static constexpr bool has_axes = false;
  static constexpr bool sets_the_pace = false;
  static constexpr bool in_every_set = false;
  static constexpr const char* mountings = "heading_";
};

struct AirData {
  static constexpr SensorKind kind = SensorKind::AirData;
  static constexpr std::string_view name = "air_data";
  static constexpr const char* singular = "air data probe";
  static constexpr const char* plural = "air data probes";
  static constexpr const char* service = "inslab-air-data";
  static constexpr const char* service_title = "air data probe";
  static constexpr const char* purpose = "Turns the truth and the wind into what one air data probe puts out";
  static constexpr std::tuple streams{Stream<Airflow>{"air_data", Audience::App, 100.0},
                                      Stream<AirflowTruth>{"air_data_truth", Audience::Referee, 100.0}};
  using Profiles = Types<AirDataErrorProfile, InstallationProfile, FaultProfile>;
  static constexpr bool has_axes = true;
  static constexpr bool sets_the_pace = false;
  static constexpr bool in_every_set = false;
  static constexpr const char* mountings = "air_data_";
};

/// In the order of SensorKind, whose enumerators have the names.
using SensorKinds = Types<Imu, Gnss, Magnetometer, Barometer, Odometer, Heading, AirData>;

namespace detail {
template <class... Kind>
constexpr bool sensors_are_as_their_enumeration(Types<Kind...>) {
  std::size_t place = 0;
  return ((static_cast<std::size_t>(Kind::kind) == place && Kind::name == EnumNames<SensorKind>::values[place++]) &&
          ...) &&
         place == EnumNames<SensorKind>::values.size();
}

template <class Streams>
struct SamplesOf;
template <class... Sample>
struct SamplesOf<const std::tuple<Stream<Sample>...>> {
  using type = Types<Sample...>;
};

template <class Sample, class List>
struct SourceOf;
template <class Sample>
struct SourceOf<Sample, Types<>> {
  using type = void;
};
template <class Sample, class Kind, class... More>
struct SourceOf<Sample, Types<Kind, More...>> {
  static constexpr bool is_it = is_among<Sample, typename SamplesOf<decltype(Kind::streams)>::type>;
  using type = typename std::conditional_t<is_it, Tag<Kind>, SourceOf<Sample, Types<More...>>>::type;
};
}  // namespace detail
static_assert(detail::sensors_are_as_their_enumeration(SensorKinds{}));

/// The samples of a kind's streams, in their order.
template <class Kind>
using SamplesOf = typename detail::SamplesOf<decltype(Kind::streams)>::type;

/// Those of its first stream: what an app has of it.
template <class Kind>
using FirstSampleOf = std::tuple_element_t<0, Applied<std::tuple, SamplesOf<Kind>>>;

namespace detail {
template <class List>
struct AllSamples;
template <class... Kind>
struct AllSamples<Types<Kind...>> {
  using type = Joined<catalog::SamplesOf<Kind>...>;
};
}  // namespace detail

/// The samples of all sensors' streams.
using SensorSamples = typename detail::AllSamples<SensorKinds>::type;

/// The kind of sensor that puts out such samples; void: none does.
template <class Sample>
using SourceOf = typename detail::SourceOf<Sample, SensorKinds>::type;

template <class Sample>
inline constexpr bool is_of_a_sensor = !std::is_void_v<SourceOf<Sample>>;

/// The stream with such samples.
template <class Sample>
inline constexpr const Stream<Sample>& kStream = std::get<Stream<Sample>>(SourceOf<Sample>::streams);

/// Calls `visit` with the Tag of the kind.
template <class Visit>
void with_sensor(SensorKind kind, const Visit& visit) {
  for_each(SensorKinds{}, [&](auto sensor) {
    if (decltype(sensor)::type::kind == kind) visit(sensor);
  });
}

/// Whether sensors of this kind have such profiles.
template <class Kind, class Profile>
inline constexpr bool takes = is_among<Profile, typename Kind::Profiles>;
inline bool takes_profile(SensorKind sensor, ProfileKind profile) {
  bool takes_it = false;
  with_sensor(sensor, [&](auto kind) {
    for_each(typename decltype(kind)::type::Profiles{},
             [&](auto one) { takes_it = takes_it || decltype(one)::type::kind == profile; });
  });
  return takes_it;
}

/// Whom such profiles are for when nobody says: the first kind of sensor that has them.
inline SensorKind usual_sensor(ProfileKind profile) {
  std::optional<SensorKind> first;
  for_each(SensorKinds{}, [&](auto sensor) {
    constexpr SensorKind kind = decltype(sensor)::type::kind;
    if (!first && takes_profile(kind, profile)) first = kind;
  });
  return first.value();
}

/// The kinds of sensor that have such profiles: "imu or gnss".
inline std::string wearers(ProfileKind profile) {
  std::string names;
  for_each(SensorKinds{}, [&](auto sensor) {
    using Kind = typename decltype(sensor)::type;
    if (takes_profile(Kind::kind, profile)) names += (names.empty() ? "" : " or ") + std::string(Kind::name);
  });
  return names;
}

/// Whether the mounting of such a sensor has angles.
inline bool has_axes(SensorKind sensor) {
  bool has = false;
  with_sensor(sensor, [&has](auto kind) { has = decltype(kind)::type::has_axes; });
  return has;
}

}  // namespace inslab::catalog
