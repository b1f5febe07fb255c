#include "services/inslab/gnuplot.hpp"

#include <cstdio>
#include <memory>
#include <stdexcept>

namespace inslab::cli {

void gnuplot(const std::string& script) {
  std::FILE* pipe = ::popen("gnuplot -", "w");
  if (pipe == nullptr) throw std::runtime_error("gnuplot cannot be started");
  std::fwrite(script.data(), 1, script.size(), pipe);
  if (::pclose(pipe) != 0) {
    throw std::runtime_error("gnuplot failed (its words are above); Debian's package is gnuplot-nox");
  }
}

}  // namespace inslab::cli
