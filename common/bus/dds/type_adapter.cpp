// The generated headers come first: they name their types without a namespace, which would be ambiguous after ours.
// clang-format off
#include "blockPubSubTypes.hpp"
#include "controlPubSubTypes.hpp"
#include "gnssPubSubTypes.hpp"
#include "imuPubSubTypes.hpp"
#include "magnetometerPubSubTypes.hpp"
#include "navPubSubTypes.hpp"
#include "profilePubSubTypes.hpp"
#include "truthPubSubTypes.hpp"
#include "vehiclePubSubTypes.hpp"
// clang-format on

#include "inslab/bus/dds/type_adapter.hpp"

#include <mutex>

namespace inslab::dds {

namespace types = ::inslab::v2;  // the generated ones

bool GeneratedType::key_of(std::vector<std::uint8_t>& cdr, fast_dds::Handle& handle) const {
  // The generated code keeps its key buffer in the type object, which all threads of a participant share.
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  fast_dds::Payload payload;
  payload.data = cdr.data();
  payload.length = static_cast<std::uint32_t>(cdr.size());
  payload.max_size = payload.length;
  const bool ok = fast_dds::key_of(*type_, payload, handle);
  payload.data = nullptr;  // not the payload's to free
  return ok;
}

template <class T>
static std::unique_ptr<fast_dds::TopicDataType> new_adapter(
    const std::shared_ptr<std::atomic<std::uint32_t>>& refused) {
  return std::make_unique<TypeAdapter<T>>(refused);
}

#define INSLAB_TYPE(Struct, IdlName)                                      \
  template <>                                                             \
  GeneratedType generated_type<Struct>() {                                \
    return GeneratedType(std::make_unique<types::IdlName##PubSubType>()); \
  }                                                                       \
  template <>                                                             \
  std::unique_ptr<fast_dds::TopicDataType> type_adapter<Struct>(          \
      const std::shared_ptr<std::atomic<std::uint32_t>>& refused) {       \
    return new_adapter<Struct>(refused);                                  \
  }
#define INSLAB_GENERATED_TYPE(Struct) INSLAB_TYPE(samples::Struct, Struct)

INSLAB_GENERATED_TYPE(TruthState)
INSLAB_GENERATED_TYPE(ImuSample)
INSLAB_GENERATED_TYPE(ImuTruth)
INSLAB_GENERATED_TYPE(GnssFix)
INSLAB_GENERATED_TYPE(MagneticField)
INSLAB_GENERATED_TYPE(NavSolution)
INSLAB_GENERATED_TYPE(ImuErrorProfile)
INSLAB_GENERATED_TYPE(VibrationProfile)
INSLAB_GENERATED_TYPE(InstallationProfile)
INSLAB_GENERATED_TYPE(GnssErrorProfile)
INSLAB_GENERATED_TYPE(FaultProfile)
INSLAB_GENERATED_TYPE(MagnetometerErrorProfile)
INSLAB_GENERATED_TYPE(ProfileAck)
INSLAB_GENERATED_TYPE(Installation)
INSLAB_GENERATED_TYPE(SimCommand)
INSLAB_GENERATED_TYPE(SimStatus)
INSLAB_GENERATED_TYPE(TimeMark)
INSLAB_GENERATED_TYPE(ServiceStatus)
INSLAB_GENERATED_TYPE(VehicleState)
INSLAB_GENERATED_TYPE(UsedVehicleState)
INSLAB_GENERATED_TYPE(VehicleLink)
INSLAB_GENERATED_TYPE(Credit)

#undef INSLAB_GENERATED_TYPE

#define INSLAB_GENERATED_BLOCK(Struct, IdlName) INSLAB_TYPE(samples::Block<samples::Struct>, IdlName)

INSLAB_GENERATED_BLOCK(TruthState, TruthBlock)
INSLAB_GENERATED_BLOCK(ImuSample, ImuBlock)
INSLAB_GENERATED_BLOCK(ImuTruth, ImuTruthBlock)
INSLAB_GENERATED_BLOCK(GnssFix, GnssBlock)
INSLAB_GENERATED_BLOCK(MagneticField, MagneticFieldBlock)
INSLAB_GENERATED_BLOCK(NavSolution, NavBlock)

#undef INSLAB_GENERATED_BLOCK
#undef INSLAB_TYPE

}  // namespace inslab::dds
