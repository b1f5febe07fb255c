#pragma once

#include "inslab/data/profiles/recorded_error.hpp"

namespace inslab {
inline namespace samples {

/// Errors, claims and outages of a real receiver, recorded once, that are put onto the simulated one epoch by epoch.
/// `inslab graft extract-gnss` makes the recordings.
struct RecordedFixError {
  std::string file;
  std::string sha256;
  RecordingStart from = RecordingStart::Drawn;
  double from_s = 0.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("file", "name of a recording in the folder of recordings; absent: none").at_most(128), self.file);
    visit(Field("sha256", "of the file, 64 digits 0-9 a-f: no other file of that name is taken").at_most(64),
          self.sha256);
    visit(
        Field("from", "where in the recording the run begins: drawn by the seed, so that it lasts; or given by from_s"),
        self.from);
    visit(Field("from_s", "time of the recording at sim time 0; below 0 it begins later than the run: for a swap")
              .in(-1e9, 1e9),
          self.from_s);
  }
};

}  // namespace samples
}  // namespace inslab
