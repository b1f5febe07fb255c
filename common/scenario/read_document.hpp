#pragma once

#include "inslab/data/json/json_reader.hpp"
#include "inslab/scenario/document_kind.hpp"

namespace inslab::scenario {

/// Reads a document of one kind. Throws json::Error; one that is of another kind, and cannot be read for that, is
/// called what it is.
template <class T>
T read_document(const std::filesystem::path& file, DocumentKind expected) {
  const json::Json json = json::read_json_file(file);
  try {
    return json::struct_from_json<T>(json, file.string());
  } catch (const json::Error& error) {
    const bool is_about_keys = error.rule() == Rule::KnownKey || error.rule() == Rule::RequiredKey;
    const auto kind = document_kind(json, expected);
    if (!is_about_keys || !kind || *kind == expected) throw;
    throw json::Error(file.string(),
                      {Rule::KnownKey, "", "is " + words_of(*kind) + "; expected " + words_of(expected)});
  }
}

}  // namespace inslab::scenario
