// libFuzzer's entry: one program reads all formats; SPIA_FUZZ_FORMAT=NAME chooses.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <oneapi/tbb/global_control.h>
#include <string>
#include <string_view>
#include <utility>

#include "tests/fuzz/cad_fuzz.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/mutate.h"

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

extern "C" size_t LLVMFuzzerMutate(std::uint8_t* data, size_t size, size_t most);

/// CAD files are lists of numbers; changes of bytes alone are refused by the checks of their words,
/// nearly all of them.
extern "C" size_t LLVMFuzzerCustomMutator(std::uint8_t* data, size_t size, size_t most, unsigned seed)
{
    std::mt19937 random(seed);
    if (random() % 4 || !spia::fuzz::is_cad_target(format()) || size == 0)
        return LLVMFuzzerMutate(data, size, most);
    std::string content(reinterpret_cast<const char*>(data), size);
    for (uint32_t changes = 1 + random() % 3; changes > 0; --changes)
        content = spia::fuzz::with_other_number(std::move(content), random);
    content.resize(std::min(content.size(), most));
    std::copy(content.begin(), content.end(), data);
    return content.size();
}

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
