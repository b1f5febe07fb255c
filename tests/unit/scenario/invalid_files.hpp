#pragma once

#include <string>
#include <vector>

#include "inslab/data/requests/profile_request.hpp"
#include "inslab/foundation/fields/rule.hpp"

namespace inslab::test {

/// What config/invalid/expected.json says of one file beside it.
struct InvalidFile {
  std::string file;
  std::string kind;
  std::optional<SensorKind> sensor_kind;
  Rule rule = Rule::Readable;
  std::string path;
  std::string reason;
  std::string reported_file;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("file").at_most(256).required(), self.file);
    visit(Field("kind", "scenario, navigation, or of a profile").at_most(64).required(), self.kind);
    visit(Field("sensor_kind", "of a profile: whom it goes to; absent: the first kind of sensor that has such"),
          self.sensor_kind);
    visit(Field("rule").required(), self.rule);
    visit(Field("path", "in the file; empty: the whole file").at_most(256).required(), self.path);
    visit(Field("reason", "or its beginning").at_most(256).required(), self.reason);
    visit(Field("reported_file", "when another file than this is at fault").at_most(256), self.reported_file);
  }
};

struct InvalidFiles {
  std::vector<InvalidFile> files;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("files").at_most(1000).required(), self.files);
  }
};

}  // namespace inslab::test
