#include "tests/ui/by_hand/drop_source.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <chrono>
#include <functional>
#include <string>
#include <thread>

#include "engine/core/error.h"

namespace spia::viewer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int protocol = 5;

/// A window that nobody sees, which owns what is dragged.
class Source {
public:
    explicit Source(std::string uris) : uris_(std::move(uris)), display_(XOpenDisplay(nullptr))
    {
        if (!display_)
            throw Error("there is no X display to drag files on");
        window_ = XCreateSimpleWindow(display_, DefaultRootWindow(display_), 0, 0, 1, 1, 0, 0, 0);
        XSetSelectionOwner(display_, atom("XdndSelection"), window_, CurrentTime);
    }
    ~Source() { XCloseDisplay(display_); }
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;

    Atom atom(const char* name) const { return XInternAtom(display_, name, False); }
    long self() const { return long(window_); }

    void tell(Window target, const char* message, long a, long b, long c, long d) const
    {
        XEvent event{};
        event.xclient.type = ClientMessage;
        event.xclient.display = display_;
        event.xclient.window = target;
        event.xclient.message_type = atom(message);
        event.xclient.format = 32;
        const long data[] = {self(), a, b, c, d};
        std::copy(std::begin(data), std::end(data), event.xclient.data.l);
        XSendEvent(display_, target, False, NoEventMask, &event);
        XFlush(display_);
    }

    /// Hands out the names on the way. @throws Error after 10 s without the answer
    void wait_for(const char* answer)
    {
        const auto until = Clock::now() + std::chrono::seconds(10);
        while (Clock::now() < until) {
            if (XPending(display_) == 0) {
                std::this_thread::sleep_for(std::chrono::milliseconds(5));
                continue;
            }
            XEvent event;
            XNextEvent(display_, &event);
            if (event.type == SelectionRequest)
                hand_out(event.xselectionrequest);
            if (event.type == ClientMessage && event.xclient.message_type == atom(answer))
                return;
        }
        throw Error(std::string("the window does not answer what is dropped on it with ") + answer);
    }

private:
    void hand_out(const XSelectionRequestEvent& asked) const
    {
        XChangeProperty(display_, asked.requestor, asked.property, asked.target, 8, PropModeReplace,
                        reinterpret_cast<const unsigned char*>(uris_.data()), int(uris_.size()));
        XEvent event{};
        event.xselection.type = SelectionNotify;
        event.xselection.requestor = asked.requestor;
        event.xselection.selection = asked.selection;
        event.xselection.target = asked.target;
        event.xselection.property = asked.property;
        event.xselection.time = asked.time;
        XSendEvent(display_, asked.requestor, False, NoEventMask, &event);
        XFlush(display_);
    }

    std::string uris_;
    Display* display_;
    Window window_ = 0;
};

} // namespace

void drop_files(unsigned long window, const std::vector<std::filesystem::path>& files, int x, int y)
{
    std::string uris;
    for (const auto& file : files)
        uris += "file://" + std::filesystem::absolute(file).string() + "\r\n";
    Source source(uris);
    source.tell(window, "XdndEnter", long(protocol) << 24, long(source.atom("text/uri-list")), 0, 0);
    source.tell(window, "XdndPosition", 0, (long(x) << 16) | y, CurrentTime, long(source.atom("XdndActionCopy")));
    source.wait_for("XdndStatus");
    source.tell(window, "XdndDrop", 0, CurrentTime, 0, 0);
    source.wait_for("XdndFinished");
}

} // namespace spia::viewer
