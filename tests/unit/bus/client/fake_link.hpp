#pragma once

#include <map>

#include "inslab/bus/client/run_link.hpp"

namespace inslab::test {

/// A running set as its client sees it.
class FakeLink : public client::RunLink {
 public:
  bool connected() const override { return is_connected; }
  bool send(const catalog::AnyProfile& request) override {
    if (takes_requests) requests.push_back(request);
    return takes_requests;
  }
  bool send(const SimCommand& command) override {
    commands.push_back(command);
    return true;
  }
  std::optional<SimStatus> status() const override { return last_status; }
  std::uint64_t statuses() const override { return status_count; }
  std::string other_run() const override { return other; }
  std::vector<ProfileAck> acks(std::uint64_t request_id) const override {
    const auto found = answers.find(request_id);
    return found == answers.end() ? std::vector<ProfileAck>{} : std::vector<ProfileAck>{found->second};
  }

  void hear(RunState state, double sim_time_s, std::uint32_t journal_entries = 0) {
    last_status = SimStatus{};
    last_status->run_id.bytes.fill(1);
    last_status->state = state;
    last_status->sim_time_ns = static_cast<std::int64_t>(sim_time_s * 1e9);
    last_status->journal_entries = journal_entries;
    ++status_count;
  }
  void answer(std::uint64_t request_id, AckOutcome outcome) {
    ProfileAck ack;
    ack.request_id = request_id;
    ack.outcome = outcome;
    answers[request_id] = ack;
  }

  bool is_connected = true;
  bool takes_requests = true;
  std::optional<SimStatus> last_status;
  std::uint64_t status_count = 0;
  std::string other;
  std::vector<catalog::AnyProfile> requests;
  std::vector<SimCommand> commands;
  std::map<std::uint64_t, ProfileAck> answers;
};

/// A swap of an IMU with this request id.
inline catalog::AnyProfile imu_swap(std::uint64_t request_id) {
  ImuErrorProfile profile;
  profile.request.request_id = request_id;
  return profile;
}

}  // namespace inslab::test
