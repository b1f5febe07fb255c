#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace inslab::dds {

/// A folder of its own that goes with the object, with keys made by deploy/security/make-keys in it; for `units`, or
/// for all of them.
class Keys {
 public:
  explicit Keys(const std::string& units = "") {
    char pattern[] = "/tmp/inslab-keys-XXXXXX";
    folder_ = mkdtemp(pattern);
    made_ = shell("'" INSLAB_SOURCE_DIR "/deploy/security/make-keys' " + path() + " 2 " + units);
  }
  /// A copy of others, to be damaged.
  Keys(const Keys& other) : made_(other.made_) {
    char pattern[] = "/tmp/inslab-keys-XXXXXX";
    folder_ = mkdtemp(pattern);
    std::filesystem::copy(other.path(), path());
  }
  ~Keys() { std::filesystem::remove_all(folder_); }
  Keys& operator=(const Keys&) = delete;

  bool made() const { return made_; }
  std::string path() const { return folder_ + "/keys"; }
  std::string operator/(const std::string& name) const { return path() + "/" + name; }

  /// Runs a command in the folder; true when it succeeds. What it prints is dropped.
  bool run(const std::string& command) const { return shell("cd " + path() + " && " + command); }

  /// Changes NAME.xml with a sed expression and signs it anew with the authority's key, as make-keys does.
  bool rewrite(const std::string& name, const std::string& sed_expression) const {
    return run("sed -i '" + sed_expression + "' " + name + ".xml && openssl smime -sign -in " + name +
               ".xml -text -out " + name + ".p7s -signer ca.cert.pem -inkey ca.key.pem");
  }

 private:
  static bool shell(const std::string& command) {
    return std::system(("exec >/dev/null 2>&1; " + command).c_str()) == 0;
  }

  std::string folder_;
  bool made_ = false;
};

}  // namespace inslab::dds
