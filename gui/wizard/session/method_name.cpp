// SPDX-License-Identifier: MIT
#include "wizard/session/method_name.h"

#include <QCoreApplication>

namespace relucent {
namespace {

struct Names {
  Q_DECLARE_TR_FUNCTIONS(Method)
};

}  // namespace

QString methodName(Method method) {
  switch (method) {
    case Method::none:
      return Names::tr("No correction");
    case Method::scalar:
      return Names::tr("Each pixel's brightness");
    case Method::mix:
      return Names::tr("Each pixel on its own");
    case Method::sharpen:
      return Names::tr("Each pixel, sharpened");
    case Method::clusters:
      return Names::tr("Clusters");
    case Method::windows:
      return Names::tr("Windows");
    case Method::refined:
      return Names::tr("Windows and steps");
    case Method::optimum:
      break;
  }
  return Names::tr("Best possible, still pictures");
}

}  // namespace relucent
