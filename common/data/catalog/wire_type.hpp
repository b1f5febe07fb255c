#pragma once

#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "inslab/data/catalog/topics.hpp"

namespace inslab::catalog {

/// The module of idl/ that all types are in. Its last part is the version of the wire types: it goes up with every
/// change of a struct or an enumeration, so that a client built with other types does not match instead of reading
/// them wrong.
#define INSLAB_WIRE_MODULE "inslab::v5::"
inline constexpr std::string_view kModule = INSLAB_WIRE_MODULE;

/// The IDL name of every struct that travels as a topic, and the file of idl/ that declares it. This row is all that a
/// type needs to travel: a compiler asks for the row of each topic's type, and for the struct in idl/.
template <class T>
struct WireType;

#define INSLAB_WIRE_TYPE(Struct, File)                                   \
  template <>                                                            \
  struct WireType<samples::Struct> {                                     \
    static constexpr std::string_view name = INSLAB_WIRE_MODULE #Struct; \
    static constexpr std::string_view idl_file = File;                   \
  }

INSLAB_WIRE_TYPE(TruthState, "truth.idl");
INSLAB_WIRE_TYPE(ImuSample, "imu.idl");
INSLAB_WIRE_TYPE(ImuTruth, "imu.idl");
INSLAB_WIRE_TYPE(GnssFix, "gnss.idl");
INSLAB_WIRE_TYPE(PulsePerSecond, "gnss.idl");
INSLAB_WIRE_TYPE(PulseTruth, "gnss.idl");
INSLAB_WIRE_TYPE(MagneticField, "magnetometer.idl");
INSLAB_WIRE_TYPE(AirPressure, "barometer.idl");
INSLAB_WIRE_TYPE(WheelTravel, "odometer.idl");
INSLAB_WIRE_TYPE(BaselineHeading, "heading.idl");
INSLAB_WIRE_TYPE(Airflow, "air_data.idl");
INSLAB_WIRE_TYPE(AirflowTruth, "air_data.idl");
INSLAB_WIRE_TYPE(NavSolution, "nav.idl");
INSLAB_WIRE_TYPE(ImuErrorProfile, "profile.idl");
INSLAB_WIRE_TYPE(VibrationProfile, "profile.idl");
INSLAB_WIRE_TYPE(InstallationProfile, "profile.idl");
INSLAB_WIRE_TYPE(GnssErrorProfile, "profile.idl");
INSLAB_WIRE_TYPE(FaultProfile, "profile.idl");
INSLAB_WIRE_TYPE(MagnetometerErrorProfile, "profile.idl");
INSLAB_WIRE_TYPE(BarometerErrorProfile, "profile.idl");
INSLAB_WIRE_TYPE(OdometerErrorProfile, "profile.idl");
INSLAB_WIRE_TYPE(HeadingErrorProfile, "profile.idl");
INSLAB_WIRE_TYPE(AirDataErrorProfile, "profile.idl");
INSLAB_WIRE_TYPE(ProfileAck, "control.idl");
INSLAB_WIRE_TYPE(Installation, "control.idl");
INSLAB_WIRE_TYPE(SimCommand, "control.idl");
INSLAB_WIRE_TYPE(SimStatus, "control.idl");
INSLAB_WIRE_TYPE(TimeMark, "control.idl");
INSLAB_WIRE_TYPE(ServiceStatus, "control.idl");
INSLAB_WIRE_TYPE(VehicleState, "vehicle.idl");
INSLAB_WIRE_TYPE(UsedVehicleState, "vehicle.idl");
INSLAB_WIRE_TYPE(VehicleLink, "vehicle.idl");
INSLAB_WIRE_TYPE(Credit, "control.idl");

#undef INSLAB_WIRE_TYPE

#define INSLAB_BLOCK_TYPE(Struct, IdlName)                               \
  template <>                                                            \
  struct WireType<samples::Block<samples::Struct>> {                     \
    static constexpr std::string_view name = INSLAB_WIRE_MODULE IdlName; \
    static constexpr std::string_view idl_file = "block.idl";            \
  }

INSLAB_BLOCK_TYPE(TruthState, "TruthBlock");
INSLAB_BLOCK_TYPE(ImuSample, "ImuBlock");
INSLAB_BLOCK_TYPE(ImuTruth, "ImuTruthBlock");
INSLAB_BLOCK_TYPE(GnssFix, "GnssBlock");
INSLAB_BLOCK_TYPE(PulsePerSecond, "PulsePerSecondBlock");
INSLAB_BLOCK_TYPE(PulseTruth, "PulseTruthBlock");
INSLAB_BLOCK_TYPE(MagneticField, "MagneticFieldBlock");
INSLAB_BLOCK_TYPE(AirPressure, "AirPressureBlock");
INSLAB_BLOCK_TYPE(WheelTravel, "WheelTravelBlock");
INSLAB_BLOCK_TYPE(BaselineHeading, "BaselineHeadingBlock");
INSLAB_BLOCK_TYPE(Airflow, "AirflowBlock");
INSLAB_BLOCK_TYPE(AirflowTruth, "AirflowTruthBlock");
INSLAB_BLOCK_TYPE(NavSolution, "NavBlock");

#undef INSLAB_BLOCK_TYPE
#undef INSLAB_WIRE_MODULE

/// The samples that travel in blocks too: the server's, the sensors' and the app's.
using StreamSamples = Joined<Types<TruthState>, SensorSamples, Types<NavSolution>>;
using Blocks = Mapped<samples::Block, StreamSamples>;

namespace detail {
template <class Topics>
struct TypesOf;
template <class... T, bool... has_blocks>
struct TypesOf<const std::tuple<Topic<T, has_blocks>...>> {
  static_assert(((is_among<T, StreamSamples> == has_blocks) && ...), "StreamSamples has each topic with blocks");
  using without_blocks = Joined<std::conditional_t<has_blocks, Types<>, Types<T>>...>;
};
}  // namespace detail

/// Every type that travels as a topic by itself: `Of` is given them all, as testing::Types is in tests.
using WireTypes = Joined<StreamSamples, ProfileKinds, typename detail::TypesOf<decltype(kTopics)>::without_blocks>;
template <template <class...> class Of>
using EveryWireType = Applied<Of, WireTypes>;

/// Those and the blocks.
using TravellingTypes = Joined<WireTypes, Blocks>;

}  // namespace inslab::catalog
