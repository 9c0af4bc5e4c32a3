// SPDX-License-Identifier: MIT
#include "wizard/session/method_name.h"

#include <QCoreApplication>

namespace relucent::gui {
namespace {

struct Names {
  Q_DECLARE_TR_FUNCTIONS(Method)
};

}  // namespace

QString methodName(compensation::Method method) {
  switch (method) {
    case compensation::Method::none:
      return Names::tr("Uncorrected");
    case compensation::Method::scalar:
      return Names::tr("Each pixel's brightness");
    case compensation::Method::mix:
      return Names::tr("Each pixel on its own");
    case compensation::Method::sharpen:
      return Names::tr("Each pixel, sharpened");
    case compensation::Method::clusters:
      return Names::tr("Clusters");
    case compensation::Method::windows:
      return Names::tr("Windows");
    case compensation::Method::refined:
      return Names::tr("All bounces, for films");
    case compensation::Method::optimum:
      break;
  }
  return Names::tr("All bounces, solved, for stills");
}

}  // namespace relucent::gui
