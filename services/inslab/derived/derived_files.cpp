#include "inslab/services/inslab/derived/derived_files.hpp"

#include "inslab/data/catalog/profile_kinds.hpp"
#include "inslab/data/json/reference_writer.hpp"
#include "inslab/data/json/schema_writer.hpp"
#include "inslab/data/wire/idl_writer.hpp"
#include "inslab/models/navigation/parameters.hpp"
#include "inslab/scenario/scenario.hpp"
#include "inslab/services/inslab/derived/deploy_files.hpp"

namespace inslab::derived {

namespace {

template <class T>
DerivedFile schema_file(const std::string& name, const std::string& title) {
  return {"config/schema/" + name + ".schema.json", [title] { return json::schema<T>(title).dump(2) + "\n"; }};
}

std::string parameters_page() {
  std::string page =
      "# Every key of the JSON files\n\n"
      "Derived from the declarations in `common/scenario`, `common/data/profiles` and `common/models/navigation` by "
      "`inslab reference docs/parameters.md`; a key carries its unit. Where a list of 3 is expected, one number stands "
      "for all axes.\n";
  const auto add = [&page](const std::string& title, const std::string& table) {
    page += "\n## " + title + "\n\n" + table;
  };
  add("Scenario (`config/scenarios`)", json::reference_table<scenario::Scenario>());
  for_each(catalog::ProfileKinds{}, [&add](auto tag) {
    using Profile = typename decltype(tag)::type;
    const catalog::ProfileWords& words = catalog::kWords<Profile>;
    add(std::string(words.title) + " (`config/profiles/" + std::string(words.folder) + "`)",
        json::reference_table<Profile>());
  });
  add("Navigation filter (`config/nav`)", json::reference_table<navigation::NavigationParameters>());
  return page;
}

}  // namespace

const std::vector<DerivedFile>& derived_files() {
  static const std::vector<DerivedFile> files = [] {
    std::vector<DerivedFile> all{schema_file<scenario::Scenario>("scenario", "Inslab scenario")};
    for_each(catalog::ProfileKinds{}, [&all](auto tag) {
      using Profile = typename decltype(tag)::type;
      all.push_back(schema_file<Profile>(std::string(enum_name(Profile::kind)),
                                         "Inslab " + std::string(catalog::kWords<Profile>.document)));
    });
    all.push_back(schema_file<navigation::NavigationParameters>("navigation", "Inslab navigation filter"));
    all.push_back({"idl/profile.idl", wire::profile_idl});
    all.push_back({"idl/block.idl", wire::block_idl});
    all.push_back({"docs/parameters.md", parameters_page});
    for (DerivedFile& file : deploy_files()) all.push_back(std::move(file));
    return all;
  }();
  return files;
}

}  // namespace inslab::derived
