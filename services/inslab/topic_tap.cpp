#include "services/inslab/topic_tap.hpp"

#include <stdexcept>

#include "app/host.hpp"
#include "dds/reader.hpp"
#include "dds/topics.hpp"

namespace inslab::cli {

namespace {

using Callback = std::function<void(const TappedMessage&)>;

/// Opens a reader when a topic of the table has the name that is looked for.
class Opener {
 public:
  Opener(dds::Participant& participant, const std::string& wanted, Callback callback)
      : participant_(participant), wanted_(wanted), callback_(std::move(callback)) {}

  template <class T>
  void offer(const dds::Topic<T>& topic) {
    if (topic.name != wanted_) return;
    const io::LogType* type = io::find_log_type(wire::WireType<T>::name);
    reader = std::make_shared<dds::Reader<T>>(
        participant_, topic,
        [type, callback = callback_](const dds::Received<T>& sample, const dds::SampleOrigin&) {
          callback({*type, sample.cdr, app::realtime_now().count()});
        },
        dds::Reliability::BestEffort);
  }

  template <class Profile>
  void offer_profile() {
    offer(dds::topics::request<Profile>());
    offer(dds::topics::journal<Profile>());
  }

  std::shared_ptr<void> reader;

 private:
  dds::Participant& participant_;
  std::string wanted_;
  Callback callback_;
};

/// The number at the end of a sensor's topic; nothing when it is not a number.
std::optional<std::uint32_t> number_of(const std::string& topic) {
  const std::string digits = topic.substr(topic.rfind('/') + 1);
  if (digits.empty() || digits.size() > 2 || digits.find_first_not_of("0123456789") != std::string::npos) {
    return std::nullopt;
  }
  return static_cast<std::uint32_t>(std::stoul(digits));
}

}  // namespace

TopicTap::TopicTap(dds::Participant& participant, const std::string& topic, Callback callback) {
  Opener opener(participant, topic, std::move(callback));
  opener.offer(dds::topics::truth());
  if (const auto number = number_of(topic)) {
    opener.offer(dds::topics::imu(*number));
    opener.offer(dds::topics::imu_truth(*number));
    opener.offer(dds::topics::gnss(*number));
  }
  opener.offer(dds::topics::nav());
  opener.offer(dds::topics::vehicle_state());
  opener.offer(dds::topics::vehicle_state_used());
  opener.offer(dds::topics::vehicle_link());
  opener.offer(dds::topics::installation());
  opener.offer(dds::topics::sim_status());
  opener.offer(dds::topics::sim_command());
  opener.offer(dds::topics::service_status());
  opener.offer(dds::topics::time_mark());
  opener.offer(dds::topics::profile_ack());
  opener.offer_profile<ImuErrorProfile>();
  opener.offer_profile<VibrationProfile>();
  opener.offer_profile<InstallationProfile>();
  opener.offer_profile<GnssErrorProfile>();
  opener.offer_profile<FaultProfile>();
  if (!opener.reader) {
    throw std::invalid_argument(
        "no topic '" + topic +
        "'; expected inslab/truth, inslab/imu/N, inslab/imu_truth/N, inslab/gnss/N, inslab/nav, "
        "inslab/sim/status or another of the README's table");
  }
  reader_ = opener.reader;
}

}  // namespace inslab::cli
