#pragma once

#include <string>

#include "inslab/data/samples/nav_solution.hpp"
#include "inslab/formats/recordings/nav_text.hpp"
#include "inslab/foundation/files/text_writer.hpp"

namespace inslab::navigate {

/// The result of an offline navigation: STEM.nav, the 11-column text of positions, velocities and attitudes, and line
/// by line beside it STEM_sigmas.txt: week, seconds of week, standard deviations of position m, velocity m/s (north,
/// east, down) and attitude deg (about north, east, down).
class ResultFiles {
 public:
  /// Throws files::WriteError.
  explicit ResultFiles(const std::string& stem);
  /// Throws files::WriteError.
  void write(const NavSolution& solution);
  void close();
  std::uint64_t rows() const { return rows_; }

 private:
  recordings::NavTextWriter solution_;
  files::TextWriter sigmas_;
  std::uint64_t rows_ = 0;
};

}  // namespace inslab::navigate
