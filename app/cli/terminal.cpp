#include "app/cli/terminal.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>

#include "engine/core/text.h"
#include "engine/options/option.h"

namespace spia::cli {
namespace {

constexpr int bar_width = 28;

bool on_terminal() { return isatty(STDERR_FILENO) == 1; }

std::shared_ptr<std::atomic<bool>>& flag()
{
    static auto cancel = std::make_shared<std::atomic<bool>>(false);
    return cancel;
}
std::atomic<bool>* flag_of_handler = nullptr; // a handler may touch nothing but lock-free atomics

extern "C" void on_signal(int signal)
{
    if (flag_of_handler->exchange(true))
        _exit(128 + signal);
}

} // namespace

std::shared_ptr<const std::atomic<bool>> cancelled_by_user()
{
    if (!flag_of_handler) {
        flag_of_handler = flag().get();
        std::signal(SIGINT, on_signal);
        std::signal(SIGTERM, on_signal);
    }
    return flag();
}

std::string shown(std::string_view words)
{
    const std::string text = command_line_text(words);
    std::string result;
    for (size_t at = 0; at < text.size();) {
        const size_t length = utf8_length(std::string_view(text).substr(at));
        const auto byte = [&](size_t k) { return static_cast<unsigned char>(text[at + k]); };
        const bool control = length == 0 || (length == 1 && (byte(0) < 0x20 || byte(0) == 0x7f) && byte(0) != '\n') ||
                             (length == 2 && byte(0) == 0xc2 && byte(1) < 0xa0);
        if (control)
            for (size_t k = 0; k < std::max<size_t>(1, length); ++k)
                result += fmt::format("\\x{:02x}", byte(k));
        else
            result.append(text, at, length);
        at += std::max<size_t>(1, length);
    }
    return result;
}

JobDisplay::JobDisplay(std::string title) : title_(std::move(title)) {}

Progress JobDisplay::progress() const
{
    if (!on_terminal())
        return Progress({}, cancelled_by_user());
    return Progress(
        [title = title_](double fraction, std::string_view step) {
            const int full = int(fraction * bar_width);
            fmt::print(stderr, "\r\033[K{:<6} [{}{}] {:3.0f} %  {}", title, std::string(size_t(full), '#'),
                       std::string(size_t(bar_width - full), ' '), 100 * fraction, shown(step));
            std::fflush(stderr);
        },
        cancelled_by_user());
}

void JobDisplay::done(double seconds)
{
    finished_ = true;
    fmt::print(stderr, "{}{:<6} {:8.2f} s\n", on_terminal() ? "\r\033[K" : "", title_, seconds);
}

JobDisplay::~JobDisplay()
{
    if (!finished_ && on_terminal())
        fmt::print(stderr, "\r\033[K");
}

} // namespace spia::cli
