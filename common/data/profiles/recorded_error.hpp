#pragma once

#include "inslab/foundation/fields/field.hpp"

namespace inslab {
inline namespace samples {

/// Which triads take the errors of a recording.
enum class RecordedAxes : std::uint32_t { All, Gyro, Accel };

template <>
struct EnumNames<RecordedAxes> {
  static constexpr std::string_view type = "RecordedAxes";
  static constexpr std::string_view prefix = "RECORDED_AXES_";
  static constexpr std::array<std::string_view, 3> values{"all", "gyro", "accel"};
};

/// Where in a recording a run begins.
enum class RecordingStart : std::uint32_t { Drawn, Given };

template <>
struct EnumNames<RecordingStart> {
  static constexpr std::string_view type = "RecordingStart";
  static constexpr std::string_view prefix = "RECORDING_START_";
  static constexpr std::array<std::string_view, 2> values{"drawn", "given"};
};

/// What comes after the end of a recording.
enum class RecordingEnd : std::uint32_t { Refuse, Crossfade };

template <>
struct EnumNames<RecordingEnd> {
  static constexpr std::string_view type = "RecordingEnd";
  static constexpr std::string_view prefix = "RECORDING_END_";
  static constexpr std::array<std::string_view, 2> values{"refuse", "crossfade"};
};

/// Errors of a real sensor, recorded once, that are put onto the simulated one: signal grafting (Sensors 16(6),
/// 854, 2016: its basic-error form). `inslab graft extract` makes the recordings.
struct RecordedError {
  std::string file;
  std::string sha256;
  RecordedAxes axes = RecordedAxes::All;
  RecordingStart from = RecordingStart::Drawn;
  double from_s = 0.0;
  RecordingEnd loop = RecordingEnd::Refuse;
  double crossfade_s = 10.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("file", "name of a recording in the folder of recordings; absent: none").at_most(128), self.file);
    visit(Field("sha256", "of the file, 64 digits 0-9 a-f: no other file of that name is taken").at_most(64),
          self.sha256);
    visit(Field("axes", "which triads take it"), self.axes);
    visit(
        Field("from", "where in the recording the run begins: drawn by the seed, so that it lasts; or given by from_s"),
        self.from);
    visit(Field("from_s",
                "time of the recording at sim time 0, to its nearest sample; below 0 it begins later than "
                "the run: for a swap")
              .in(-1e9, 1e9),
          self.from_s);
    visit(Field("loop", "after its end: refuse a run that is longer, or crossfade into its beginning"), self.loop);
    visit(Field("crossfade_s", "how long the end fades into the beginning").in(0.0, 3600.0), self.crossfade_s);
  }
};

}  // namespace samples
}  // namespace inslab
