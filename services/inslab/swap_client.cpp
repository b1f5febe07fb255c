#include "services/inslab/swap_client.hpp"

namespace inslab::cli {

SwapClient::SwapClient(dds::Participant& participant)
    : imu_error_(participant, dds::topics::request<ImuErrorProfile>()),
      vibration_(participant, dds::topics::request<VibrationProfile>()),
      installation_(participant, dds::topics::request<InstallationProfile>()),
      gnss_error_(participant, dds::topics::request<GnssErrorProfile>()),
      fault_(participant, dds::topics::request<FaultProfile>()),
      command_(participant, dds::topics::sim_command()),
      status_reader_(participant, dds::topics::sim_status(),
                     [this](const SimStatus& status, const dds::SampleOrigin&) {
                       const std::lock_guard<std::mutex> lock(mutex_);
                       status_ = status;
                     }),
      ack_reader_(participant, dds::topics::profile_ack(), [this](const ProfileAck& ack, const dds::SampleOrigin&) {
        const std::lock_guard<std::mutex> lock(mutex_);
        acks_[ack.request_id].push_back(ack);
      }) {}

bool SwapClient::connected() const {
  return imu_error_.matched_readers() > 0 && vibration_.matched_readers() > 0 && installation_.matched_readers() > 0 &&
         gnss_error_.matched_readers() > 0 && fault_.matched_readers() > 0 && command_.matched_readers() > 0;
}

bool SwapClient::send(const AnyProfile& request) {
  struct Send {
    SwapClient& client;
    bool operator()(const ImuErrorProfile& p) const { return client.imu_error_.write(p); }
    bool operator()(const VibrationProfile& p) const { return client.vibration_.write(p); }
    bool operator()(const InstallationProfile& p) const { return client.installation_.write(p); }
    bool operator()(const GnssErrorProfile& p) const { return client.gnss_error_.write(p); }
    bool operator()(const FaultProfile& p) const { return client.fault_.write(p); }
  };
  return std::visit(Send{*this}, request);
}

bool SwapClient::stop() { return command_.write({1, CommandKind::Stop}); }

std::optional<SimStatus> SwapClient::status() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return status_;
}

std::vector<ProfileAck> SwapClient::acks(std::uint64_t request_id) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = acks_.find(request_id);
  return found == acks_.end() ? std::vector<ProfileAck>{} : found->second;
}

}  // namespace inslab::cli
