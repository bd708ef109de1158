// libFuzzer's entry: one program reads all formats; SPIA_FUZZ_FORMAT=NAME chooses.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <oneapi/tbb/global_control.h>

#include "tests/fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size)
{
    static const spia::fuzz::FuzzTarget& target = [] {
        const char* name = std::getenv("SPIA_FUZZ_FORMAT");
        if (!name) {
            std::fputs("choose a format: SPIA_FUZZ_FORMAT=obj\n", stderr);
            std::exit(2);
        }
        return std::ref(spia::fuzz::fuzz_target(name));
    }();
    // Handing files of a few lines to a second thread costs more than reading them does.
    static const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    target.read({reinterpret_cast<const char*>(data), size});
    return 0;
}
