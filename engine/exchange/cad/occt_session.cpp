#include "engine/exchange/cad/occt_session.h"

#include <IGESControl_Controller.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <STEPControl_Controller.hxx>
#include <TCollection_AsciiString.hxx>
#include <spdlog/spdlog.h>
#include <utility>

namespace spia {
namespace {

using Log = std::function<void(std::string_view)>;

class LogPrinter : public Message_Printer {
public:
    explicit LogPrinter(Log log) : log_(std::move(log)) {}

protected:
    void send(const TCollection_AsciiString& text, const Message_Gravity) const override { log_(text.ToCString()); }

private:
    Log log_;
};

void print_to(Log log)
{
    Message::DefaultMessenger()->ChangePrinters().Clear();
    Message::DefaultMessenger()->AddPrinter(new LogPrinter(std::move(log)));
}

std::mutex& the_lock()
{
    static std::mutex mutex;
    return mutex;
}

void prepare_once()
{
    static const bool prepared = [] {
        print_to([](std::string_view text) { spdlog::debug("OpenCASCADE: {}", text); });
        IGESControl_Controller::Init();
        STEPControl_Controller::Init();
        return true;
    }();
    (void)prepared;
}

} // namespace

OcctSession::OcctSession() : lock_(the_lock()) { prepare_once(); }

void OcctSession::redirect(Log log) const { print_to(std::move(log)); }

} // namespace spia
