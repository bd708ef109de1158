#include "tests/fuzz/crash_owner.h"

#include <array>
#include <cstdio>
#include <cstring>
#include <dlfcn.h>
#include <execinfo.h>
#include <span>
#include <ucontext.h>

#include "tests/fuzz/cad_target.h"

namespace spia::fuzz {
namespace {

Place innermost(std::span<void* const> frames)
{
    for (void* const frame : frames)
        if (const Owner owner = owner_of(frame); owner != Owner::unknown)
            return {owner, frame};
    return {};
}

} // namespace

Owner owner_of(const void* code)
{
    Dl_info info{};
    if (::dladdr(code, &info) == 0 || !info.dli_fname)
        return Owner::unknown;
    if (std::strstr(info.dli_fname, "libTK"))
        return Owner::opencascade;
    return info.dli_sname && std::strstr(info.dli_sname, "4spia") ? Owner::reader : Owner::unknown;
}

Place place_on_stack()
{
    std::array<void*, 64> frame;
    const int frames = ::backtrace(frame.data(), int(frame.size()));
    constexpr size_t own = 2; // this function, and the handler that called it
    return size_t(frames) > own ? innermost(std::span(frame).subspan(own, size_t(frames) - own)) : Place{};
}

Place place_of_signal(void* context)
{
    const greg_t* const registers = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
    void* const here = reinterpret_cast<void*>(registers[REG_RIP]);
    std::array<void*, 64> frame;
    const int frames = ::backtrace(frame.data(), int(frame.size()));
    int at = 0; // where the stack of the signal's handler ends
    while (at < frames && frame[size_t(at)] != here)
        ++at;
    if (const Place place = innermost(std::span(frame).subspan(size_t(at), size_t(frames - at)));
        place.owner != Owner::unknown)
        return place;
    void* const from = *reinterpret_cast<void**>(registers[REG_RSP]); // called by a broken pointer
    return innermost(std::array{here, from});
}

void put_name(const void* code, char* name, size_t size)
{
    Dl_info info{};
    if (::dladdr(code, &info) == 0 || !info.dli_fname) {
        std::snprintf(name, size, "nowhere");
        return;
    }
    const char* const file = std::strrchr(info.dli_fname, '/');
    std::snprintf(name, size, "%s+%zx", file ? file + 1 : info.dli_fname,
                  size_t(static_cast<const char*>(code) - static_cast<const char*>(info.dli_fbase)));
}

std::string_view fault_of_owners()
{
    if (owner_of(reinterpret_cast<const void*>(&read_and_examine)) != Owner::reader)
        return "functions of the reader have no names in this program";
    if (owner_of(::dlsym(RTLD_DEFAULT, "_ZN8Standard8AllocateEm")) != Owner::opencascade)
        return "OpenCASCADE is not in libraries of its own here";
    return "";
}

} // namespace spia::fuzz
