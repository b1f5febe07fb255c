#include "inslab/formats/log/log_types.hpp"

#include <algorithm>
#include <type_traits>

#include "inslab/data/catalog/wire_type.hpp"
#include "inslab/data/wire/cdr.hpp"
#include "inslab/data/wire/idl_text.hpp"

namespace inslab::log {
namespace {

template <class T, class = void>
struct HasHeader : std::false_type {};
template <class T>
struct HasHeader<T, std::void_t<decltype(std::declval<T>().header.sequence_number)>> : std::true_type {};

template <class T, class = void>
struct HasRunId : std::false_type {};
template <class T>
struct HasRunId<T, std::void_t<decltype(std::declval<T>().run_id)>> : std::true_type {};

template <class T, class = void>
struct HasSimTime : std::false_type {};
template <class T>
struct HasSimTime<T, std::void_t<decltype(std::declval<T>().sim_time_ns)>> : std::true_type {};

template <class T>
bool row_of(const std::uint8_t* data, std::size_t size, tables::Row& row) {
  T sample;
  if (!wire::decode(data, size, sample)) return false;
  tables::fill_row(sample, row);
  return true;
}

template <class T>
bool stamp_of(const std::uint8_t* data, std::size_t size, SampleStamp& stamp) {
  T sample;
  if (!wire::decode(data, size, sample)) return false;
  stamp = {};
  if constexpr (HasHeader<T>::value) {
    stamp.run_id = sample.header.run_id;
    stamp.sequence_number = sample.header.sequence_number;
    stamp.sim_time_ns = sample.header.sim_time_ns;
  }
  if constexpr (HasRunId<T>::value) stamp.run_id = sample.run_id;
  if constexpr (HasSimTime<T>::value) stamp.sim_time_ns = sample.sim_time_ns;
  return true;
}

template <class... Types>
struct Table {
  std::vector<LogType> rows{
      LogType{catalog::WireType<Types>::name, tables::columns_of<Types>(), &row_of<Types>, &stamp_of<Types>}...};
};

}  // namespace

const std::vector<LogType>& log_types() {
  static const catalog::EveryWireType<Table> table;
  return table.rows;
}

const LogType* find_log_type(std::string_view schema_name) {
  const std::vector<LogType>& types = log_types();
  const auto found =
      std::find_if(types.begin(), types.end(),
                   [name = wire::present_name(schema_name)](const LogType& type) { return type.name == name; });
  return found == types.end() ? nullptr : &*found;
}

}  // namespace inslab::log
