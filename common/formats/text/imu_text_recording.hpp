#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "inslab/formats/text/even_imu_samples.hpp"
#include "inslab/formats/text/imu_columns.hpp"
#include "inslab/foundation/files/text_lines.hpp"

namespace inslab::io {

/// The layout of a text: from its line of names, or the seven columns.
struct ImuTextLayout {
  char separator = ',';
  std::size_t fields = 0;
  std::vector<ImuColumn> columns;
};

/// The samples of a text, line by line (imu_recording.hpp says which texts).
class ImuTextRecording {
 public:
  /// Throws ReadError, naming file and line, when the text is empty or its columns are not known.
  explicit ImuTextRecording(const std::string& path);

  const ImuTextLayout& layout() const { return layout_; }

  /// The next sample; false after the last. Throws ReadError, naming file, line and column.
  bool next(RawImuSample& raw);

 private:
  bool next_line();
  static std::string names_in_comment(std::string_view comment);
  double time_of(const std::string& place, const ImuColumn& column);
  std::string_view field(std::size_t i);
  bool all_numbers();

  std::string path_;
  TextLines lines_;
  std::string_view line_;
  std::vector<std::string_view> fields_;
  std::string names_;  ///< in a comment above the first line; empty: none
  ImuTextLayout layout_;
  bool first_is_data_ = false;
  std::optional<std::int64_t> first_ns_;
};

}  // namespace inslab::io
