// libFuzzer's entry: one program reads all formats; SPIA_FUZZ_FORMAT=NAME chooses.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

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
    target.read({reinterpret_cast<const char*>(data), size});
    return 0;
}
