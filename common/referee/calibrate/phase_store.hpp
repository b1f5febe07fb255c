#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>

namespace inslab::calibrate {

/// The integral of one axis at every sample. Six axes of 45 h at 200 Hz are 1.6 GB, too much to hold: what exceeds 32
/// MB an axis goes to a file without a name in the folder that TMPDIR names, or /tmp, 8 bytes a sample, which the
/// system takes away when the program ends, however it ends. phase() then holds one axis, 260 MB.
class PhaseStore {
 public:
  /// The next increment of the integral. Throws files::WriteError when the temporary file cannot be made or is full.
  void add(double increment);

  std::int64_t samples() const { return samples_; }

  /// One value more than samples, beginning at 0, each less its number times the first increment, so that the integral
  /// of a large constant costs no digits. Throws files::ReadError.
  std::vector<double> phase() const;

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void put(double phase);

  std::unique_ptr<std::FILE, Closer> file_;
  std::vector<double> held_{0.0};
  std::size_t in_file_ = 0;
  std::int64_t samples_ = 0;
  double first_ = 0.0;
  double phase_ = 0.0;
};

}  // namespace inslab::calibrate
