// SPDX-License-Identifier: MIT
#include "jobs/failure.h"

#include <QCoreApplication>
#include <new>

#include "relucent/devices/check/screen_proof.h"
#include "relucent/devices/command/shell_command.h"
#include "text/message_text.h"

namespace relucent::gui {
namespace {

struct Translated {
  Q_DECLARE_TR_FUNCTIONS(Failure)
};

Failure failureOf(const Error& error) {
  return {error.kind(), fullSentence(error.summary()), fullSentence(error.advice()),
          QString::fromStdString(std::string(toString(error.kind())) + ": " + error.what())};
}

}  // namespace

Failure failureOf(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(std::move(thrown));
  } catch (const devices::ScreenNotSeen& error) {
    Failure failure = failureOf(static_cast<const Error&>(error));
    failure.heading = Translated::tr("The camera does not see this projector");
    return failure;
  } catch (const devices::CommandFailed& error) {
    Failure failure = failureOf(static_cast<const Error&>(error));
    failure.heading = Translated::tr("A program of this venue failed");
    failure.advice +=
        ' ' + Translated::tr("Another command is typed at the step Venue, by “Change the programs”.");
    return failure;
  } catch (const Error& error) {
    return failureOf(error);
  } catch (const std::bad_alloc&) {
    return {ErrorKind::memory, Translated::tr("The computer has no memory left."),
            Translated::tr("Close other programs, or choose fewer pixels."), "bad_alloc"};
  } catch (const std::exception& error) {
    return {
        ErrorKind::numerics, Translated::tr("Relucent made a mistake."),
        Translated::tr(
            "What is saved is safe. Copy the details for whoever looks after the program, then try again."),
        QString::fromUtf8(error.what())};
  } catch (...) {
    return {ErrorKind::numerics,
            Translated::tr("Relucent made a mistake."),
            Translated::tr("What is saved is safe. Try again."),
            {}};
  }
}

}  // namespace relucent::gui
