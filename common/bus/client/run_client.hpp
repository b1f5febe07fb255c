#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "inslab/bus/client/run_link.hpp"
#include "inslab/bus/dds/reader.hpp"
#include "inslab/bus/dds/writer.hpp"
#include "inslab/bus/service/writers.hpp"
#include "inslab/data/catalog/any_profile.hpp"
#include "inslab/data/streams/run_follower.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::client {

/// A client of a running set: sends requests for swaps and commands, hears acknowledgements and how the run goes. It
/// follows one run until that has ended, the first that it hears of its set's trajectory server; what is said of
/// another one meanwhile, or by somebody else, is left out, and said in the log.
class RunClient : public RunLink {
 public:
  /// Of whatever set is in the participant's unit, and of its next run when one has ended.
  explicit RunClient(dds::Participant& participant);
  /// Of the set that has this process's scenario and run, and of no other run.
  RunClient(dds::Participant& participant, const streams::Identity& own);

  bool connected() const override;
  bool send(const catalog::AnyProfile& request) override;
  bool send(const SimCommand& command) override;
  std::optional<SimStatus> status() const override;
  std::uint64_t statuses() const override;
  std::string other_run() const override;
  std::vector<ProfileAck> acks(std::uint64_t request_id) const override;

  /// Who may speak in this set.
  service::Writers& writers() { return writers_; }

 private:
  void hear(const SimStatus& status, const dds::ParticipantKey& server);

  /// A writer of the requests for each kind of profile.
  template <class... Profile>
  struct RequestWriters : dds::Writer<Profile>... {
    explicit RequestWriters(dds::Participant& participant)
        : dds::Writer<Profile>(participant, dds::topics::request<Profile>())... {}

    template <class One>
    bool send(const One& request) {
      return static_cast<dds::Writer<One>&>(*this).write(request);
    }
    /// How many readers of that participant each kind has at least.
    int least_readers_of(const dds::ParticipantKey& participant) const {
      return std::min({static_cast<const dds::Writer<Profile>&>(*this).matched_readers_of(participant)...});
    }
  };

  streams::RunFollower run_;
  service::Writers writers_;
  Applied<RequestWriters, catalog::ProfileKinds> requests_;
  dds::Writer<SimCommand> command_;
  mutable std::mutex mutex_;
  std::optional<SimStatus> status_;
  dds::ParticipantKey server_{};  ///< who says it
  std::uint64_t statuses_ = 0;
  std::string other_run_;
  std::map<std::uint64_t, std::vector<ProfileAck>> acks_;
  dds::Reader<SimStatus> status_reader_;
  dds::Reader<ProfileAck> ack_reader_;
};

/// Waits until `condition` holds; false at the deadline (CLOCK_MONOTONIC) or at a signal. A wait that grows long says
/// on the error output what it waits for.
bool wait_for(time::Nanoseconds deadline, const std::function<bool()>& condition, const std::string& what);

/// Sleeps for so long, or until a signal.
void listen_for(double seconds);

/// Says after two seconds, once, what is waited for.
class LongWait {
 public:
  LongWait();
  /// Call now and then while the wait goes on.
  void tell(const std::string& what);

 private:
  time::Nanoseconds begun_;
  bool told_ = false;
};

}  // namespace inslab::client
