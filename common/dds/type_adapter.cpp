// The generated headers come first: they name their types without a namespace, which would be ambiguous after ours.
// clang-format off
#include "blockPubSubTypes.h"
#include "controlPubSubTypes.h"
#include "gnssPubSubTypes.h"
#include "imuPubSubTypes.h"
#include "navPubSubTypes.h"
#include "profilePubSubTypes.h"
#include "truthPubSubTypes.h"
#include "vehiclePubSubTypes.h"
// clang-format on

#include "dds/type_adapter.hpp"

#include <mutex>

namespace inslab::dds {

bool GeneratedType::key_of(std::vector<std::uint8_t>& cdr, eprosima::fastrtps::rtps::InstanceHandle_t& handle) const {
  // The generated code keeps its key buffer in the type object, which all threads of a participant share.
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  eprosima::fastrtps::rtps::SerializedPayload_t payload;
  payload.data = cdr.data();
  payload.length = static_cast<std::uint32_t>(cdr.size());
  payload.max_size = payload.length;
  void* sample = type_->createData();
  const bool ok = type_->deserialize(&payload, sample) && type_->getKey(sample, &handle, false);
  type_->deleteData(sample);
  payload.data = nullptr;  // not the payload's to free
  return ok;
}

#define INSLAB_GENERATED_TYPE(Struct)                                       \
  template <>                                                               \
  GeneratedType generated_type<samples::Struct>() {                         \
    return GeneratedType(std::make_unique<::inslab::Struct##PubSubType>()); \
  }

INSLAB_GENERATED_TYPE(TruthState)
INSLAB_GENERATED_TYPE(ImuSample)
INSLAB_GENERATED_TYPE(ImuTruth)
INSLAB_GENERATED_TYPE(GnssFix)
INSLAB_GENERATED_TYPE(NavSolution)
INSLAB_GENERATED_TYPE(ImuErrorProfile)
INSLAB_GENERATED_TYPE(VibrationProfile)
INSLAB_GENERATED_TYPE(InstallationProfile)
INSLAB_GENERATED_TYPE(GnssErrorProfile)
INSLAB_GENERATED_TYPE(FaultProfile)
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

#define INSLAB_GENERATED_BLOCK(Struct, IdlName)                              \
  template <>                                                                \
  GeneratedType generated_type<samples::Block<samples::Struct>>() {          \
    return GeneratedType(std::make_unique<::inslab::IdlName##PubSubType>()); \
  }

INSLAB_GENERATED_BLOCK(TruthState, TruthBlock)
INSLAB_GENERATED_BLOCK(ImuSample, ImuBlock)
INSLAB_GENERATED_BLOCK(ImuTruth, ImuTruthBlock)
INSLAB_GENERATED_BLOCK(GnssFix, GnssBlock)
INSLAB_GENERATED_BLOCK(NavSolution, NavBlock)

#undef INSLAB_GENERATED_BLOCK

}  // namespace inslab::dds
