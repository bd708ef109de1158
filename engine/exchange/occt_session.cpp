#include "engine/exchange/occt_session.h"

#include <IGESControl_Controller.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <STEPControl_Controller.hxx>
#include <TCollection_AsciiString.hxx>
#include <spdlog/spdlog.h>

namespace spia {
namespace {

class LogPrinter : public Message_Printer {
protected:
    void send(const TCollection_AsciiString& text, const Message_Gravity) const override
    {
        spdlog::debug("OpenCASCADE: {}", text.ToCString());
    }
};

std::mutex& the_lock()
{
    static std::mutex mutex;
    return mutex;
}

void prepare_once()
{
    static const bool prepared = [] {
        Message::DefaultMessenger()->ChangePrinters().Clear();
        Message::DefaultMessenger()->AddPrinter(new LogPrinter);
        IGESControl_Controller::Init();
        STEPControl_Controller::Init();
        return true;
    }();
    (void)prepared;
}

} // namespace

OcctSession::OcctSession() : lock_(the_lock()) { prepare_once(); }

} // namespace spia
