#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace inslab::dds {

/// Keys made by deploy/security/make-keys into a folder that goes with the object; for `units`, or for all of them.
class Keys {
 public:
  explicit Keys(const std::string& units = "") {
    char pattern[] = "/tmp/inslab-keys-XXXXXX";
    folder_ = mkdtemp(pattern);
    const std::string command =
        INSLAB_SOURCE_DIR "/deploy/security/make-keys " + folder_ + "/keys 2 " + units + " >/dev/null 2>&1";
    made_ = std::system(command.c_str()) == 0;
  }
  ~Keys() { std::filesystem::remove_all(folder_); }
  Keys(const Keys&) = delete;
  Keys& operator=(const Keys&) = delete;

  bool made() const { return made_; }
  std::string path() const { return folder_ + "/keys"; }

 private:
  std::string folder_;
  bool made_ = false;
};

}  // namespace inslab::dds
