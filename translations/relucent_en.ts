<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="en" sourcelanguage="en">
<context>
    <name>Overlay</name>
    <message numerus="yes">
        <source>compensated, %n step(s), %1 % out of reach</source>
        <translation>
            <numerusform>compensated, %n step, %1 % out of reach</numerusform>
            <numerusform>compensated, %n steps, %1 % out of reach</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>RecentVenues</name>
    <message numerus="yes">
        <source>Interrupted: %n pattern(s) are safe</source>
        <translation>
            <numerusform>Interrupted: %n pattern is safe</numerusform>
            <numerusform>Interrupted: %n patterns are safe</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Measured; %n newer pattern(s) are safe</source>
        <translation>
            <numerusform>Measured; %n newer pattern is safe</numerusform>
            <numerusform>Measured; %n newer patterns are safe</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>acquisition.stopped-with-forecast</name>
    <message numerus="yes">
        <source>Stopped at {} px blocks; {} dB expected, about {} dB with {} more photographs, {}; go on measuring any time as long as nothing has moved</source>
        <comment>Stopped at {} px blocks; {} dB expected, about {} dB with {} more photograph, {}; go on measuring any time as long as nothing has moved</comment>
        <translation>
            <numerusform>Stopped at {} px blocks; {} dB expected, about {} dB with {} more photograph, {}; go on measuring any time as long as nothing has moved</numerusform>
            <numerusform>Stopped at {} px blocks; {} dB expected, about {} dB with {} more photographs, {}; go on measuring any time as long as nothing has moved</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>acquisition.taken-again</name>
    <message numerus="yes">
        <source>{}: {} patterns from No. {} on were photographed again</source>
        <comment>{}: {} pattern from No. {} on was photographed again</comment>
        <translation>
            <numerusform>{}: {} pattern from No. {} on was photographed again</numerusform>
            <numerusform>{}: {} patterns from No. {} on were photographed again</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>check.pictures-late</name>
    <message numerus="yes">
        <source>Pictures arrive {} photographs late: measure the latency, so that it is waited for.</source>
        <comment>Pictures arrive {} photograph late: measure the latency, so that it is waited for.</comment>
        <translation>
            <numerusform>Pictures arrive {} photograph late: measure the latency, so that it is waited for.</numerusform>
            <numerusform>Pictures arrive {} photographs late: measure the latency, so that it is waited for.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::gui::AcquirePage</name>
    <message numerus="yes">
        <source>%n pattern(s), %1</source>
        <translation>
            <numerusform>%n pattern, %1</numerusform>
            <numerusform>%n patterns, %1</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>About %n pattern(s), %1. Leave the room dark and still.</source>
        <translation>
            <numerusform>About %n pattern, %1. Leave the room dark and still.</numerusform>
            <numerusform>About %n patterns, %1. Leave the room dark and still.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Begins in %n second(s)</source>
        <translation>
            <numerusform>Begins in %n second</numerusform>
            <numerusform>Begins in %n seconds</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Measuring begins in %n second(s). Leave the room dark and still.</source>
        <translation>
            <numerusform>Measuring begins in %n second. Leave the room dark and still.</numerusform>
            <numerusform>Measuring begins in %n seconds. Leave the room dark and still.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Compared with the start every %n pattern(s). What changed is photographed again; if that does not help, the measurement pauses and asks.</source>
        <translation>
            <numerusform>Compared with the start after every pattern. What changed is photographed again; if that does not help, the measurement pauses and asks.</numerusform>
            <numerusform>Compared with the start every %n patterns. What changed is photographed again; if that does not help, the measurement pauses and asks.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1 dB expected, about %2 dB with %n more photograph(s), %3. Go on any time, if nothing has moved.</source>
        <translation>
            <numerusform>%1 dB expected, about %2 dB with %n more photograph, %3. Go on any time, if nothing has moved.</numerusform>
            <numerusform>%1 dB expected, about %2 dB with %n more photographs, %3. Go on any time, if nothing has moved.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>“%1” photographs %n pattern(s) again, from No. %2 on, and goes on from there.</source>
        <translation>
            <numerusform>“%1” photographs %n pattern again, from No. %2 on, and goes on from there.</numerusform>
            <numerusform>“%1” photographs %n patterns again, from No. %2 on, and goes on from there.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s)</source>
        <translation>
            <numerusform>%n pattern</numerusform>
            <numerusform>%n patterns</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s) expected, %1 of them checks; known exactly as each level begins</source>
        <translation>
            <numerusform>%n pattern expected, %1 of them checks; known exactly as each level begins</numerusform>
            <numerusform>%n patterns expected, %1 of them checks; known exactly as each level begins</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s), %1 of them checks</source>
        <translation>
            <numerusform>%n pattern, %1 of them checks</numerusform>
            <numerusform>%n patterns, %1 of them checks</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s) kept</source>
        <translation>
            <numerusform>%n pattern kept</numerusform>
            <numerusform>%n patterns kept</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The photographs of %n pattern(s) are read first. Then measuring goes on where it ended.</source>
        <translation>
            <numerusform>The photographs of %n pattern are read first. Then measuring goes on where it ended.</numerusform>
            <numerusform>The photographs of %n patterns are read first. Then measuring goes on where it ended.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The photographs of %n pattern(s) are safe. Resuming gives the same result as if nothing had happened.</source>
        <translation>
            <numerusform>The photographs of %n pattern are safe. Resuming gives the same result as if nothing had happened.</numerusform>
            <numerusform>The photographs of %n patterns are safe. Resuming gives the same result as if nothing had happened.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The new photographs of %n pattern(s) are safe: resume any time. Until then the earlier measurement is used.</source>
        <translation>
            <numerusform>The new photographs of %n pattern are safe: resume any time. Until then the earlier measurement is used.</numerusform>
            <numerusform>The new photographs of %n patterns are safe: resume any time. Until then the earlier measurement is used.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The photographs of %n pattern(s) are on the disk. The pattern under way is not counted.</source>
        <translation>
            <numerusform>The photographs of %n pattern are on the disk. The pattern under way is not counted.</numerusform>
            <numerusform>The photographs of %n patterns are on the disk. The pattern under way is not counted.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Reading the photographs of %n pattern(s): %1.</source>
        <translation>
            <numerusform>Reading the photographs of %n pattern: %1.</numerusform>
            <numerusform>Reading the photographs of %n patterns: %1.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::gui::CameraPage</name>
    <message numerus="yes">
        <source>%n projector(s): %1</source>
        <translation>
            <numerusform>%n projector: %1</numerusform>
            <numerusform>%n projectors: %1</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::gui::CameraRows</name>
    <message numerus="yes">
        <source>%1 pixels, %n bit(s), exposures %2 to %3</source>
        <translation>
            <numerusform>%1 pixels, %n bit, exposures %2 to %3</numerusform>
            <numerusform>%1 pixels, %n bits, exposures %2 to %3</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::gui::ClusterPage</name>
    <message numerus="yes">
        <source>%n cluster(s)</source>
        <translation>
            <numerusform>%n cluster</numerusform>
            <numerusform>%n clusters</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n cluster(s), median %1 px</source>
        <translation>
            <numerusform>%n cluster, median %1 px</numerusform>
            <numerusform>%n clusters, median %1 px</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1, %2: %n projector pixel(s), error %3</source>
        <translation>
            <numerusform>%1, %2: %n projector pixel, error %3</numerusform>
            <numerusform>%1, %2: %n projector pixels, error %3</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Cluster map, %n cluster(s), largest %1</source>
        <translation>
            <numerusform>Cluster map, %n cluster, largest %1</numerusform>
            <numerusform>Cluster map, %n clusters, largest %1</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1, %2: %n projector pixel(s)</source>
        <translation>
            <numerusform>%1, %2: %n projector pixel</numerusform>
            <numerusform>%1, %2: %n projector pixels</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::gui::FlashConsent</name>
    <message numerus="yes">
        <source>The projector shows patterns that change about %n time(s) a second, and at times more often.</source>
        <translation>
            <numerusform>The projector shows patterns that change about once a second, and at times more often.</numerusform>
            <numerusform>The projector shows patterns that change about %n times a second, and at times more often.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::gui::LinearizePage</name>
    <message numerus="yes">
        <source>%n level(s) a colour, drift removed</source>
        <translation>
            <numerusform>%n level a colour, drift removed</numerusform>
            <numerusform>%n levels a colour, drift removed</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>About %n test pattern(s)</source>
        <translation>
            <numerusform>About %n test pattern</numerusform>
            <numerusform>About %n test patterns</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::gui::MaskView</name>
    <message numerus="yes">
        <source>Drawing a mask: %n point(s). Space sets one at %1, %2. Return closes it, Escape leaves it.</source>
        <translation>
            <numerusform>Drawing a mask: %n point. Space sets one at %1, %2. Return closes it, Escape leaves it.</numerusform>
            <numerusform>Drawing a mask: %n points. Space sets one at %1, %2. Return closes it, Escape leaves it.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::gui::Nights</name>
    <message numerus="yes">
        <source>%n night(s).</source>
        <translation>
            <numerusform>%n night.</numerusform>
            <numerusform>%n nights.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n picture(s) perfected.</source>
        <translation>
            <numerusform>%n picture perfected.</numerusform>
            <numerusform>%n pictures perfected.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputPage</name>
    <message numerus="yes">
        <source>Each of the %n projector(s) needs a screen of its own. Plug in another one.</source>
        <translation>
            <numerusform>The projector needs a screen of its own. Plug in another one.</numerusform>
            <numerusform>Each of the %n projectors needs a screen of its own. Plug in another one.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::gui::Perfecting</name>
    <message numerus="yes">
        <source>%n photograph(s) by now. Keep the room as it is.</source>
        <translation>
            <numerusform>%n photograph by now. Keep the room as it is.</numerusform>
            <numerusform>%n photographs by now. Keep the room as it is.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1: %2 before, %3 now, by %n photograph(s).</source>
        <translation>
            <numerusform>%1: %2 before, %3 now, by %n photograph.</numerusform>
            <numerusform>%1: %2 before, %3 now, by %n photographs.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::gui::SettingsDialog</name>
    <message numerus="yes">
        <source>At most %n change(s) a second</source>
        <translation>
            <numerusform>At most %n change a second</numerusform>
            <numerusform>At most %n changes a second</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::gui::StatusStrip</name>
    <message numerus="yes">
        <source>%n screen(s)</source>
        <translation>
            <numerusform>%n screen</numerusform>
            <numerusform>%n screens</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n with %1, %2</source>
        <comment>projectors and their pixels</comment>
        <translation>
            <numerusform>%n with %1, %2</numerusform>
            <numerusform>%n with %1, %2</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n, simulated</source>
        <comment>cameras</comment>
        <translation>
            <numerusform>%n, simulated</numerusform>
            <numerusform>%n, simulated</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n camera(s)</source>
        <translation>
            <numerusform>%n camera</numerusform>
            <numerusform>%n cameras</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::gui::ThresholdPage</name>
    <message numerus="yes">
        <source>%n pixel(s)</source>
        <translation>
            <numerusform>%n pixel</numerusform>
            <numerusform>%n pixels</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::gui::TidyDialog</name>
    <message numerus="yes">
        <source>%n photograph(s)</source>
        <translation>
            <numerusform>%n photograph</numerusform>
            <numerusform>%n photographs</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::gui::VenuePage</name>
    <message numerus="yes">
        <source>About %n pattern(s), %1</source>
        <translation>
            <numerusform>About %n pattern, %1</numerusform>
            <numerusform>About %n patterns, %1</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>There are %n venue(s) within it: open one of them.</source>
        <translation>
            <numerusform>There is %n venue within it: open it.</numerusform>
            <numerusform>There are %n venues within it: open one of them.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n projector(s)</source>
        <translation>
            <numerusform>%n projector</numerusform>
            <numerusform>%n projectors</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n camera(s)</source>
        <translation>
            <numerusform>%n camera</numerusform>
            <numerusform>%n cameras</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n answer. Choose from the list of each.</source>
        <translation>
            <numerusform>%n answers. Choose it from the list.</numerusform>
            <numerusform>%n answer. Choose from the list of each.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>stage.level-of-tree</name>
    <message numerus="yes">
        <source>level {} of {}: {} patterns</source>
        <comment>level {} of {}: {} pattern</comment>
        <translation>
            <numerusform>level {} of {}: {} pattern</numerusform>
            <numerusform>level {} of {}: {} patterns</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>stage.remeasuring-flagged-pixels</name>
    <message numerus="yes">
        <source>measuring {} flagged pixels again</source>
        <comment>measuring {} flagged pixel again</comment>
        <translation>
            <numerusform>measuring {} flagged pixel again</numerusform>
            <numerusform>measuring {} flagged pixels again</numerusform>
        </translation>
    </message>
</context>
</TS>
