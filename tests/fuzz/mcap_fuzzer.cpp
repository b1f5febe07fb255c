// Logs: any bytes give messages or an files::ReadError, nothing else.
#include "inslab/formats/log/log_info.hpp"
#include "inslab/formats/mcap/mcap_reader.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "tests/fuzz/memory_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace inslab;
  const fuzz::MemoryFile file(data, size, "fuzz.mcap");
  mcap::McapReader::Options options;
  options.max_chunk_bytes = 1 << 20;  // the fuzzer's own limit of memory is the tighter one otherwise
  options.max_open_bytes = 1 << 22;
  try {
    const mcap::McapReader reader(file.path(), options);
    reader.for_each([](const mcap::Message&) { return true; }, mcap::McapReader::Order::LogTime);
  } catch (const files::ReadError&) {
  }
  return 0;
}
