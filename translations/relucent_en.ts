<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="en" sourcelanguage="en">
<context>
    <name>relucent::AcquirePage</name>
    <message numerus="yes">
        <source>%n pattern(s), %1</source>
        <translation>
            <numerusform>%n pattern, %1</numerusform>
            <numerusform>%n patterns, %1</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n photograph(s) kept</source>
        <translation>
            <numerusform>%n photograph kept</numerusform>
            <numerusform>%n photographs kept</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n photograph(s) are safe. Resuming gives the same result as if nothing had happened.</source>
        <translation>
            <numerusform>%n photograph is safe. Resuming gives the same result as if nothing had happened.</numerusform>
            <numerusform>%n photographs are safe. Resuming gives the same result as if nothing had happened.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>All %n photograph(s) are on the disk. The one being taken is not counted.</source>
        <translation>
            <numerusform>%n photograph is on the disk. The one being taken is not counted.</numerusform>
            <numerusform>All %n photographs are on the disk. The one being taken is not counted.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::ClusterPage</name>
    <message numerus="yes">
        <source>%n unknown(s)</source>
        <translation>
            <numerusform>%n unknown</numerusform>
            <numerusform>%n unknowns</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::LinearizePage</name>
    <message numerus="yes">
        <source>%n level(s) a colour, random order, drift removed</source>
        <translation>
            <numerusform>%n level a colour, random order, drift removed</numerusform>
            <numerusform>%n levels a colour, random order, drift removed</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::ThresholdPage</name>
    <message numerus="yes">
        <source>%n pixel(s)</source>
        <translation>
            <numerusform>%n pixel</numerusform>
            <numerusform>%n pixels</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::SettingsDialog</name>
    <message numerus="yes">
        <source>At most %n change(s) a second</source>
        <translation>
            <numerusform>At most %n change a second</numerusform>
            <numerusform>At most %n changes a second</numerusform>
        </translation>
    </message>
</context>
</TS>
