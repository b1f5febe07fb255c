#include "inslab/bus/client/run_client.hpp"

#include <spdlog/spdlog.h>

#include <cstdio>
#include <thread>

#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/shutdown.hpp"
#include "inslab/foundation/text/shown.hpp"

namespace inslab::client {

namespace {

streams::Identity of_any_set(const dds::Participant& participant) {
  streams::Identity own;
  own.service = participant.options().name;
  own.unit = participant.options().unit;
  return own;
}

}  // namespace

RunClient::RunClient(dds::Participant& participant) : RunClient(participant, of_any_set(participant)) {}

RunClient::RunClient(dds::Participant& participant, const streams::Identity& own)
    : run_(own.run_id, streams::RunFollower::Changes::WhenItEnded),
      writers_(participant.peers(), participant.key(), own),
      requests_(participant),
      command_(participant, dds::topics::sim_command()),
      status_reader_(participant, dds::topics::sim_status(),
                     writers_.only(dds::topics::sim_status(),
                                   [this](const SimStatus& status, const dds::SampleOrigin& origin) {
                                     hear(status, dds::participant_of(origin));
                                   })),
      ack_reader_(participant, dds::topics::profile_ack(),
                  writers_.only(dds::topics::profile_ack(), [this](const ProfileAck& ack, const dds::SampleOrigin&) {
                    const std::lock_guard<std::mutex> lock(mutex_);
                    acks_[ack.request_id].push_back(ack);
                  })) {}

void RunClient::hear(const SimStatus& status, const dds::ParticipantKey& server) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (run_.hear(status, host::monotonic_now()) != streams::RunFollower::Heard::OfAnother) {
    status_ = status;
    server_ = server;
    ++statuses_;
  } else if (other_run_.empty()) {
    other_run_ = "another run, " + host::run_id_text(status.run_id) + " of '" + text::shown(status.scenario) +
                 "', is in its place";
    spdlog::warn("{}", other_run_);
  }
}

std::string RunClient::other_run() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return other_run_;
}

bool RunClient::connected() const {
  constexpr int kOfTheServer = 2;  // a dds::OpenReader
  dds::ParticipantKey server;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!status_) return false;
    server = server_;
  }
  return requests_.least_readers_of(server) >= kOfTheServer && command_.matched_readers_of(server) >= kOfTheServer;
}

bool RunClient::send(const catalog::AnyProfile& request) {
  return std::visit([this](const auto& one) { return requests_.send(one); }, request);
}

bool RunClient::send(const SimCommand& command) { return command_.write(command); }

std::optional<SimStatus> RunClient::status() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return status_;
}

std::uint64_t RunClient::statuses() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return statuses_;
}

std::vector<ProfileAck> RunClient::acks(std::uint64_t request_id) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = acks_.find(request_id);
  return found == acks_.end() ? std::vector<ProfileAck>{} : found->second;
}

void listen_for(double seconds) {
  const time::Nanoseconds end = host::monotonic_now() + time::from_seconds(seconds);
  while (host::monotonic_now() < end && !host::shutdown_requested()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

LongWait::LongWait() : begun_(host::monotonic_now()) {}

void LongWait::tell(const std::string& what) {
  constexpr time::Nanoseconds kLong = std::chrono::seconds(2);
  if (told_ || host::monotonic_now() - begun_ < kLong) return;
  told_ = true;
  std::fprintf(stderr, "waits for %s\n", what.c_str());
}

bool wait_for(time::Nanoseconds deadline, const std::function<bool()>& condition, const std::string& what) {
  LongWait wait;
  while (!condition()) {
    if (host::monotonic_now() > deadline || host::shutdown_requested()) return false;
    wait.tell(what);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

}  // namespace inslab::client
