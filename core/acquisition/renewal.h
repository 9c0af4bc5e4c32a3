// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/acquisition/acquisition.h"
#include "relucent/acquisition/venue_change.h"

namespace relucent::acquisition {

/// A T that fits the venue as it is now.
struct Renewal {
  VenueChange change;
  transport::Acquisition acquisition;
  // Relative error of test patterns: of the former T, of what could be made of it without measuring, and of
  // the one above. Their noise is part of it.
  double errorBefore = 0.0, errorAdapted = 0.0, errorAfter = 0.0;
  double measured = 0.0;  // share of camera pixels whose rows were measured again
};

struct RenewalSettings {
  double wrongFrom = 0.05;      // a row is wrong from this relative error on, beyond noise, ...
  double timesBefore = 2.0;     // and from so many times what it had when it was measured
  double measuredFrom = 0.002;  // wrong rows are measured again if there is at least this share of them
  double worthMeasuring =
      0.05;              // ... if they have at least this share of all squared errors, beyond those of then
  double allFrom = 0.5;  // from this share on all rows are
  double leastLight = 0.1;  // of what there was: less is a projector that is off, or a covered lens
};

/// Makes T fit a venue that has changed, from as few photographs as that takes: black, floods and test
/// patterns tell
///  - what became of views and light, which T is made to fit (fitted_transport.h);
///  - which rows are still wrong, beyond noise: these, and what no camera saw before, are measured by dense
///    patterns as if they were all there is, and replace the former ones where they predict further test
///    patterns better.
/// e and the floods are those of now.  Flags of rows that were wrong before and are not measured again stay.
/// Source: core/acquisition/README.md.
/// Throws: Error{device} if hardly any light is left; as acquire().
Renewal renew(const AcquisitionRun& run, const transport::Acquisition& former,
              const RenewalSettings& settings, Progress& progress);

}  // namespace relucent::acquisition
