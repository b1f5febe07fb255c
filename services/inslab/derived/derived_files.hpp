#pragma once

#include <functional>
#include <string>
#include <vector>

namespace inslab::derived {

/// A file of the product that follows from the declarations in C++; a test compares it with the one committed.
struct DerivedFile {
  std::string path;  ///< in the product's sources
  std::function<std::string()> text;
};

/// The schemas of config/schema, idl/profile.idl, docs/parameters.md, and what deploy takes from the catalogue.
const std::vector<DerivedFile>& derived_files();

}  // namespace inslab::derived
