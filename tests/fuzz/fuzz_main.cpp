// libFuzzer's entry: one program reads all formats; SPIA_FUZZ_FORMAT=NAME chooses.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <oneapi/tbb/global_control.h>

#include "tests/fuzz/cad_fuzz.h"
#include "tests/fuzz/fuzz_target.h"

namespace {

std::string_view format()
{
    const char* name = std::getenv("SPIA_FUZZ_FORMAT");
    if (!name) {
        std::fputs("choose a format: SPIA_FUZZ_FORMAT=obj\n", stderr);
        std::exit(2);
    }
    return name;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size)
{
    // Handing files of a few lines to a second thread costs more than reading them does.
    static const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const std::string_view content(reinterpret_cast<const char*>(data), size);
    static const bool cad = spia::fuzz::is_cad_target(format());
    if (cad) {
        static const spia::fuzz::CadTarget& target = spia::fuzz::cad_target(format());
        spia::fuzz::fuzz_cad(target, content);
    } else {
        static const spia::fuzz::FuzzTarget& target = spia::fuzz::fuzz_target(format());
        target.read(content);
    }
    return 0;
}
