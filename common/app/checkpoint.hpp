#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/service.hpp"
#include "recovery/checkpoint_file.hpp"
#include "recovery/state_stream.hpp"
#include "samples/stream_header.hpp"

namespace inslab::app {

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

/// Where a service keeps what it needs to go on after a SIGKILL: one small file in the folder --state. Without a place
/// for it the service runs all the same and says that it could not go on.
class Checkpoint {
 public:
  explicit Checkpoint(const Context& context);

  /// Whether a process before this one left a state: it did not end in order.
  bool has_any() const { return file_ && file_->last() && !file_->last()->empty(); }
  /// The run has ended in order: there is nothing to go on with.
  void forget() {
    if (file_) file_->keep({});
  }

  /// When the last state belongs to `run` of this scenario: its head, and `load` has been called with the rest. Throws
  /// recovery::StateError when that cannot be read.
  template <class Load>
  std::optional<CheckpointHead> resume(const RunId& run, const Load& load) {
    if (!has_any()) return std::nullopt;
    recovery::StateReader reader(file_->last()->data(), file_->last()->size());
    CheckpointHead head;
    reader(head);
    if (head.run_id != run || head.scenario != scenario_ || head.seed != seed_) return std::nullopt;
    load(reader);
    reader.expect_end();
    return head;
  }

  /// The state as bytes for keep(); `save` appends to a recovery::StateWriter.
  template <class Save>
  std::vector<std::uint8_t> state(const RunId& run, const Save& save) const {
    std::vector<std::uint8_t> bytes;
    recovery::StateWriter writer(bytes);
    writer(CheckpointHead{run, scenario_, seed_, now()});
    save(writer);
    return bytes;
  }
  void keep(const std::vector<std::uint8_t>& state) {
    if (file_) file_->keep(state);
  }

  /// Path of a file of this service in the folder --state.
  static std::string path(const Context& context, const std::string& kind);

 private:
  static std::int64_t now();

  std::string scenario_;
  std::uint64_t seed_;
  std::unique_ptr<recovery::CheckpointFile> file_;  ///< null: there is no place for it
};

}  // namespace inslab::app
