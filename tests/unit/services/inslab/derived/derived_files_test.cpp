#include "inslab/services/inslab/derived/derived_files.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace inslab::derived {
namespace derived_files_test {

TEST(DerivedFiles, AreInTheTreeAsTheDeclarationsSay) {
  for (const DerivedFile& file : derived_files()) {
    std::ifstream stream(std::filesystem::path(INSLAB_SOURCE_DIR) / file.path, std::ios::binary);
    ASSERT_TRUE(stream) << file.path << " is missing: inslab reference " << file.path << " > " << file.path;
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    // Compared as a truth value: the whole file in the message would help nobody.
    EXPECT_TRUE(text == file.text()) << "a declaration changed. Renew with: inslab reference " << file.path << " > "
                                     << file.path << ".new && mv " << file.path << ".new " << file.path;
  }
}

TEST(DerivedFiles, AreAllTheSchemasThereAre) {
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(INSLAB_SOURCE_DIR) / "config" / "schema")) {
    const std::string path = "config/schema/" + entry.path().filename().string();
    EXPECT_TRUE(std::any_of(derived_files().begin(), derived_files().end(),
                            [&](const DerivedFile& file) { return file.path == path; }))
        << path << " follows from no declaration";
  }
}

}  // namespace derived_files_test
}  // namespace inslab::derived
