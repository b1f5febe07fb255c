#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "inslab/bus/service/service.hpp"
#include "inslab/data/samples/stream_header.hpp"
#include "inslab/data/state/checkpoint_file.hpp"
#include "inslab/data/state/state_stream.hpp"

namespace inslab::service {

/// What begins every checkpoint: which run of which scenario it belongs to, and when it was kept.
struct CheckpointHead {
  RunId run_id;
  std::string scenario;
  std::uint64_t seed = 0;
  std::int64_t kept_realtime_ns = 0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("run_id"), self.run_id);
    visit(Field("scenario"), self.scenario);
    visit(Field("seed"), self.seed);
    visit(Field("kept_realtime_ns"), self.kept_realtime_ns);
  }
};

/// Where a service keeps what it needs to go on after a SIGKILL: one small file for each run in the folder --state,
/// gone when the run has ended in order. Without a place for it the service runs all the same and says that it could
/// not go on.
class Checkpoint {
 public:
  explicit Checkpoint(const Context& context);

  /// Whether a process before this one left a state: it did not end in order.
  bool left_behind() const;
  /// From now on `run` is the run; what was kept of another one is not needed.
  void begin(const RunId& run);
  /// The run has ended in order: there is nothing to go on with.
  void forget();

  /// When a process before this one left a state of this run and scenario: its head, and `load` has been called with
  /// the rest. Nothing, and said, when the state cannot be read.
  template <class Load>
  std::optional<CheckpointHead> resume(const Load& load) {
    if (!file_ || !file_->last() || file_->last()->empty()) return std::nullopt;
    try {
      state::StateReader reader(file_->last()->data(), file_->last()->size());
      CheckpointHead head;
      reader(head);
      if (head.run_id != run_ || head.scenario != scenario_ || head.seed != seed_) return std::nullopt;
      load(reader);
      reader.expect_end();
      return head;
    } catch (const state::StateError& error) {
      say_that_there_is_none(error.what());
      return std::nullopt;
    }
  }

  /// The state as bytes for keep(); `save` appends to a state::StateWriter.
  template <class Save>
  std::vector<std::uint8_t> state(const Save& save) const {
    std::vector<std::uint8_t> bytes;
    state::StateWriter writer(bytes);
    writer(CheckpointHead{run_, scenario_, seed_, now()});
    save(writer);
    return bytes;
  }
  /// False without a place. A full disk is said once; the state kept before stays, and each later one is tried again.
  bool keep(const std::vector<std::uint8_t>& state);

  /// Path of a file of this service and run: "state", or a kind of its own. Throws std::runtime_error without a place.
  std::string path(const std::string& kind) const;

 private:
  static std::int64_t now();
  static void say_that_there_is_none(const std::string& why);
  bool is_of_this_service(const std::filesystem::path& file) const;

  std::string scenario_;
  std::uint64_t seed_;
  std::filesystem::path folder_;  ///< empty: there is no place
  std::string name_;              ///< what the files of this service begin with, of whatever run
  RunId run_;
  std::unique_ptr<state::CheckpointFile> file_;  ///< null: before a run, or there is no place for it
  bool no_room_was_said_ = false;
};

/// Removes the files that services left of `run` in the folder `state_folder` (empty: the user's own): of those that
/// were killed and not started again.
void remove_checkpoints(const std::string& state_folder, const RunId& run);

}  // namespace inslab::service
