// A long search through damaged CAD files: spia-fuzz-cad FORMAT COUNT [FIRST]. With KEEP as the
// fourth argument it only writes them: into files KEEP-NUMBER.FORMAT.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fmt/core.h>
#include <fstream>

#include "tests/fuzz/cad_search.h"

int main(int count, char** values)
{
    if (count < 3) {
        std::fputs("usage: spia-fuzz-cad step|igs|brep COUNT [FIRST [KEEP]]\n", stderr);
        return 2;
    }
    const auto whole = [&](int k) {
        int number = 0, read = 0;
        return k >= count ? 0 : std::sscanf(values[k], "%9d%n", &number, &read) == 1 && !values[k][read] ? number : -1;
    };
    const int files = whole(2), first = whole(3);
    if (files < 1 || first < 0) {
        std::fputs("spia-fuzz-cad: how many files, and from which number on? e.g. spia-fuzz-cad step 1000 0\n", stderr);
        return 2;
    }
    if (count > 4) {
        for (int number = first; number < first + files; ++number)
            std::ofstream(fmt::format("{}-{}.{}", values[4], number, values[1]), std::ios::binary)
                << spia::fuzz::damaged_cad_file(values[1], number);
        return 0;
    }
    constexpr int at_once = 10000;
    spia::fuzz::CadSearch sum;
    try {
        for (int begin = first; begin < first + files; begin += at_once) {
            const auto found = spia::fuzz::search_cad(values[1], begin, std::min(at_once, first + files - begin));
            sum.files += found.files;
            sum.accepted += found.accepted;
            sum.refused += found.refused;
            sum.crashed += found.crashed;
            sum.endless += found.endless;
            std::printf("%s: %d files, %d accepted, %d refused, %d crashed or needed too much memory and %d were busy "
                        "for long, in a process of their own\n",
                        values[1], sum.files, sum.accepted, sum.refused, sum.crashed, sum.endless);
            std::fflush(stdout);
        }
    } catch (const std::exception& fault) {
        std::fprintf(stderr, "%s: %s\n", values[1], fault.what());
        return 1;
    }
}
