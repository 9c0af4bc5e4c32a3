// SPDX-License-Identifier: MIT
#include "content/live_stream.h"

namespace relucent::gui {

LiveStream::LiveStream(const StreamAddress& address, const Canvas& canvas, const StreamPatience& patience,
                       const LivePauses& pauses)
    : LiveLink(
          [address, patience](const Opening& opening) {
            return std::make_unique<StreamDecoder>(address, patience, opening.isUnwanted);
          },
          shownStream(address.url), address.hold == StreamAddress::Hold::black, canvas, pauses) {}

}  // namespace relucent::gui
