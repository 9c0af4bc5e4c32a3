// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "relucent/charts/chart.h"
#include "relucent/linearization/linearization.h"

namespace relucent::report {

/// Light over drive of the three channels, in percent; colours and marks both differ.
charts::Chart responseChart(const linearization::ProjectorResponse& response, const std::string& title);

/// Two histograms over one another: percent of the values that are no NaN in bins of equal width from 0 to
/// `most`, greater ones in the last.
charts::Chart histogram(const std::vector<float>& before, const std::vector<float>& after, double most,
                        const std::string& unit);

}  // namespace relucent::report
