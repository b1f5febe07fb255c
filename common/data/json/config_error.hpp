#pragma once

#include <stdexcept>
#include <string>

#include "inslab/foundation/fields/violation.hpp"

namespace inslab::json {

/// A file that cannot be used: which one, where in it, and what was expected instead.
class Error : public std::runtime_error {
 public:
  Error(const std::string& file, const Violation& broken)
      : std::runtime_error(file + ": " + (broken.path.empty() ? "" : broken.path + ": ") + broken.reason),
        file_(file),
        broken_(broken) {}

  const std::string& file() const { return file_; }
  Rule rule() const { return broken_.rule; }
  const std::string& path() const { return broken_.path; }  ///< such as "imu[0].rate_hz"; empty: the whole file
  const std::string& reason() const { return broken_.reason; }

 private:
  std::string file_;
  Violation broken_;
};

}  // namespace inslab::json
