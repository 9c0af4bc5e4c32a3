<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de">
<context>
    <name>About</name>
    <message>
        <source>About Relucent</source>
        <translation>Über Relucent</translation>
    </message>
    <message>
        <source>Version %1, with these libraries: %2.</source>
        <translation>Version %1, mit diesen Bibliotheken: %2.</translation>
    </message>
</context>
<context>
    <name>ContentFiles</name>
    <message>
        <source>Pictures and films</source>
        <translation>Bilder und Filme</translation>
    </message>
    <message>
        <source>Pictures</source>
        <translation>Bilder</translation>
    </message>
    <message>
        <source>All files</source>
        <translation>Alle Dateien</translation>
    </message>
</context>
<context>
    <name>DeviceLabel</name>
    <message>
        <source>Projector %1</source>
        <translation>Projektor %1</translation>
    </message>
    <message>
        <source>Camera %1</source>
        <translation>Kamera %1</translation>
    </message>
</context>
<context>
    <name>EndQuestion</name>
    <message>
        <source>A measurement is under way</source>
        <translation>Eine Messung läuft</translation>
    </message>
    <message>
        <source>%1 in the venue “%2”.</source>
        <translation>%1 am Spielort „%2“.</translation>
    </message>
    <message>
        <source>Every photograph is on the disk. Opened again, the venue goes on from there.</source>
        <translation>Jedes Foto ist auf der Festplatte. Wird der Spielort wieder geöffnet, geht es dort weiter.</translation>
    </message>
    <message>
        <source>End it for now</source>
        <translation>Vorerst beenden</translation>
    </message>
    <message>
        <source>Go on measuring</source>
        <translation>Weiter messen</translation>
    </message>
    <message>
        <source>The show of the venue “%1”: the projector&apos;s screen goes dark.</source>
        <translation>Die Show des Spielorts „%1“: Der Bildschirm des Projektors wird dunkel.</translation>
    </message>
    <message>
        <source>Playlist and results are on the disk. Open the output again to play the show again.</source>
        <translation>Playlist und Ergebnisse sind auf der Festplatte. Öffnen Sie die Ausgabe wieder, um die Show wieder zu spielen.</translation>
    </message>
    <message>
        <source>A measurement and a show are under way</source>
        <translation>Eine Messung und eine Show laufen</translation>
    </message>
    <message>
        <source>End both</source>
        <translation>Beide beenden</translation>
    </message>
    <message>
        <source>Let both go on</source>
        <translation>Beide weiterlaufen lassen</translation>
    </message>
    <message>
        <source>A show is playing</source>
        <translation>Eine Show läuft</translation>
    </message>
    <message>
        <source>End the show</source>
        <translation>Show beenden</translation>
    </message>
    <message>
        <source>Go on playing</source>
        <translation>Weiterspielen</translation>
    </message>
    <message>
        <source>The show of the venue “%1”.</source>
        <translation>Die Vorführung des Spielorts „%1“.</translation>
    </message>
</context>
<context>
    <name>Failure</name>
    <message>
        <source>The computer has no memory left.</source>
        <translation>Der Arbeitsspeicher reicht nicht.</translation>
    </message>
    <message>
        <source>Close other programs, or choose fewer pixels.</source>
        <translation>Schließen Sie andere Programme oder wählen Sie weniger Pixel.</translation>
    </message>
    <message>
        <source>Relucent made a mistake.</source>
        <translation>In Relucent ist ein Fehler aufgetreten.</translation>
    </message>
    <message>
        <source>What is saved is safe. Copy the details for whoever looks after the program, then try again.</source>
        <translation>Gespeichertes ist sicher. Kopieren Sie die Details für die Person, die das Programm betreut, und versuchen Sie es erneut.</translation>
    </message>
    <message>
        <source>What is saved is safe. Try again.</source>
        <translation>Gespeichertes ist sicher. Versuchen Sie es erneut.</translation>
    </message>
    <message>
        <source>The camera does not see this projector</source>
        <translation>Die Kamera sieht diesen Projektor nicht</translation>
    </message>
    <message>
        <source>A program of this venue failed</source>
        <translation>Ein Programm dieses Spielorts ist gescheitert</translation>
    </message>
    <message>
        <source>Another command is typed at the step Venue, by “Change the programs”.</source>
        <translation>Ein anderer Befehl wird im Schritt „Spielort“ mit „Programme ändern“ eingegeben.</translation>
    </message>
</context>
<context>
    <name>FullDisk</name>
    <message>
        <source>The disk is full. Measuring has paused.</source>
        <translation>Die Festplatte ist voll. Die Messung macht Pause.</translation>
    </message>
    <message>
        <source>Every photograph is safe. %1 are free, %2 are needed: then measuring goes on by itself.</source>
        <translation>Alle Fotos sind sicher. %1 sind frei, %2 werden gebraucht: Dann läuft die Messung von selbst weiter.</translation>
    </message>
</context>
<context>
    <name>LostDevice</name>
    <message>
        <source>The projector&apos;s screen is unplugged</source>
        <translation>Der Bildschirm des Projektors ist getrennt</translation>
    </message>
    <message>
        <source>Everything so far is safe. Plug it in again: it goes on by itself.</source>
        <translation>Alles Bisherige ist sicher. Schließen Sie ihn wieder an: Es geht von selbst weiter.</translation>
    </message>
    <message>
        <source>Everything so far is safe. Push in its cable at both ends, and do not move the tripod: it goes on by itself.</source>
        <translation>Alles Bisherige ist sicher. Drücken Sie das Kabel an beiden Enden fest und bewegen Sie das Stativ nicht: Es geht von selbst weiter.</translation>
    </message>
    <message>
        <source>The camera does not answer</source>
        <translation>Die Kamera antwortet nicht</translation>
    </message>
    <message>
        <source>Screen unplugged</source>
        <translation>Bildschirm getrennt</translation>
    </message>
    <message>
        <source>Camera silent</source>
        <translation>Kamera stumm</translation>
    </message>
    <message>
        <source>%1: its screen is unplugged</source>
        <extracomment>%1 is a projector: its name, or &quot;Projector 2&quot;</extracomment>
        <translation>%1: Sein Bildschirm ist getrennt</translation>
    </message>
    <message>
        <source>%1 does not answer</source>
        <extracomment>%1 is a camera: its name, or &quot;Camera 2&quot;</extracomment>
        <translation>%1 antwortet nicht</translation>
    </message>
    <message>
        <source>Everything so far is safe. Plug it in again, then resume.</source>
        <translation>Alles Bisherige ist sicher. Schließen Sie ihn wieder an und setzen Sie dann fort.</translation>
    </message>
    <message>
        <source>Everything so far is safe. Push in its cable at both ends, and do not move the tripod, then resume.</source>
        <translation>Alles Bisherige ist sicher. Drücken Sie das Kabel an beiden Enden fest, bewegen Sie das Stativ nicht und setzen Sie dann fort.</translation>
    </message>
</context>
<context>
    <name>Method</name>
    <message>
        <source>Each pixel&apos;s brightness</source>
        <translation>Helligkeit je Pixel</translation>
    </message>
    <message>
        <source>Each pixel on its own</source>
        <translation>Jedes Pixel für sich</translation>
    </message>
    <message>
        <source>Each pixel, sharpened</source>
        <translation>Jedes Pixel, geschärft</translation>
    </message>
    <message>
        <source>Clusters</source>
        <translation>Cluster</translation>
    </message>
    <message>
        <source>Windows</source>
        <translation>Fenster</translation>
    </message>
    <message>
        <source>All bounces, for films</source>
        <translation>Alle Reflexe, für Filme</translation>
    </message>
    <message>
        <source>Uncorrected</source>
        <translation>Unkorrigiert</translation>
    </message>
    <message>
        <source>All bounces, solved, for stills</source>
        <translation>Alle Reflexe gelöst, Standbilder</translation>
    </message>
</context>
<context>
    <name>NumberText</name>
    <message>
        <source>%1 million</source>
        <translation>%1 Mio.</translation>
    </message>
    <message>
        <source>%1 billion</source>
        <translation>%1 Mrd.</translation>
    </message>
</context>
<context>
    <name>Overlay</name>
    <message>
        <source>%1 frames a second, %2 ms a frame, %3 of %4 late</source>
        <translation>%1 Bilder je Sekunde, %2 ms je Bild, %3 von %4 verspätet</translation>
    </message>
    <message>
        <source>not compensated</source>
        <translation>nicht kompensiert</translation>
    </message>
    <message>
        <source>frozen</source>
        <translation>eingefroren</translation>
    </message>
    <message>
        <source>test chart: %1</source>
        <translation>Testbild: %1</translation>
    </message>
    <message numerus="yes">
        <source>compensated, %n step(s), %1 % out of reach</source>
        <translation>
            <numerusform>kompensiert, %n Schritt, %1 % unerreichbar</numerusform>
            <numerusform>kompensiert, %n Schritte, %1 % unerreichbar</numerusform>
        </translation>
    </message>
    <message>
        <source>still picture</source>
        <translation>Standbild</translation>
    </message>
    <message>
        <source>follows a viewer within %1 ms</source>
        <translation>folgt einem Betrachter binnen %1 ms</translation>
    </message>
    <message>
        <source>perfected by photographs</source>
        <translation>durch Fotos perfektioniert</translation>
    </message>
    <message>
        <source>live picture within %1 ms of its arrival</source>
        <translation>Live-Bild binnen %1 ms nach seiner Ankunft</translation>
    </message>
</context>
<context>
    <name>RecentVenues</name>
    <message>
        <source>Nothing measured yet</source>
        <translation>Noch nichts gemessen</translation>
    </message>
    <message>
        <source>Acquire is next</source>
        <translation>Als Nächstes: Erfassen</translation>
    </message>
    <message>
        <source>Ready to play</source>
        <translation>Spielbereit</translation>
    </message>
    <message>
        <source>Preview out of date</source>
        <translation>Vorschau veraltet</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Gemessen</translation>
    </message>
    <message numerus="yes">
        <source>Interrupted: %n pattern(s) are safe</source>
        <translation>
            <numerusform>Unterbrochen: %n Muster ist sicher</numerusform>
            <numerusform>Unterbrochen: %n Muster sind sicher</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Measured; %n newer pattern(s) are safe</source>
        <translation>
            <numerusform>Gemessen; %n neueres Muster ist sicher</numerusform>
            <numerusform>Gemessen; %n neuere Muster sind sicher</numerusform>
        </translation>
    </message>
    <message>
        <source>Ended by a change</source>
        <translation>Durch Änderung beendet</translation>
    </message>
    <message>
        <source>Stopped at blocks of %1 px</source>
        <translation>Gestoppt bei Blöcken von %1 px</translation>
    </message>
    <message>
        <source>Stopped at %1 px; newer patterns: %2</source>
        <translation>Gestoppt bei %1 px; neuere Muster: %2</translation>
    </message>
    <message>
        <source>A show plays</source>
        <translation>Eine Show läuft</translation>
    </message>
</context>
<context>
    <name>ScreenChoice</name>
    <message>
        <source>This computer</source>
        <translation>Dieser Computer</translation>
    </message>
    <message>
        <source>%1, %2 × %3, %4 Hz</source>
        <translation>%1, %2 × %3, %4 Hz</translation>
    </message>
    <message>
        <source>There is no other screen: the patterns cover this window while they are shown. Plug the projector in, and switch the desktop to extended screens, to keep both apart.</source>
        <translation>Es gibt keinen anderen Bildschirm: Die Muster verdecken dieses Fenster, solange sie gezeigt werden. Um beides zu trennen, schließen Sie den Projektor an und erweitern Sie den Desktop auf ihn.</translation>
    </message>
    <message>
        <source>This is the screen that you work on. Choose the projector&apos;s.</source>
        <translation>Auf diesem Bildschirm arbeiten Sie. Wählen Sie den des Projektors.</translation>
    </message>
    <message>
        <source>The projector was measured with %1 pixels. Set this screen to that size.</source>
        <translation>Der Projektor wurde mit %1 Pixeln gemessen. Stellen Sie diesen Bildschirm auf diese Größe.</translation>
    </message>
    <message>
        <source>This is another projector than the one that was measured. Its light and its place differ: take a verification photograph, and measure again where that does not look as predicted.</source>
        <translation>Das ist ein anderer Projektor als der gemessene. Sein Licht und sein Ort sind anders: Machen Sie ein Prüffoto, und messen Sie neu, wo sie nicht wie vorhergesagt aussieht.</translation>
    </message>
    <message>
        <source>Measured at %1, used at %2. If it is the same projector in the same place, everything that was measured holds; a verification photograph tells.</source>
        <translation>Gemessen an %1, verwendet an %2. Ist es derselbe Projektor am selben Ort, gilt alles Gemessene weiter; ein Prüffoto zeigt es.</translation>
    </message>
</context>
<context>
    <name>StoppedEarly</name>
    <message>
        <source>Measuring was stopped at blocks of %1 px</source>
        <translation>Die Messung wurde bei Blöcken von %1 px gestoppt</translation>
    </message>
    <message>
        <source>All that follows is as coarse. Go on measuring any time.</source>
        <translation>Alles Folgende ist ebenso grob. Messen Sie jederzeit weiter.</translation>
    </message>
    <message>
        <source>Go on at Acquire</source>
        <translation>Weiter bei „Erfassen“</translation>
    </message>
    <message>
        <source>What was measured does not fit together</source>
        <translation>Das Gemessene passt nicht zusammen</translation>
    </message>
    <message>
        <source>Corrected pictures are expected at %1: that is no better than uncorrected. Measure again.</source>
        <translation>Korrigierte Bilder lassen %1 erwarten: Das ist nicht besser als unkorrigiert. Messen Sie neu.</translation>
    </message>
    <message>
        <source>%1 dB</source>
        <translation>%1 dB</translation>
    </message>
    <message>
        <source>Go to Acquire</source>
        <translation>Zu „Erfassen“</translation>
    </message>
    <message>
        <source>Measuring ended because something had changed</source>
        <translation>Die Messung endete, weil sich etwas geändert hatte</translation>
    </message>
    <message>
        <source>What follows is of before. See at Acquire what helps.</source>
        <translation>Was folgt, ist von davor. Unter „Erfassen“ steht, was hilft.</translation>
    </message>
    <message>
        <source>%1 of the view is too bright for the camera</source>
        <translation>%1 des Blicks sind für die Kamera zu hell</translation>
    </message>
    <message>
        <source>Nothing is corrected there. Close the lens a little, check the camera, then measure again.</source>
        <translation>Dort wird nichts korrigiert. Schließen Sie die Blende etwas, prüfen Sie die Kamera, dann messen Sie neu.</translation>
    </message>
    <message>
        <source>%1 of the view is left out</source>
        <translation>%1 des Blicks sind ausgelassen</translation>
    </message>
    <message>
        <source>Test patterns looked different there from what was measured, and nothing is corrected. See that all stands still, then measure again.</source>
        <translation>Testmuster sahen dort anders aus als gemessen, und nichts wird korrigiert. Sorgen Sie dafür, dass alles still steht, dann messen Sie neu.</translation>
    </message>
    <message>
        <source>Measuring was stopped before anything was told apart</source>
        <translation>Das Messen wurde beendet, bevor etwas unterschieden war</translation>
    </message>
    <message>
        <source>No picture can be corrected by it. Go on measuring, or use the earlier one, at Acquire.</source>
        <translation>Damit lässt sich kein Bild korrigieren. Messen Sie weiter, oder nehmen Sie die frühere Messung, bei „Erfassen“.</translation>
    </message>
    <message>
        <source>No picture can be corrected by it. Go on measuring any time.</source>
        <translation>Damit lässt sich kein Bild korrigieren. Messen Sie jederzeit weiter.</translation>
    </message>
    <message>
        <source>Measuring again has not ended</source>
        <translation>Die neue Messung ist nicht zu Ende</translation>
    </message>
    <message>
        <source>What was measured is out of date: it belongs to earlier settings</source>
        <translation>Das Gemessene ist veraltet: Es gehört zu früheren Einstellungen</translation>
    </message>
    <message>
        <source>It still works, and what you see follows from the earlier measurement, until the new one is ready.</source>
        <translation>Die frühere Messung gilt weiter, und was Sie sehen, folgt daraus, bis die neue fertig ist.</translation>
    </message>
</context>
<context>
    <name>VenueKeeping</name>
    <message>
        <source>It is being measured.</source>
        <translation>Er wird gerade gemessen.</translation>
    </message>
    <message>
        <source>It is open. Open another venue, then come back.</source>
        <translation>Er ist geöffnet. Öffnen Sie einen anderen Spielort und kommen Sie dann zurück.</translation>
    </message>
    <message>
        <source>Give the venue a name.</source>
        <translation>Geben Sie dem Spielort einen Namen.</translation>
    </message>
    <message>
        <source>A name cannot hold a slash.</source>
        <translation>Ein Name darf keinen Schrägstrich enthalten.</translation>
    </message>
    <message>
        <source>A name cannot begin with a full stop: its folder would be hidden.</source>
        <translation>Ein Name darf nicht mit einem Punkt beginnen: Sein Ordner wäre verborgen.</translation>
    </message>
    <message>
        <source>There is a folder of that name. Choose another name.</source>
        <translation>Einen Ordner dieses Namens gibt es schon. Wählen Sie einen anderen Namen.</translation>
    </message>
    <message>
        <source>Its show starts at log-in. Open it, and remove the installed show at Output first.</source>
        <translation>Seine Show startet bei der Anmeldung. Öffnen Sie ihn und entfernen Sie zuerst bei Ausgabe die installierte Show.</translation>
    </message>
</context>
<context>
    <name>ViewActions</name>
    <message>
        <source>Show everything</source>
        <translation>Alles zeigen</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>Speichern</translation>
    </message>
    <message>
        <source>Picture as seen</source>
        <translation>Bild wie angezeigt</translation>
    </message>
    <message>
        <source>Save the picture</source>
        <translation>Bild speichern</translation>
    </message>
    <message>
        <source>Pictures (*.png)</source>
        <translation>Bilder (*.png)</translation>
    </message>
    <message>
        <source>Values</source>
        <translation>Werte</translation>
    </message>
    <message>
        <source>Save the values</source>
        <translation>Werte speichern</translation>
    </message>
    <message>
        <source>OpenEXR (*.exr)</source>
        <translation>OpenEXR (*.exr)</translation>
    </message>
    <message>
        <source>Whole screen, save</source>
        <translation>Ganzer Bildschirm, speichern</translation>
    </message>
    <message>
        <source>Whole screen (F11 in the picture)</source>
        <translation>Vollbild (F11 im Bild)</translation>
    </message>
</context>
<context>
    <name>WindowProjector</name>
    <message>
        <source>The desktop scales this screen by %1, which blurs every pixel. Set its scale to 100 %.</source>
        <translation>Der Desktop skaliert diesen Bildschirm um den Faktor %1; das macht jedes Pixel unscharf. Stellen Sie die Skalierung auf 100 %.</translation>
    </message>
    <message>
        <source>A venue is being measured</source>
        <translation>Ein Spielort wird gemessen</translation>
    </message>
</context>
<context>
    <name>acquisition.alarm-skipped</name>
    <message>
        <source>accepted before pattern {}: {}</source>
        <translation>vor Muster {} hingenommen: {}</translation>
    </message>
</context>
<context>
    <name>acquisition.ended-by-change</name>
    <message>
        <source>measuring ended with a change: {}; photographs from No. {} on are left out</source>
        <translation>die Messung endete mit einer Veränderung: {}; Fotos ab Nr. {} sind weggelassen</translation>
    </message>
</context>
<context>
    <name>acquisition.light-drifted</name>
    <message>
        <source>The light changed by {} % between the first and the last photograph; this was compensated for, but let the projector warm up before the next time</source>
        <translation>das Licht hat sich zwischen dem ersten und dem letzten Foto um {} % geändert; das wurde berücksichtigt, aber lassen Sie den Projektor das nächste Mal vorher warm werden</translation>
    </message>
</context>
<context>
    <name>acquisition.overexposed</name>
    <message>
        <source>{} % of the camera pixels are overexposed even at the shortest exposure: close the camera&apos;s aperture a little, then measure again</source>
        <translation>{} % der Kamerapixel sind selbst bei der kürzesten Belichtung überbelichtet: Schließen Sie die Blende der Kamera etwas, dann messen Sie erneut</translation>
    </message>
</context>
<context>
    <name>acquisition.pixels-flagged</name>
    <message>
        <source>{} % of the camera pixels do not see what was predicted for the test patterns: check that nothing moved or flickered; these pixels are left out of the compensation</source>
        <translation>{} % der Kamerapixel sehen in den Testmustern etwas anderes als vorhergesagt: Prüfen Sie, dass sich nichts bewegt und nichts geflackert hat; diese Pixel bleiben bei der Kompensation außer Acht</translation>
    </message>
</context>
<context>
    <name>acquisition.poor-quality</name>
    <message>
        <source>What was measured does not fit together: corrected pictures are expected at {} dB, no better than uncorrected; see that projector, camera and surface stand still and that no other light changes, then measure again</source>
        <translation>Das Gemessene passt nicht zusammen: Korrigierte Bilder lassen {} dB erwarten, nicht besser als unkorrigierte; sorgen Sie dafür, dass Projektor, Kamera und Oberfläche stillstehen und kein anderes Licht sich ändert, und messen Sie dann neu</translation>
    </message>
</context>
<context>
    <name>acquisition.stopped-early</name>
    <message>
        <source>Measuring was stopped at blocks of {} px: what is finer is missing, and pictures are compensated less sharply; go on measuring any time as long as nothing has moved</source>
        <translation>Die Messung wurde bei Blöcken von {} px gestoppt: Was feiner ist, fehlt, und Bilder werden weniger scharf kompensiert; messen Sie jederzeit weiter, solange sich nichts bewegt hat</translation>
    </message>
</context>
<context>
    <name>acquisition.stopped-with-forecast</name>
    <message numerus="yes">
        <source>Stopped at {} px blocks; {} dB expected, about {} dB with {} more photographs, {}; go on measuring any time as long as nothing has moved</source>
        <comment>Stopped at {} px blocks; {} dB expected, about {} dB with {} more photograph, {}; go on measuring any time as long as nothing has moved</comment>
        <translation>
            <numerusform>Bei Blöcken von {} px gestoppt; {} dB zu erwarten, etwa {} dB mit {} weiteren Foto, {}; messen Sie jederzeit weiter, solange sich nichts bewegt hat</numerusform>
            <numerusform>Bei Blöcken von {} px gestoppt; {} dB zu erwarten, etwa {} dB mit {} weiteren Fotos, {}; messen Sie jederzeit weiter, solange sich nichts bewegt hat</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>acquisition.taken-again</name>
    <message numerus="yes">
        <source>{}: {} patterns from No. {} on were photographed again</source>
        <comment>{}: {} pattern from No. {} on was photographed again</comment>
        <translation>
            <numerusform>{}: {} Muster ab Nr. {} wurde noch einmal fotografiert</numerusform>
            <numerusform>{}: {} Muster ab Nr. {} wurden noch einmal fotografiert</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>alarm.by-resuming</name>
    <message>
        <source>{} by resuming the calibration; {}</source>
        <translation>{}, indem Sie die Kalibrierung fortsetzen; {}</translation>
    </message>
</context>
<context>
    <name>alarm.camera-sees-nothing</name>
    <message>
        <source>the camera sees nothing at all</source>
        <translation>die Kamera sieht gar nichts</translation>
    </message>
</context>
<context>
    <name>alarm.check-screen</name>
    <message>
        <source>check that the right screen is chosen and nothing covers the picture, then try again</source>
        <translation>prüfen Sie, ob der richtige Bildschirm gewählt ist und nichts das Bild verdeckt, dann versuchen Sie es erneut</translation>
    </message>
</context>
<context>
    <name>alarm.clear-the-view</name>
    <message>
        <source>take away what is in the light or in the view, then try again</source>
        <translation>entfernen Sie, was im Licht oder im Bild steht, dann versuchen Sie es erneut</translation>
    </message>
</context>
<context>
    <name>alarm.lamp-changed</name>
    <message>
        <source>the projector&apos;s light changed by {} % within a few photographs</source>
        <translation>das Licht des Projektors hat sich innerhalb weniger Fotos um {} % geändert</translation>
    </message>
</context>
<context>
    <name>alarm.leave-it-as-it-is</name>
    <message>
        <source>leave it as it is now, then try again: measuring begins again</source>
        <translation>lassen Sie es, wie es jetzt ist, und versuchen Sie es noch einmal: Die Messung beginnt von vorn</translation>
    </message>
</context>
<context>
    <name>alarm.light-flickers</name>
    <message>
        <source>the light flickers or was switched: photographs of one pattern differ by {} %</source>
        <translation>das Licht flackert oder wurde geschaltet: Fotos eines Musters unterscheiden sich um {} %</translation>
    </message>
</context>
<context>
    <name>alarm.light-room-or-measure-again</name>
    <message>
        <source>switch on again what shone when measuring began, then try again; or stop, and measure again in the light as it is now</source>
        <translation>schalten Sie wieder ein, was zu Beginn der Messung leuchtete, und versuchen Sie es noch einmal; oder halten Sie an und messen Sie im jetzigen Licht neu</translation>
    </message>
</context>
<context>
    <name>alarm.moved</name>
    <message>
        <source>a camera or projector has moved: the view of camera {} is shifted by {}, {} pixels and turned by {} degrees</source>
        <translation>eine Kamera oder ein Projektor hat sich bewegt: Das Bild von Kamera {} ist um {} und {} Pixel verschoben und um {} Grad gedreht</translation>
    </message>
</context>
<context>
    <name>alarm.moved-besides</name>
    <message>
        <source>{}; besides, {}</source>
        <translation>{}; außerdem {}</translation>
    </message>
</context>
<context>
    <name>alarm.photograph-dark</name>
    <message>
        <source>one of two photographs of a pattern is dark: the lens was covered, or the projector&apos;s picture gone</source>
        <translation>eines von zwei Fotos eines Musters ist dunkel: Das Objektiv war verdeckt, oder das Bild des Projektors war weg</translation>
    </message>
</context>
<context>
    <name>alarm.photographs-differ</name>
    <message>
        <source>photographs of one pattern differ by {} %: the light flickers, or something moved between them</source>
        <translation>Fotos desselben Musters unterscheiden sich um {} %: das Licht flackert, oder dazwischen hat sich etwas bewegt</translation>
    </message>
</context>
<context>
    <name>alarm.picture-mirrored</name>
    <message>
        <source>the picture of projector {} appears mirrored</source>
        <translation>das Bild von Projektor {} erscheint gespiegelt</translation>
    </message>
</context>
<context>
    <name>alarm.projector-shows-nothing</name>
    <message>
        <source>the projector shows nothing, though the room&apos;s own light is still seen</source>
        <translation>der Projektor zeigt nichts, nur das Raumlicht ist noch zu sehen</translation>
    </message>
</context>
<context>
    <name>alarm.put-back-or-measure-again</name>
    <message>
        <source>put it back, then try again; or stop, and measure again without it</source>
        <translation>stellen Sie es zurück und versuchen Sie es noch einmal; oder halten Sie an und messen Sie ohne es neu</translation>
    </message>
</context>
<context>
    <name>alarm.put-it-back</name>
    <message>
        <source>put it back to within half a pixel, then try again</source>
        <translation>stellen Sie das Gerät auf ein halbes Pixel genau zurück, dann versuchen Sie es erneut</translation>
    </message>
</context>
<context>
    <name>alarm.put-it-back-and-restore-light</name>
    <message>
        <source>put it back to within half a pixel and restore the light of the room, then try again</source>
        <translation>stellen Sie das Gerät auf ein halbes Pixel genau zurück und das Raumlicht wieder her, dann versuchen Sie es erneut</translation>
    </message>
</context>
<context>
    <name>alarm.restore-room-light</name>
    <message>
        <source>restore the light of the room, keep doors and curtains closed, then try again</source>
        <translation>stellen Sie den alten Zustand wieder her, halten Sie Türen und Vorhänge geschlossen, dann versuchen Sie es erneut</translation>
    </message>
</context>
<context>
    <name>alarm.room-brighter</name>
    <message>
        <source>the light of the room became brighter</source>
        <translation>das Raumlicht ist heller geworden</translation>
    </message>
</context>
<context>
    <name>alarm.room-darker</name>
    <message>
        <source>the light of the room became darker</source>
        <translation>das Raumlicht ist dunkler geworden</translation>
    </message>
</context>
<context>
    <name>alarm.safe-before-check</name>
    <message>
        <source>every photograph up to the previous check is safe</source>
        <translation>alle Fotos bis zur letzten Kontrolle davor sind sicher</translation>
    </message>
</context>
<context>
    <name>alarm.safe-before-light-transport</name>
    <message>
        <source>every photograph before the light transport is safe</source>
        <translation>alle Fotos vor dem Lichttransport sind sicher</translation>
    </message>
</context>
<context>
    <name>alarm.something-gone</name>
    <message>
        <source>{} % of the view of camera {} are brighter than before: what stood there is gone</source>
        <translation>{} % des Blickfelds von Kamera {} sind heller als zuvor: Was dort stand, ist weg</translation>
    </message>
</context>
<context>
    <name>alarm.steady-all</name>
    <message>
        <source>see that camera, projector and surface stand still, switch off dimmed and fluorescent lamps and the projector&apos;s power saving, then try again</source>
        <translation>achten Sie darauf, dass Kamera, Projektor und Fläche stillstehen, schalten Sie gedimmte Lampen, Leuchtstofflampen und den Energiesparmodus des Projektors aus, dann versuchen Sie es erneut</translation>
    </message>
</context>
<context>
    <name>alarm.switch-off-dimmed-lamps</name>
    <message>
        <source>switch off dimmed and fluorescent lamps and the projector&apos;s power saving, then try again</source>
        <translation>schalten Sie gedimmte Lampen, Leuchtstofflampen und den Energiesparmodus des Projektors aus, dann versuchen Sie es erneut</translation>
    </message>
</context>
<context>
    <name>alarm.switch-off-eco-modes</name>
    <message>
        <source>switch off its automatic brightness and eco modes, let it warm up, then try again</source>
        <translation>schalten Sie seine automatische Helligkeit und seine Eco-Modi aus, lassen Sie ihn warm werden, dann versuchen Sie es erneut</translation>
    </message>
</context>
<context>
    <name>alarm.switch-off-rear-projection</name>
    <message>
        <source>switch off the projector&apos;s rear or ceiling mode, or allow a mirrored picture, then try again</source>
        <translation>schalten Sie Rückprojektion oder Deckenmontage am Projektor aus oder erlauben Sie ein gespiegeltes Bild, dann versuchen Sie es erneut</translation>
    </message>
</context>
<context>
    <name>alarm.uncover-lens</name>
    <message>
        <source>uncover the lens, check that the projector is on, then try again</source>
        <translation>decken Sie das Objektiv auf, prüfen Sie, ob der Projektor eingeschaltet ist, dann versuchen Sie es erneut</translation>
    </message>
</context>
<context>
    <name>alarm.view-changed</name>
    <message>
        <source>{} % of the view of camera {} look different from before</source>
        <translation>{} % des Bilds von Kamera {} sehen anders aus als zuvor</translation>
    </message>
</context>
<context>
    <name>alarm.wake-projector</name>
    <message>
        <source>wake the projector, switch off its and the screen&apos;s power saving, then try again</source>
        <translation>wecken Sie den Projektor, schalten Sie seinen Energiesparmodus und den des Bildschirms aus, dann versuchen Sie es erneut</translation>
    </message>
</context>
<context>
    <name>alarm.wrong-picture</name>
    <message>
        <source>projector {} does not show the picture that it is given</source>
        <translation>Projektor {} zeigt das Bild nicht, das er bekommt</translation>
    </message>
</context>
<context>
    <name>calibration.allow-writing-then-resume</name>
    <message>
        <source>check that the folder may be written to, then go on</source>
        <translation>prüfen Sie, ob in den Ordner geschrieben werden darf, dann machen Sie weiter</translation>
    </message>
</context>
<context>
    <name>calibration.allow-writing-then-retry</name>
    <message>
        <source>check that the folder may be written to, then try again</source>
        <translation>prüfen Sie, ob in den Ordner geschrieben werden darf, dann versuchen Sie es erneut</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-list-folder</name>
    <message>
        <source>cannot look into the folder ({})</source>
        <translation>Inhalt des Ordners kann nicht gelesen werden ({})</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-move-photograph</name>
    <message>
        <source>a photograph cannot be moved ({})</source>
        <translation>ein Foto kann nicht verschoben werden ({})</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-open-folder</name>
    <message>
        <source>cannot open the folder ({})</source>
        <translation>Ordner kann nicht geöffnet werden ({})</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-remove-photograph</name>
    <message>
        <source>a photograph cannot be removed ({})</source>
        <translation>ein Foto kann nicht gelöscht werden ({})</translation>
    </message>
</context>
<context>
    <name>calibration.check-path-and-permission</name>
    <message>
        <source>check the path and that you may read it</source>
        <translation>prüfen Sie den Pfad und ob Sie ihn lesen dürfen</translation>
    </message>
</context>
<context>
    <name>calibration.check-permission-or-name</name>
    <message>
        <source>check that you may read it, or choose another name</source>
        <translation>prüfen Sie, ob Sie ihn lesen dürfen, oder wählen Sie einen anderen Namen</translation>
    </message>
</context>
<context>
    <name>calibration.choose-another-or-copy-again</name>
    <message>
        <source>choose another calibration, or copy it again from where it was measured</source>
        <translation>wählen Sie eine andere Kalibrierung oder kopieren Sie sie neu von dort, wo sie gemessen wurde</translation>
    </message>
</context>
<context>
    <name>calibration.disk-full</name>
    <message>
        <source>the disk is full</source>
        <translation>die Festplatte ist voll</translation>
    </message>
</context>
<context>
    <name>calibration.give-addresses-again</name>
    <message>
        <source>give the projectors&apos; addresses again</source>
        <translation>geben Sie die Adressen der Projektoren erneut an</translation>
    </message>
</context>
<context>
    <name>calibration.make-room-then-resume</name>
    <message>
        <source>every photograph so far is safe: free at least {} MB there, then resume</source>
        <translation>alle bisherigen Fotos sind sicher: geben Sie dort mindestens {} MB frei, dann setzen Sie fort</translation>
    </message>
</context>
<context>
    <name>calibration.manifest-damaged</name>
    <message>
        <source>the file that describes the venue is damaged</source>
        <translation>die Datei, die den Ort beschreibt, ist beschädigt</translation>
    </message>
</context>
<context>
    <name>calibration.network-unreadable</name>
    <message>
        <source>the addresses of the projectors on the network cannot be read ({})</source>
        <translation>die Adressen der Projektoren im Netzwerk sind nicht lesbar ({})</translation>
    </message>
</context>
<context>
    <name>calibration.not-a-calibration</name>
    <message>
        <source>this is not a calibration of Relucent</source>
        <translation>dies ist keine Kalibrierung von Relucent</translation>
    </message>
</context>
<context>
    <name>calibration.result-file-missing</name>
    <message>
        <source>a file of the calibration&apos;s {} is missing</source>
        <translation>eine Datei der Kalibrierung ({}) fehlt</translation>
    </message>
</context>
<context>
    <name>calibration.result-file-size-wrong</name>
    <message>
        <source>a file of the calibration&apos;s {} has {} bytes instead of {}</source>
        <translation>eine Datei der Kalibrierung ({}) hat {} statt {} Bytes</translation>
    </message>
</context>
<context>
    <name>cast.check-screen</name>
    <message>
        <source>see whether the screen is on, or the window open</source>
        <translation>sehen Sie nach, ob der Bildschirm eingeschaltet oder das Fenster offen ist</translation>
    </message>
</context>
<context>
    <name>cast.choice-refused</name>
    <message>
        <source>the desktop no longer gives what was chosen for it</source>
        <translation>der Desktop gibt nicht mehr, was dafür gewählt war</translation>
    </message>
</context>
<context>
    <name>cast.choose-again</name>
    <message>
        <source>play it again, and choose there what is shown</source>
        <translation>spielen Sie es erneut ab und wählen Sie dort, was gezeigt wird</translation>
    </message>
</context>
<context>
    <name>cast.choose-in-wizard</name>
    <message>
        <source>play it once in the wizard, on Output, and choose there; a show then takes the same</source>
        <translation>spielen Sie es einmal im Assistenten unter „Ausgabe“ ab und wählen Sie dort; eine Show nimmt dann dasselbe</translation>
    </message>
</context>
<context>
    <name>cast.ended</name>
    <message>
        <source>the desktop has ended it</source>
        <translation>der Desktop hat es beendet</translation>
    </message>
</context>
<context>
    <name>cast.install-pipewire</name>
    <message>
        <source>install pipewire and wireplumber, and log in again</source>
        <translation>installieren Sie pipewire und wireplumber und melden Sie sich neu an</translation>
    </message>
</context>
<context>
    <name>cast.install-portal</name>
    <message>
        <source>install xdg-desktop-portal and its part for this desktop, and log in again</source>
        <translation>installieren Sie xdg-desktop-portal und seinen Teil für diesen Desktop und melden Sie sich neu an</translation>
    </message>
</context>
<context>
    <name>cast.log-in-again</name>
    <message>
        <source>log in again</source>
        <translation>melden Sie sich neu an</translation>
    </message>
</context>
<context>
    <name>cast.no-pipewire</name>
    <message>
        <source>PipeWire, which brings the picture, does not answer</source>
        <translation>PipeWire, das das Bild bringt, antwortet nicht</translation>
    </message>
</context>
<context>
    <name>cast.no-portal</name>
    <message>
        <source>this desktop has no portal that gives the picture of a screen</source>
        <translation>dieser Desktop hat kein Portal, das das Bild eines Bildschirms gibt</translation>
    </message>
</context>
<context>
    <name>cast.no-windows</name>
    <message>
        <source>this desktop gives pictures of screens, not of windows</source>
        <translation>dieser Desktop gibt Bilder von Bildschirmen, nicht von Fenstern</translation>
    </message>
</context>
<context>
    <name>cast.not-chosen</name>
    <message>
        <source>nobody has chosen in the desktop&apos;s dialog what is shown</source>
        <translation>niemand hat im Dialog des Desktops gewählt, was gezeigt wird</translation>
    </message>
</context>
<context>
    <name>cast.play-screen</name>
    <message>
        <source>play the screen on which the window is</source>
        <translation>spielen Sie den Bildschirm ab, auf dem das Fenster ist</translation>
    </message>
</context>
<context>
    <name>cast.portal-failed</name>
    <message>
        <source>the desktop&apos;s portal gives no picture ({})</source>
        <translation>das Portal des Desktops gibt kein Bild ({})</translation>
    </message>
</context>
<context>
    <name>cast.portal-silent</name>
    <message>
        <source>the desktop&apos;s portal has not answered for {} s</source>
        <translation>das Portal des Desktops hat {} s lang nicht geantwortet</translation>
    </message>
</context>
<context>
    <name>cast.refused</name>
    <message>
        <source>it was refused in the desktop&apos;s dialog</source>
        <translation>es wurde im Dialog des Desktops abgelehnt</translation>
    </message>
</context>
<context>
    <name>cast.unusable</name>
    <message>
        <source>what the desktop sends is no picture that can be shown</source>
        <translation>was der Desktop sendet, ist kein Bild, das gezeigt werden kann</translation>
    </message>
</context>
<context>
    <name>cast.update-desktop</name>
    <message>
        <source>update the desktop&apos;s portal and PipeWire</source>
        <translation>aktualisieren Sie das Portal des Desktops und PipeWire</translation>
    </message>
</context>
<context>
    <name>check.colour-wheel</name>
    <message>
        <source>The colours come one after the other, as through a colour wheel ({} % in {} ms): expose whole frames, multiples of {} ms.</source>
        <translation>Die Farben kommen nacheinander, wie durch ein Farbrad ({} % in {} ms): ganze Bilder belichten, Vielfache von {} ms.</translation>
    </message>
</context>
<context>
    <name>check.dithering</name>
    <message>
        <source>The projector mixes greys in time, pixel by pixel ({} %): expose several whole frames, and switch its smoothing and 3D modes off.</source>
        <translation>Der Projektor mischt Grautöne zeitlich, Pixel für Pixel ({} %): mehrere ganze Bilder belichten, seine Glättung und 3D-Modi ausschalten.</translation>
    </message>
</context>
<context>
    <name>check.lamp-flickers</name>
    <message>
        <source>The lamp flickers within a frame, by {} % in {} ms: expose whole frames, multiples of {} ms.</source>
        <translation>Die Lampe flackert innerhalb eines Einzelbilds, um {} % in {} ms: ganze Bilder belichten, Vielfache von {} ms.</translation>
    </message>
</context>
<context>
    <name>check.light-even</name>
    <message>
        <source>The light is even: no flicker, colour wheel, bands or dithering is seen.</source>
        <translation>Das Licht ist gleichmäßig: kein Flackern, kein Farbrad, keine Streifen, kein Dithering.</translation>
    </message>
</context>
<context>
    <name>check.light-unsteady</name>
    <message>
        <source>The light changes by {} % between exposures of whole frames: let the lamp warm up, and switch off dynamic brightness and the lamps in the room.</source>
        <translation>Das Licht ändert sich zwischen Belichtungen ganzer Bilder um {} %: Lampe warm werden lassen, dynamische Helligkeit und Lampen im Raum ausschalten.</translation>
    </message>
</context>
<context>
    <name>check.no-brief-exposure</name>
    <message>
        <source>The camera cannot expose for a part of a frame, or sees too little then: flicker within a frame cannot be detected.</source>
        <translation>Die Kamera kann nicht kürzer als ein Einzelbild belichten oder sieht dann zu wenig: Flackern innerhalb eines Einzelbilds ist nicht zu erkennen.</translation>
    </message>
</context>
<context>
    <name>check.other-screen-seen</name>
    <message>
        <source>The camera sees {} and not {}.</source>
        <translation>Die Kamera sieht {} und nicht {}.</translation>
    </message>
</context>
<context>
    <name>check.picture-takes</name>
    <message>
        <source>A picture takes {} ms to appear: each one is waited for that long.</source>
        <translation>Ein Bild braucht {} ms, bis es erscheint: So lange wird auf jedes gewartet.</translation>
    </message>
</context>
<context>
    <name>check.pictures-late</name>
    <message numerus="yes">
        <source>Pictures arrive {} photographs late: measure the latency, so that it is waited for.</source>
        <comment>Pictures arrive {} photograph late: measure the latency, so that it is waited for.</comment>
        <translation>
            <numerusform>Bilder kommen ein Foto zu spät: Die Verzögerung muss gemessen und abgewartet werden.</numerusform>
            <numerusform>Bilder kommen {} Fotos zu spät: Die Verzögerung muss gemessen und abgewartet werden.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>check.rolling-shutter</name>
    <message>
        <source>The camera exposes its rows one after the other (rolling shutter): brief exposures have bands of {} %. Expose whole frames, multiples of {} ms.</source>
        <translation>Die Kamera belichtet ihre Zeilen nacheinander (Rolling Shutter): Kurze Belichtungen haben Streifen von {} %. Ganze Bilder belichten, Vielfache von {} ms.</translation>
    </message>
</context>
<context>
    <name>check.screen-mirrored</name>
    <message>
        <source>The picture appears mirrored. If it is not meant to (rear projection, a mirror), switch that off in the projector&apos;s menu.</source>
        <translation>Das Bild erscheint gespiegelt. Ist das nicht gewollt (Rückprojektion, Spiegel), im Menü des Projektors ausschalten.</translation>
    </message>
</context>
<context>
    <name>check.screen-not-seen</name>
    <message>
        <source>The camera does not see {}.</source>
        <translation>Die Kamera sieht {} nicht.</translation>
    </message>
</context>
<context>
    <name>check.screen-seen</name>
    <message>
        <source>The camera sees {}: {} % of its view follow the test pattern.</source>
        <translation>Die Kamera sieht {}: {} % ihres Bildes folgen dem Testmuster.</translation>
    </message>
</context>
<context>
    <name>check.white-changes</name>
    <message>
        <source>White changes by {} % from photograph to photograph: expose whole frames of the projector, multiples of {} ms, and switch its dynamic brightness off.</source>
        <translation>Weiß ändert sich von Foto zu Foto um {} %: ganze Bilder des Projektors belichten, Vielfache von {} ms, und seine dynamische Helligkeit ausschalten.</translation>
    </message>
</context>
<context>
    <name>compensation.draw-masks-of-cameras</name>
    <message>
        <source>draw masks in the views of the cameras that measured this calibration</source>
        <translation>zeichnen Sie Masken in den Ansichten der Kameras, die diese Kalibrierung gemessen haben</translation>
    </message>
</context>
<context>
    <name>compensation.mask-crosses-itself</name>
    <message>
        <source>its outline crosses itself</source>
        <translation>ihr Umriss überkreuzt sich selbst</translation>
    </message>
</context>
<context>
    <name>compensation.mask-encloses-nothing</name>
    <message>
        <source>its outline encloses nothing</source>
        <translation>ihr Umriss umschließt nichts</translation>
    </message>
</context>
<context>
    <name>compensation.mask-feather-out-of-range</name>
    <message>
        <source>its feather must lie between 0 and half of the view&apos;s larger side</source>
        <translation>ihr weicher Rand muss zwischen 0 und der Hälfte der längeren Seite der Ansicht liegen</translation>
    </message>
</context>
<context>
    <name>compensation.mask-not-finite</name>
    <message>
        <source>its points must be finite numbers</source>
        <translation>ihre Punkte müssen endliche Zahlen sein</translation>
    </message>
</context>
<context>
    <name>compensation.mask-of-no-camera</name>
    <message>
        <source>a mask was drawn in the view of camera {}, but there are {} cameras</source>
        <translation>eine Maske wurde in der Ansicht von Kamera {} gezeichnet, aber es gibt {} Kameras</translation>
    </message>
</context>
<context>
    <name>compensation.mask-outside-view</name>
    <message>
        <source>its points must lie within the view, from 0 to 1 along both sides</source>
        <translation>ihre Punkte müssen in der Ansicht liegen, von 0 bis 1 längs beider Seiten</translation>
    </message>
</context>
<context>
    <name>compensation.mask-point-twice</name>
    <message>
        <source>two points of its outline are the same</source>
        <translation>zwei Punkte ihres Umrisses sind gleich</translation>
    </message>
</context>
<context>
    <name>compensation.mask-too-few-points</name>
    <message>
        <source>its outline needs three points at least</source>
        <translation>ihr Umriss braucht mindestens drei Punkte</translation>
    </message>
</context>
<context>
    <name>compensation.mask-too-many-points</name>
    <message>
        <source>its outline may have {} points at most</source>
        <translation>ihr Umriss darf höchstens {} Punkte haben</translation>
    </message>
</context>
<context>
    <name>compensation.masks-cover-everything</name>
    <message>
        <source>the masks cover the whole picture</source>
        <translation>die Masken bedecken das ganze Bild</translation>
    </message>
</context>
<context>
    <name>compensation.of-mask</name>
    <message>
        <source>mask {}: {}</source>
        <translation>Maske {}: {}</translation>
    </message>
</context>
<context>
    <name>compensation.shrink-masks</name>
    <message>
        <source>make a mask smaller, or remove one</source>
        <translation>verkleinern Sie eine Maske oder entfernen Sie eine</translation>
    </message>
</context>
<context>
    <name>content.choose-picture-folder</name>
    <message>
        <source>choose a folder with PNG, JPEG, TIFF or EXR files</source>
        <translation>wählen Sie einen Ordner mit PNG-, JPEG-, TIFF- oder EXR-Dateien</translation>
    </message>
</context>
<context>
    <name>content.choose-supported-picture</name>
    <message>
        <source>choose a PNG, JPEG, TIFF or EXR picture</source>
        <translation>wählen Sie ein Bild in PNG, JPEG, TIFF oder EXR</translation>
    </message>
</context>
<context>
    <name>content.connect-capture-device</name>
    <message>
        <source>plug it in, close other programs that use it, and try again</source>
        <translation>schließen Sie es an, schließen Sie andere Programme, die es nutzen, und versuchen Sie es erneut</translation>
    </message>
</context>
<context>
    <name>content.log-in-to-xorg</name>
    <message>
        <source>log in to a desktop, or play files</source>
        <translation>melden Sie sich an einem Desktop an oder spielen Sie Dateien ab</translation>
    </message>
</context>
<context>
    <name>content.no-pictures</name>
    <message>
        <source>no pictures in this folder</source>
        <translation>in diesem Ordner sind keine Bilder</translation>
    </message>
</context>
<context>
    <name>content.no-x-server</name>
    <message>
        <source>the live picture of a screen needs an X server, and none answers</source>
        <translation>das Livebild eines Bildschirms braucht einen X-Server, und keiner antwortet</translation>
    </message>
</context>
<context>
    <name>content.nothing-captured</name>
    <message>
        <source>the capture device gives no picture</source>
        <translation>das Aufnahmegerät liefert kein Bild</translation>
    </message>
</context>
<context>
    <name>content.open-first</name>
    <message>
        <source>open it first</source>
        <translation>öffnen Sie es zuerst</translation>
    </message>
</context>
<context>
    <name>content.open-first-or-choose</name>
    <message>
        <source>open it first; there are: {}</source>
        <translation>öffnen Sie es zuerst; es gibt: {}</translation>
    </message>
</context>
<context>
    <name>content.picture-unreadable</name>
    <message>
        <source>not a picture that can be read</source>
        <translation>kein Bild, das gelesen werden kann</translation>
    </message>
</context>
<context>
    <name>content.sequence-empty</name>
    <message>
        <source>the sequence has no pictures</source>
        <translation>die Bildfolge hat keine Bilder</translation>
    </message>
</context>
<context>
    <name>content.unknown-window</name>
    <message>
        <source>there is no window &apos;{}&apos;</source>
        <translation>es gibt kein Fenster „{}“</translation>
    </message>
</context>
<context>
    <name>device.aim-uncover-and-expose-longer</name>
    <message>
        <source>aim it at the projection, take off its lens cap, and expose longer</source>
        <translation>richten Sie sie auf die Projektion, nehmen Sie den Objektivdeckel ab und belichten Sie länger</translation>
    </message>
</context>
<context>
    <name>device.allow-command-more-time</name>
    <message>
        <source>check the device, or allow the command more time: {}</source>
        <translation>prüfen Sie das Gerät oder geben Sie dem Befehl mehr Zeit: {}</translation>
    </message>
</context>
<context>
    <name>device.another-program-holds-camera</name>
    <message>
        <source>another program holds the camera</source>
        <translation>ein anderes Programm belegt die Kamera</translation>
    </message>
</context>
<context>
    <name>device.ask-for-fewer-pixels</name>
    <message>
        <source>ask for that or less</source>
        <translation>verlangen Sie höchstens so viele</translation>
    </message>
</context>
<context>
    <name>device.ask-for-given-size</name>
    <message>
        <source>ask for the size that it gives</source>
        <translation>verlangen Sie die Größe, die sie liefert</translation>
    </message>
</context>
<context>
    <name>device.ask-for-listed-size</name>
    <message>
        <source>ask for a size that it has: v4l2-ctl --list-formats-ext names them</source>
        <translation>verlangen Sie eine Größe, die es bietet: v4l2-ctl --list-formats-ext zeigt sie</translation>
    </message>
</context>
<context>
    <name>device.automatic-exposure-stays</name>
    <message>
        <source>the video device&apos;s automatic exposure cannot be switched off</source>
        <translation>die Belichtungsautomatik des Videogeräts lässt sich nicht ausschalten</translation>
    </message>
</context>
<context>
    <name>device.automatic-focus-stays</name>
    <message>
        <source>the video device&apos;s automatic focus cannot be switched off</source>
        <translation>der Autofokus des Videogeräts lässt sich nicht ausschalten</translation>
    </message>
</context>
<context>
    <name>device.automatic-function-stays</name>
    <message>
        <source>{} cannot be switched off</source>
        <translation>{} lässt sich nicht ausschalten</translation>
    </message>
</context>
<context>
    <name>device.automatic-iso</name>
    <message>
        <source>the camera chooses its sensitivity itself (automatic ISO)</source>
        <translation>die Kamera wählt ihre Empfindlichkeit selbst (ISO-Automatik)</translation>
    </message>
</context>
<context>
    <name>device.automatic-white-balance-stays</name>
    <message>
        <source>the video device&apos;s automatic white balance cannot be switched off</source>
        <translation>der automatische Weißabgleich des Videogeräts lässt sich nicht ausschalten</translation>
    </message>
</context>
<context>
    <name>device.battery-empty</name>
    <message>
        <source>the camera&apos;s battery seems to be empty ({} % when it was last asked)</source>
        <translation>der Akku der Kamera scheint leer zu sein ({} % bei der letzten Abfrage)</translation>
    </message>
</context>
<context>
    <name>device.battery-low</name>
    <message>
        <source>has {} % left in its battery: a measurement needs a full one or a mains adapter</source>
        <translation>hat noch {} % Akkuladung: Eine Messung braucht einen vollen Akku oder ein Netzteil</translation>
    </message>
</context>
<context>
    <name>device.built-without-genicam</name>
    <message>
        <source>this build of Relucent does not know GenICam cameras</source>
        <translation>dieser Build von Relucent kennt keine GenICam-Kameras</translation>
    </message>
</context>
<context>
    <name>device.built-without-gphoto</name>
    <message>
        <source>this build of Relucent does not know DSLR and mirrorless cameras</source>
        <translation>dieser Build von Relucent kennt keine Spiegelreflex- und Systemkameras</translation>
    </message>
</context>
<context>
    <name>device.camera-asleep</name>
    <message>
        <source>the camera is there but does not answer, it may be asleep</source>
        <translation>die Kamera ist da, antwortet aber nicht, vielleicht schläft sie</translation>
    </message>
</context>
<context>
    <name>device.camera-command-empty</name>
    <message>
        <source>the camera&apos;s command is empty</source>
        <translation>der Befehl der Kamera ist leer</translation>
    </message>
</context>
<context>
    <name>device.camera-command-lacks</name>
    <message>
        <source>the camera&apos;s command does not contain {}</source>
        <translation>im Befehl der Kamera fehlt {}</translation>
    </message>
</context>
<context>
    <name>device.camera-given-up</name>
    <message>
        <source>the camera does not answer</source>
        <translation>die Kamera antwortet nicht</translation>
    </message>
</context>
<context>
    <name>device.camera-given-up-advice</name>
    <message>
        <source>push in its cable at both ends and switch it on, then go on: every photograph so far is kept</source>
        <translation>drücken Sie das Kabel an beiden Enden fest und schalten Sie sie ein, dann machen Sie weiter: Alle bisherigen Fotos sind behalten</translation>
    </message>
</context>
<context>
    <name>device.camera-gone</name>
    <message>
        <source>the camera has been unplugged or switched off, or has fallen asleep</source>
        <translation>die Kamera wurde getrennt oder ausgeschaltet oder ist eingeschlafen</translation>
    </message>
</context>
<context>
    <name>device.camera-no-longer-answers</name>
    <message>
        <source>the camera no longer answers ({}: {})</source>
        <translation>die Kamera antwortet nicht mehr ({}: {})</translation>
    </message>
</context>
<context>
    <name>device.camera-not-back</name>
    <message>
        <source>the camera has been gone for {} s: {}</source>
        <translation>die Kamera ist seit {} s weg: {}</translation>
    </message>
</context>
<context>
    <name>device.camera-refuses</name>
    <message>
        <source>the camera refuses ({}: {})</source>
        <translation>die Kamera verweigert dies ({}: {})</translation>
    </message>
</context>
<context>
    <name>device.camera-sends-no-stream</name>
    <message>
        <source>the camera sends no stream</source>
        <translation>die Kamera sendet keinen Datenstrom</translation>
    </message>
</context>
<context>
    <name>device.camera-size-out-of-range</name>
    <message>
        <source>a camera of {} pixels is impossible: each side is {} to {}</source>
        <translation>eine Kamera mit {} Pixeln gibt es nicht: Jede Seite hat {} bis {}</translation>
    </message>
</context>
<context>
    <name>device.camera-stays-busy</name>
    <message>
        <source>the camera stays busy</source>
        <translation>die Kamera bleibt beschäftigt</translation>
    </message>
</context>
<context>
    <name>device.camera-twice</name>
    <message>
        <source>{} is camera {} and camera {}: choose another camera, or one with a serial number of its own</source>
        <translation>{} ist Kamera {} und Kamera {}: Wählen Sie eine andere Kamera oder eine mit eigener Seriennummer</translation>
    </message>
</context>
<context>
    <name>device.cannot-create-temporary-folder</name>
    <message>
        <source>cannot create a temporary folder ({})</source>
        <translation>temporärer Ordner kann nicht angelegt werden ({})</translation>
    </message>
</context>
<context>
    <name>device.cannot-remove-file</name>
    <message>
        <source>cannot remove the file ({})</source>
        <translation>Datei kann nicht gelöscht werden ({})</translation>
    </message>
</context>
<context>
    <name>device.cannot-reopen-video-device</name>
    <message>
        <source>the video device cannot be opened again</source>
        <translation>das Videogerät lässt sich nicht wieder öffnen</translation>
    </message>
</context>
<context>
    <name>device.cannot-start-command</name>
    <message>
        <source>the command cannot be started ({})</source>
        <translation>der Befehl lässt sich nicht starten ({})</translation>
    </message>
</context>
<context>
    <name>device.cannot-write-recording</name>
    <message>
        <source>the recording cannot be written ({})</source>
        <translation>die Aufzeichnung kann nicht geschrieben werden ({})</translation>
    </message>
</context>
<context>
    <name>device.card-full</name>
    <message>
        <source>the camera has no room left for a photograph: its memory card is full</source>
        <translation>die Kamera hat keinen Platz mehr für ein Foto: Ihre Speicherkarte ist voll</translation>
    </message>
</context>
<context>
    <name>device.change-or-empty-card</name>
    <message>
        <source>change or empty the memory card</source>
        <translation>wechseln oder leeren Sie die Speicherkarte</translation>
    </message>
</context>
<context>
    <name>device.charge-or-change-battery</name>
    <message>
        <source>charge or change the battery, or better, use a mains adapter, and switch the camera on again</source>
        <translation>laden oder wechseln Sie den Akku, am besten verwenden Sie ein Netzteil, und schalten Sie die Kamera wieder ein</translation>
    </message>
</context>
<context>
    <name>device.check-cable-and-power</name>
    <message>
        <source>check its cable and its power</source>
        <translation>prüfen Sie Kabel und Stromversorgung</translation>
    </message>
</context>
<context>
    <name>device.check-cable-and-power-saving</name>
    <message>
        <source>check its cable, and switch off its power saving</source>
        <translation>prüfen Sie das Kabel und schalten Sie den Energiesparmodus aus</translation>
    </message>
</context>
<context>
    <name>device.check-cable-network-and-programs</name>
    <message>
        <source>check the camera&apos;s cable and network card, and that no other program uses it</source>
        <translation>prüfen Sie Kabel und Netzwerkkarte der Kamera und ob kein anderes Programm sie nutzt</translation>
    </message>
</context>
<context>
    <name>device.check-cable-power-address</name>
    <message>
        <source>check its cable, its power and its address; `relucent-cli devices` lists what is there</source>
        <translation>prüfen Sie Kabel, Stromversorgung und Adresse; `relucent-cli devices` zeigt, was vorhanden ist</translation>
    </message>
</context>
<context>
    <name>device.check-projector-and-aim</name>
    <message>
        <source>check that the projector is on and shows that output, aim the camera at it, and take its cap off; or choose another screen</source>
        <translation>prüfen Sie, ob der Projektor eingeschaltet ist und diesen Ausgang zeigt, richten Sie die Kamera darauf und nehmen Sie den Objektivdeckel ab; oder wählen Sie einen anderen Bildschirm</translation>
    </message>
</context>
<context>
    <name>device.check-projector-or-aim-another</name>
    <message>
        <source>check that this projector is on and shows that output, and aim a camera at it; or remove it from the venue</source>
        <translation>prüfen Sie, ob dieser Projektor eingeschaltet ist und diesen Ausgang zeigt, und richten Sie eine Kamera darauf; oder entfernen Sie ihn aus dem Spielort</translation>
    </message>
</context>
<context>
    <name>device.choose-gain-in-range</name>
    <message>
        <source>choose a gain from {} to {}</source>
        <translation>die Kamera kann {} bis {}</translation>
    </message>
</context>
<context>
    <name>device.choose-offered-iso</name>
    <message>
        <source>choose one of those that it has: {}</source>
        <translation>sie bietet {}</translation>
    </message>
</context>
<context>
    <name>device.choose-or-aim-at-screen</name>
    <message>
        <source>choose {}, or aim the camera at {}</source>
        <translation>wählen Sie {} oder richten Sie die Kamera auf {}</translation>
    </message>
</context>
<context>
    <name>device.choose-readable-pixel-format</name>
    <message>
        <source>it has {}; unpacked Mono, Bayer and RGB of 8 to 16 bits are read</source>
        <translation>sie bietet {}; gelesen werden ungepackte Formate Mono, Bayer und RGB mit 8 bis 16 Bit</translation>
    </message>
</context>
<context>
    <name>device.claimed-exposures-invalid</name>
    <message>
        <source>the camera claims exposures of {} to {} s</source>
        <translation>die Kamera meldet Belichtungszeiten von {} bis {} s</translation>
    </message>
</context>
<context>
    <name>device.close-menus-and-live-view</name>
    <message>
        <source>close its menus and its playback, and leave live view</source>
        <translation>schließen Sie ihre Menüs und ihre Wiedergabe und beenden Sie Live-View</translation>
    </message>
</context>
<context>
    <name>device.close-menus-and-restart</name>
    <message>
        <source>close its menus, and switch it off and on</source>
        <translation>schließen Sie ihre Menüs und schalten Sie sie aus und wieder ein</translation>
    </message>
</context>
<context>
    <name>device.close-other-program</name>
    <message>
        <source>close the other program, a camera viewer or a second Relucent perhaps</source>
        <translation>das andere Programm schließen, vielleicht einen Kamera-Viewer oder ein zweites Relucent</translation>
    </message>
</context>
<context>
    <name>device.close-other-programs</name>
    <message>
        <source>close other programs and try again</source>
        <translation>schließen Sie andere Programme und versuchen Sie es erneut</translation>
    </message>
</context>
<context>
    <name>device.colour-filter-not-bayer</name>
    <message>
        <source>the camera&apos;s colour filter is not a Bayer filter</source>
        <translation>der Farbfilter der Kamera ist kein Bayer-Filter</translation>
    </message>
</context>
<context>
    <name>device.command-failed</name>
    <message>
        <source>the command failed with status {}</source>
        <translation>der Befehl scheiterte mit Status {}</translation>
    </message>
</context>
<context>
    <name>device.command-failed-saying</name>
    <message>
        <source>the command failed with status {}, saying &quot;{}&quot;</source>
        <translation>der Befehl scheiterte mit Status {} und meldete „{}“</translation>
    </message>
</context>
<context>
    <name>device.command-killed</name>
    <message>
        <source>the command was killed by signal {}</source>
        <translation>der Befehl wurde durch Signal {} beendet</translation>
    </message>
</context>
<context>
    <name>device.command-killed-saying</name>
    <message>
        <source>the command was killed by signal {}, saying &quot;{}&quot;</source>
        <translation>der Befehl wurde durch Signal {} beendet und meldete „{}“</translation>
    </message>
</context>
<context>
    <name>device.command-too-long</name>
    <message>
        <source>the command took longer than {} s</source>
        <translation>der Befehl dauerte länger als {} s</translation>
    </message>
</context>
<context>
    <name>device.command-too-long-saying</name>
    <message>
        <source>the command took longer than {} s, saying &quot;{}&quot;</source>
        <translation>der Befehl dauerte länger als {} s und meldete „{}“</translation>
    </message>
</context>
<context>
    <name>device.command-without-consent</name>
    <message>
        <source>the calibration runs a program to which nobody at this computer has agreed: {}</source>
        <translation>Die Kalibrierung startet ein Programm, dem an diesem Rechner niemand zugestimmt hat: {}</translation>
    </message>
</context>
<context>
    <name>device.command-wrote-nothing</name>
    <message>
        <source>the command ended well but wrote nothing, not {}</source>
        <translation>der Befehl endete ohne Fehler, schrieb aber nichts; erwartet war {}</translation>
    </message>
</context>
<context>
    <name>device.command-wrote-something-else</name>
    <message>
        <source>the command ended well but wrote {}, not {}</source>
        <translation>der Befehl endete ohne Fehler, schrieb aber {}; erwartet war {}</translation>
    </message>
</context>
<context>
    <name>device.copy-or-retake-photograph</name>
    <message>
        <source>copy it again, or take the photograph again; a camera newer than this LibRaw needs DNG files</source>
        <translation>kopieren Sie sie neu oder nehmen Sie das Foto neu auf; eine Kamera, die neuer ist als dieses LibRaw, braucht DNG-Dateien</translation>
    </message>
</context>
<context>
    <name>device.delivers-8-bits</name>
    <message>
        <source>delivers 8 bits: dark places stay uncertain</source>
        <translation>liefert 8 Bit: dunkle Stellen bleiben ungenau</translation>
    </message>
</context>
<context>
    <name>device.develop-linearly</name>
    <message>
        <source>develop the files linearly, as 16-bit TIFF, or use another camera</source>
        <translation>entwickeln Sie die Dateien linear, als TIFF mit 16 Bit, oder verwenden Sie eine andere Kamera</translation>
    </message>
</context>
<context>
    <name>device.exposure-range-invalid</name>
    <message>
        <source>the shortest exposure must be above zero and no longer than the longest</source>
        <translation>die kürzeste Belichtung muss größer als null und nicht länger als die längste sein</translation>
    </message>
</context>
<context>
    <name>device.exposure-refused</name>
    <message>
        <source>the camera was asked to expose {} s but exposes {} s</source>
        <translation>von der Kamera wurden {} s Belichtung verlangt, sie bleibt aber bei {} s</translation>
    </message>
</context>
<context>
    <name>device.exposure-time-cannot-be-set</name>
    <message>
        <source>the camera&apos;s exposure time cannot be set</source>
        <translation>die Belichtungszeit der Kamera lässt sich nicht einstellen</translation>
    </message>
</context>
<context>
    <name>device.exposure-time-fixed</name>
    <message>
        <source>the camera exposes {} s whatever exposure it is asked for</source>
        <translation>die Kamera bleibt bei {} s, welche Belichtung auch verlangt wird</translation>
    </message>
</context>
<context>
    <name>device.focuses-by-itself</name>
    <message>
        <source>focuses by itself: switch its lens to manual focus</source>
        <translation>stellt selbst scharf: Stellen Sie das Objektiv auf manuellen Fokus</translation>
    </message>
</context>
<context>
    <name>device.free-space-or-record-elsewhere</name>
    <message>
        <source>free some space, or record elsewhere</source>
        <translation>geben Sie Speicherplatz frei oder zeichnen Sie an einem anderen Ort auf</translation>
    </message>
</context>
<context>
    <name>device.free-space-or-set-tmpdir</name>
    <message>
        <source>free some space there, or set TMPDIR to a folder that you may write to</source>
        <translation>geben Sie dort Speicherplatz frei oder lassen Sie TMPDIR auf einen Ordner zeigen, in den Sie schreiben dürfen</translation>
    </message>
</context>
<context>
    <name>device.gain-out-of-range</name>
    <message>
        <source>a gain of {} is wanted</source>
        <translation>eine Verstärkung von {} ist verlangt</translation>
    </message>
</context>
<context>
    <name>device.gain-refused</name>
    <message>
        <source>was asked for a gain of {} but uses {}</source>
        <translation>soll eine Verstärkung von {} verwenden und bleibt bei {}</translation>
    </message>
</context>
<context>
    <name>device.genicam-missing</name>
    <message>
        <source>GigE Vision and USB3 Vision cameras: this build lacks Aravis; install libaravis-dev and build again</source>
        <translation>GigE-Vision- und USB3-Vision-Kameras: Diesem Programm fehlt Aravis; installieren Sie libaravis-dev und bauen Sie es neu</translation>
    </message>
</context>
<context>
    <name>device.gphoto-missing</name>
    <message>
        <source>DSLR and mirrorless cameras: this build lacks libgphoto2 or LibRaw; install libgphoto2-dev and libraw-dev and build again</source>
        <translation>Spiegelreflex- und spiegellose Kameras: Diesem Programm fehlt libgphoto2 oder LibRaw; installieren Sie libgphoto2-dev und libraw-dev und bauen Sie es neu</translation>
    </message>
</context>
<context>
    <name>device.held-by-desktop</name>
    <message>
        <source>another program is using the camera, usually the desktop, which mounts it like a memory stick</source>
        <translation>ein anderes Programm belegt die Kamera, meist der Desktop, der sie wie einen USB-Stick einbindet</translation>
    </message>
</context>
<context>
    <name>device.install-aravis</name>
    <message>
        <source>install Aravis (libaravis-dev) and build again, or use another kind of camera</source>
        <translation>installieren Sie Aravis (libaravis-dev) und erstellen Sie das Programm neu oder verwenden Sie eine Kamera anderer Art</translation>
    </message>
</context>
<context>
    <name>device.install-libgphoto2</name>
    <message>
        <source>install libgphoto2 and LibRaw (libgphoto2-dev, libraw-dev) and build again, or use a command</source>
        <translation>installieren Sie libgphoto2 und LibRaw (libgphoto2-dev, libraw-dev) und erstellen Sie das Programm neu oder verwenden Sie einen Befehl</translation>
    </message>
</context>
<context>
    <name>device.iso-refused</name>
    <message>
        <source>was asked for ISO {} but uses ISO {}</source>
        <translation>soll ISO {} verwenden und bleibt bei ISO {}</translation>
    </message>
</context>
<context>
    <name>device.iso-wanted-not-there</name>
    <message>
        <source>ISO {} is wanted and the camera does not have it</source>
        <translation>ISO {} ist verlangt, die Kamera hat diesen Wert aber nicht</translation>
    </message>
</context>
<context>
    <name>device.lift-exposure-limits</name>
    <message>
        <source>switch its automatic exposure and its frame rate limit off</source>
        <translation>schalten Sie ihre Belichtungsautomatik und die Begrenzung ihrer Bildrate aus</translation>
    </message>
</context>
<context>
    <name>device.longest-exposure-overstated</name>
    <message>
        <source>claims exposures up to {} s but reaches only {} s</source>
        <translation>gibt Belichtungen bis {} s an, bleibt aber bei {} s</translation>
    </message>
</context>
<context>
    <name>device.may-fire-flash</name>
    <message>
        <source>may fire its flash: close it</source>
        <translation>löst eventuell den Blitz aus: Klappen Sie ihn ein</translation>
    </message>
</context>
<context>
    <name>device.may-take-dark-frame</name>
    <message>
        <source>may take a dark frame after long exposures, which doubles their time</source>
        <translation>nimmt nach langen Belichtungen eventuell ein Dunkelbild auf, was deren Zeit verdoppelt</translation>
    </message>
</context>
<context>
    <name>device.may-take-several-photographs</name>
    <message>
        <source>may take several photographs at once: switch it to single shots</source>
        <translation>nimmt eventuell mehrere Bilder auf einmal auf: Stellen Sie sie auf Einzelbild</translation>
    </message>
</context>
<context>
    <name>device.mode-dial-not-manual</name>
    <message>
        <source>the camera&apos;s mode dial is set to {}, where the camera chooses exposures itself</source>
        <translation>das Moduswahlrad der Kamera steht auf {}, dort wählt die Kamera die Belichtung selbst</translation>
    </message>
</context>
<context>
    <name>device.name-camera-by-port</name>
    <message>
        <source>name one by its port: gphoto2:{} or gphoto2:{}</source>
        <translation>geben Sie eine davon mit ihrem Anschluss an: gphoto2:{} oder gphoto2:{}</translation>
    </message>
</context>
<context>
    <name>device.name-connected-camera</name>
    <message>
        <source>name that one: gphoto2:{}</source>
        <translation>geben Sie diese an: gphoto2:{}</translation>
    </message>
</context>
<context>
    <name>device.no-capture-times</name>
    <message>
        <source>does not say when pictures were captured: some are dropped before each photograph</source>
        <translation>sagt nicht, wann Bilder aufgenommen wurden: Vor jeder Aufnahme werden einige verworfen</translation>
    </message>
</context>
<context>
    <name>device.no-contrast</name>
    <message>
        <source>the camera sees no difference between white and black</source>
        <translation>die Kamera sieht keinen Unterschied zwischen Weiß und Schwarz</translation>
    </message>
</context>
<context>
    <name>device.no-focus</name>
    <message>
        <source>the camera could not focus and took no photograph ({})</source>
        <translation>die Kamera fand keinen Fokus und nahm kein Foto auf ({})</translation>
    </message>
</context>
<context>
    <name>device.no-genicam-camera-answers</name>
    <message>
        <source>no GenICam camera &apos;{}&apos; answers</source>
        <translation>keine GenICam-Kamera „{}“ antwortet</translation>
    </message>
</context>
<context>
    <name>device.no-photograph-came</name>
    <message>
        <source>a photograph was asked for and none came</source>
        <translation>ein Foto wurde angefordert, aber keines kam</translation>
    </message>
</context>
<context>
    <name>device.no-raw-file-sent</name>
    <message>
        <source>the camera sent {} and no raw file</source>
        <translation>die Kamera sendete {} und keine RAW-Datei</translation>
    </message>
</context>
<context>
    <name>device.no-raw-files</name>
    <message>
        <source>the camera does not deliver raw files</source>
        <translation>die Kamera liefert keine RAW-Dateien</translation>
    </message>
</context>
<context>
    <name>device.no-readable-pixel-format</name>
    <message>
        <source>none of the camera&apos;s pixel formats can be read</source>
        <translation>keines der Pixelformate der Kamera ist lesbar</translation>
    </message>
</context>
<context>
    <name>device.no-software-trigger</name>
    <message>
        <source>has no software trigger: each photograph may wait for one more exposure</source>
        <translation>hat keinen Software-Auslöser: Jede Aufnahme wartet eventuell eine Belichtung länger</translation>
    </message>
</context>
<context>
    <name>device.no-video-pictures</name>
    <message>
        <source>the video device sends no pictures</source>
        <translation>das Videogerät sendet keine Bilder</translation>
    </message>
</context>
<context>
    <name>device.only-other-camera-connected</name>
    <message>
        <source>no camera of this name is plugged in, but {} is</source>
        <translation>keine Kamera dieses Namens ist angeschlossen, dafür aber {}</translation>
    </message>
</context>
<context>
    <name>device.other-screen-seen</name>
    <message>
        <source>the camera sees {}, not {}</source>
        <translation>die Kamera sieht {}, nicht {}</translation>
    </message>
</context>
<context>
    <name>device.part-of-sensor-lost</name>
    <message>
        <source>the camera does not go back to the part of the sensor that it had</source>
        <translation>die Kamera kehrt nicht zu dem Teil des Sensors zurück, den sie hatte</translation>
    </message>
</context>
<context>
    <name>device.parts-lost-on-the-way</name>
    <message>
        <source>parts of the photograph were lost on the way</source>
        <translation>Teile des Fotos gingen unterwegs verloren</translation>
    </message>
</context>
<context>
    <name>device.photograph-attempts-failed</name>
    <message>
        <source>{} attempts at a photograph failed: {}</source>
        <translation>{} Versuche, ein Foto aufzunehmen, sind gescheitert: {}</translation>
    </message>
</context>
<context>
    <name>device.photograph-exceeds-sensor</name>
    <message>
        <source>{} pixels are wanted and the camera has {}</source>
        <translation>{} Pixel sind verlangt, die Kamera hat {}</translation>
    </message>
</context>
<context>
    <name>device.photograph-format-changed</name>
    <message>
        <source>the photograph has {} pixels as {} where {} as {} were agreed</source>
        <translation>das Foto hat {} Pixel als {}, vereinbart waren {} als {}</translation>
    </message>
</context>
<context>
    <name>device.photograph-larger-than-announced</name>
    <message>
        <source>the photograph is larger than the camera announced</source>
        <translation>das Foto ist größer als von der Kamera angekündigt</translation>
    </message>
</context>
<context>
    <name>device.photograph-not-finished</name>
    <message>
        <source>the photograph was not finished</source>
        <translation>das Foto wurde nicht fertig</translation>
    </message>
</context>
<context>
    <name>device.photograph-size-refused</name>
    <message>
        <source>{} pixels are wanted and the camera gives {}</source>
        <translation>{} Pixel sind verlangt, die Kamera liefert {}</translation>
    </message>
</context>
<context>
    <name>device.photograph-size-unexpected</name>
    <message>
        <source>the photograph has {} pixels where {} were announced</source>
        <translation>das Foto hat {} Pixel, angekündigt waren {}</translation>
    </message>
</context>
<context>
    <name>device.photograph-timed-out</name>
    <message>
        <source>no photograph came within {} s</source>
        <translation>innerhalb von {} s kam kein Foto</translation>
    </message>
</context>
<context>
    <name>device.photograph-truncated</name>
    <message>
        <source>a photograph of {} pixels as {} came with {} of {} bytes</source>
        <translation>ein Foto mit {} Pixeln als {} kam mit {} von {} Bytes an</translation>
    </message>
</context>
<context>
    <name>device.picture-not-settled</name>
    <message>
        <source>a new picture has not fully appeared after {} frames</source>
        <translation>ein neues Bild ist nach {} Einzelbildern noch nicht vollständig da</translation>
    </message>
</context>
<context>
    <name>device.pixel-format-lost</name>
    <message>
        <source>the camera has forgotten the pixel format that it was set to</source>
        <translation>die Kamera hat das eingestellte Pixelformat vergessen</translation>
    </message>
</context>
<context>
    <name>device.pixel-format-not-offered</name>
    <message>
        <source>the camera has no pixel format {} that can be read</source>
        <translation>die Kamera hat kein lesbares Pixelformat {}</translation>
    </message>
</context>
<context>
    <name>device.projector-command-empty</name>
    <message>
        <source>the projector&apos;s command is empty</source>
        <translation>der Befehl des Projektors ist leer</translation>
    </message>
</context>
<context>
    <name>device.projector-command-lacks</name>
    <message>
        <source>the projector&apos;s command does not contain {}</source>
        <translation>im Befehl des Projektors fehlt {}</translation>
    </message>
</context>
<context>
    <name>device.projector-size-out-of-range</name>
    <message>
        <source>a projector of {} pixels is impossible: each side is {} to {}</source>
        <translation>einen Projektor mit {} Pixeln gibt es nicht: Jede Seite hat {} bis {}</translation>
    </message>
</context>
<context>
    <name>device.projector-unseen</name>
    <message>
        <source>no camera sees what is shown on {}</source>
        <translation>keine Kamera sieht, was auf {} gezeigt wird</translation>
    </message>
</context>
<context>
    <name>device.push-cable-in</name>
    <message>
        <source>push in the camera&apos;s cable at both ends</source>
        <translation>drücken Sie das Kabel der Kamera an beiden Enden fest</translation>
    </message>
</context>
<context>
    <name>device.raw-file-empty</name>
    <message>
        <source>it is empty</source>
        <translation>sie ist leer</translation>
    </message>
</context>
<context>
    <name>device.raw-file-incomplete</name>
    <message>
        <source>parts of it are missing</source>
        <translation>Teile davon fehlen</translation>
    </message>
</context>
<context>
    <name>device.raw-file-unreadable</name>
    <message>
        <source>the raw file cannot be read ({})</source>
        <translation>die RAW-Datei kann nicht gelesen werden ({})</translation>
    </message>
</context>
<context>
    <name>device.raw-file-without-sensor-values</name>
    <message>
        <source>the raw file does not hold the sensor&apos;s own values</source>
        <translation>die RAW-Datei enthält nicht die Sensorwerte selbst</translation>
    </message>
</context>
<context>
    <name>device.reconnect-same-camera</name>
    <message>
        <source>connect the camera that the measurement was begun with</source>
        <translation>schließen Sie die Kamera an, mit der die Messung begonnen wurde</translation>
    </message>
</context>
<context>
    <name>device.reconnected-camera-size-differs</name>
    <message>
        <source>the camera came back with {} pixels instead of {}</source>
        <translation>die Kamera kam mit {} statt {} Pixeln zurück</translation>
    </message>
</context>
<context>
    <name>device.release-from-desktop</name>
    <message>
        <source>make the desktop release it with `gio mount -s gphoto2` (or eject it in the file manager) and close photo programs</source>
        <translation>lösen Sie die Kamera mit `gio mount -s gphoto2` vom Desktop (oder werfen Sie sie im Dateimanager aus) und schließen Sie Fotoprogramme</translation>
    </message>
</context>
<context>
    <name>device.remove-file-by-hand</name>
    <message>
        <source>remove it by hand, then try again</source>
        <translation>löschen Sie sie von Hand, dann versuchen Sie es erneut</translation>
    </message>
</context>
<context>
    <name>device.request-refused</name>
    <message>
        <source>the camera refused what it was asked for ({})</source>
        <translation>die Kamera hat das Verlangte verweigert ({})</translation>
    </message>
</context>
<context>
    <name>device.restart-or-change-pixel-format</name>
    <message>
        <source>switch the camera off and on, or choose another of its pixel formats</source>
        <translation>schalten Sie die Kamera aus und wieder ein oder wählen Sie ein anderes ihrer Pixelformate</translation>
    </message>
</context>
<context>
    <name>device.restart-with-default-settings</name>
    <message>
        <source>switch it off and on, load its default settings with its maker&apos;s program, and try again</source>
        <translation>schalten Sie sie aus und wieder ein, laden Sie ihre Standardeinstellungen mit dem Programm des Herstellers und versuchen Sie es erneut</translation>
    </message>
</context>
<context>
    <name>device.run-command-in-terminal</name>
    <message>
        <source>run it in a terminal to find out why: {}</source>
        <translation>führen Sie ihn in einem Terminal aus, um die Ursache zu finden: {}</translation>
    </message>
</context>
<context>
    <name>device.screen-loses-picture</name>
    <message>
        <source>the projector&apos;s screen keeps losing its picture</source>
        <translation>der Bildschirm des Projektors verliert immer wieder sein Bild</translation>
    </message>
</context>
<context>
    <name>device.screen-not-seen</name>
    <message>
        <source>the camera does not see what is shown on {}</source>
        <translation>die Kamera sieht nicht, was auf {} gezeigt wird</translation>
    </message>
</context>
<context>
    <name>device.screen-twice</name>
    <message>
        <source>screen {} is projector {} and projector {}: choose another screen</source>
        <translation>Bildschirm {} ist Projektor {} und Projektor {}: Wählen Sie einen anderen Bildschirm</translation>
    </message>
</context>
<context>
    <name>device.sees-no-colours</name>
    <message>
        <source>sees no colours: brightness can be compensated, colours cannot</source>
        <translation>sieht keine Farben: Helligkeit kann ausgeglichen werden, Farben nicht</translation>
    </message>
</context>
<context>
    <name>device.set-iso-100</name>
    <message>
        <source>set it to ISO 100 by hand</source>
        <translation>stellen Sie sie von Hand auf ISO 100</translation>
    </message>
</context>
<context>
    <name>device.set-manual-exposure-mode</name>
    <message>
        <source>set its exposure mode to timed and manual, or update its firmware</source>
        <translation>stellen Sie ihren Belichtungsmodus auf „Timed“ und manuell oder aktualisieren Sie ihre Firmware</translation>
    </message>
</context>
<context>
    <name>device.several-cameras-of-model</name>
    <message>
        <source>{} cameras of this model are plugged in</source>
        <translation>{} Kameras dieses Modells sind angeschlossen</translation>
    </message>
</context>
<context>
    <name>device.shortest-exposure-understated</name>
    <message>
        <source>claims exposures from {} s but does not go below {} s</source>
        <translation>gibt Belichtungen ab {} s an, bleibt aber bei {} s</translation>
    </message>
</context>
<context>
    <name>device.simulated-camera-unplugged</name>
    <message>
        <source>the camera&apos;s cable is out</source>
        <translation>das Kabel der Kamera ist herausgerutscht</translation>
    </message>
</context>
<context>
    <name>device.steady-view-and-expose-briefly</name>
    <message>
        <source>check that the camera&apos;s view is steady and its exposure short, and switch the projector&apos;s smoothing of motion off</source>
        <translation>prüfen Sie, ob die Kamera ruhig steht und kurz belichtet, und schalten Sie die Bewegungsglättung des Projektors aus</translation>
    </message>
</context>
<context>
    <name>device.switch-off-automatic-exposure</name>
    <message>
        <source>switch its automatic exposure off; a camera without manual exposure cannot be used</source>
        <translation>schalten Sie ihre Belichtungsautomatik aus; eine Kamera ohne manuelle Belichtung ist nicht verwendbar</translation>
    </message>
</context>
<context>
    <name>device.switch-off-with-makers-program</name>
    <message>
        <source>switch it off with the camera maker&apos;s program, or use another camera</source>
        <translation>schalten Sie dies mit dem Programm des Kameraherstellers aus oder verwenden Sie eine andere Kamera</translation>
    </message>
</context>
<context>
    <name>device.switch-off-with-v4l2-ctl</name>
    <message>
        <source>switch it off with v4l2-ctl (--list-ctrls names what it has), or use another camera</source>
        <translation>schalten Sie dies mit v4l2-ctl aus (--list-ctrls zeigt, was es bietet) oder verwenden Sie eine andere Kamera</translation>
    </message>
</context>
<context>
    <name>device.switch-on-and-keep-awake</name>
    <message>
        <source>check its cable, switch it on and disable its automatic power-off</source>
        <translation>prüfen Sie das Kabel, schalten Sie sie ein und ihre automatische Abschaltung aus</translation>
    </message>
</context>
<context>
    <name>device.switch-quality-to-raw</name>
    <message>
        <source>switch its picture quality to RAW by hand; a camera without RAW cannot be used</source>
        <translation>stellen Sie ihre Bildqualität von Hand auf RAW; eine Kamera ohne RAW ist nicht verwendbar</translation>
    </message>
</context>
<context>
    <name>device.switch-to-full-size-raw</name>
    <message>
        <source>switch the camera to full-size RAW (no sRAW, mRAW, no linear DNG)</source>
        <translation>stellen Sie die Kamera auf RAW in voller Größe (kein sRAW, kein mRAW, kein lineares DNG)</translation>
    </message>
</context>
<context>
    <name>device.switch-to-manual-focus</name>
    <message>
        <source>switch its lens to manual focus</source>
        <translation>stellen Sie ihr Objektiv auf manuellen Fokus</translation>
    </message>
</context>
<context>
    <name>device.switches-itself-off</name>
    <message>
        <source>switches itself off after a while: switch that off</source>
        <translation>schaltet sich nach einer Weile selbst ab: Stellen Sie das ab</translation>
    </message>
</context>
<context>
    <name>device.take-photograph-by-hand</name>
    <message>
        <source>switch its lens to manual focus, close its menus, and take a photograph by hand to see what it complains of</source>
        <translation>stellen Sie ihr Objektiv auf manuellen Fokus, schließen Sie ihre Menüs und nehmen Sie von Hand ein Foto auf, um zu sehen, was sie beanstandet</translation>
    </message>
</context>
<context>
    <name>device.then-go-on</name>
    <message>
        <source>{}, then go on: every photograph so far is kept</source>
        <translation>{}, dann machen Sie weiter: Alle bisherigen Fotos bleiben erhalten</translation>
    </message>
</context>
<context>
    <name>device.trial-photograph-failed</name>
    <message>
        <source>the camera was asked for a photograph and took none</source>
        <translation>von der Kamera wurde ein Foto verlangt, sie nahm aber keines auf</translation>
    </message>
</context>
<context>
    <name>device.turn-dial-or-change-camera</name>
    <message>
        <source>turn its mode dial to M; a camera without manual exposure cannot be used</source>
        <translation>drehen Sie ihr Moduswahlrad auf M; eine Kamera ohne M ist nicht verwendbar</translation>
    </message>
</context>
<context>
    <name>device.turn-dial-to-m</name>
    <message>
        <source>turn it to M</source>
        <translation>drehen Sie es auf M</translation>
    </message>
</context>
<context>
    <name>device.use-manual-exposure-camera</name>
    <message>
        <source>use a camera with manual exposure</source>
        <translation>verwenden Sie eine Kamera mit manueller Belichtung</translation>
    </message>
</context>
<context>
    <name>device.video-device</name>
    <message>
        <source>video device</source>
        <translation>Videogerät</translation>
    </message>
</context>
<context>
    <name>device.video-device-in-use</name>
    <message>
        <source>the video device cannot be opened: another program may be using it</source>
        <translation>das Videogerät lässt sich nicht öffnen: Vielleicht nutzt es ein anderes Programm</translation>
    </message>
</context>
<context>
    <name>device.video-device-missing</name>
    <message>
        <source>no such video device is plugged in</source>
        <translation>kein solches Videogerät ist angeschlossen</translation>
    </message>
</context>
<context>
    <name>device.video-device-unplugged</name>
    <message>
        <source>the video device has been unplugged</source>
        <translation>das Videogerät wurde getrennt</translation>
    </message>
</context>
<context>
    <name>device.video-exposure-not-settable</name>
    <message>
        <source>the video device has no exposure that can be set</source>
        <translation>das Videogerät hat keine einstellbare Belichtung</translation>
    </message>
</context>
<context>
    <name>device.video-size-refused</name>
    <message>
        <source>{} pixels are wanted and the video device gives {}</source>
        <translation>{} Pixel sind verlangt, das Videogerät liefert {}</translation>
    </message>
</context>
<context>
    <name>device.wake-camera</name>
    <message>
        <source>press its shutter button half way or switch it off and on, and disable its automatic power-off</source>
        <translation>drücken Sie ihren Auslöser halb durch oder schalten Sie sie aus und wieder ein, und schalten Sie ihre automatische Abschaltung aus</translation>
    </message>
</context>
<context>
    <name>device.write-announced-size</name>
    <message>
        <source>let the command write that size, or begin again with the size that the camera delivers</source>
        <translation>lassen Sie den Befehl diese Größe schreiben oder beginnen Sie neu mit der Größe, die die Kamera liefert</translation>
    </message>
</context>
<context>
    <name>device.write-photograph-to-output</name>
    <message>
        <source>let it write the photograph to {output}: {}</source>
        <translation>lassen Sie ihn das Foto in {output} schreiben: {}</translation>
    </message>
</context>
<context>
    <name>disk.cannot-create-folder</name>
    <message>
        <source>cannot create the folder ({})</source>
        <translation>Ordner kann nicht angelegt werden ({})</translation>
    </message>
</context>
<context>
    <name>disk.cannot-open</name>
    <message>
        <source>cannot open ({})</source>
        <translation>kann nicht geöffnet werden ({})</translation>
    </message>
</context>
<context>
    <name>disk.cannot-read</name>
    <message>
        <source>cannot read ({})</source>
        <translation>kann nicht gelesen werden ({})</translation>
    </message>
</context>
<context>
    <name>disk.cannot-write</name>
    <message>
        <source>cannot write ({})</source>
        <translation>kann nicht geschrieben werden ({})</translation>
    </message>
</context>
<context>
    <name>disk.check-disk-and-cable</name>
    <message>
        <source>check the disk and its cable</source>
        <translation>prüfen Sie Laufwerk und Kabel</translation>
    </message>
</context>
<context>
    <name>disk.check-path</name>
    <message>
        <source>check the path</source>
        <translation>prüfen Sie den Pfad</translation>
    </message>
</context>
<context>
    <name>disk.check-path-and-disk</name>
    <message>
        <source>check the path and the disk</source>
        <translation>prüfen Sie Pfad und Laufwerk</translation>
    </message>
</context>
<context>
    <name>disk.choose-scratch-folder</name>
    <message>
        <source>let the environment variable TMPDIR name a folder on a disk that you may write to; what has been photographed is safe</source>
        <translation>nennen Sie in der Umgebungsvariablen TMPDIR einen Ordner auf einer Platte, auf die Sie schreiben dürfen; was fotografiert wurde, ist sicher</translation>
    </message>
</context>
<context>
    <name>disk.choose-writable-folder</name>
    <message>
        <source>choose a folder that you may write to, or ask for the permission</source>
        <translation>wählen Sie einen Ordner, in den Sie schreiben dürfen, oder lassen Sie sich das Recht dazu geben</translation>
    </message>
</context>
<context>
    <name>disk.free-scratch-room</name>
    <message>
        <source>free some space there; what has been photographed is safe</source>
        <translation>schaffen Sie dort Platz; was fotografiert wurde, ist sicher</translation>
    </message>
</context>
<context>
    <name>disk.free-space-or-check-disk</name>
    <message>
        <source>free some space there or check the disk, then try again</source>
        <translation>geben Sie dort Speicherplatz frei oder prüfen Sie das Laufwerk, dann versuchen Sie es erneut</translation>
    </message>
</context>
<context>
    <name>disk.free-space-or-choose-another</name>
    <message>
        <source>free some space there or choose another disk, then try again</source>
        <translation>geben Sie dort Speicherplatz frei oder wählen Sie ein anderes Laufwerk, dann versuchen Sie es erneut</translation>
    </message>
</context>
<context>
    <name>disk.no-scratch-room</name>
    <message>
        <source>there is no room for intermediate results ({})</source>
        <translation>für Zwischenergebnisse ist kein Platz ({})</translation>
    </message>
</context>
<context>
    <name>duration.hours-minutes</name>
    <message>
        <source>{} h {} min</source>
        <translation>{} h {} min</translation>
    </message>
</context>
<context>
    <name>duration.minutes</name>
    <message>
        <source>{} min</source>
        <translation>{} min</translation>
    </message>
</context>
<context>
    <name>duration.seconds</name>
    <message>
        <source>{} s</source>
        <translation>{} s</translation>
    </message>
</context>
<context>
    <name>duration.under-a-minute</name>
    <message>
        <source>under a minute</source>
        <translation>unter einer Minute</translation>
    </message>
</context>
<context>
    <name>engine.compute-on-processor</name>
    <message>
        <source>compute on the processor instead</source>
        <translation>lassen Sie den Prozessor rechnen</translation>
    </message>
</context>
<context>
    <name>engine.graphics-buffer-too-large</name>
    <message>
        <source>the graphics card can hold {} MB in one piece, but {} MB are needed</source>
        <translation>die Grafikkarte kann {} MB auf einmal ansprechen, {} MB sind nötig</translation>
    </message>
</context>
<context>
    <name>engine.graphics-card-lost</name>
    <message>
        <source>the graphics card was lost</source>
        <translation>die Grafikkarte ging verloren</translation>
    </message>
</context>
<context>
    <name>engine.graphics-card-unusable</name>
    <message>
        <source>the graphics card cannot be used</source>
        <translation>die Grafikkarte ist nicht verwendbar</translation>
    </message>
</context>
<context>
    <name>engine.graphics-memory-exhausted</name>
    <message>
        <source>the graphics card has no {} MB of memory left</source>
        <translation>die Grafikkarte hat keine {} MB Speicher mehr frei</translation>
    </message>
</context>
<context>
    <name>engine.install-driver</name>
    <message>
        <source>install the graphics card&apos;s driver, or compute on the processor</source>
        <translation>installieren Sie den Treiber der Grafikkarte oder lassen Sie den Prozessor rechnen</translation>
    </message>
</context>
<context>
    <name>engine.no-graphics-card</name>
    <message>
        <source>there is no graphics card with OpenGL 4.3 and compute shaders</source>
        <translation>keine Grafikkarte mit OpenGL 4.3 und Compute-Shadern ist vorhanden</translation>
    </message>
</context>
<context>
    <name>engine.no-libegl-or-libopengl</name>
    <message>
        <source>there is no libEGL or no libOpenGL, which open graphics cards without a display</source>
        <translation>libEGL oder libOpenGL fehlt, die Grafikkarten ohne Bildschirm öffnen</translation>
    </message>
</context>
<context>
    <name>engine.no-opengl</name>
    <message>
        <source>there is no OpenGL 4.3 with compute shaders</source>
        <translation>OpenGL 4.3 mit Compute-Shadern ist nicht vorhanden</translation>
    </message>
</context>
<context>
    <name>import.camera-taken-as-linear</name>
    <message>
        <source>The camera is taken to be linear, and one photograph counts as one second of exposure</source>
        <translation>die Kamera wird als linear angenommen, und ein Foto zählt als eine Sekunde Belichtung</translation>
    </message>
</context>
<context>
    <name>import.lit-share</name>
    <message>
        <source>The projector lights {} % of the camera&apos;s pixels</source>
        <translation>der Projektor beleuchtet {} % der Pixel der Kamera</translation>
    </message>
</context>
<context>
    <name>import.paired-by-time</name>
    <message>
        <source>The photographs were paired with the patterns in the order in which they were taken, from {} to {}, which is not that of their names</source>
        <translation>die Fotos wurden den Mustern in der Reihenfolge ihrer Aufnahme zugeordnet, von {} bis {}, die nicht die ihrer Namen ist</translation>
    </message>
</context>
<context>
    <name>import.patterns-and-photographs-grey</name>
    <message>
        <source>Patterns and photographs are grey: colours are not told apart, and T&apos;s blocks are neutral</source>
        <translation>Muster und Fotos sind grau: Farben werden nicht unterschieden, und die Blöcke von T sind neutral</translation>
    </message>
</context>
<context>
    <name>import.patterns-black-and-white</name>
    <message>
        <source>The patterns hold black and white only: the projector&apos;s response is assumed to be a gamma of 2.2</source>
        <translation>die Muster enthalten nur Schwarz und Weiß: Als Kennlinie des Projektors wird eine Potenz von 2,2 angenommen</translation>
    </message>
</context>
<context>
    <name>import.patterns-grey</name>
    <message>
        <source>The patterns are grey: how colours mix was not measured, and T&apos;s blocks are diagonal</source>
        <translation>die Muster sind grau: Wie sich Farben mischen, wurde nicht gemessen, und die Blöcke von T sind diagonal</translation>
    </message>
</context>
<context>
    <name>import.photographs-are-jpeg</name>
    <message>
        <source>The photographs are JPEG: they were made linear by the curve of sRGB, which cameras follow only roughly; develop them linearly, as TIFF or EXR, to measure more exactly</source>
        <translation>die Fotos sind JPEG: Sie wurden mit der Kurve von sRGB linearisiert, der Kameras nur ungefähr folgen; entwickeln Sie sie linear, als TIFF oder EXR, um genauer zu messen</translation>
    </message>
</context>
<context>
    <name>import.photographs-grey</name>
    <message>
        <source>The photographs are grey: what each of the projector&apos;s colours contributes is known in brightness only</source>
        <translation>die Fotos sind grau: Was jede Farbe des Projektors beiträgt, ist nur als Helligkeit bekannt</translation>
    </message>
</context>
<context>
    <name>linearization.choose-overlapping-exposures</name>
    <message>
        <source>set them to ranges of exposure times that overlap</source>
        <translation>stellen Sie sie auf Bereiche von Belichtungszeiten ein, die sich überschneiden</translation>
    </message>
</context>
<context>
    <name>linearization.halves-brighter-than-whole</name>
    <message>
        <source>{}: two halves of a picture are {} % brighter than the whole; switch off the dynamic iris, dynamic contrast and any picture mode that adapts to the content</source>
        <translation>{}: zwei Hälften eines Bildes sind {} % heller als das Ganze; schalten Sie dynamische Iris, dynamischen Kontrast und jeden Bildmodus aus, der sich dem Inhalt anpasst</translation>
    </message>
</context>
<context>
    <name>linearization.halves-darker-than-whole</name>
    <message>
        <source>{}: two halves of a picture are {} % darker than the whole; switch off the dynamic iris, dynamic contrast and any picture mode that adapts to the content</source>
        <translation>{}: zwei Hälften eines Bildes sind {} % dunkler als das Ganze; schalten Sie dynamische Iris, dynamischen Kontrast und jeden Bildmodus aus, der sich dem Inhalt anpasst</translation>
    </message>
</context>
<context>
    <name>linearization.highlights-overexposed</name>
    <message>
        <source>{}: some highlights are overexposed even at {} s, the shortest exposure, and will not be compensated; close the aperture or add a grey filter if they matter</source>
        <translation>{}: einige Glanzlichter sind selbst bei {} s, der kürzesten Belichtung, überbelichtet und werden nicht kompensiert; schließen Sie die Blende oder setzen Sie einen Graufilter auf, falls sie wichtig sind</translation>
    </message>
</context>
<context>
    <name>linearization.light-flickers</name>
    <message>
        <source>{}: the light changes by {} % from one photograph to the next; switch off the projector&apos;s dynamic lamp modes and other lamps nearby, and choose exposure times that are multiples of the mains period</source>
        <translation>{}: das Licht ändert sich von einem Foto zum nächsten um {} %; schalten Sie die dynamischen Lampenmodi des Projektors und andere Lampen in der Nähe aus, und wählen Sie Belichtungszeiten, die Vielfache der Netzperiode sind</translation>
    </message>
</context>
<context>
    <name>linearization.no-common-exposure</name>
    <message>
        <source>the cameras have no exposure time in common</source>
        <translation>die Kameras haben keine gemeinsame Belichtungszeit</translation>
    </message>
</context>
<context>
    <name>linearization.overexposed</name>
    <message>
        <source>{}: the projection is overexposed even at {} s, the shortest exposure; close the aperture, lower the gain or add a grey filter</source>
        <translation>{}: die Projektion ist selbst bei {} s, der kürzesten Belichtung, überbelichtet; schließen Sie die Blende, verringern Sie die Verstärkung oder setzen Sie einen Graufilter auf</translation>
    </message>
</context>
<context>
    <name>linearization.response-uneven</name>
    <message>
        <source>{}: the brightness curves are not the same everywhere in its picture, by up to {} % of white; switch off uniformity correction, local dimming and edge blending in the projector</source>
        <translation>{}: die Helligkeitskurven sind nicht überall im Bild gleich, sondern weichen um bis zu {} % von Weiß ab; schalten Sie Gleichmäßigkeitskorrektur, lokales Dimmen und Randüberblendung am Projektor aus</translation>
    </message>
</context>
<context>
    <name>linearization.underexposed</name>
    <message>
        <source>{}: the projection reaches only {} % of the camera&apos;s range at {} s, the longest exposure; open the aperture or raise the gain</source>
        <translation>{0}: die Projektion erreicht bei {2} s, der längsten Belichtung, nur {1} % des Bereichs der Kamera; öffnen Sie die Blende oder erhöhen Sie die Verstärkung</translation>
    </message>
</context>
<context>
    <name>linearization.white-brighter-than-colours</name>
    <message>
        <source>{}: white is {} % brighter than red, green and blue together; switch off the white segment (often called brilliant colour or bright mode) and choose a picture mode for video or sRGB</source>
        <translation>{}: Weiß ist {} % heller als Rot, Grün und Blau zusammen; schalten Sie das Weißsegment aus (oft „Brilliant Color“ oder „heller Modus“ genannt) und wählen Sie einen Bildmodus für Video oder sRGB</translation>
    </message>
</context>
<context>
    <name>linearization.white-darker-than-colours</name>
    <message>
        <source>{}: white is {} % darker than red, green and blue together; switch off power saving, colour management and dynamic picture modes</source>
        <translation>{}: Weiß ist {} % dunkler als Rot, Grün und Blau zusammen; schalten Sie Stromsparen, Farbmanagement und dynamische Bildmodi aus</translation>
    </message>
</context>
<context>
    <name>masks.draw-again</name>
    <message>
        <source>draw it again, or correct the file</source>
        <translation>zeichnen Sie sie neu oder berichtigen Sie die Datei</translation>
    </message>
</context>
<context>
    <name>masks.unknown-key</name>
    <message>
        <source>mask {} has &quot;{}&quot;, which this version does not know</source>
        <translation>Maske {} hat „{}“, was diese Version nicht kennt</translation>
    </message>
</context>
<context>
    <name>masks.unreadable</name>
    <message>
        <source>mask {} cannot be read: it needs points as [[x, y], ...], and may have camera, outline and feather</source>
        <translation>Maske {} ist nicht lesbar: Sie braucht points als [[x, y], ...] und darf camera, outline und feather haben</translation>
    </message>
</context>
<context>
    <name>night.hours-began</name>
    <message>
        <source>the show&apos;s hours began before it was done</source>
        <translation>die Stunden der Show begannen, bevor sie fertig war</translation>
    </message>
</context>
<context>
    <name>night.missed</name>
    <message>
        <source>it could not begin within two hours of its time: the show did not run, or the computer slept</source>
        <translation>sie konnte nicht binnen zwei Stunden nach ihrer Zeit beginnen: Die Show lief nicht, oder der Computer schlief</translation>
    </message>
</context>
<context>
    <name>night.not-as-predicted</name>
    <message>
        <source>the picture has a colour error of {} where {} was predicted, and no repair helped</source>
        <translation>das Bild hat einen Farbfehler von {}, vorhergesagt waren {}, und keine Reparatur half</translation>
    </message>
</context>
<context>
    <name>night.part-not-as-predicted</name>
    <message>
        <source>a part of the surface looks otherwise than predicted, by a colour error of {}, and no repair helped</source>
        <translation>ein Teil der Oberfläche sieht anders aus als vorhergesagt, um einen Farbfehler von {}, und keine Reparatur half</translation>
    </message>
</context>
<context>
    <name>night.too-long</name>
    <message>
        <source>it was not done within six hours</source>
        <translation>sie war nach sechs Stunden nicht fertig</translation>
    </message>
</context>
<context>
    <name>perfect.camera-blinded</name>
    <message>
        <source>something blinds the camera: {} of its view is overexposed</source>
        <translation>etwas blendet die Kamera: {} ihres Bildes sind überbelichtet</translation>
    </message>
</context>
<context>
    <name>perfect.camera-moved</name>
    <message>
        <source>the view of camera {} has moved by {}, {} pixels since the venue was measured</source>
        <translation>der Ausschnitt von Kamera {} hat sich seit der Messung um {}, {} Pixel verschoben</translation>
    </message>
</context>
<context>
    <name>perfect.light-missing</name>
    <message>
        <source>light is missing: is the lens covered, or a projector asleep?</source>
        <translation>es fehlt Licht: Ist das Objektiv verdeckt oder schläft ein Projektor?</translation>
    </message>
</context>
<context>
    <name>perfect.something-else</name>
    <message>
        <source>the camera sees something else than expected: did somebody stand in the light, or did the room&apos;s light change?</source>
        <translation>die Kamera sieht etwas anderes als erwartet: Stand jemand im Licht, oder hat sich das Raumlicht geändert?</translation>
    </message>
</context>
<context>
    <name>pjlink.address-twice</name>
    <message>
        <source>projectors {} and {} have the same address, {}</source>
        <translation>die Projektoren {} und {} haben dieselbe Adresse, {}</translation>
    </message>
</context>
<context>
    <name>pjlink.cannot-search</name>
    <message>
        <source>projectors cannot be searched ({})</source>
        <translation>nach Projektoren kann nicht gesucht werden ({})</translation>
    </message>
</context>
<context>
    <name>pjlink.check-address-and-port</name>
    <message>
        <source>check the address and the port of the projector</source>
        <translation>prüfen Sie Adresse und Port des Projektors</translation>
    </message>
</context>
<context>
    <name>pjlink.check-lens</name>
    <message>
        <source>check lens caps, shutter and input of the projector, and where the camera looks</source>
        <translation>prüfen Sie Objektivdeckel, Verschluss und Eingang des Projektors, und wohin die Kamera sieht</translation>
    </message>
</context>
<context>
    <name>pjlink.check-network</name>
    <message>
        <source>check its address, its network cable, and that PJLink and the network in standby are switched on in its menu</source>
        <translation>prüfen Sie seine Adresse und sein Netzwerkkabel, und dass PJLink und das Netzwerk im Standby in seinem Menü eingeschaltet sind</translation>
    </message>
</context>
<context>
    <name>pjlink.check-own-network</name>
    <message>
        <source>check this computer&apos;s network, or give the projector&apos;s address</source>
        <translation>prüfen Sie das Netzwerk dieses Computers, oder geben Sie die Adresse des Projektors an</translation>
    </message>
</context>
<context>
    <name>pjlink.choose-class-one-authentication</name>
    <message>
        <source>choose the authentication of PJLink class 1 in its menu, or none</source>
        <translation>wählen Sie in seinem Menü die Anmeldung nach PJLink Klasse 1, oder keine</translation>
    </message>
</context>
<context>
    <name>pjlink.closed</name>
    <message>
        <source>it closed the connection</source>
        <translation>er hat die Verbindung geschlossen</translation>
    </message>
</context>
<context>
    <name>pjlink.end-dimming</name>
    <message>
        <source>switch off its dynamic contrast, lamp dimming and eco modes, and daylight in the room; or measure without waiting for its lamp</source>
        <translation>schalten Sie dynamischen Kontrast, Lampendimmung und Sparmodi aus und halten Sie Tageslicht fern; oder messen Sie, ohne auf seine Lampe zu warten</translation>
    </message>
</context>
<context>
    <name>pjlink.frozen</name>
    <message>
        <source>projector {} freezes its picture: end that in its menu</source>
        <translation>Projektor {} friert sein Bild ein: beenden Sie das in seinem Menü</translation>
    </message>
</context>
<context>
    <name>pjlink.give-password</name>
    <message>
        <source>give the PJLink password that is set in its menu</source>
        <translation>geben Sie das PJLink-Passwort an, das in seinem Menü eingestellt ist</translation>
    </message>
</context>
<context>
    <name>pjlink.light-drifts</name>
    <message>
        <source>the light of projector {} still drifts by {} % within {} s after {} s</source>
        <translation>das Licht von Projektor {0} ändert sich nach {3} s noch um {1} % in {2} s</translation>
    </message>
</context>
<context>
    <name>pjlink.light-unseen</name>
    <message>
        <source>no camera sees light of projector {}</source>
        <translation>keine Kamera sieht Licht von Projektor {}</translation>
    </message>
</context>
<context>
    <name>pjlink.look-at-projector</name>
    <message>
        <source>look at its lamps and its menu</source>
        <translation>sehen Sie seine Lämpchen und sein Menü an</translation>
    </message>
</context>
<context>
    <name>pjlink.more-than-projectors</name>
    <message>
        <source>projector {} on the network is none of the {} that there are</source>
        <translation>Projektor {} im Netzwerk ist keiner der {} vorhandenen</translation>
    </message>
</context>
<context>
    <name>pjlink.newer-authentication</name>
    <message>
        <source>the projector at {} asks for its password in a way that this version does not know</source>
        <translation>der Projektor unter {} fragt sein Passwort auf eine Weise ab, die diese Version nicht kennt</translation>
    </message>
</context>
<context>
    <name>pjlink.no-answer</name>
    <message>
        <source>the projector at {} does not answer ({})</source>
        <translation>der Projektor unter {} antwortet nicht ({})</translation>
    </message>
</context>
<context>
    <name>pjlink.no-signal</name>
    <message>
        <source>projector {} has no signal at its input {}: choose the input of this computer</source>
        <translation>Projektor {} hat kein Signal an seinem Eingang {}: wählen Sie den Eingang dieses Computers</translation>
    </message>
</context>
<context>
    <name>pjlink.not-native</name>
    <message>
        <source>projector {} receives {} pixels and has {}: it scales the picture, which blurs the compensation; send it its own size</source>
        <translation>Projektor {} empfängt {} Pixel und hat {}: er skaliert das Bild, was die Kompensation unscharf macht; senden Sie ihm seine eigene Größe</translation>
    </message>
</context>
<context>
    <name>pjlink.not-on</name>
    <message>
        <source>projector {} was told to switch on and is not on after {} s</source>
        <translation>Projektor {} sollte sich einschalten und ist nach {} s nicht an</translation>
    </message>
</context>
<context>
    <name>pjlink.not-pjlink</name>
    <message>
        <source>what answers at {} does not speak PJLink</source>
        <translation>was unter {} antwortet, spricht kein PJLink</translation>
    </message>
</context>
<context>
    <name>pjlink.open-shutter-by-hand</name>
    <message>
        <source>open it at the projector, and start again</source>
        <translation>öffnen Sie ihn am Projektor, und beginnen Sie erneut</translation>
    </message>
</context>
<context>
    <name>pjlink.other-signal</name>
    <message>
        <source>projector {} receives {} pixels where {} are sent: something between scales the picture, or it shows another input</source>
        <translation>Projektor {} empfängt {} Pixel, gesendet werden {}: etwas dazwischen skaliert das Bild, oder er zeigt einen anderen Eingang</translation>
    </message>
</context>
<context>
    <name>pjlink.own-failure</name>
    <message>
        <source>the projector at {} reports a failure of its own</source>
        <translation>der Projektor unter {} meldet einen eigenen Fehler</translation>
    </message>
</context>
<context>
    <name>pjlink.part-cover</name>
    <message>
        <source>cover open</source>
        <translation>Abdeckung offen</translation>
    </message>
</context>
<context>
    <name>pjlink.part-fan</name>
    <message>
        <source>fan</source>
        <translation>Lüfter</translation>
    </message>
</context>
<context>
    <name>pjlink.part-filter</name>
    <message>
        <source>filter</source>
        <translation>Filter</translation>
    </message>
</context>
<context>
    <name>pjlink.part-lamp</name>
    <message>
        <source>lamp</source>
        <translation>Lampe</translation>
    </message>
</context>
<context>
    <name>pjlink.part-other</name>
    <message>
        <source>something else</source>
        <translation>etwas anderes</translation>
    </message>
</context>
<context>
    <name>pjlink.part-temperature</name>
    <message>
        <source>temperature</source>
        <translation>Temperatur</translation>
    </message>
</context>
<context>
    <name>pjlink.reports-error</name>
    <message>
        <source>projector {} reports an error: {}</source>
        <translation>Projektor {} meldet einen Fehler: {}</translation>
    </message>
</context>
<context>
    <name>pjlink.reports-warning</name>
    <message>
        <source>projector {} warns: {}</source>
        <translation>Projektor {} warnt: {}</translation>
    </message>
</context>
<context>
    <name>pjlink.shutter-stays-closed</name>
    <message>
        <source>the shutter of projector {} does not open</source>
        <translation>der Verschluss von Projektor {} öffnet sich nicht</translation>
    </message>
</context>
<context>
    <name>pjlink.still-warming</name>
    <message>
        <source>projector {} is still warming up or cooling down after {} s</source>
        <translation>Projektor {} wärmt sich nach {} s noch auf oder kühlt noch ab</translation>
    </message>
</context>
<context>
    <name>pjlink.switch-on-by-hand</name>
    <message>
        <source>look at its lamps and its menu, switch it on by hand, and start again</source>
        <translation>sehen Sie seine Lämpchen und sein Menü an, schalten Sie ihn von Hand ein, und beginnen Sie erneut</translation>
    </message>
</context>
<context>
    <name>pjlink.too-slow</name>
    <message>
        <source>nothing complete came in time</source>
        <translation>nichts Vollständiges kam rechtzeitig</translation>
    </message>
</context>
<context>
    <name>pjlink.wants-password</name>
    <message>
        <source>the projector at {} asks for a password</source>
        <translation>der Projektor unter {} verlangt ein Passwort</translation>
    </message>
</context>
<context>
    <name>pjlink.wrong-password</name>
    <message>
        <source>the projector at {} refuses the password</source>
        <translation>der Projektor unter {} weist das Passwort zurück</translation>
    </message>
</context>
<context>
    <name>reduction.binned</name>
    <message>
        <source>of the camera&apos;s {} pixels, {} are made: of the part around what is lit, every {} become one</source>
        <translation>von den {} Pixeln der Kamera werden {}: vom Teil um das Beleuchtete werden je {} zu einem</translation>
    </message>
</context>
<context>
    <name>reduction.binned-for-memory</name>
    <message>
        <source>of the camera&apos;s {} pixels, {} are made: every {} become one, as there is memory for no more</source>
        <translation>von den {} Pixeln der Kamera werden {}: je {} werden zu einem, da der Speicher für mehr nicht reicht</translation>
    </message>
</context>
<context>
    <name>reduction.cropped</name>
    <message>
        <source>of the camera&apos;s {} pixels, the {} around what is lit are used</source>
        <translation>von den {} Pixeln der Kamera werden die {} um das Beleuchtete verwendet</translation>
    </message>
</context>
<context>
    <name>reduction.fewer-camera-pixels</name>
    <message>
        <source>choose fewer camera pixels: automatic ones are as many as fit</source>
        <translation>wählen Sie weniger Kamerapixel: automatisch sind es so viele, wie Platz haben</translation>
    </message>
</context>
<context>
    <name>reduction.memory-too-little</name>
    <message>
        <source>measuring would take {} GB of memory, and {} GB may be taken</source>
        <translation>das Messen bräuchte {} GB Speicher, und {} GB stehen zur Verfügung</translation>
    </message>
</context>
<context>
    <name>reduction.more-memory-or-smaller-projector</name>
    <message>
        <source>use a computer or a limit with more memory, or a projector signal of fewer pixels</source>
        <translation>nehmen Sie einen Computer oder eine Grenze mit mehr Speicher oder ein Projektorsignal mit weniger Pixeln</translation>
    </message>
</context>
<context>
    <name>reduction.other-size</name>
    <message>
        <source>the camera delivers {} pixels where {} were calibrated</source>
        <translation>die Kamera liefert {} Pixel, kalibriert wurden {}</translation>
    </message>
</context>
<context>
    <name>reduction.restore-camera-size</name>
    <message>
        <source>set the camera to the size that it had, or calibrate again</source>
        <translation>stellen Sie die Kamera auf die frühere Größe ein oder kalibrieren Sie neu</translation>
    </message>
</context>
<context>
    <name>relucent::gui::AcquirePage</name>
    <message>
        <source>Paused, %1</source>
        <translation>Pausiert, %1</translation>
    </message>
    <message>
        <source>Measuring, %1</source>
        <translation>Messung, %1</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s), %1</source>
        <translation>
            <numerusform>%n Muster, %1</numerusform>
            <numerusform>%n Muster, %1</numerusform>
        </translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Gemessen</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>Veraltet</translation>
    </message>
    <message>
        <source>Stopped by a failure</source>
        <translation>Durch Fehler gestoppt</translation>
    </message>
    <message>
        <source>Waiting for you. Nothing is being projected.</source>
        <translation>Wartet auf Sie. Es wird nichts projiziert.</translation>
    </message>
    <message>
        <source>Every photograph is saved. Threshold opens when the last is taken.</source>
        <translation>Jedes Foto wird gespeichert. Nach dem letzten öffnet sich „Schwelle“.</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>Die Seite „%1“ nutzt die Geräte.</translation>
    </message>
    <message>
        <source>Measured in %1</source>
        <translation>Gemessen in %1</translation>
    </message>
    <message>
        <source>Leave the room dark and still, then start.</source>
        <translation>Lassen Sie den Raum dunkel und ruhig, dann starten Sie.</translation>
    </message>
    <message>
        <source>Show threshold</source>
        <translation>Schwelle zeigen</translation>
    </message>
    <message>
        <source>Resume</source>
        <translation>Fortsetzen</translation>
    </message>
    <message>
        <source>Start measuring</source>
        <translation>Messung starten</translation>
    </message>
    <message>
        <source>Stop and keep</source>
        <translation>Stoppen, behalten</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>This measurement belongs to earlier settings</source>
        <translation>Diese Messung gehört zu früheren Einstellungen</translation>
    </message>
    <message>
        <source>It still works and stays until the new one is ready.</source>
        <translation>Sie gilt weiter, bis die neue fertig ist.</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>Neu messen</translation>
    </message>
    <message>
        <source>The last session ended before it was finished</source>
        <translation>Die letzte Sitzung endete vorzeitig</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>Nichts wurde geändert.</translation>
    </message>
    <message>
        <source>Fineness</source>
        <translation>Feinheit</translation>
    </message>
    <message>
        <source>Acquire</source>
        <translation>Erfassen</translation>
    </message>
    <message>
        <source>Measure how every projector pixel lights every camera pixel. Leave the room dark and still.</source>
        <translation>Messen Sie, wie jedes Projektorpixel jedes Kamerapixel beleuchtet. Lassen Sie den Raum dunkel und ruhig.</translation>
    </message>
    <message>
        <source>Sent to the projector</source>
        <translation>An den Projektor gesendet</translation>
    </message>
    <message>
        <source>Seen by the camera</source>
        <translation>Von der Kamera gesehen</translation>
    </message>
    <message>
        <source>Pattern that the projector shows</source>
        <translation>Muster, das der Projektor zeigt</translation>
    </message>
    <message>
        <source>Last photograph</source>
        <translation>Letztes Foto</translation>
    </message>
    <message>
        <source>Appears when measuring begins. Nothing is projected before you start.</source>
        <translation>Erscheint, sobald die Messung beginnt. Vor dem Start wird nichts projiziert.</translation>
    </message>
    <message>
        <source>How finely</source>
        <translation>Wie fein</translation>
    </message>
    <message>
        <source>Fast</source>
        <translation>Schnell</translation>
    </message>
    <message>
        <source>a first look; misses weak bounces</source>
        <translation>ein erster Blick; schwache Reflexionen fehlen</translation>
    </message>
    <message>
        <source>Usual</source>
        <translation>Üblich</translation>
    </message>
    <message>
        <source>suits most surfaces</source>
        <translation>für die meisten Oberflächen</translation>
    </message>
    <message>
        <source>Fine</source>
        <translation>Fein</translation>
    </message>
    <message>
        <source>glass, gloss, deep corners</source>
        <translation>Glas, Glanz, tiefe Ecken</translation>
    </message>
    <message>
        <source>Disk still needed</source>
        <translation>Noch nötiger Platz</translation>
    </message>
    <message>
        <source>Watching</source>
        <translation>Überwachung</translation>
    </message>
    <message>
        <source>Paused</source>
        <translation>Pausiert</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>Messung</translation>
    </message>
    <message>
        <source>about %1</source>
        <translation>etwa %1</translation>
    </message>
    <message>
        <source>alarm beyond</source>
        <translation>Alarm ab hier</translation>
    </message>
    <message>
        <source>taken again</source>
        <translation>wiederholt</translation>
    </message>
    <message>
        <source>During the measurement</source>
        <translation>Während der Messung</translation>
    </message>
    <message>
        <source>light that would spoil photographs</source>
        <translation>Licht, das Fotos verderben würde</translation>
    </message>
    <message>
        <source>Minutes</source>
        <translation>Minuten</translation>
    </message>
    <message>
        <source>Room light, % of full light</source>
        <translation>Raumlicht, % des Volllichts</translation>
    </message>
    <message>
        <source>Room light during the measurement</source>
        <translation>Raumlicht während der Messung</translation>
    </message>
    <message>
        <source>Taken again</source>
        <translation>Wiederholt</translation>
    </message>
    <message numerus="yes">
        <source>About %n pattern(s), %1. Leave the room dark and still.</source>
        <translation>
            <numerusform>Etwa %n Muster, %1. Lassen Sie den Raum dunkel und ruhig.</numerusform>
            <numerusform>Etwa %n Muster, %1. Lassen Sie den Raum dunkel und ruhig.</numerusform>
        </translation>
    </message>
    <message>
        <source>What was measured</source>
        <translation>Was gemessen wurde</translation>
    </message>
    <message>
        <source>Patterns</source>
        <translation>Muster</translation>
    </message>
    <message>
        <source>Error of the test patterns</source>
        <translation>Fehler der Testmuster</translation>
    </message>
    <message>
        <source>Continue anyway</source>
        <translation>Trotzdem weiter</translation>
    </message>
    <message>
        <source>Found while measuring</source>
        <translation>Beim Messen bemerkt</translation>
    </message>
    <message numerus="yes">
        <source>Begins in %n second(s)</source>
        <translation>
            <numerusform>Beginnt in %n Sekunde</numerusform>
            <numerusform>Beginnt in %n Sekunden</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Measuring begins in %n second(s). Leave the room dark and still.</source>
        <translation>
            <numerusform>Die Messung beginnt in %n Sekunde. Lassen Sie den Raum dunkel und ruhig.</numerusform>
            <numerusform>Die Messung beginnt in %n Sekunden. Lassen Sie den Raum dunkel und ruhig.</numerusform>
        </translation>
    </message>
    <message>
        <source>Start now</source>
        <translation>Jetzt beginnen</translation>
    </message>
    <message>
        <source>Not now</source>
        <translation>Noch nicht</translation>
    </message>
    <message numerus="yes">
        <source>Compared with the start every %n pattern(s). What changed is photographed again; if that does not help, the measurement pauses and asks.</source>
        <translation>
            <numerusform>Nach jedem Muster mit dem Beginn verglichen. Was sich verändert hat, wird noch einmal fotografiert; hilft das nicht, hält die Messung an und fragt.</numerusform>
            <numerusform>Alle %n Muster mit dem Beginn verglichen. Was sich verändert hat, wird noch einmal fotografiert; hilft das nicht, hält die Messung an und fragt.</numerusform>
        </translation>
    </message>
    <message>
        <source>Start</source>
        <translation>Beginn</translation>
    </message>
    <message>
        <source>Leave the room first</source>
        <translation>Erst den Raum verlassen</translation>
    </message>
    <message>
        <source>Time to leave the room before measuring begins</source>
        <translation>Zeit zum Verlassen des Raums, bevor die Messung beginnt</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>A sound when it ends or needs me</source>
        <translation>Ein Ton am Ende oder wenn ich gebraucht werde</translation>
    </message>
    <message>
        <source>Ready</source>
        <translation>Bereit</translation>
    </message>
    <message>
        <source>Dark enough</source>
        <translation>Dunkel genug</translation>
    </message>
    <message>
        <source>Room light is %1 of full light, limit %2.</source>
        <translation>Das Raumlicht beträgt %1 des vollen Lichts, Grenze %2.</translation>
    </message>
    <message>
        <source>It is too bright here</source>
        <translation>Hier ist es zu hell</translation>
    </message>
    <message>
        <source>Room light is %1 of full light. Cover windows and lamps: less light, less noise.</source>
        <translation>Das Raumlicht beträgt %1 des vollen Lichts. Decken Sie Fenster und Lampen ab: weniger Licht, weniger Rauschen.</translation>
    </message>
    <message>
        <source>Needs %1 of %2.</source>
        <translation>Braucht %1 von %2.</translation>
    </message>
    <message>
        <source>Room on the disk</source>
        <translation>Platz auf der Festplatte</translation>
    </message>
    <message>
        <source>The disk is too full</source>
        <translation>Die Festplatte ist zu voll</translation>
    </message>
    <message>
        <source>Floodlight image</source>
        <translation>Bild im vollen Licht</translation>
    </message>
    <message>
        <source>the projector fully white</source>
        <translation>der Projektor ganz weiß</translation>
    </message>
    <message>
        <source>The surface in the projector&apos;s full light</source>
        <translation>Die Oberfläche im vollen Licht des Projektors</translation>
    </message>
    <message>
        <source>%1 px</source>
        <translation>%1 px</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 von %2</translation>
    </message>
    <message>
        <source>Level %1 of %2, %3 of %4 patterns.</source>
        <translation>Stufe %1 von %2, %3 von %4 Mustern.</translation>
    </message>
    <message>
        <source>Patterns for each block size</source>
        <translation>Muster je Blockgröße</translation>
    </message>
    <message>
        <source>blocks are divided only where light needs it</source>
        <translation>Blöcke werden nur geteilt, wo das Licht es braucht</translation>
    </message>
    <message>
        <source>Stopped at %1 px</source>
        <translation>Gestoppt bei %1 px</translation>
    </message>
    <message>
        <source>Measuring was stopped at blocks of %1 px</source>
        <translation>Die Messung wurde bei Blöcken von %1 px gestoppt</translation>
    </message>
    <message>
        <source>Finer light is missing. Go on any time, if nothing has moved.</source>
        <translation>Feineres Licht fehlt. Machen Sie jederzeit weiter, wenn sich nichts bewegt hat.</translation>
    </message>
    <message numerus="yes">
        <source>%1 dB expected, about %2 dB with %n more photograph(s), %3. Go on any time, if nothing has moved.</source>
        <translation>
            <numerusform>%1 dB zu erwarten, etwa %2 dB mit %n weiteren Foto, %3. Messen Sie jederzeit weiter, wenn sich nichts bewegt hat.</numerusform>
            <numerusform>%1 dB zu erwarten, etwa %2 dB mit %n weiteren Fotos, %3. Messen Sie jederzeit weiter, wenn sich nichts bewegt hat.</numerusform>
        </translation>
    </message>
    <message>
        <source>Pictures expected at</source>
        <translation>Bilder zu erwarten mit</translation>
    </message>
    <message>
        <source>rough</source>
        <translation>grob</translation>
    </message>
    <message>
        <source>fair</source>
        <translation>mäßig</translation>
    </message>
    <message>
        <source>good</source>
        <translation>gut</translation>
    </message>
    <message>
        <source>very good</source>
        <translation>sehr gut</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1, %2</translation>
    </message>
    <message>
        <source>%1 dB</source>
        <translation>%1 dB</translation>
    </message>
    <message>
        <source>dB says how close the picture comes to the one wanted, where it can be reached at all: 20 dB looks rough, 30 dB good, and every 6 dB halve what is off.</source>
        <translation>dB sagt, wie nahe das Bild dem gewünschten kommt, wo es überhaupt erreichbar ist: 20 dB sehen grob aus, 30 dB gut, und je 6 dB mehr halbieren die Abweichung.</translation>
    </message>
    <message>
        <source>Compensated so far</source>
        <translation>Bisher kompensiert</translation>
    </message>
    <message>
        <source>A picture, compensated with what is measured so far</source>
        <translation>Ein Bild, kompensiert mit dem bisher Gemessenen</translation>
    </message>
    <message>
        <source>Appears after the first patterns, and grows sharper.</source>
        <translation>Erscheint nach den ersten Mustern und wird schärfer.</translation>
    </message>
    <message>
        <source>Expected now</source>
        <translation>Jetzt zu erwarten</translation>
    </message>
    <message>
        <source>Blocks of %1 px. Expected now: %2. In the end: %3.</source>
        <translation>Blöcke von %1 px. Jetzt zu erwarten: %2. Am Ende: %3.</translation>
    </message>
    <message>
        <source>In the end</source>
        <translation>Am Ende</translation>
    </message>
    <message>
        <source>Waiting for room on the disk. Nothing is being projected.</source>
        <translation>Wartet auf Platz auf der Festplatte. Es wird nichts projiziert.</translation>
    </message>
    <message>
        <source>Go on now</source>
        <translation>Jetzt weiter</translation>
    </message>
    <message>
        <source>Photographs to keep</source>
        <translation>Fotos behalten</translation>
    </message>
    <message>
        <source>Photographs to keep once all is measured</source>
        <translation>Fotos, die nach der ganzen Messung behalten werden</translation>
    </message>
    <message>
        <source>All</source>
        <translation>Alle</translation>
    </message>
    <message>
        <source>Of the latest measurement</source>
        <translation>Die der letzten Messung</translation>
    </message>
    <message>
        <source>None: results only</source>
        <translation>Keine: nur Ergebnisse</translation>
    </message>
    <message>
        <source>Those that were set aside by measuring again are removed once all is measured.</source>
        <translation>Fotos, die beim erneuten Messen beiseitegelegt wurden, werden entfernt, sobald alles gemessen ist.</translation>
    </message>
    <message>
        <source>Removed once all is measured. Other settings then have to photograph everything again.</source>
        <translation>Sie werden entfernt, sobald alles gemessen ist. Mit anderen Einstellungen wird dann alles neu fotografiert.</translation>
    </message>
    <message>
        <source>Measuring with other settings then needs fewer new photographs.</source>
        <translation>Eine Messung mit anderen Einstellungen braucht dann weniger neue Fotos.</translation>
    </message>
    <message>
        <source>Those of the last measurement were removed: all are taken again.</source>
        <translation>Die Fotos der letzten Messung wurden entfernt: Alle werden neu aufgenommen.</translation>
    </message>
    <message>
        <source>Waiting for the projector&apos;s screen.</source>
        <translation>Wartet auf den Bildschirm des Projektors.</translation>
    </message>
    <message>
        <source>Every photograph is saved. The earlier measurement is used until the new one is ready.</source>
        <translation>Jedes Foto wird gespeichert. Die frühere Messung gilt, bis die neue fertig ist.</translation>
    </message>
    <message>
        <source>To go on measuring, confirm that the room is clear.</source>
        <translation>Um weiter zu messen, bestätigen Sie, dass der Raum geräumt ist.</translation>
    </message>
    <message>
        <source>Takes every photograph again. What is measured stays until then.</source>
        <translation>Nimmt jedes Foto neu auf. Bis dahin bleibt das Gemessene.</translation>
    </message>
    <message>
        <source>Measuring again has not ended</source>
        <translation>Die neue Messung ist nicht zu Ende</translation>
    </message>
    <message>
        <source>Measuring with these settings.</source>
        <translation>Mit diesen Einstellungen wird gemessen.</translation>
    </message>
    <message>
        <source>Waiting for the camera.</source>
        <translation>Wartet auf die Kamera.</translation>
    </message>
    <message>
        <source>Keep the earlier one</source>
        <translation>Frühere behalten</translation>
    </message>
    <message>
        <source>The earlier measurement is used again, with all that followed from it.</source>
        <translation>Die frühere Messung wird wieder verwendet, mit allem, was daraus folgte.</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>Das Gemessene ist sicher.</translation>
    </message>
    <message>
        <source>Paused, about %1 left</source>
        <translation>Pausiert, noch etwa %1</translation>
    </message>
    <message>
        <source>%1 of about %2</source>
        <translation>%1 von etwa %2</translation>
    </message>
    <message>
        <source>About %1 left</source>
        <translation>Noch etwa %1</translation>
    </message>
    <message>
        <source>Ends near %1. %2</source>
        <translation>Ende gegen %1. %2</translation>
    </message>
    <message>
        <source>Put the camera back</source>
        <translation>Kamera zurückstellen</translation>
    </message>
    <message>
        <source>Test patterns are predicted from the measurement, then photographed: this is how far the two differ, the photographs&apos; noise included.</source>
        <translation>Testmuster werden aus der Messung vorhergesagt und dann fotografiert: So weit liegen beide auseinander, das Rauschen der Fotos eingeschlossen.</translation>
    </message>
    <message>
        <source>%1; light right within about %2</source>
        <translation>%1; Licht auf etwa %2 genau</translation>
    </message>
    <message>
        <source>Reading, %1</source>
        <translation>Liest, %1</translation>
    </message>
    <message>
        <source>Waiting for your answer. Every photograph is saved.</source>
        <translation>Wartet auf Ihre Antwort. Jedes Foto ist gespeichert.</translation>
    </message>
    <message>
        <source>Go on measuring</source>
        <translation>Weiter messen</translation>
    </message>
    <message>
        <source>Answer</source>
        <translation>Antworten</translation>
    </message>
    <message>
        <source>Try again</source>
        <translation>Erneut versuchen</translation>
    </message>
    <message>
        <source>The camera is back at its place</source>
        <translation>Die Kamera steht wieder an ihrem Platz</translation>
    </message>
    <message>
        <source>It had moved while it measured, and looks again where it looked.</source>
        <translation>Sie hatte sich während der Messung bewegt und sieht wieder dorthin, wohin sie sah.</translation>
    </message>
    <message numerus="yes">
        <source>“%1” photographs %n pattern(s) again, from No. %2 on, and goes on from there.</source>
        <translation>
            <numerusform>„%1“ fotografiert %n Muster ab Nr. %2 noch einmal und macht von dort weiter.</numerusform>
            <numerusform>„%1“ fotografiert %n Muster ab Nr. %2 noch einmal und macht von dort weiter.</numerusform>
        </translation>
    </message>
    <message>
        <source>“%1” looks once more, and goes on.</source>
        <translation>„%1“ sieht noch einmal nach und macht weiter.</translation>
    </message>
    <message>
        <source>“%1” keeps all as it is: what changed will be wrong, and the report says so.</source>
        <translation>„%1“ lässt alles, wie es ist: Was sich geändert hat, wird falsch, und der Bericht sagt es.</translation>
    </message>
    <message>
        <source>Measuring waits for your answer.</source>
        <translation>Die Messung wartet auf Ihre Antwort.</translation>
    </message>
    <message>
        <source>Kept photographs are read first.</source>
        <translation>Erst werden die vorhandenen Fotos gelesen.</translation>
    </message>
    <message>
        <source>Nothing is being projected.</source>
        <translation>Es wird nichts projiziert.</translation>
    </message>
    <message>
        <source>Reading</source>
        <translation>Liest</translation>
    </message>
    <message>
        <source>Reading, under a minute left</source>
        <translation>Liest, noch unter einer Minute</translation>
    </message>
    <message>
        <source>Reading, about %1 left</source>
        <translation>Liest, noch etwa %1</translation>
    </message>
    <message>
        <source>Paused, under a minute left</source>
        <translation>Pause, noch unter einer Minute</translation>
    </message>
    <message>
        <source>Under a minute left</source>
        <translation>Noch unter einer Minute</translation>
    </message>
    <message>
        <source>%1 expected</source>
        <translation>%1 zu erwarten</translation>
    </message>
    <message>
        <source>To measure again, confirm that the room is clear.</source>
        <translation>Um neu zu messen, bestätigen Sie, dass der Raum geräumt ist.</translation>
    </message>
    <message>
        <source>%1, %2 a minute</source>
        <translation>%1, %2 je Minute</translation>
    </message>
    <message>
        <source>all projectors fully white</source>
        <translation>alle Projektoren ganz weiß</translation>
    </message>
    <message>
        <source>Reading what was measured</source>
        <translation>Gemessenes wird gelesen</translation>
    </message>
    <message>
        <source>The camera is at its place</source>
        <translation>Die Kamera steht an ihrem Platz</translation>
    </message>
    <message>
        <source>It looks where it looked. Perhaps the light flickered.</source>
        <translation>Sie sieht, wohin sie sah. Vielleicht hat das Licht geflackert.</translation>
    </message>
    <message>
        <source>Ended by a change</source>
        <translation>Durch Änderung beendet</translation>
    </message>
    <message>
        <source>Put right what changed, then go on measuring.</source>
        <translation>Beheben Sie, was sich geändert hat, dann messen Sie weiter.</translation>
    </message>
    <message>
        <source>Measure again as it stands now, or put it back and go on measuring.</source>
        <translation>Messen Sie neu, wie es jetzt steht, oder stellen Sie es zurück und messen Sie weiter.</translation>
    </message>
    <message>
        <source>Measuring was stopped at blocks of %1 px: something had changed</source>
        <translation>Die Messung wurde bei Blöcken von %1 px gestoppt: Etwas hatte sich geändert</translation>
    </message>
    <message>
        <source>Measuring ended, and something had changed</source>
        <translation>Die Messung ist zu Ende, und etwas hatte sich geändert</translation>
    </message>
    <message>
        <source>What was photographed since the look before is left out, all before it is kept.</source>
        <translation>Was seit der letzten Kontrolle davor fotografiert wurde, ist weggelassen; alles davor bleibt.</translation>
    </message>
    <message>
        <source>Working out, %1</source>
        <translation>Auswertung, %1</translation>
    </message>
    <message>
        <source>Working out the result</source>
        <translation>Ergebnis wird berechnet</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s)</source>
        <translation>
            <numerusform>%n Muster</numerusform>
            <numerusform>%n Muster</numerusform>
        </translation>
    </message>
    <message>
        <source>Waits for an answer</source>
        <translation>Wartet auf Antwort</translation>
    </message>
    <message>
        <source>%1 too bright</source>
        <translation>%1 zu hell</translation>
    </message>
    <message>
        <source>%1 left out</source>
        <translation>%1 ausgelassen</translation>
    </message>
    <message>
        <source>Waiting for your answer.</source>
        <translation>Wartet auf Ihre Antwort.</translation>
    </message>
    <message>
        <source>Stop and keep this one</source>
        <translation>Stoppen, diese behalten</translation>
    </message>
    <message>
        <source>Going on has not ended</source>
        <translation>Das Weitermessen ist nicht zu Ende</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s) expected, %1 of them checks; known exactly as each level begins</source>
        <translation>
            <numerusform>%n Muster erwartet, davon %1 Prüfungen; genau bekannt, wenn jede Stufe beginnt</numerusform>
            <numerusform>%n Muster erwartet, davon %1 Prüfungen; genau bekannt, wenn jede Stufe beginnt</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s), %1 of them checks</source>
        <translation>
            <numerusform>%n Muster, davon %1 Prüfungen</numerusform>
            <numerusform>%n Muster, davon %1 Prüfungen</numerusform>
        </translation>
    </message>
    <message>
        <source>Ending</source>
        <translation>Wird beendet</translation>
    </message>
    <message>
        <source>Measure with these settings</source>
        <translation>Mit diesen Einstellungen messen</translation>
    </message>
    <message>
        <source>Use the earlier one</source>
        <translation>Frühere verwenden</translation>
    </message>
    <message>
        <source>Waiting</source>
        <translation>Wartet</translation>
    </message>
    <message>
        <source>Waiting, under a minute left</source>
        <translation>Wartet, noch unter einer Minute</translation>
    </message>
    <message>
        <source>Waiting, about %1 left</source>
        <translation>Wartet, noch etwa %1</translation>
    </message>
    <message>
        <source>Keep the new ones</source>
        <translation>Neue behalten</translation>
    </message>
    <message>
        <source>Keep the earlier measurement?</source>
        <translation>Frühere Messung behalten?</translation>
    </message>
    <message>
        <source>The new photographs are set aside and not used again: measuring again then takes every photograph again.</source>
        <translation>Die neuen Fotos werden beiseitegelegt und nicht wieder verwendet: Erneutes Messen nimmt dann jedes Foto neu auf.</translation>
    </message>
    <message>
        <source>The earlier measurement, and all that followed from it.</source>
        <translation>Die frühere Messung und alles, was daraus folgte.</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s) kept</source>
        <translation>
            <numerusform>%n Muster gesichert</numerusform>
            <numerusform>%n Muster gesichert</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The photographs of %n pattern(s) are read first. Then measuring goes on where it ended.</source>
        <translation>
            <numerusform>Erst werden die Fotos von %n Muster gelesen. Dann geht die Messung dort weiter, wo sie endete.</numerusform>
            <numerusform>Erst werden die Fotos von %n Mustern gelesen. Dann geht die Messung dort weiter, wo sie endete.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The photographs of %n pattern(s) are safe. Resuming gives the same result as if nothing had happened.</source>
        <translation>
            <numerusform>Die Fotos von %n Muster sind sicher. Fortsetzen führt zum selben Ergebnis, als wäre nichts geschehen.</numerusform>
            <numerusform>Die Fotos von %n Mustern sind sicher. Fortsetzen führt zum selben Ergebnis, als wäre nichts geschehen.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The new photographs of %n pattern(s) are safe: resume any time. Until then the earlier measurement is used.</source>
        <translation>
            <numerusform>Die neuen Fotos von %n Muster sind sicher: Setzen Sie jederzeit fort. Bis dahin gilt die frühere Messung.</numerusform>
            <numerusform>Die neuen Fotos von %n Mustern sind sicher: Setzen Sie jederzeit fort. Bis dahin gilt die frühere Messung.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The photographs of %n pattern(s) are on the disk. The pattern under way is not counted.</source>
        <translation>
            <numerusform>Die Fotos von %n Muster sind auf dem Laufwerk. Das gerade gezeigte zählt nicht mit.</numerusform>
            <numerusform>Die Fotos von %n Mustern sind auf dem Laufwerk. Das gerade gezeigte zählt nicht mit.</numerusform>
        </translation>
    </message>
    <message>
        <source>Photographs</source>
        <translation>Fotos</translation>
    </message>
    <message numerus="yes">
        <source>Reading the photographs of %n pattern(s): %1.</source>
        <translation>
            <numerusform>Liest die Fotos von %n Muster: %1.</numerusform>
            <numerusform>Liest die Fotos von %n Mustern: %1.</numerusform>
        </translation>
    </message>
    <message>
        <source>Keep the new one</source>
        <translation>Neue behalten</translation>
    </message>
    <message>
        <source>Use the earlier measurement?</source>
        <translation>Frühere Messung verwenden?</translation>
    </message>
    <message>
        <source>%1; lit, within the dashes: %2 of the view</source>
        <translation>%1; beleuchtet, in der gestrichelten Linie: %2 der Ansicht</translation>
    </message>
    <message>
        <source>Stopped after %1</source>
        <translation>Gestoppt nach %1</translation>
    </message>
    <message>
        <source>Stopped early: light finer than blocks of %1 px is missing.</source>
        <translation>Vorzeitig gestoppt: Licht, das feiner ist als Blöcke von %1 px, fehlt.</translation>
    </message>
    <message>
        <source>Again, not ended</source>
        <translation>Erneut, nicht beendet</translation>
    </message>
    <message>
        <source>What was measured cannot be read</source>
        <translation>Das Gemessene lässt sich nicht lesen</translation>
    </message>
    <message>
        <source>Use the earlier measurement, or measure again.</source>
        <translation>Verwenden Sie die frühere Messung, oder messen Sie neu.</translation>
    </message>
    <message>
        <source>Measure again.</source>
        <translation>Messen Sie neu.</translation>
    </message>
    <message>
        <source>%1 dB expected: what was measured does not fit together, and pictures are no better than uncorrected.</source>
        <translation>%1 dB zu erwarten: Das Gemessene passt nicht zusammen, und Bilder sind nicht besser als unkorrigiert.</translation>
    </message>
    <message>
        <source>%1 dB expected. Go on any time, if nothing has moved.</source>
        <translation>%1 dB zu erwarten. Messen Sie jederzeit weiter, wenn sich nichts bewegt hat.</translation>
    </message>
    <message>
        <source>What was measured cannot be read.</source>
        <translation>Das Gemessene lässt sich nicht lesen.</translation>
    </message>
    <message>
        <source>%1: what was photographed since the check before is taken again.</source>
        <translation>%1: Was seit der vorigen Kontrolle fotografiert wurde, wird wiederholt.</translation>
    </message>
    <message>
        <source>The light of the room was another one, too: see that it is as it was.</source>
        <translation>Auch das Raumlicht war ein anderes: Sorgen Sie dafür, dass es ist wie zuvor.</translation>
    </message>
    <message>
        <source>Ending: what is begun is photographed to its end, and test patterns. Then all of it is kept.</source>
        <translation>Endet: Was begonnen ist, wird zu Ende fotografiert, dazu Testmuster. Dann wird alles behalten.</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the patterns flash.</source>
        <translation>Bestätigen Sie, dass der Raum geräumt ist: Die Muster blitzen.</translation>
    </message>
    <message>
        <source>%1: all patterns are taken again, from the first.</source>
        <translation>%1: Alle Muster werden noch einmal aufgenommen, vom ersten an.</translation>
    </message>
    <message>
        <source>Measured in %1, and repaired since</source>
        <translation>Gemessen in %1 und seither repariert</translation>
    </message>
    <message>
        <source>Photographs of the repair since</source>
        <translation>Fotos der Reparatur seither</translation>
    </message>
    <message>
        <source>Stopped too early</source>
        <translation>Zu früh beendet</translation>
    </message>
</context>
<context>
    <name>relucent::gui::AcquisitionTrace</name>
    <message>
        <source>the light flickered</source>
        <translation>das Licht flackerte</translation>
    </message>
    <message>
        <source>the room light changed</source>
        <translation>das Raumlicht änderte sich</translation>
    </message>
    <message>
        <source>the projector&apos;s light changed</source>
        <translation>das Licht des Projektors änderte sich</translation>
    </message>
    <message>
        <source>the camera or the projector moved</source>
        <translation>Kamera oder Projektor bewegt</translation>
    </message>
    <message>
        <source>the picture was not the one sent</source>
        <translation>es war nicht das gesendete Bild</translation>
    </message>
    <message>
        <source>the camera saw nothing</source>
        <translation>die Kamera sah nichts</translation>
    </message>
    <message>
        <source>the projector showed nothing</source>
        <translation>der Projektor zeigte nichts</translation>
    </message>
    <message>
        <source>too bright, shorter exposure</source>
        <translation>zu hell, kürzer belichtet</translation>
    </message>
    <message>
        <source>does not fit what was seen before</source>
        <translation>passt nicht zu Früherem</translation>
    </message>
    <message>
        <source>No. %1</source>
        <translation>Nr. %1</translation>
    </message>
    <message>
        <source>No. %1 to %2</source>
        <translation>Nr. %1 bis %2</translation>
    </message>
    <message>
        <source>Room light</source>
        <translation>Raumlicht</translation>
    </message>
    <message>
        <source>Camera and view</source>
        <translation>Kamera und Bild</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>Projektor</translation>
    </message>
    <message>
        <source>Flicker</source>
        <translation>Flackern</translation>
    </message>
    <message>
        <source>Room light steady</source>
        <translation>Raumlicht stabil</translation>
    </message>
    <message>
        <source>Room light changed</source>
        <translation>Raumlicht verändert</translation>
    </message>
    <message>
        <source>%1 of full light, changed by %2 since the start.</source>
        <translation>%1 des Volllichts, seit Beginn um %2 verändert.</translation>
    </message>
    <message>
        <source>Camera still</source>
        <translation>Kamera unbewegt</translation>
    </message>
    <message>
        <source>The view changed</source>
        <translation>Das Bild hat sich verändert</translation>
    </message>
    <message>
        <source>The view differs by %1 from the first.</source>
        <translation>Das Bild weicht um %1 vom ersten ab.</translation>
    </message>
    <message>
        <source>Projector steady</source>
        <translation>Projektor stabil</translation>
    </message>
    <message>
        <source>The projector&apos;s light changed</source>
        <translation>Das Licht des Projektors hat sich verändert</translation>
    </message>
    <message>
        <source>Its light drifted by %1 and is corrected.</source>
        <translation>Sein Licht driftete um %1 und wird korrigiert.</translation>
    </message>
    <message>
        <source>No flicker</source>
        <translation>Kein Flackern</translation>
    </message>
    <message>
        <source>Photographs of one pattern agree within %1.</source>
        <translation>Fotos eines Musters stimmen auf %1 überein.</translation>
    </message>
    <message>
        <source>No difference between photographs of one pattern was found.</source>
        <translation>Zwischen Fotos eines Musters zeigte sich kein Unterschied.</translation>
    </message>
    <message>
        <source>The camera or the projector moved</source>
        <translation>Kamera oder Projektor hat sich bewegt</translation>
    </message>
    <message>
        <source>The picture is not the one sent</source>
        <translation>Das Bild ist nicht das gesendete</translation>
    </message>
    <message>
        <source>The camera sees nothing</source>
        <translation>Die Kamera sieht nichts</translation>
    </message>
    <message>
        <source>The projector shows nothing</source>
        <translation>Der Projektor zeigt nichts</translation>
    </message>
    <message>
        <source>Put right</source>
        <translation>Behoben</translation>
    </message>
    <message>
        <source>Looked at again at the next check.</source>
        <translation>Wird bei der nächsten Kontrolle wieder angesehen.</translation>
    </message>
    <message>
        <source>the light flickered, or something moved</source>
        <translation>das Licht flackerte, oder etwas bewegte sich</translation>
    </message>
    <message>
        <source>The light flickers, or something moves</source>
        <translation>Das Licht flackert, oder etwas bewegt sich</translation>
    </message>
    <message>
        <source>Not known while the view has changed.</source>
        <translation>Nicht zu beurteilen, solange sich der Blick geändert hat.</translation>
    </message>
    <message>
        <source>The light flickers, or was switched</source>
        <translation>Das Licht flackert oder wurde geschaltet</translation>
    </message>
    <message>
        <source>Photographed again</source>
        <translation>Erneut fotografiert</translation>
    </message>
    <message>
        <source>dark: lens covered for a moment?</source>
        <translation>dunkel: Objektiv kurz verdeckt?</translation>
    </message>
    <message>
        <source>Found since the last check.</source>
        <translation>Seit der letzten Prüfung gefunden.</translation>
    </message>
    <message>
        <source>something in the view changed</source>
        <translation>im Blickfeld hat sich etwas verändert</translation>
    </message>
    <message>
        <source>Something in the view changed</source>
        <translation>Im Blickfeld hat sich etwas verändert</translation>
    </message>
    <message>
        <source>Not known while the camera sees nothing.</source>
        <translation>Nicht bekannt, solange die Kamera nichts sieht.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ActionBar</name>
    <message>
        <source>Progress of the measurement</source>
        <translation>Fortschritt der Messung</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Zurück</translation>
    </message>
    <message>
        <source>Show where</source>
        <translation>Wo?</translation>
    </message>
</context>
<context>
    <name>relucent::gui::CameraPage</name>
    <message>
        <source>Choose</source>
        <translation>Wählen</translation>
    </message>
    <message>
        <source>Choose %1</source>
        <translation>%1 wählen</translation>
    </message>
    <message>
        <source>Choose the one that looks at the surface.</source>
        <translation>Wählen Sie die, die auf die Oberfläche blickt.</translation>
    </message>
    <message>
        <source>Looking for cameras</source>
        <translation>Suche nach Kameras</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>Nichts wurde geändert.</translation>
    </message>
    <message>
        <source>Checking</source>
        <translation>Prüfung läuft</translation>
    </message>
    <message>
        <source>Checked %1</source>
        <translation>Geprüft %1</translation>
    </message>
    <message>
        <source>Choose the camera that looks at the surface.</source>
        <translation>Wählen Sie die Kamera, die auf die Oberfläche blickt.</translation>
    </message>
    <message>
        <source>Opening the devices</source>
        <translation>Öffnen der Geräte</translation>
    </message>
    <message>
        <source>%1 is too bright in every exposure.</source>
        <translation>%1 sind in jeder Belichtung zu hell.</translation>
    </message>
    <message>
        <source>Look through the camera first.</source>
        <translation>Sehen Sie zuerst durch die Kamera.</translation>
    </message>
    <message>
        <source>Next: test patterns for the projector&apos;s response</source>
        <translation>Als Nächstes: Testmuster für die Kennlinie des Projektors</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>Check again</source>
        <translation>Erneut prüfen</translation>
    </message>
    <message>
        <source>Choose another camera</source>
        <translation>Andere Kamera wählen</translation>
    </message>
    <message>
        <source>Focus area</source>
        <translation>Fokusbereich</translation>
    </message>
    <message>
        <source>Nothing is measured at this step, so nothing is lost.</source>
        <translation>In diesem Schritt wird nichts gemessen, also geht nichts verloren.</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Kamera</translation>
    </message>
    <message>
        <source>Frame the surface, focus, and let the exposures cover its brightest and darkest parts.</source>
        <translation>Wählen Sie den Ausschnitt, stellen Sie scharf und decken Sie mit den Belichtungen die hellsten und dunkelsten Stellen ab.</translation>
    </message>
    <message>
        <source>Focus, %1 of best</source>
        <translation>Fokus, %1 des Bestwerts</translation>
    </message>
    <message>
        <source>Camera view</source>
        <translation>Kamerabild</translation>
    </message>
    <message>
        <source>What the camera sees now</source>
        <translation>Was die Kamera jetzt sieht</translation>
    </message>
    <message>
        <source>The camera is not being looked through.</source>
        <translation>Es wird nicht durch die Kamera gesehen.</translation>
    </message>
    <message>
        <source>Light in this exposure: red, green, blue</source>
        <translation>Licht in dieser Belichtung: Rot, Grün, Blau</translation>
    </message>
    <message>
        <source>Signal</source>
        <translation>Signal</translation>
    </message>
    <message>
        <source>Focus</source>
        <translation>Fokus</translation>
    </message>
    <message>
        <source>Turn the lens until the bar stays at the mark: the best so far.</source>
        <translation>Drehen Sie am Objektiv, bis der Balken an der Marke bleibt: dem bisher besten Wert.</translation>
    </message>
    <message>
        <source>Exposures</source>
        <translation>Belichtungen</translation>
    </message>
    <message>
        <source>Checks</source>
        <translation>Prüfungen</translation>
    </message>
    <message>
        <source>Signal, share of full</source>
        <translation>Signal, Anteil am Maximum</translation>
    </message>
    <message>
        <source>Pixels</source>
        <translation>Pixel</translation>
    </message>
    <message>
        <source>The camera sees the projector</source>
        <translation>Die Kamera sieht den Projektor</translation>
    </message>
    <message>
        <source>White and black differ as they should.</source>
        <translation>Weiß und Schwarz unterscheiden sich wie erwartet.</translation>
    </message>
    <message>
        <source>Bright parts are covered</source>
        <translation>Helle Stellen sind abgedeckt</translation>
    </message>
    <message>
        <source>%1 is too bright in every exposure</source>
        <translation>%1 sind in jeder Belichtung zu hell</translation>
    </message>
    <message>
        <source>Close the lens a little, or shade lamps in the view.</source>
        <translation>Schließen Sie die Blende etwas oder schirmen Sie Lampen im Bild ab.</translation>
    </message>
    <message>
        <source>Dark parts are covered</source>
        <translation>Dunkle Stellen sind abgedeckt</translation>
    </message>
    <message>
        <source>%1 is too dark in every exposure</source>
        <translation>%1 sind in jeder Belichtung zu dunkel</translation>
    </message>
    <message>
        <source>The projector may not reach there. Where it should, open the lens.</source>
        <translation>Vielleicht reicht der Projektor nicht dorthin. Wo er es sollte, öffnen Sie die Blende.</translation>
    </message>
    <message>
        <source>Keep exposures</source>
        <translation>Belichtungen behalten</translation>
    </message>
    <message>
        <source>too bright to tell</source>
        <translation>zu hell zum Beurteilen</translation>
    </message>
    <message>
        <source>Too bright %1</source>
        <translation>Zu hell %1</translation>
    </message>
    <message>
        <source>Too dark %1</source>
        <translation>Zu dunkel %1</translation>
    </message>
    <message>
        <source>No camera is chosen yet</source>
        <translation>Noch keine Kamera gewählt</translation>
    </message>
    <message>
        <source>Camera pixels</source>
        <translation>Kamerapixel</translation>
    </message>
    <message>
        <source>As many as needed: %1</source>
        <translation>So viele wie nötig: %1</translation>
    </message>
    <message>
        <source>All: %1</source>
        <translation>Alle: %1</translation>
    </message>
    <message>
        <source>%1 become one: %2</source>
        <translation>%1 werden zu einem: %2</translation>
    </message>
    <message>
        <source>Camera pixels that are used</source>
        <translation>Kamerapixel, die verwendet werden</translation>
    </message>
    <message>
        <source>Memory</source>
        <translation>Arbeitsspeicher</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>Laufwerk</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>More camera pixels than projector pixels show nothing more. The photographs that prove the result stay as large as they are.</source>
        <translation>Mehr Kamerapixel als Projektorpixel zeigen nicht mehr. Die Fotos, die das Ergebnis belegen, bleiben so groß, wie sie sind.</translation>
    </message>
    <message>
        <source>Mark what is sharp</source>
        <translation>Scharfes markieren</translation>
    </message>
    <message>
        <source>Checked before. Check again if camera or projector were moved.</source>
        <translation>Schon geprüft. Erneut prüfen, wenn Kamera oder Projektor bewegt wurden.</translation>
    </message>
    <message>
        <source>Continue</source>
        <translation>Weiter</translation>
    </message>
    <message>
        <source>Exposure times</source>
        <translation>Belichtungszeiten</translation>
    </message>
    <message>
        <source>The projector&apos;s picture: the camera sees %1 of it</source>
        <translation>Das Bild des Projektors: Die Kamera sieht %1 davon</translation>
    </message>
    <message>
        <source>at the left</source>
        <translation>links</translation>
    </message>
    <message>
        <source>at the right</source>
        <translation>rechts</translation>
    </message>
    <message>
        <source>at the top</source>
        <translation>oben</translation>
    </message>
    <message>
        <source>at the bottom</source>
        <translation>unten</translation>
    </message>
    <message>
        <source>Missing are places within it: in shadow, or too dark for the camera.</source>
        <translation>Es fehlen Stellen darin: im Schatten oder zu dunkel für die Kamera.</translation>
    </message>
    <message>
        <source>Missing: %1. Aim the camera there, or move it back.</source>
        <translation>Es fehlt: %1. Richten Sie die Kamera dorthin, oder stellen Sie sie weiter weg.</translation>
    </message>
    <message>
        <source>%1 of the projector&apos;s picture is seen</source>
        <translation>%1 vom Bild des Projektors ist zu sehen</translation>
    </message>
    <message>
        <source>%1 of projector %2&apos;s picture is seen</source>
        <translation>%1 vom Bild des Projektors %2 ist zu sehen</translation>
    </message>
    <message>
        <source>Every exposure is a multiple of %1</source>
        <translation>Jede Belichtung ist ein Vielfaches von %1</translation>
    </message>
    <message>
        <source>The projector&apos;s light changes as quickly as that: each photograph has all of it.</source>
        <translation>So schnell ändert sich das Licht des Projektors: Jedes Foto hat alles davon.</translation>
    </message>
    <message>
        <source>Allow any exposure</source>
        <translation>Jede Belichtung zulassen</translation>
    </message>
    <message>
        <source>Exposures shorter than %1 flicker</source>
        <translation>Belichtungen kürzer als %1 flackern</translation>
    </message>
    <message>
        <source>The projector&apos;s light changes within that time.</source>
        <translation>Das Licht des Projektors ändert sich in dieser Zeit.</translation>
    </message>
    <message>
        <source>Use multiples of %1</source>
        <translation>Vielfache von %1 verwenden</translation>
    </message>
    <message>
        <source>Checked before</source>
        <translation>Schon geprüft</translation>
    </message>
    <message>
        <source>These exposures are kept. “Check again” looks through the camera.</source>
        <translation>Diese Belichtungen sind gespeichert. „Erneut prüfen“ blickt durch die Kamera.</translation>
    </message>
    <message>
        <source>Not checked yet</source>
        <translation>Noch nicht geprüft</translation>
    </message>
    <message>
        <source>Missing: %1. A simulated camera stays where it stands: go on, what it does not see is left as it is.</source>
        <translation>Es fehlt: %1. Eine simulierte Kamera bleibt, wo sie steht: Machen Sie weiter, was sie nicht sieht, bleibt, wie es ist.</translation>
    </message>
    <message>
        <source>Exposures as measured</source>
        <translation>Belichtungen wie gemessen</translation>
    </message>
    <message>
        <source>Camera %1: %2 is too bright in every exposure.</source>
        <translation>Kamera %1: %2 ist in jeder Belichtung zu hell.</translation>
    </message>
    <message>
        <source>What %1 sees now</source>
        <translation>Was %1 jetzt sieht</translation>
    </message>
    <message>
        <source>Focus %1</source>
        <translation>Schärfe %1</translation>
    </message>
    <message numerus="yes">
        <source>%n projector(s): %1</source>
        <translation>
            <numerusform>%n Projektor: %1</numerusform>
            <numerusform>%n Projektoren: %1</numerusform>
        </translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Licht</translation>
    </message>
    <message>
        <source>Overlap</source>
        <translation>Überlappung</translation>
    </message>
    <message>
        <source>how many projectors light each place</source>
        <translation>wie viele Projektoren jede Stelle beleuchten</translation>
    </message>
    <message>
        <source>Checks done</source>
        <translation>Prüfungen fertig</translation>
    </message>
    <message>
        <source>%1 of every picture is seen</source>
        <translation>Von jedem Bild sind %1 zu sehen</translation>
    </message>
    <message>
        <source>Exposures, kept</source>
        <translation>Belichtungen, behalten</translation>
    </message>
    <message>
        <source>Check again to look with another one.</source>
        <translation>Prüfen Sie erneut, um mit einer anderen zu schauen.</translation>
    </message>
    <message>
        <source>Exposures, paused</source>
        <translation>Belichtungen, angehalten</translation>
    </message>
    <message>
        <source>places within it</source>
        <translation>Stellen darin</translation>
    </message>
    <message>
        <source>All of the view, by one exposure or another.</source>
        <translation>Das ganze Bild, von der einen oder der anderen Belichtung.</translation>
    </message>
    <message>
        <source>All but %1 of the view, by one exposure or another.</source>
        <translation>Bis auf %1 des Kamerabilds, von der einen oder der anderen Belichtung.</translation>
    </message>
    <message>
        <source>%1 too bright</source>
        <translation>%1 zu hell</translation>
    </message>
    <message>
        <source>Keep the former camera</source>
        <translation>Bisherige Kamera behalten</translation>
    </message>
    <message>
        <source>exposure %1, click to judge focus</source>
        <translation>Belichtung %1, Klick prüft den Fokus dort</translation>
    </message>
    <message>
        <source>Checks under way</source>
        <translation>Prüfungen laufen</translation>
    </message>
    <message>
        <source>Stop the checks</source>
        <translation>Prüfungen beenden</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the checks begin with that.</source>
        <translation>Bestätigen Sie, dass der Raum geräumt ist: Damit beginnen die Prüfungen.</translation>
    </message>
    <message>
        <source>as it was seen last, exposure %1</source>
        <translation>wie zuletzt gesehen, Belichtung %1</translation>
    </message>
    <message>
        <source>%1 of full light was too bright in every exposure. “Check again” looks through the camera.</source>
        <translation>%1 des vollen Lichts waren in jeder Belichtung zu hell. „Erneut prüfen“ blickt durch die Kamera.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::CameraRows</name>
    <message>
        <source>Cameras</source>
        <translation>Kameras</translation>
    </message>
    <message>
        <source>Look again</source>
        <translation>Erneut suchen</translation>
    </message>
    <message>
        <source>Looking for cameras</source>
        <translation>Suche nach Kameras</translation>
    </message>
    <message>
        <source>Cannot be used: %1</source>
        <translation>Nicht nutzbar: %1</translation>
    </message>
    <message numerus="yes">
        <source>%1 pixels, %n bit(s), exposures %2 to %3</source>
        <translation>
            <numerusform>%1 Pixel, %n Bit, Belichtungen %2 bis %3</numerusform>
            <numerusform>%1 Pixel, %n Bit, Belichtungen %2 bis %3</numerusform>
        </translation>
    </message>
    <message>
        <source>Recommended: it tells faint light apart best</source>
        <translation>Empfohlen: unterscheidet schwaches Licht am besten</translation>
    </message>
    <message>
        <source>Fewer bits: faint light is told apart less well</source>
        <translation>Weniger Bits: Schwaches Licht wird schlechter unterschieden</translation>
    </message>
    <message>
        <source>Recommended: its exposures cover most, from bright to dark</source>
        <translation>Empfohlen: Ihre Belichtungen decken am meisten ab, von hell bis dunkel</translation>
    </message>
    <message>
        <source>Fewer exposures: bright and dark are harder to cover</source>
        <translation>Weniger Belichtungen: Hell und Dunkel sind schwerer abzudecken</translation>
    </message>
    <message>
        <source>Recommended: it has most pixels</source>
        <translation>Empfohlen: Sie hat die meisten Pixel</translation>
    </message>
    <message>
        <source>Fewer pixels than the first</source>
        <translation>Weniger Pixel als die erste</translation>
    </message>
    <message>
        <source>As suitable as the first</source>
        <translation>So geeignet wie die erste</translation>
    </message>
    <message>
        <source>No camera answers. Check its cable and its power, and close other programs that use it.</source>
        <translation>Keine Kamera antwortet. Prüfen Sie Kabel und Stromversorgung, und schließen Sie andere Programme, die sie benutzen.</translation>
    </message>
    <message>
        <source>These are found here: webcams and other video devices, industrial cameras by GigE Vision or USB3 Vision, and still cameras on USB.</source>
        <translation>Hier werden gefunden: Webcams und andere Videogeräte, Industriekameras über GigE Vision oder USB3 Vision und Fotoapparate am USB.</translation>
    </message>
    <message>
        <source>Any other is driven by a program of yours: go Back and choose “New venue by script”. The guide (F1) tells how cameras are set up.</source>
        <translation>Jede andere wird von einem eigenen Programm gesteuert: gehen Sie „Zurück“ und wählen Sie „Neuer Spielort per Skript“. Die Anleitung (F1) sagt, wie Kameras eingerichtet werden.</translation>
    </message>
    <message>
        <source>Any other is driven by a program of yours. The guide (F1) tells how cameras are set up.</source>
        <translation>Jede andere wird von einem eigenen Programm gesteuert. Die Anleitung (F1) sagt, wie Kameras eingerichtet werden.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ClusterPage</name>
    <message>
        <source>What is measured is safe.</source>
        <translation>Das Gemessene ist sicher.</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>Veraltet</translation>
    </message>
    <message>
        <source>Grouping again</source>
        <translation>Neue Gruppierung</translation>
    </message>
    <message>
        <source>Grouping</source>
        <translation>Gruppierung</translation>
    </message>
    <message>
        <source>Reading the light transport</source>
        <translation>Lesen des Lichttransports</translation>
    </message>
    <message>
        <source>Preview content</source>
        <translation>Vorschau zeigen</translation>
    </message>
    <message>
        <source>The clusters that are kept belong to an earlier threshold</source>
        <translation>Die gespeicherten Cluster gehören zu einer früheren Schwelle</translation>
    </message>
    <message>
        <source>What you see here has been grouped again. Going on keeps it.</source>
        <translation>Was Sie hier sehen, ist neu gruppiert. Beim Weitergehen wird es gespeichert.</translation>
    </message>
    <message>
        <source>Cluster</source>
        <translation>Cluster</translation>
    </message>
    <message>
        <source>Cluster map</source>
        <translation>Clusterkarte</translation>
    </message>
    <message>
        <source>click a pixel</source>
        <translation>Pixel anklicken</translation>
    </message>
    <message>
        <source>Error map</source>
        <translation>Fehlerkarte</translation>
    </message>
    <message>
        <source>Flat</source>
        <translation>Flach</translation>
    </message>
    <message>
        <source>Relief</source>
        <translation>Relief</translation>
    </message>
    <message>
        <source>Cluster sizes</source>
        <translation>Clustergrößen</translation>
    </message>
    <message>
        <source>Projector pixels in the cluster</source>
        <translation>Projektorpixel im Cluster</translation>
    </message>
    <message>
        <source>Clusters</source>
        <translation>Cluster</translation>
    </message>
    <message>
        <source>%1, %2: in no cluster</source>
        <translation>%1, %2: in keinem Cluster</translation>
    </message>
    <message>
        <source>Error map, median %1</source>
        <translation>Fehlerkarte, Median %1</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>Abstand</translation>
    </message>
    <message>
        <source>small, sharp</source>
        <translation>klein, scharf</translation>
    </message>
    <message>
        <source>large, fast</source>
        <translation>groß, schnell</translation>
    </message>
    <message>
        <source>Share of the brightest</source>
        <translation>Anteil am Hellsten</translation>
    </message>
    <message>
        <source>more detail</source>
        <translation>mehr Details</translation>
    </message>
    <message>
        <source>more speed</source>
        <translation>mehr Tempo</translation>
    </message>
    <message>
        <source>Largest cluster</source>
        <translation>Größter Cluster</translation>
    </message>
    <message>
        <source>fast</source>
        <translation>schnell</translation>
    </message>
    <message>
        <source>exact</source>
        <translation>genau</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>Ergebnis</translation>
    </message>
    <message>
        <source>Light kept in clusters</source>
        <translation>Licht in Clustern</translation>
    </message>
    <message>
        <source>Median error</source>
        <translation>Fehler (Median)</translation>
    </message>
    <message>
        <source>%1 px</source>
        <translation>%1 px</translation>
    </message>
    <message>
        <source>%1 of light</source>
        <translation>%1 des Lichts</translation>
    </message>
    <message numerus="yes">
        <source>%n cluster(s)</source>
        <translation>
            <numerusform>%n Cluster</numerusform>
            <numerusform>%n Cluster</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n cluster(s), median %1 px</source>
        <translation>
            <numerusform>%n Cluster, Median %1 px</numerusform>
            <numerusform>%n Cluster, Median %1 px</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1, %2: %n projector pixel(s), error %3</source>
        <translation>
            <numerusform>%1, %2: %n Projektorpixel, Fehler %3</numerusform>
            <numerusform>%1, %2: %n Projektorpixel, Fehler %3</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Cluster map, %n cluster(s), largest %1</source>
        <translation>
            <numerusform>Clusterkarte, %n Cluster, größter %1</numerusform>
            <numerusform>Clusterkarte, %n Cluster, größter %1</numerusform>
        </translation>
    </message>
    <message>
        <source>95 % of pixels below</source>
        <translation>95 % der Pixel unter</translation>
    </message>
    <message numerus="yes">
        <source>%1, %2: %n projector pixel(s)</source>
        <translation>
            <numerusform>%1, %2: %n Projektorpixel</numerusform>
            <numerusform>%1, %2: %n Projektorpixel</numerusform>
        </translation>
    </message>
    <message>
        <source>error</source>
        <translation>Fehler</translation>
    </message>
    <message>
        <source>limit %1</source>
        <translation>Grenze %1</translation>
    </message>
    <message>
        <source>over %1</source>
        <translation>über %1</translation>
    </message>
    <message>
        <source>about %1</source>
        <translation>etwa %1</translation>
    </message>
    <message>
        <source>Cut off by the size limit</source>
        <translation>Von der Größengrenze abgeschnitten</translation>
    </message>
    <message>
        <source>Films, frames a second</source>
        <translation>Filme, Bilder je Sekunde</translation>
    </message>
    <message>
        <source>What this computer manages in Full HD with the light that Threshold keeps. The groups make no difference to it: films are solved in overlapping windows.</source>
        <translation>Was dieser Computer in Full HD mit dem Licht schafft, das die Schwelle behält. Die Gruppen ändern daran nichts: Filme werden in überlappenden Fenstern gelöst.</translation>
    </message>
    <message>
        <source>Without a size limit, one cluster would cover %1 of the picture.</source>
        <translation>Ohne Größengrenze würde ein Cluster %1 des Bildes einnehmen.</translation>
    </message>
    <message>
        <source>The surface is blurred across neighbouring pixels, so groups join up. The limit keeps them apart.</source>
        <translation>Die Fläche ist über Nachbarpixel hinweg unscharf, sodass Gruppen zusammenwachsen. Die Grenze hält sie getrennt.</translation>
    </message>
    <message>
        <source>The clusters that are kept belong to an earlier measurement</source>
        <translation>Die gespeicherten Cluster gehören zu einer früheren Messung</translation>
    </message>
    <message>
        <source>Films are shown by “All bounces, for films”, whatever the clusters are. Clusters tell which places light each other, and can be compared at Preview.</source>
        <translation>Filme zeigt „Alle Reflexe, für Filme“, gleich wie die Cluster sind. Cluster sagen, welche Stellen einander beleuchten, und lassen sich bei Vorschau vergleichen.</translation>
    </message>
    <message>
        <source>See which parts of the surface light each other, and split them into groups that can be solved on their own.</source>
        <translation>Sehen, welche Teile der Oberfläche einander beleuchten, und sie in Gruppen teilen, die für sich lösbar sind.</translation>
    </message>
    <message>
        <source>Grouped anew</source>
        <translation>Neu gruppiert</translation>
    </message>
    <message>
        <source>Changed: it is applied as soon as you go on.</source>
        <translation>Geändert: Es gilt, sobald Sie weitergehen.</translation>
    </message>
    <message>
        <source>What was measured is too coarse to group. Go on measuring.</source>
        <translation>Was gemessen wurde, ist zu grob, um Cluster zu bilden. Messen Sie weiter.</translation>
    </message>
    <message>
        <source>No light is strong enough to group.</source>
        <translation>Kein Licht ist stark genug, um Cluster zu bilden.</translation>
    </message>
    <message>
        <source>Reliefs need OpenGL, which is not there.</source>
        <translation>Reliefs brauchen OpenGL, das fehlt.</translation>
    </message>
    <message>
        <source>An error of %1 is normal here.</source>
        <translation>Ein Fehler von %1 ist hier normal.</translation>
    </message>
    <message>
        <source>Grouping drops the blur of the lens on purpose: little where it is sharp, 70 to 80 % where it is blurred. Look for patches that stand out from their surroundings.</source>
        <translation>Die Gruppierung lässt die Unschärfe des Objektivs absichtlich weg: wenig, wo es scharf ist, 70 bis 80 %, wo es unscharf ist. Achten Sie auf Stellen, die sich von ihrer Umgebung abheben.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::CornerView</name>
    <message>
        <source>Top left corner, %1, %2.</source>
        <translation>Ecke oben links, %1, %2.</translation>
    </message>
    <message>
        <source>Top right corner, %1, %2.</source>
        <translation>Ecke oben rechts, %1, %2.</translation>
    </message>
    <message>
        <source>Bottom right corner, %1, %2.</source>
        <translation>Ecke unten rechts, %1, %2.</translation>
    </message>
    <message>
        <source>Bottom left corner, %1, %2.</source>
        <translation>Ecke unten links, %1, %2.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::DevicePage</name>
    <message>
        <source>A show is playing</source>
        <translation>Eine Show läuft</translation>
    </message>
    <message>
        <source>What is begun here shines in its place. The show is seen again once it has ended.</source>
        <translation>Was hier begonnen wird, leuchtet an ihrer Stelle. Danach ist die Show wieder zu sehen.</translation>
    </message>
    <message>
        <source>Another program plays a show of this venue</source>
        <translation>Ein anderes Programm spielt eine Show dieses Spielorts</translation>
    </message>
    <message>
        <source>The show plays on.</source>
        <translation>Die Show läuft weiter.</translation>
    </message>
    <message>
        <source>End that show</source>
        <translation>Diese Show beenden</translation>
    </message>
    <message>
        <source>End the show</source>
        <translation>Show beenden</translation>
    </message>
    <message>
        <source>Let it play</source>
        <translation>Weiterspielen lassen</translation>
    </message>
    <message>
        <source>The show that another program plays of this venue: the projector&apos;s screen goes dark.</source>
        <translation>Die Show dieses Spielorts, die ein anderes Programm spielt: Der Bildschirm des Projektors wird dunkel.</translation>
    </message>
    <message>
        <source>Venue and playlist stay. An installed show starts again at the next log-in.</source>
        <translation>Spielort und Playlist bleiben. Eine installierte Show startet bei der nächsten Anmeldung wieder.</translation>
    </message>
    <message>
        <source>Its pictures shine on the projector whatever is shown from here, and may come between patterns that are measured.</source>
        <translation>Ihre Bilder leuchten auf dem Projektor, was auch immer von hier gezeigt wird, und können zwischen gemessene Muster geraten.</translation>
    </message>
    <message>
        <source>It is ending</source>
        <translation>Sie endet gerade</translation>
    </message>
    <message>
        <source>The show that another program plays of another venue: the projector&apos;s screen goes dark.</source>
        <translation>Die Show, die ein anderes Programm von einem anderen Spielort spielt: Der Bildschirm des Projektors wird dunkel.</translation>
    </message>
    <message>
        <source>Another program plays a show of another venue on this projector</source>
        <translation>Ein anderes Programm spielt auf diesem Projektor eine Show eines anderen Spielorts</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged. Plug it in again: the show comes back by itself.</source>
        <translation>Der Bildschirm des Projektors ist getrennt. Schließen Sie ihn wieder an: Die Show kommt von selbst zurück.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::DeviceSelector</name>
    <message>
        <source>Projector that is shown</source>
        <translation>Gezeigter Projektor</translation>
    </message>
    <message>
        <source>Camera that is shown</source>
        <translation>Gezeigte Kamera</translation>
    </message>
</context>
<context>
    <name>relucent::gui::EndingDialog</name>
    <message>
        <source>Ending</source>
        <translation>Wird beendet</translation>
    </message>
    <message>
        <source>Ending…</source>
        <translation>Wird beendet …</translation>
    </message>
    <message>
        <source>Everything that was measured is safe. The devices finish what they are doing, which can take half a minute; then this window closes by itself.</source>
        <translation>Alles Gemessene ist sicher. Die Geräte beenden, was sie gerade tun; das kann eine halbe Minute dauern. Dann schließt sich dieses Fenster von selbst.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::FailureDialog</name>
    <message>
        <source>The disk did not do what was asked</source>
        <translation>Der Zugriff auf das Laufwerk ist gescheitert</translation>
    </message>
    <message>
        <source>The memory is full</source>
        <translation>Der Arbeitsspeicher ist voll</translation>
    </message>
    <message>
        <source>A file cannot be read</source>
        <translation>Eine Datei ist nicht lesbar</translation>
    </message>
    <message>
        <source>This cannot be done as it is</source>
        <translation>So ist das nicht möglich</translation>
    </message>
    <message>
        <source>The computation failed</source>
        <translation>Die Berechnung ist gescheitert</translation>
    </message>
    <message>
        <source>What happened</source>
        <translation>Was geschehen ist</translation>
    </message>
    <message>
        <source>What is safe</source>
        <translation>Was sicher ist</translation>
    </message>
    <message>
        <source>What to do</source>
        <translation>Was zu tun ist</translation>
    </message>
    <message>
        <source>Copy details</source>
        <translation>Details kopieren</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>What it ends</source>
        <translation>Was endet</translation>
    </message>
    <message>
        <source>What happens</source>
        <translation>Was geschieht</translation>
    </message>
    <message>
        <source>A device did not do what was asked</source>
        <translation>Ein Gerät hat nicht getan, was verlangt war</translation>
    </message>
</context>
<context>
    <name>relucent::gui::FlashConsent</name>
    <message>
        <source>The projector shows patterns that change as quickly as the devices can, perhaps more than 3 times a second.</source>
        <translation>Der Projektor zeigt Muster, die so schnell wechseln, wie die Geräte es können, vielleicht öfter als 3‑mal je Sekunde.</translation>
    </message>
    <message>
        <source>The room is clear</source>
        <translation>Der Raum ist geräumt</translation>
    </message>
    <message>
        <source>Flashing light</source>
        <translation>Lichtblitze</translation>
    </message>
    <message>
        <source>The room is clear and everyone here knows</source>
        <translation>Der Raum ist geräumt und alle hier wissen Bescheid</translation>
    </message>
    <message>
        <source>Flashing light can cause seizures. Clear the room and cover the entrance.</source>
        <translation>Lichtblitze können Anfälle auslösen. Räumen Sie den Raum und verdecken Sie den Eingang.</translation>
    </message>
    <message numerus="yes">
        <source>The projector shows patterns that change about %n time(s) a second, and at times more often.</source>
        <translation>
            <numerusform>Der Projektor zeigt Muster, die etwa einmal je Sekunde wechseln, zeitweise öfter.</numerusform>
            <numerusform>Der Projektor zeigt Muster, die etwa %n-mal je Sekunde wechseln, zeitweise öfter.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::gui::HelpWindow</name>
    <message>
        <source>Help</source>
        <translation>Hilfe</translation>
    </message>
    <message>
        <source>Search the guide</source>
        <translation>Im Handbuch suchen</translation>
    </message>
    <message>
        <source>Pages of the guide</source>
        <translation>Seiten des Handbuchs</translation>
    </message>
    <message>
        <source>The page</source>
        <translation>Die Seite</translation>
    </message>
    <message>
        <source>No page holds these words.</source>
        <translation>Keine Seite enthält diese Wörter.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::IdentifyOverlay</name>
    <message>
        <source>%1, %2 × %3, %4 Hz</source>
        <translation>%1, %2 × %3, %4 Hz</translation>
    </message>
    <message>
        <source>Lines sharp? Then this is the projector&apos;s own resolution.</source>
        <translation>Linien scharf? Dann ist dies die native Auflösung des Projektors.</translation>
    </message>
    <message>
        <source>Screen %1</source>
        <translation>Bildschirm %1</translation>
    </message>
</context>
<context>
    <name>relucent::gui::LinearizePage</name>
    <message>
        <source>The photographs of this step are still in the folder.</source>
        <translation>Die Fotos dieses Schritts liegen noch im Ordner.</translation>
    </message>
    <message>
        <source>Measuring, %1</source>
        <translation>Messung, %1</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Gemessen</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>Veraltet</translation>
    </message>
    <message>
        <source>Stopped by a failure</source>
        <translation>Durch Fehler gestoppt</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>Die Seite „%1“ nutzt die Geräte.</translation>
    </message>
    <message>
        <source>The colours do not add up. Continuing is recorded in the report.</source>
        <translation>Die Farben addieren sich nicht. Fortfahren wird im Bericht vermerkt.</translation>
    </message>
    <message>
        <source>Measured in %1</source>
        <translation>Gemessen in %1</translation>
    </message>
    <message>
        <source>Plan acquisition</source>
        <translation>Erfassung planen</translation>
    </message>
    <message>
        <source>Continue anyway</source>
        <translation>Trotzdem weiter</translation>
    </message>
    <message>
        <source>Measure response</source>
        <translation>Kennlinie messen</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Stopp</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>Neu messen</translation>
    </message>
    <message>
        <source>These curves belong to earlier settings</source>
        <translation>Diese Kurven gehören zu früheren Einstellungen</translation>
    </message>
    <message>
        <source>They still work and stay until the new ones are measured.</source>
        <translation>Sie gelten weiter, bis die neuen gemessen sind.</translation>
    </message>
    <message>
        <source>Levels</source>
        <translation>Stufen</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>Nichts wurde geändert.</translation>
    </message>
    <message>
        <source>Try again</source>
        <translation>Erneut versuchen</translation>
    </message>
    <message>
        <source>Every photograph that was taken is on the disk. Trying again goes on from there.</source>
        <translation>Jedes aufgenommene Foto ist auf dem Laufwerk. Ein neuer Versuch macht dort weiter.</translation>
    </message>
    <message>
        <source>Linearize</source>
        <translation>Linearisieren</translation>
    </message>
    <message>
        <source>Measure how much light each step of the projector&apos;s three colours really gives.</source>
        <translation>Messen Sie, wie viel Licht jede Stufe der drei Projektorfarben wirklich gibt.</translation>
    </message>
    <message>
        <source>Red</source>
        <translation>Rot</translation>
    </message>
    <message>
        <source>Green</source>
        <translation>Grün</translation>
    </message>
    <message>
        <source>Blue</source>
        <translation>Blau</translation>
    </message>
    <message>
        <source>Sent to the projector</source>
        <translation>An den Projektor gesendet</translation>
    </message>
    <message>
        <source>Seen by the camera</source>
        <translation>Von der Kamera gesehen</translation>
    </message>
    <message>
        <source>Pattern that the projector shows</source>
        <translation>Muster, das der Projektor zeigt</translation>
    </message>
    <message>
        <source>Last photograph</source>
        <translation>Letztes Foto</translation>
    </message>
    <message>
        <source>Appears when measuring begins.</source>
        <translation>Erscheint, sobald die Messung beginnt.</translation>
    </message>
    <message>
        <source>%1, photograph %2</source>
        <translation>%1, Foto %2</translation>
    </message>
    <message>
        <source>Response of the projector</source>
        <translation>Kennlinie des Projektors</translation>
    </message>
    <message>
        <source>Level sent to the projector</source>
        <translation>An den Projektor gesendete Stufe</translation>
    </message>
    <message>
        <source>Light, % of full</source>
        <translation>Licht, % des Maximums</translation>
    </message>
    <message>
        <source>Light of every level, three colours</source>
        <translation>Licht jeder Stufe, drei Farben</translation>
    </message>
    <message>
        <source>as it is measured</source>
        <translation>während der Messung</translation>
    </message>
    <message numerus="yes">
        <source>%n level(s) a colour, drift removed</source>
        <translation>
            <numerusform>%n Stufe je Farbe, ohne Drift</numerusform>
            <numerusform>%n Stufen je Farbe, ohne Drift</numerusform>
        </translation>
    </message>
    <message>
        <source>not measured yet</source>
        <translation>noch nicht gemessen</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>Ergebnis</translation>
    </message>
    <message>
        <source>Exposures</source>
        <translation>Belichtungen</translation>
    </message>
    <message>
        <source>Chosen for this venue</source>
        <translation>Gewählt</translation>
    </message>
    <message>
        <source>Measure with</source>
        <translation>Messen mit</translation>
    </message>
    <message>
        <source>Levels a colour</source>
        <translation>Stufen je Farbe</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>Messung</translation>
    </message>
    <message>
        <source>Not measured yet</source>
        <translation>Noch nicht gemessen</translation>
    </message>
    <message>
        <source>Whether the colours add up, the camera is linear and every level is brighter than the one below is told when all levels are measured.</source>
        <translation>Ob sich die Farben addieren, die Kamera linear ist und jede Stufe heller ist als die darunter, zeigt sich, wenn alle Stufen gemessen sind.</translation>
    </message>
    <message>
        <source>The colours add up</source>
        <translation>Die Farben addieren sich</translation>
    </message>
    <message>
        <source>Red, green and blue together give white within %1.</source>
        <translation>Rot, Grün und Blau zusammen ergeben Weiß auf %1 genau.</translation>
    </message>
    <message>
        <source>The colours do not add up</source>
        <translation>Die Farben addieren sich nicht</translation>
    </message>
    <message>
        <source>White differs by %1 from its colours. Turn off “brilliant” or “dynamic” in the projector&apos;s menu, then measure again.</source>
        <translation>Weiß weicht um %1 von seinen Farben ab. Schalten Sie „Brillant“ oder „Dynamisch“ im Menü des Projektors aus, dann messen Sie neu.</translation>
    </message>
    <message>
        <source>The camera is linear</source>
        <translation>Die Kamera ist linear</translation>
    </message>
    <message>
        <source>The camera&apos;s curve is known</source>
        <translation>Die Kurve der Kamera ist bekannt</translation>
    </message>
    <message>
        <source>Doubling the exposure doubles the signal.</source>
        <translation>Doppelte Belichtung verdoppelt das Signal.</translation>
    </message>
    <message>
        <source>Its photographs are brought back to linear light.</source>
        <translation>Ihre Fotos werden in lineares Licht umgerechnet.</translation>
    </message>
    <message>
        <source>Curves rise everywhere</source>
        <translation>Kurven steigen überall</translation>
    </message>
    <message>
        <source>No level is darker than the one below it.</source>
        <translation>Keine Stufe ist dunkler als die darunter.</translation>
    </message>
    <message>
        <source>Found while measuring</source>
        <translation>Beim Messen bemerkt</translation>
    </message>
    <message numerus="yes">
        <source>About %n test pattern(s)</source>
        <translation>
            <numerusform>Etwa %n Testmuster</numerusform>
            <numerusform>Etwa %n Testmuster</numerusform>
        </translation>
    </message>
    <message>
        <source>Go on now</source>
        <translation>Jetzt weiter</translation>
    </message>
    <message>
        <source>Measuring with these settings. Stop to change them.</source>
        <translation>Mit diesen Einstellungen wird gemessen. Stoppen Sie, um sie zu ändern.</translation>
    </message>
    <message>
        <source>Keep the earlier one</source>
        <translation>Frühere behalten</translation>
    </message>
    <message>
        <source>The earlier curves are used again, with all that followed from them.</source>
        <translation>Die früheren Kurven werden wieder verwendet, mit allem, was daraus folgte.</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>Das Gemessene ist sicher.</translation>
    </message>
    <message>
        <source>Black level</source>
        <translation>Schwarzwert</translation>
    </message>
    <message>
        <source>Contrast</source>
        <translation>Kontrast</translation>
    </message>
    <message>
        <source>%1 of full light</source>
        <translation>%1 des vollen Lichts</translation>
    </message>
    <message>
        <source>Colours within %1</source>
        <translation>Farben auf %1 genau</translation>
    </message>
    <message>
        <source>How far each level&apos;s light is from the fitted curve</source>
        <translation>Wie weit das Licht jeder Stufe von der Kurve liegt</translation>
    </message>
    <message>
        <source>within ±%1</source>
        <translation>innerhalb ±%1</translation>
    </message>
    <message>
        <source>One test pattern shows many levels side by side, so few patterns are enough.</source>
        <translation>Ein Testmuster zeigt viele Stufen nebeneinander, darum genügen wenige Muster.</translation>
    </message>
    <message>
        <source>Off the curve</source>
        <translation>Abstand zur Kurve</translation>
    </message>
    <message>
        <source>Residuals: what was photographed, less the curve that was fitted to it.</source>
        <translation>Residuen: was fotografiert wurde, minus die daran angepasste Kurve.</translation>
    </message>
    <message>
        <source>Off the curve, % of full</source>
        <translation>Abstand zur Kurve, % von voll</translation>
    </message>
    <message>
        <source>Stopping after the photograph under way.</source>
        <translation>Stoppt nach dem laufenden Foto.</translation>
    </message>
    <message>
        <source>To measure again, confirm that the room is clear.</source>
        <translation>Um neu zu messen, bestätigen Sie, dass der Raum geräumt ist.</translation>
    </message>
    <message>
        <source>Colours off by %1</source>
        <translation>Farben um %1 daneben</translation>
    </message>
    <message>
        <source>The photographs contradict each other. See that nothing covers the lens, then measure again.</source>
        <translation>Die Fotos widersprechen einander. Dafür sorgen, dass nichts das Objektiv verdeckt, dann noch einmal messen.</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the patterns flash.</source>
        <translation>Bestätigen Sie, dass der Raum geräumt ist: Die Muster blitzen.</translation>
    </message>
    <message>
        <source>The photographs contradict each other</source>
        <translation>Die Fotos widersprechen einander</translation>
    </message>
    <message>
        <source>White differs by %1 from its colours, and levels by up to %2 from their curve: no picture mode does that. Something covered the lens or the picture, or the light changed. Nothing else is told from these photographs; measure again.</source>
        <translation>Weiß weicht um %1 von seinen Farben ab, und Stufen um bis zu %2 von ihrer Kurve: Das bewirkt kein Bildmodus. Etwas verdeckte das Objektiv oder das Bild, oder das Licht änderte sich. Sonst lässt sich aus diesen Fotos nichts ablesen; noch einmal messen.</translation>
    </message>
    <message>
        <source>The camera sees hardly any light of the projector</source>
        <translation>Die Kamera sieht kaum Licht vom Projektor</translation>
    </message>
    <message>
        <source>See that nothing covers the lens or the picture. What is photographed meanwhile is lost: stop, and measure again.</source>
        <translation>Dafür sorgen, dass nichts das Objektiv oder das Bild verdeckt. Was inzwischen fotografiert wird, ist verloren: anhalten und noch einmal messen.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MainWindow</name>
    <message>
        <source>Dim pictures</source>
        <translation>Bilder dimmen</translation>
    </message>
    <message>
        <source>Pictures dimmed</source>
        <translation>Bilder gedimmt</translation>
    </message>
    <message>
        <source>Settings</source>
        <translation>Optionen</translation>
    </message>
    <message>
        <source>Help</source>
        <translation>Hilfe</translation>
    </message>
    <message>
        <source>F1</source>
        <translation>F1</translation>
    </message>
    <message>
        <source>Less light from this screen falls into the room (F9)</source>
        <translation>Vom Licht dieses Bildschirms fällt weniger in den Raum (F9)</translation>
    </message>
    <message>
        <source>Undone: %1</source>
        <translation>Rückgängig: %1</translation>
    </message>
    <message>
        <source>Nothing to undo here</source>
        <translation>Hier gibt es nichts rückgängig zu machen</translation>
    </message>
    <message>
        <source>Done again: %1</source>
        <translation>Wiederhergestellt: %1</translation>
    </message>
    <message>
        <source>Nothing to do again</source>
        <translation>Nichts wiederherzustellen</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MaskEditing</name>
    <message>
        <source>This is no mask: %1.</source>
        <translation>Das ist keine Maske: %1.</translation>
    </message>
    <message>
        <source>New mask</source>
        <translation>Neue Maske</translation>
    </message>
    <message>
        <source>Outline of a mask</source>
        <translation>Umriss einer Maske</translation>
    </message>
    <message>
        <source>Feather of a mask</source>
        <translation>Weicher Rand einer Maske</translation>
    </message>
    <message>
        <source>Removed mask</source>
        <translation>Entfernte Maske</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MaskView</name>
    <message numerus="yes">
        <source>Drawing a mask: %n point(s). Space sets one at %1, %2. Return closes it, Escape leaves it.</source>
        <translation>
            <numerusform>Eine Maske wird gezeichnet: %n Punkt. Die Leertaste setzt einen bei %1, %2. Die Eingabetaste schließt sie, Escape bricht ab.</numerusform>
            <numerusform>Eine Maske wird gezeichnet: %n Punkte. Die Leertaste setzt einen bei %1, %2. Die Eingabetaste schließt sie, Escape bricht ab.</numerusform>
        </translation>
    </message>
    <message>
        <source>Point %1 of %2, %3, %4.</source>
        <translation>Punkt %1 von %2, %3, %4.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MatrixView</name>
    <message>
        <source>camera %1
projector %2</source>
        <translation>Kamera %1
Projektor %2</translation>
    </message>
    <message>
        <source>%1
%2</source>
        <translation>%1
%2</translation>
    </message>
    <message>
        <source>transport</source>
        <translation>Transport</translation>
    </message>
    <message>
        <source>projector x, y</source>
        <translation>Projektor x, y</translation>
    </message>
    <message>
        <source>projector line</source>
        <translation>Projektorzeile</translation>
    </message>
    <message>
        <source>camera x, y</source>
        <translation>Kamera x, y</translation>
    </message>
    <message>
        <source>camera line</source>
        <translation>Kamerazeile</translation>
    </message>
    <message>
        <source>%1 across, %2 down</source>
        <translation>%1 →, %2 ↓</translation>
    </message>
</context>
<context>
    <name>relucent::gui::NameDialog</name>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Type a name.</source>
        <translation>Geben Sie einen Namen ein.</translation>
    </message>
    <message>
        <source>It has this name.</source>
        <translation>So heißt es schon.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Nights</name>
    <message>
        <source>The venue was as it was measured.</source>
        <translation>Der Spielort war noch so, wie er gemessen wurde.</translation>
    </message>
    <message>
        <source>Repaired.</source>
        <translation>Repariert.</translation>
    </message>
    <message>
        <source>Something has changed, and no better picture came of a repair.</source>
        <translation>Etwas hat sich verändert, und eine Reparatur ergab kein besseres Bild.</translation>
    </message>
    <message>
        <source>%1 dB</source>
        <translation>%1 dB</translation>
    </message>
    <message>
        <source>Photographed</source>
        <translation>Fotografiert</translation>
    </message>
    <message>
        <source>Predicted</source>
        <translation>Vorhergesagt</translation>
    </message>
    <message>
        <source>Repaired</source>
        <translation>Repariert</translation>
    </message>
    <message>
        <source>Alarm</source>
        <translation>Alarm</translation>
    </message>
    <message>
        <source>Days before the last night</source>
        <translation>Tage vor der letzten Nacht</translation>
    </message>
    <message>
        <source>Colour error ΔE</source>
        <translation>Farbfehler ΔE</translation>
    </message>
    <message numerus="yes">
        <source>%n night(s).</source>
        <translation>
            <numerusform>%n Nacht.</numerusform>
            <numerusform>%n Nächte.</numerusform>
        </translation>
    </message>
    <message>
        <source>Photographed: %1 to %2, last %3.</source>
        <translation>Fotografiert: %1 bis %2, zuletzt %3.</translation>
    </message>
    <message>
        <source>Repairs: %1. Alarms: %2.</source>
        <translation>Reparaturen: %1. Alarme: %2.</translation>
    </message>
    <message>
        <source>Left out: %1</source>
        <translation>Ausgelassen: %1</translation>
    </message>
    <message>
        <source>Alarm: %1</source>
        <translation>Alarm: %1</translation>
    </message>
    <message numerus="yes">
        <source>%n picture(s) perfected.</source>
        <translation>
            <numerusform>%n Bild perfektioniert.</numerusform>
            <numerusform>%n Bilder perfektioniert.</numerusform>
        </translation>
    </message>
    <message>
        <source>Photographed: %1, predicted: %2.</source>
        <translation>Fotografiert: %1, vorhergesagt: %2.</translation>
    </message>
    <message>
        <source>Nobody was told: %1</source>
        <translation>Niemand wurde verständigt: %1</translation>
    </message>
    <message>
        <source>Quality, dB</source>
        <translation>Qualität, dB</translation>
    </message>
</context>
<context>
    <name>relucent::gui::NightsDialog</name>
    <message>
        <source>Quality over weeks</source>
        <translation>Qualität über Wochen</translation>
    </message>
    <message>
        <source>Colour error</source>
        <translation>Farbfehler</translation>
    </message>
    <message>
        <source>What the photograph of each night&apos;s proof came to, beside what was predicted.</source>
        <translation>Was das Prüffoto jeder Nacht ergab, neben dem, was vorhergesagt war.</translation>
    </message>
    <message>
        <source>Quality of the picture, night by night</source>
        <translation>Qualität des Bildes, Nacht für Nacht</translation>
    </message>
    <message>
        <source>What came of each night, the last one first</source>
        <translation>Was jede Nacht ergab, die letzte zuerst</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>Quality</source>
        <translation>Qualität</translation>
    </message>
    <message>
        <source>Colour error: CIEDE2000, less is better. Quality: peak signal-to-noise ratio, PSNR, in dB; more is better.</source>
        <translation>Farbfehler: CIEDE2000, weniger ist besser. Qualität: Spitzen-Signal-Rausch-Verhältnis, PSNR, in dB; mehr ist besser.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::NightsPart</name>
    <message>
        <source>Every night</source>
        <translation>Jede Nacht</translation>
    </message>
    <message>
        <source>Quality over weeks</source>
        <translation>Qualität über Wochen</translation>
    </message>
    <message>
        <source>A chart of all nights, and what came of each.</source>
        <translation>Ein Diagramm aller Nächte und was jede ergab.</translation>
    </message>
    <message>
        <source>There was no night yet</source>
        <translation>Es gab noch keine Nacht</translation>
    </message>
    <message>
        <source>Somebody has to look, %1</source>
        <translation>Jemand muss nachsehen, %1</translation>
    </message>
    <message>
        <source>Left out, %1</source>
        <translation>Ausgelassen, %1</translation>
    </message>
    <message>
        <source>All is well, %1</source>
        <translation>Alles ist gut, %1</translation>
    </message>
    <message>
        <source>Look after the picture</source>
        <translation>Für das Bild sorgen</translation>
    </message>
    <message>
        <source>never</source>
        <translation>nie</translation>
    </message>
    <message>
        <source>at %1</source>
        <translation>um %1</translation>
    </message>
    <message>
        <source>A show can look after the picture by itself at night: it checks, repairs, perfects and proves, and tells here what came of it. Its camera has to stay where it is.</source>
        <translation>Eine Show kann nachts selbst für das Bild sorgen: Sie prüft, repariert, perfektioniert und weist nach, und sagt hier, was dabei herauskam. Ihre Kamera muss stehen bleiben, wo sie ist.</translation>
    </message>
    <message>
        <source>No show of a rehearsal is looked after.</source>
        <translation>Für die Show einer Probe wird nicht gesorgt.</translation>
    </message>
    <message>
        <source>The installed show has its first one at %1, if it plays by then. Its camera has to stay where it is.</source>
        <translation>Die installierte Show hat ihre erste um %1, wenn sie dann läuft. Ihre Kamera muss bleiben, wo sie ist.</translation>
    </message>
    <message>
        <source>A night is under way</source>
        <translation>Eine Nacht läuft gerade</translation>
    </message>
    <message>
        <source>The show makes way while its picture is looked after. What comes of it is told here.</source>
        <translation>Die Show macht Platz, während nach ihrem Bild gesehen wird. Was dabei herauskommt, steht dann hier.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::NudgeDialog</name>
    <message>
        <source>fits</source>
        <translation>stimmt</translation>
    </message>
    <message>
        <source>Turn the camera to the right and down.</source>
        <translation>Drehen Sie die Kamera nach rechts unten.</translation>
    </message>
    <message>
        <source>Turn the camera to the right and up.</source>
        <translation>Drehen Sie die Kamera nach rechts oben.</translation>
    </message>
    <message>
        <source>Turn the camera to the left and down.</source>
        <translation>Drehen Sie die Kamera nach links unten.</translation>
    </message>
    <message>
        <source>Turn the camera to the left and up.</source>
        <translation>Drehen Sie die Kamera nach links oben.</translation>
    </message>
    <message>
        <source>Turn the camera to the right.</source>
        <translation>Drehen Sie die Kamera nach rechts.</translation>
    </message>
    <message>
        <source>Turn the camera to the left.</source>
        <translation>Drehen Sie die Kamera nach links.</translation>
    </message>
    <message>
        <source>Turn the camera down.</source>
        <translation>Drehen Sie die Kamera nach unten.</translation>
    </message>
    <message>
        <source>Turn the camera up.</source>
        <translation>Drehen Sie die Kamera nach oben.</translation>
    </message>
    <message>
        <source>Tilt the camera clockwise.</source>
        <translation>Neigen Sie die Kamera im Uhrzeigersinn.</translation>
    </message>
    <message>
        <source>Tilt the camera anticlockwise.</source>
        <translation>Neigen Sie die Kamera gegen den Uhrzeigersinn.</translation>
    </message>
    <message>
        <source>What the camera saw, and what it sees now</source>
        <translation>Was die Kamera sah und was sie jetzt sieht</translation>
    </message>
    <message>
        <source>The projector shows full light. Left of the line stands what the camera saw when the venue was measured, right of it what it sees now.</source>
        <translation>Der Projektor zeigt volles Licht. Links der Linie steht, was die Kamera beim Vermessen sah, rechts, was sie jetzt sieht.</translation>
    </message>
    <message>
        <source>Sideways</source>
        <translation>Seitlich</translation>
    </message>
    <message>
        <source>Up and down</source>
        <translation>Auf und ab</translation>
    </message>
    <message>
        <source>Tilt</source>
        <translation>Neigung</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>Opening the devices</source>
        <translation>Öffnen der Geräte</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Gemessen</translation>
    </message>
    <message>
        <source>Now</source>
        <translation>Jetzt</translation>
    </message>
    <message>
        <source>%1 px to the right</source>
        <translation>%1 px nach rechts</translation>
    </message>
    <message>
        <source>%1 px to the left</source>
        <translation>%1 px nach links</translation>
    </message>
    <message>
        <source>%1 px down</source>
        <translation>%1 px nach unten</translation>
    </message>
    <message>
        <source>%1 px up</source>
        <translation>%1 px nach oben</translation>
    </message>
    <message>
        <source>%1°</source>
        <translation>%1°</translation>
    </message>
    <message>
        <source>Looking through the camera</source>
        <translation>Blick durch die Kamera</translation>
    </message>
    <message>
        <source>The camera looks where it looked.</source>
        <translation>Die Kamera blickt dorthin, wohin sie blickte.</translation>
    </message>
    <message>
        <source>Fasten it, look once more, and close this window.</source>
        <translation>Stellen Sie sie fest, sehen Sie noch einmal hin und schließen Sie dieses Fenster.</translation>
    </message>
    <message>
        <source>The arrow shows where. If the projector was bumped instead, move its picture the other way.</source>
        <translation>Der Pfeil zeigt, wohin. Wurde der Projektor angestoßen, bewegen Sie dessen Bild in die andere Richtung.</translation>
    </message>
    <message>
        <source>What is seen is not the view that was measured.</source>
        <translation>Zu sehen ist nicht die Ansicht, die vermessen wurde.</translation>
    </message>
    <message>
        <source>Turn the camera until both halves look alike. If they do, the light or the surface has changed.</source>
        <translation>Drehen Sie die Kamera, bis beide Hälften gleich aussehen. Tun sie das schon, hat sich das Licht oder die Fläche geändert.</translation>
    </message>
    <message>
        <source>Put the camera back</source>
        <translation>Kamera zurückstellen</translation>
    </message>
    <message>
        <source>In a rehearsal it comes back by itself while you look.</source>
        <translation>In einer Probe kommt sie von selbst zurück, während Sie zusehen.</translation>
    </message>
    <message>
        <source>%1° clockwise</source>
        <translation>%1° im Uhrzeigersinn</translation>
    </message>
    <message>
        <source>%1° anticlockwise</source>
        <translation>%1° gegen den Uhrzeigersinn</translation>
    </message>
    <message>
        <source>If the projector was bumped instead, move its picture the other way.</source>
        <translation>Wurde stattdessen der Projektor angestoßen, bewegen Sie sein Bild in die andere Richtung.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputPage</name>
    <message>
        <source>Projector&apos;s screen</source>
        <translation>Bildschirm des Projektors</translation>
    </message>
    <message>
        <source>This screen</source>
        <translation>Dieser Bildschirm</translation>
    </message>
    <message>
        <source>%1: measured ΔE %2, predicted %3</source>
        <translation>%1: gemessen ΔE %2, vorhergesagt %3</translation>
    </message>
    <message>
        <source>Not photographed yet</source>
        <translation>Noch nicht fotografiert</translation>
    </message>
    <message>
        <source>One photograph shows whether the surface looks as predicted.</source>
        <translation>Ein Foto zeigt, ob die Oberfläche wie vorhergesagt aussieht.</translation>
    </message>
    <message>
        <source>Corrected</source>
        <translation>Korrigiert</translation>
    </message>
    <message>
        <source>Original</source>
        <translation>Original</translation>
    </message>
    <message>
        <source>%1 of the picture can be reached.</source>
        <translation>%1 des Bilds sind erreichbar.</translation>
    </message>
    <message>
        <source>The surface looks as predicted</source>
        <translation>Die Oberfläche sieht aus wie vorhergesagt</translation>
    </message>
    <message>
        <source>The camera or projector may have moved.</source>
        <translation>Kamera oder Projektor haben sich vielleicht bewegt.</translation>
    </message>
    <message>
        <source>Error of the test patterns: %1, when measured %2. %3 of the view changed.</source>
        <translation>Fehler der Testmuster: %1, bei der Messung %2. %3 des Kamerabilds sind verändert.</translation>
    </message>
    <message>
        <source>The measurement still holds</source>
        <translation>Die Messung gilt noch</translation>
    </message>
    <message>
        <source>Verification</source>
        <translation>Prüfung</translation>
    </message>
    <message>
        <source>Take verification photograph</source>
        <translation>Prüffoto aufnehmen</translation>
    </message>
    <message>
        <source>Ctrl+Shift+V</source>
        <translation>Strg+Umschalt+V</translation>
    </message>
    <message>
        <source>Check for drift</source>
        <translation>Auf Drift prüfen</translation>
    </message>
    <message>
        <source>Photographs the test patterns of the measurement again, ten or so.</source>
        <translation>Fotografiert die Testmuster der Messung noch einmal, etwa zehn.</translation>
    </message>
    <message>
        <source>Hand over</source>
        <translation>Übergabe</translation>
    </message>
    <message>
        <source>Save report</source>
        <translation>Bericht speichern</translation>
    </message>
    <message>
        <source>Installed. The show starts at the next log-in, without camera or wizard.</source>
        <translation>Installiert. Die Show startet bei der nächsten Anmeldung, ohne Kamera und Assistent.</translation>
    </message>
    <message>
        <source>Playlist</source>
        <translation>Playlist</translation>
    </message>
    <message>
        <source>The picture stands in its middle, pixel for pixel.</source>
        <translation>Das Bild steht in der Mitte, Pixel für Pixel.</translation>
    </message>
    <message>
        <source>Still pictures: %1</source>
        <translation>Standbilder: %1</translation>
    </message>
    <message>
        <source>Films and cross-fades use windows and steps, which are quick enough.</source>
        <translation>Filme und Überblendungen nutzen „Fenster und Schritte“; das ist schnell genug.</translation>
    </message>
    <message>
        <source>Make the list again.</source>
        <translation>Erstellen Sie die Playlist neu.</translation>
    </message>
    <message>
        <source>Black</source>
        <translation>Schwarz</translation>
    </message>
    <message>
        <source>Frozen</source>
        <translation>Eingefroren</translation>
    </message>
    <message>
        <source>Playing</source>
        <translation>Läuft</translation>
    </message>
    <message>
        <source>Add a picture or a film to the playlist.</source>
        <translation>Fügen Sie der Playlist ein Bild oder einen Film hinzu.</translation>
    </message>
    <message>
        <source>Choose the projector&apos;s screen.</source>
        <translation>Wählen Sie den Bildschirm des Projektors.</translation>
    </message>
    <message>
        <source>Playing. Hold A to compare.</source>
        <translation>Läuft. Zum Vergleichen A halten.</translation>
    </message>
    <message>
        <source>Take a verification photograph, or install without proof.</source>
        <translation>Nehmen Sie ein Prüffoto auf oder installieren Sie ohne Prüfung.</translation>
    </message>
    <message>
        <source>Nothing is projected before you open the output.</source>
        <translation>Vor dem Öffnen der Ausgabe wird nichts projiziert.</translation>
    </message>
    <message>
        <source>Install show</source>
        <translation>Show installieren</translation>
    </message>
    <message>
        <source>Install without proof</source>
        <translation>Ungeprüft installieren</translation>
    </message>
    <message>
        <source>Open output</source>
        <translation>Ausgabe öffnen</translation>
    </message>
    <message>
        <source>Play</source>
        <translation>Abspielen</translation>
    </message>
    <message>
        <source>Freeze</source>
        <translation>Einfrieren</translation>
    </message>
    <message>
        <source>Show again</source>
        <translation>Wieder zeigen</translation>
    </message>
    <message>
        <source>Close output</source>
        <translation>Ausgabe schließen</translation>
    </message>
    <message>
        <source>Add to the playlist</source>
        <translation>Zur Playlist hinzufügen</translation>
    </message>
    <message>
        <source>Remove from the playlist</source>
        <translation>Aus der Playlist entfernen</translation>
    </message>
    <message>
        <source>Order of the playlist</source>
        <translation>Reihenfolge der Playlist</translation>
    </message>
    <message>
        <source>Repeat</source>
        <translation>Endlos</translation>
    </message>
    <message>
        <source>Cross-fade</source>
        <translation>Überblendung</translation>
    </message>
    <message>
        <source>The calibration is as it was.</source>
        <translation>Die Kalibrierung ist unverändert.</translation>
    </message>
    <message>
        <source>Output</source>
        <translation>Ausgabe</translation>
    </message>
    <message>
        <source>Play corrected content, prove that it works with one photograph, and hand the venue over.</source>
        <translation>Spielen Sie korrigierten Inhalt ab, prüfen Sie ihn mit einem Foto und übergeben Sie den Spielort.</translation>
    </message>
    <message>
        <source>Playback</source>
        <translation>Wiedergabe</translation>
    </message>
    <message>
        <source>frames a second</source>
        <translation>Bilder/s</translation>
    </message>
    <message>
        <source>frame time</source>
        <translation>Bildzeit</translation>
    </message>
    <message>
        <source>frames late</source>
        <translation>Bilder verspätet</translation>
    </message>
    <message>
        <source>Seconds</source>
        <translation>Sekunden</translation>
    </message>
    <message>
        <source>Frame time, ms</source>
        <translation>Bildzeit, ms</translation>
    </message>
    <message>
        <source>Frame times of the last minute</source>
        <translation>Bildzeiten der letzten Minute</translation>
    </message>
    <message>
        <source>%1 ms</source>
        <translation>%1 ms</translation>
    </message>
    <message>
        <source>closed</source>
        <translation>geschlossen</translation>
    </message>
    <message>
        <source>on %1</source>
        <translation>auf %1</translation>
    </message>
    <message>
        <source>still picture, on %1</source>
        <translation>Standbild, auf %1</translation>
    </message>
    <message>
        <source>On the projector now</source>
        <translation>Jetzt am Projektor</translation>
    </message>
    <message>
        <source>What the projector shows</source>
        <translation>Was der Projektor zeigt</translation>
    </message>
    <message>
        <source>Photograph of the surface</source>
        <translation>Foto der Oberfläche</translation>
    </message>
    <message>
        <source>What was wanted at the left of the divider, the photograph at the right</source>
        <translation>Links der Trennlinie das Soll, rechts das Foto</translation>
    </message>
    <message>
        <source>No verification photograph has been taken.</source>
        <translation>Es wurde noch kein Prüffoto aufgenommen.</translation>
    </message>
    <message>
        <source>Photograph against wanted</source>
        <translation>Foto gegen Soll</translation>
    </message>
    <message>
        <source>colour difference</source>
        <translation>Farbabstand</translation>
    </message>
    <message>
        <source>Colour difference between the photograph and what was wanted</source>
        <translation>Farbabstand zwischen Foto und Soll</translation>
    </message>
    <message>
        <source>A verification photograph shows here what is left to see.</source>
        <translation>Ein Prüffoto zeigt hier, welche Abweichung noch zu sehen ist.</translation>
    </message>
    <message>
        <source>taken %1</source>
        <translation>um %1</translation>
    </message>
    <message>
        <source>Wanted</source>
        <translation>Soll</translation>
    </message>
    <message>
        <source>Photograph</source>
        <translation>Foto</translation>
    </message>
    <message>
        <source>Delete removes an item, Ctrl+Up and Ctrl+Down move it. Files can be dropped here.</source>
        <translation>Entf entfernt einen Eintrag, Strg+Hoch und Strg+Runter verschieben ihn. Dateien lassen sich hier ablegen.</translation>
    </message>
    <message>
        <source>%1, playing</source>
        <translation>%1, läuft</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Einfügen</translation>
    </message>
    <message>
        <source>Add files to the playlist</source>
        <translation>Dateien zur Playlist hinzufügen</translation>
    </message>
    <message>
        <source>Move up</source>
        <translation>Nach oben</translation>
    </message>
    <message>
        <source>Move down</source>
        <translation>Nach unten</translation>
    </message>
    <message>
        <source>Cross-fade, tenths of a second</source>
        <translation>Überblendung, Zehntelsekunden</translation>
    </message>
    <message>
        <source>Add pictures or films</source>
        <translation>Bilder oder Filme hinzufügen</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>Skipped: %1</source>
        <translation>Übersprungen: %1</translation>
    </message>
    <message>
        <source>This screen&apos;s resolution is not that of the projector that was measured.</source>
        <translation>Dieser Bildschirm hat eine andere Auflösung als der gemessene Projektor.</translation>
    </message>
    <message>
        <source>Written to %1, and for paper to report.pdf beside it.</source>
        <translation>Geschrieben nach %1, für Papier nach report.pdf daneben.</translation>
    </message>
    <message>
        <source>The projector is another screen now</source>
        <translation>Der Projektor ist jetzt ein anderer Bildschirm</translation>
    </message>
    <message>
        <source>Show installed</source>
        <translation>Show installiert</translation>
    </message>
    <message>
        <source>Installed at %1: the show starts at the next log-in. Hold A to compare.</source>
        <translation>Um %1 installiert: Die Show beginnt bei der nächsten Anmeldung. Halten Sie A zum Vergleichen.</translation>
    </message>
    <message>
        <source>The output will cover this window. Esc closes the output.</source>
        <translation>Die Ausgabe wird dieses Fenster verdecken. Esc schließt die Ausgabe.</translation>
    </message>
    <message>
        <source>Install again</source>
        <translation>Neu installieren</translation>
    </message>
    <message>
        <source>The projector&apos;s screen %1 is not there. Plug it in, or choose another.</source>
        <translation>Der Bildschirm %1 des Projektors fehlt. Stecken Sie ihn an, oder wählen Sie einen anderen.</translation>
    </message>
    <message>
        <source>Choose a screen for projector %1.</source>
        <translation>Wählen Sie einen Bildschirm für Projektor %1.</translation>
    </message>
    <message numerus="yes">
        <source>Each of the %n projector(s) needs a screen of its own. Plug in another one.</source>
        <translation>
            <numerusform>Der Projektor braucht einen eigenen Bildschirm. Stecken Sie einen an.</numerusform>
            <numerusform>Jeder der %n Projektoren braucht einen eigenen Bildschirm. Stecken Sie einen weiteren an.</numerusform>
        </translation>
    </message>
    <message>
        <source>There is one screen only. Plug the projector in and extend the desktop to it, or choose this screen.</source>
        <translation>Es gibt nur einen Bildschirm. Stecken Sie den Projektor an und erweitern Sie den Desktop auf ihn, oder wählen Sie diesen Bildschirm.</translation>
    </message>
    <message>
        <source>still picture, %1 of the pixels at their limit</source>
        <translation>Standbild, %1 der Pixel am Anschlag</translation>
    </message>
    <message>
        <source>%1 fps, %2 ms, %3 of the pixels at their limit</source>
        <translation>%1 fps, %2 ms, %3 der Pixel am Anschlag</translation>
    </message>
    <message>
        <source>Screen unplugged</source>
        <translation>Bildschirm getrennt</translation>
    </message>
    <message>
        <source>The surface does not look as predicted. Find out whether something moved.</source>
        <translation>Die Fläche sieht nicht aus wie vorhergesagt. Prüfen Sie, ob sich etwas bewegt hat.</translation>
    </message>
    <message>
        <source>Something has changed since it was measured. Measure again, then install.</source>
        <translation>Seit der Messung hat sich etwas verändert. Messen Sie neu, installieren Sie dann.</translation>
    </message>
    <message>
        <source>Install anyway</source>
        <translation>Trotzdem installieren</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>Neu messen</translation>
    </message>
    <message>
        <source>Aim again</source>
        <translation>Neu ausrichten</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged</source>
        <translation>Der Bildschirm des Projektors ist getrennt</translation>
    </message>
    <message>
        <source>Nothing is lost. Plug it in again: the show comes back by itself.</source>
        <translation>Nichts ist verloren. Schließen Sie ihn wieder an: Die Show kommt von selbst zurück.</translation>
    </message>
    <message>
        <source>The camera&apos;s view has moved by %1 px sideways and %2 px up or down.</source>
        <translation>Die Ansicht der Kamera hat sich um %1 px seitlich und %2 px auf oder ab verschoben.</translation>
    </message>
    <message>
        <source>Shows full light, and where the camera has to be turned to look where it looked.</source>
        <translation>Zeigt volles Licht und wohin die Kamera zu drehen ist, damit sie blickt wie zuvor.</translation>
    </message>
    <message>
        <source>Limit for %1 frames a second: %2 ms</source>
        <translation>Grenze für %1 Bilder pro Sekunde: %2 ms</translation>
    </message>
    <message>
        <source>the processor</source>
        <translation>dem Prozessor</translation>
    </message>
    <message>
        <source>Next test chart (T)</source>
        <translation>Nächstes Testbild (T)</translation>
    </message>
    <message>
        <source>Figures over the picture (O)</source>
        <translation>Zahlen über dem Bild (O)</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>Die Seite „%1“ nutzt die Geräte.</translation>
    </message>
    <message>
        <source>Put the camera back</source>
        <translation>Kamera zurückstellen</translation>
    </message>
    <message>
        <source>On this page only</source>
        <translation>Nur auf dieser Seite</translation>
    </message>
    <message>
        <source>The photograph is out of date</source>
        <translation>Das Foto ist veraltet</translation>
    </message>
    <message>
        <source>Another venue&apos;s show starts at log-in. Installing this one replaces it.</source>
        <translation>Die Show eines anderen Spielorts startet bei der Anmeldung. Diese zu installieren ersetzt sie.</translation>
    </message>
    <message>
        <source>Another venue&apos;s show starts at log-in. This is a rehearsal, which is not installed.</source>
        <translation>Die Show eines anderen Spielorts startet bei der Anmeldung. Dies ist eine Probe, die nicht installiert wird.</translation>
    </message>
    <message>
        <source>Once installed, the show starts at every log-in, without camera or wizard.</source>
        <translation>Einmal installiert, startet die Show bei jeder Anmeldung, ohne Kamera und Assistent.</translation>
    </message>
    <message>
        <source>This is a rehearsal with simulated devices: its show is not installed. That of a real venue starts at every log-in.</source>
        <translation>Dies ist eine Probe mit simulierten Geräten: Ihre Show wird nicht installiert. Die eines echten Spielorts startet bei jeder Anmeldung.</translation>
    </message>
    <message>
        <source>Remove installed show</source>
        <translation>Installierte Show entfernen</translation>
    </message>
    <message>
        <source>It does not start at log-in any more. Venue and playlist stay.</source>
        <translation>Sie startet nicht mehr bei der Anmeldung. Spielort und Playlist bleiben.</translation>
    </message>
    <message>
        <source>Proof out of date</source>
        <translation>Prüffoto veraltet</translation>
    </message>
    <message>
        <source>Take a verification photograph: it proves that the venue is measured well.</source>
        <translation>Nehmen Sie ein Prüffoto auf: Es zeigt, ob der Spielort gut gemessen ist.</translation>
    </message>
    <message>
        <source>This rehearsal plays on this page only: nothing is projected.</source>
        <translation>Diese Probe spielt nur auf dieser Seite: Nichts wird projiziert.</translation>
    </message>
    <message>
        <source>Black: the show goes on unseen until you show it again.</source>
        <translation>Schwarz: Die Show läuft ungesehen weiter, bis Sie sie wieder zeigen.</translation>
    </message>
    <message>
        <source>Frozen: this picture stands until you press Play.</source>
        <translation>Eingefroren: Dieses Bild steht, bis Sie Abspielen drücken.</translation>
    </message>
    <message>
        <source>Rehearsed to the end. A simulated venue is not installed. Hold A to compare.</source>
        <translation>Zu Ende geprobt. Simuliertes wird nicht installiert. Zum Vergleichen A halten.</translation>
    </message>
    <message>
        <source>The verification photograph is out of date</source>
        <translation>Das Prüffoto ist veraltet</translation>
    </message>
    <message>
        <source>taken %1, out of date</source>
        <translation>um %1, veraltet</translation>
    </message>
    <message>
        <source>No screen chosen</source>
        <translation>Kein Bildschirm gewählt</translation>
    </message>
    <message>
        <source>%1, unplugged</source>
        <translation>%1, nicht angeschlossen</translation>
    </message>
    <message>
        <source>Not to be proved yet</source>
        <translation>Noch nicht zu prüfen</translation>
    </message>
    <message>
        <source>What it was taken of has been measured or chosen anew since, or is another set. Take it again to prove what is shown now.</source>
        <translation>Was es zeigt, wurde seitdem neu gemessen oder gewählt, oder ist eine andere Variante. Nehmen Sie es neu auf, um zu prüfen, was jetzt gezeigt wird.</translation>
    </message>
    <message>
        <source>As predicted, but errors are plain to see</source>
        <translation>Wie vorhergesagt, aber Fehler sind deutlich zu sehen</translation>
    </message>
    <message>
        <source>Nothing has moved: the prediction itself is coarse. Measuring finer or darker content helps.</source>
        <translation>Nichts hat sich bewegt: Die Vorhersage selbst ist grob. Feiner messen oder dunklere Inhalte helfen.</translation>
    </message>
    <message>
        <source>Waiting for the projector&apos;s screen to come back.</source>
        <translation>Wartet, bis der Bildschirm des Projektors zurückkommt.</translation>
    </message>
    <message>
        <source>What plays is not what was measured or chosen last. Show that first.</source>
        <translation>Was läuft, ist nicht das zuletzt Gemessene oder Gewählte. Zeigen Sie zuerst dieses.</translation>
    </message>
    <message>
        <source>Look at it first</source>
        <translation>Erst ansehen</translation>
    </message>
    <message>
        <source>What was measured or chosen since is not on the projector yet.</source>
        <translation>Was seitdem gemessen oder gewählt wurde, ist noch nicht auf dem Projektor.</translation>
    </message>
    <message>
        <source>What was measured or chosen since is not on the projector yet. Steps that are out of date count with what was chosen there before.</source>
        <translation>Was seitdem gemessen oder gewählt wurde, ist noch nicht auf dem Projektor. Veraltete Schritte gelten so, wie sie zuvor gewählt wurden.</translation>
    </message>
    <message>
        <source>The screen %1 is unplugged. Nothing is projected.</source>
        <translation>Der Bildschirm %1 ist nicht angeschlossen. Es wird nichts projiziert.</translation>
    </message>
    <message>
        <source>Camera %1: %2, as predicted</source>
        <translation>Kamera %1: %2, wie vorhergesagt</translation>
    </message>
    <message>
        <source>Camera %1: %2, not as predicted</source>
        <translation>Kamera %1: %2, nicht wie vorhergesagt</translation>
    </message>
    <message>
        <source>The view of camera %3 has moved by %1 px sideways and %2 px up or down.</source>
        <translation>Das Bild der Kamera %3 ist um %1 px seitwärts und %2 px auf- oder abwärts verschoben.</translation>
    </message>
    <message>
        <source>Camera %1 or a projector may have moved.</source>
        <translation>Kamera %1 oder ein Projektor kann sich bewegt haben.</translation>
    </message>
    <message>
        <source>Something has changed. Repair the calibration.</source>
        <translation>Etwas hat sich verändert. Reparieren Sie die Kalibrierung.</translation>
    </message>
    <message>
        <source>Something has changed since it was measured. Repair the calibration: only that is measured again.</source>
        <translation>Seit der Messung hat sich etwas verändert. Reparieren Sie die Kalibrierung: Nur das wird neu gemessen.</translation>
    </message>
    <message>
        <source>Repair the calibration</source>
        <translation>Kalibrierung reparieren</translation>
    </message>
    <message>
        <source>Nothing to repair</source>
        <translation>Nichts zu reparieren</translation>
    </message>
    <message>
        <source>The venue is as it was measured.</source>
        <translation>Der Spielort ist noch so, wie er gemessen wurde.</translation>
    </message>
    <message>
        <source>Not repaired</source>
        <translation>Nicht repariert</translation>
    </message>
    <message>
        <source>No better picture came of it: the measurement is used as before.</source>
        <translation>Das Bild wurde dadurch nicht besser: Die Messung wird verwendet wie bisher.</translation>
    </message>
    <message>
        <source>Repaired, %1</source>
        <translation>Repariert, %1</translation>
    </message>
    <message>
        <source>Colour error of a photographed picture: %1 before, %2 now.</source>
        <translation>Farbfehler eines fotografierten Bildes: vorher %1, jetzt %2.</translation>
    </message>
    <message>
        <source>Finds what has changed, measures only that again, and keeps it if a photograph of the picture is better by it.</source>
        <translation>Findet, was sich verändert hat, misst nur das neu und behält es, wenn ein Foto des Bildes dadurch besser ist.</translation>
    </message>
    <message>
        <source>Use the measurement before</source>
        <translation>Vorige Messung verwenden</translation>
    </message>
    <message>
        <source>Takes the repair back.</source>
        <translation>Nimmt die Reparatur zurück.</translation>
    </message>
    <message>
        <source>arrival to light</source>
        <translation>Ankunft bis Licht</translation>
    </message>
    <message>
        <source>From a live picture&apos;s arrival at this computer until the projectors have it: the longest of the last five seconds. The way there is not in it.</source>
        <translation>Von der Ankunft eines Live-Bildes an diesem Rechner, bis die Projektoren es haben: die längste Zeit der letzten fünf Sekunden. Der Weg hierher ist nicht darin.</translation>
    </message>
    <message>
        <source>Connecting to %1</source>
        <translation>Verbindung mit %1 wird aufgebaut</translation>
    </message>
    <message>
        <source>Lost: %1. %2</source>
        <translation>Verloren: %1. %2</translation>
    </message>
    <message>
        <source>Add a stream</source>
        <translation>Stream hinzufügen</translation>
    </message>
    <message>
        <source>A live picture from the network, as cameras and encoders send it.</source>
        <translation>Ein Live-Bild aus dem Netz, wie Kameras und Encoder es senden.</translation>
    </message>
    <message>
        <source>Nothing has moved: of the light only %1 is kept at Threshold, so that bounces are missing, in the prediction too. Keep more of it.</source>
        <translation>Nichts hat sich bewegt: Bei „Schwelle“ bleiben nur %1 des Lichts, so dass Reflexe fehlen, auch in der Vorhersage. Behalten Sie mehr davon.</translation>
    </message>
    <message>
        <source>The show of another venue will no longer start at log-in.</source>
        <translation>Die Show eines anderen Spielorts startet dann nicht mehr bei der Anmeldung.</translation>
    </message>
    <message>
        <source>The show of this venue will no longer start at log-in.</source>
        <translation>Die Show dieses Spielorts startet dann nicht mehr bei der Anmeldung.</translation>
    </message>
    <message>
        <source>Venue and playlist stay. It can be installed again from its venue&apos;s Output.</source>
        <translation>Spielort und Playlist bleiben. Sie kann in der Ausgabe ihres Spielorts wieder installiert werden.</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Keep</source>
        <translation>Behalten</translation>
    </message>
    <message>
        <source>To end it, hold Esc for two seconds at the projector&apos;s screen.</source>
        <translation>Zum Beenden halten Sie am Bildschirm des Projektors zwei Sekunden lang Esc gedrückt.</translation>
    </message>
    <message>
        <source>Test chart</source>
        <translation>Testbild</translation>
    </message>
    <message>
        <source>A test chart is on the surface. T shows the next one, then the playlist.</source>
        <translation>Auf der Oberfläche ist ein Testbild. T zeigt das nächste, dann die Playlist.</translation>
    </message>
    <message>
        <source>Show the playlist</source>
        <translation>Playlist zeigen</translation>
    </message>
    <message>
        <source>A test chart is on the surface</source>
        <translation>Auf der Oberfläche ist ein Testbild</translation>
    </message>
    <message>
        <source>The playlist runs on unseen until you show it again.</source>
        <translation>Die Playlist läuft ungesehen weiter, bis Sie sie wieder zeigen.</translation>
    </message>
    <message>
        <source>Times of sets</source>
        <translation>Zeiten der Varianten</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>Variante</translation>
    </message>
    <message>
        <source>Times of the day…</source>
        <translation>Tageszeiten…</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1: %2</translation>
    </message>
    <message>
        <source>The installed show plays this one all day.</source>
        <translation>Die installierte Show spielt diese den ganzen Tag.</translation>
    </message>
    <message>
        <source>The picture is being perfected.</source>
        <translation>Das Bild wird perfektioniert.</translation>
    </message>
    <message>
        <source>The output is being opened.</source>
        <translation>Die Ausgabe wird geöffnet.</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged.</source>
        <translation>Projektorbildschirm abgesteckt.</translation>
    </message>
    <message>
        <source>There is nothing else on the list.</source>
        <translation>Sonst ist nichts in der Liste.</translation>
    </message>
    <message>
        <source>The playlist is empty.</source>
        <translation>Die Playlist ist leer.</translation>
    </message>
    <message>
        <source>There is no other set.</source>
        <translation>Es gibt keine andere Variante.</translation>
    </message>
    <message>
        <source>The show changes by itself, here too: %1</source>
        <translation>Die Show wechselt von selbst, auch hier: %1</translation>
    </message>
    <message>
        <source>Choose in the desktop&apos;s dialog what to show as %1</source>
        <translation>Wählen Sie im Dialog des Desktops, was als %1 gezeigt wird</translation>
    </message>
    <message>
        <source>Add a screen or window</source>
        <translation>Bildschirm oder Fenster hinzufügen</translation>
    </message>
    <message>
        <source>The live picture of a screen of this computer, or of a window on it.</source>
        <translation>Das Live-Bild eines Bildschirms dieses Rechners oder eines Fensters darauf.</translation>
    </message>
    <message>
        <source>A screen, chosen in the desktop&apos;s dialog</source>
        <translation>Ein Bildschirm, im Dialog des Desktops gewählt</translation>
    </message>
    <message>
        <source>A window, chosen in the desktop&apos;s dialog</source>
        <translation>Ein Fenster, im Dialog des Desktops gewählt</translation>
    </message>
    <message>
        <source>Screen %1</source>
        <translation>Bildschirm %1</translation>
    </message>
    <message>
        <source>Window %1</source>
        <translation>Fenster %1</translation>
    </message>
    <message>
        <source>There is no desktop whose screens could be shown.</source>
        <translation>Es gibt keinen Desktop, dessen Bildschirme gezeigt werden könnten.</translation>
    </message>
    <message>
        <source>The camera is back at its place</source>
        <translation>Die Kamera steht wieder an ihrem Platz</translation>
    </message>
    <message>
        <source>Put the camera back, or repair the calibration.</source>
        <translation>Stellen Sie die Kamera zurück, oder reparieren Sie die Kalibrierung.</translation>
    </message>
    <message>
        <source>Perfecting</source>
        <translation>Perfektioniert</translation>
    </message>
    <message>
        <source>Photographing</source>
        <translation>Fotografiert</translation>
    </message>
    <message>
        <source>Checking for drift</source>
        <translation>Prüft auf Drift</translation>
    </message>
    <message>
        <source>Repairing</source>
        <translation>Wird repariert</translation>
    </message>
    <message>
        <source>The output is closed. Patterns to be photographed are projected.</source>
        <translation>Die Ausgabe ist geschlossen. Muster zum Fotografieren werden projiziert.</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Stoppen</translation>
    </message>
    <message>
        <source>Not as predicted</source>
        <translation>Nicht wie vorhergesagt</translation>
    </message>
    <message>
        <source>The output is closed. The devices are in use at %1.</source>
        <translation>Die Ausgabe ist geschlossen. Die Seite „%1“ nutzt die Geräte.</translation>
    </message>
    <message>
        <source>Show the current correction</source>
        <translation>Aktuelle Korrektur zeigen</translation>
    </message>
    <message>
        <source>The projector still shows another correction. Show the current one, then take the photograph.</source>
        <translation>Der Projektor zeigt noch eine andere Korrektur. Zeigen Sie die aktuelle, dann nehmen Sie das Foto auf.</translation>
    </message>
    <message>
        <source>Another correction</source>
        <translation>Andere Korrektur</translation>
    </message>
    <message>
        <source>The camera&apos;s view has moved. Put it back, then photograph again.</source>
        <translation>Der Blick der Kamera hat sich verschoben. Stellen Sie sie zurück und fotografieren Sie erneut.</translation>
    </message>
    <message>
        <source>The show still plays another correction</source>
        <translation>Die Show spielt noch eine andere Korrektur</translation>
    </message>
    <message>
        <source>Another correction plays. Show the current one first.</source>
        <translation>Es läuft noch eine andere Korrektur. Zeigen Sie erst die aktuelle.</translation>
    </message>
    <message>
        <source>Another correction still plays.</source>
        <translation>Es läuft noch eine andere Korrektur.</translation>
    </message>
    <message>
        <source>Covered by %1</source>
        <translation>Verdeckt von %1</translation>
    </message>
    <message>
        <source>The projector shows the light of another step: %1</source>
        <translation>Der Projektor zeigt das Licht eines anderen Schritts: %1</translation>
    </message>
    <message>
        <source>The show goes on behind it, and is seen again when that has ended.</source>
        <translation>Die Show läuft dahinter weiter und ist wieder zu sehen, wenn das beendet ist.</translation>
    </message>
    <message>
        <source>The light of another step is before the show.</source>
        <translation>Vor der Show steht das Licht eines anderen Schritts.</translation>
    </message>
    <message>
        <source>Time of a picture</source>
        <translation>Dauer eines Bildes</translation>
    </message>
    <message>
        <source>%1, skipped</source>
        <translation>%1, übersprungen</translation>
    </message>
    <message>
        <source>Seconds that the chosen picture stands</source>
        <translation>Sekunden, die das gewählte Bild steht</translation>
    </message>
    <message>
        <source> s</source>
        <translation> s</translation>
    </message>
    <message>
        <source>Picture stands for</source>
        <translation>Bild steht für</translation>
    </message>
    <message>
        <source>Photographed %1.</source>
        <translation>Fotografiert %1.</translation>
    </message>
    <message>
        <source>Photographed %1, before the last check for drift.</source>
        <translation>Fotografiert %1, vor der letzten Prüfung auf Drift.</translation>
    </message>
    <message>
        <source>The surface looked as predicted then</source>
        <translation>Die Oberfläche sah damals aus wie vorhergesagt</translation>
    </message>
    <message>
        <source>Checked %1.</source>
        <translation>Geprüft %1.</translation>
    </message>
    <message>
        <source>Hold A for the original, Ctrl+P freezes, B makes it black, T shows test charts, O figures.</source>
        <translation>A halten für das Original, Strg+P hält an, B macht schwarz, T zeigt Testbilder, O Zahlen.</translation>
    </message>
    <message>
        <source>No program here opens it: open it by hand, or take it to another computer.</source>
        <translation>Kein Programm hier öffnet ihn: Öffnen Sie ihn von Hand, oder nehmen Sie ihn auf einen anderen Computer mit.</translation>
    </message>
    <message>
        <source>Picture: %1</source>
        <translation>Bild: %1</translation>
    </message>
    <message>
        <source>The check was ended: the room is not said to be clear</source>
        <translation>Die Prüfung wurde beendet: Der Raum ist nicht mehr als geräumt bestätigt</translation>
    </message>
    <message>
        <source>It came to no result. Check again when the room is clear.</source>
        <translation>Sie kam zu keinem Ergebnis. Prüfen Sie erneut, wenn der Raum geräumt ist.</translation>
    </message>
    <message>
        <source>The repair was ended: the room is not said to be clear</source>
        <translation>Die Reparatur wurde beendet: Der Raum ist nicht mehr als geräumt bestätigt</translation>
    </message>
    <message>
        <source>The measurement is used as before. Repair again when the room is clear.</source>
        <translation>Die Messung wird wie zuvor verwendet. Reparieren Sie erneut, wenn der Raum geräumt ist.</translation>
    </message>
    <message>
        <source>The output is closed. A picture to be photographed is projected.</source>
        <translation>Die Ausgabe ist geschlossen. Ein Bild zum Fotografieren wird projiziert.</translation>
    </message>
    <message>
        <source>The room is brighter by %1 of full light.</source>
        <translation>Der Raum ist um %1 des vollen Lichts heller.</translation>
    </message>
    <message>
        <source>The room is darker by %1 of full light.</source>
        <translation>Der Raum ist um %1 des vollen Lichts dunkler.</translation>
    </message>
    <message>
        <source>The projector gives %1 of the light that it gave.</source>
        <translation>Der Projektor gibt %1 des Lichts, das er gab.</translation>
    </message>
    <message>
        <source>The output is closed. Nothing is projected from here.</source>
        <translation>Die Ausgabe ist geschlossen. Von hier wird nichts projiziert.</translation>
    </message>
    <message>
        <source>A photograph is being taken.</source>
        <translation>Ein Foto wird aufgenommen.</translation>
    </message>
    <message>
        <source>Slowly, as the room is not said to be clear: nothing flashes.</source>
        <translation>Langsam, da der Raum nicht als geräumt bestätigt ist: Nichts blitzt.</translation>
    </message>
    <message>
        <source>It plays this playlist with the measurement that is in use by then.</source>
        <translation>Sie spielt diese Playlist mit der Messung, die dann verwendet wird.</translation>
    </message>
    <message>
        <source>The output is closed here. Another program plays a show of this venue.</source>
        <translation>Die Ausgabe ist hier geschlossen. Ein anderes Programm spielt eine Show dieses Spielorts.</translation>
    </message>
    <message>
        <source>Hardly anything fits. Put the camera back or repair the calibration; if neither helps, aim and measure again.</source>
        <translation>Kaum etwas passt. Stellen Sie die Kamera zurück oder reparieren Sie die Kalibrierung; hilft beides nicht, richten Sie aus und messen Sie neu.</translation>
    </message>
    <message>
        <source>Almost nothing of the projector&apos;s light is seen. Look at the lens and at the projector, then check again.</source>
        <translation>Vom Licht des Projektors ist fast nichts zu sehen. Sehen Sie nach Objektiv und Projektor, dann prüfen Sie noch einmal.</translation>
    </message>
    <message>
        <source>Installed. The show starts at the next log-in, without wizard. The camera stays: at night it looks after the picture.</source>
        <translation>Installiert. Die Show startet bei der nächsten Anmeldung, ohne Assistenten. Die Kamera bleibt: Nachts sieht sie nach dem Bild.</translation>
    </message>
    <message>
        <source>Another program plays</source>
        <translation>Anderes Programm spielt</translation>
    </message>
    <message>
        <source>Hardly anything fits. Put the camera back, repair the calibration, or aim and measure again.</source>
        <translation>Kaum etwas passt. Stellen Sie die Kamera zurück, reparieren Sie die Kalibrierung, oder richten Sie aus und messen Sie neu.</translation>
    </message>
    <message>
        <source>Another program plays a show of this venue.</source>
        <translation>Ein anderes Programm spielt eine Show dieses Spielorts.</translation>
    </message>
    <message>
        <source>The room&apos;s light has changed. Restore it and check again, or repair the calibration.</source>
        <translation>Das Raumlicht hat sich geändert. Stellen Sie es wieder her und prüfen Sie noch einmal, oder reparieren Sie die Kalibrierung.</translation>
    </message>
    <message>
        <source>The camera looks elsewhere</source>
        <translation>Die Kamera sieht woandershin</translation>
    </message>
    <message>
        <source>It was left %1 px from where it looked when it was measured. Put it back, or repair the calibration.</source>
        <translation>Sie blieb %1 px neben der Stelle stehen, auf die sie bei der Messung sah. Stellen Sie sie zurück oder reparieren Sie die Kalibrierung.</translation>
    </message>
    <message>
        <source>Put the camera back, or measure again.</source>
        <translation>Stellen Sie die Kamera zurück, oder messen Sie neu.</translation>
    </message>
    <message>
        <source>Something has changed. Measure again.</source>
        <translation>Etwas hat sich verändert. Messen Sie neu.</translation>
    </message>
    <message>
        <source>Hardly anything fits. Put the camera back, or aim and measure again.</source>
        <translation>Kaum etwas passt. Stellen Sie die Kamera zurück, oder richten Sie aus und messen Sie neu.</translation>
    </message>
    <message>
        <source>Keep the repaired one</source>
        <translation>Reparierte behalten</translation>
    </message>
    <message>
        <source>Use the measurement before?</source>
        <translation>Vorige Messung verwenden?</translation>
    </message>
    <message>
        <source>What was repaired is measured again if you repair once more.</source>
        <translation>Was repariert wurde, wird neu gemessen, wenn Sie noch einmal reparieren.</translation>
    </message>
    <message>
        <source>The measurement from before the repair is used as it was, with all that followed from it.</source>
        <translation>Die Messung von vor der Reparatur wird verwendet, wie sie war, mit allem, was aus ihr folgte.</translation>
    </message>
    <message>
        <source>Screen %1, which this plays on</source>
        <translation>Bildschirm %1, auf dem dies spielt</translation>
    </message>
    <message>
        <source>They are larger than predicted. A check for drift tells whether something has moved.</source>
        <translation>Sie sind größer als vorhergesagt. Eine Prüfung auf Drift zeigt, ob sich etwas bewegt hat.</translation>
    </message>
    <message>
        <source>Once installed, the show starts at every log-in, without wizard. The camera stays: at night it looks after the picture.</source>
        <translation>Einmal installiert, startet die Show bei jeder Anmeldung, ohne Assistent. Die Kamera bleibt: Nachts kümmert sie sich um das Bild.</translation>
    </message>
    <message>
        <source>Take a verification photograph. What was found before is not settled.</source>
        <translation>Nehmen Sie ein Prüffoto auf. Was vorher gefunden wurde, ist nicht geklärt.</translation>
    </message>
    <message>
        <source>The surface did not look as predicted. Open the output: it leads to what helps.</source>
        <translation>Die Fläche sah nicht aus wie vorhergesagt. Öffnen Sie die Ausgabe: Sie führt zu dem, was hilft.</translation>
    </message>
    <message>
        <source>Black: the frozen picture stands unseen until you show it again.</source>
        <translation>Schwarz: Das eingefrorene Bild steht ungesehen, bis Sie es wieder zeigen.</translation>
    </message>
    <message>
        <source>still picture, perfected by photographs</source>
        <translation>Standbild, durch Fotos perfektioniert</translation>
    </message>
    <message>
        <source>Nothing has moved: part of the picture is out of the projector&apos;s reach, in a shadow, darker than its black or brighter than its white there. Another picture, or another place for it, helps.</source>
        <translation>Nichts hat sich bewegt: Ein Teil des Bildes liegt außerhalb der Reichweite des Projektors, in einem Schatten, dunkler als sein Schwarz oder heller als sein Weiß an dieser Stelle. Ein anderes Bild oder ein anderer Platz dafür hilft.</translation>
    </message>
    <message>
        <source>Errors are plain to see</source>
        <translation>Fehler sind deutlich zu sehen</translation>
    </message>
    <message>
        <source>The frozen picture stands unseen until you show it again.</source>
        <translation>Das eingefrorene Bild steht ungesehen, bis Sie es wieder zeigen.</translation>
    </message>
    <message>
        <source>The output is closed here. Another program plays a show of another venue on this projector.</source>
        <translation>Die Ausgabe ist hier geschlossen. Ein anderes Programm spielt auf diesem Projektor eine Show eines anderen Spielorts.</translation>
    </message>
    <message>
        <source>Another program plays a show of another venue on this projector.</source>
        <translation>Ein anderes Programm spielt auf diesem Projektor eine Show eines anderen Spielorts.</translation>
    </message>
    <message>
        <source>Two shows at once</source>
        <translation>Zwei Shows zugleich</translation>
    </message>
    <message>
        <source>The output is open here and in another program: whose picture is seen is not known. End one.</source>
        <translation>Die Ausgabe ist hier und in einem anderen Programm offen: Wessen Bild zu sehen ist, ist nicht bekannt. Eine davon beenden.</translation>
    </message>
    <message>
        <source>Perhaps under another program&apos;s picture</source>
        <translation>Vielleicht unter dem Bild eines anderen Programms</translation>
    </message>
    <message>
        <source>Black: the test chart stands unseen. T shows the next one, then the playlist.</source>
        <translation>Schwarz: Das Testbild steht ungesehen. T zeigt das nächste, dann die Wiedergabeliste.</translation>
    </message>
    <message>
        <source>Hide the figures</source>
        <translation>Zahlen ausblenden</translation>
    </message>
    <message>
        <source>Figures are on the surface</source>
        <translation>Zahlen stehen auf der Fläche</translation>
    </message>
    <message>
        <source>Whoever is in the room reads them over the picture.</source>
        <translation>Wer im Raum ist, liest sie über dem Bild.</translation>
    </message>
    <message>
        <source>Installed as it is. %1</source>
        <translation>Installiert, wie es ist. %1</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the patterns flash.</source>
        <translation>Bestätigen Sie, dass der Raum geräumt ist: Die Muster blitzen.</translation>
    </message>
    <message>
        <source>No picture has come yet: black</source>
        <translation>Noch ist kein Bild gekommen: schwarz</translation>
    </message>
    <message>
        <source>The live picture is lost: black</source>
        <translation>Das Live-Bild ist verloren: schwarz</translation>
    </message>
    <message>
        <source>The live picture is lost: its last one stands</source>
        <translation>Das Live-Bild ist verloren: sein letztes steht</translation>
    </message>
    <message>
        <source>A film plays to its end.</source>
        <translation>Ein Film läuft bis zu seinem Ende.</translation>
    </message>
    <message>
        <source>A part of the surface looks otherwise than predicted, by ΔE %1.</source>
        <translation>Ein Teil der Oberfläche sieht anders aus als vorhergesagt, um ΔE %1.</translation>
    </message>
    <message>
        <source>Installed, but the show cannot start with what was measured last.</source>
        <translation>Installiert, aber mit der letzten Messung kann die Show nicht starten.</translation>
    </message>
    <message>
        <source>Go on measuring, or use the earlier one, at Acquire.</source>
        <translation>Messen Sie weiter, oder nehmen Sie die frühere Messung, bei „Erfassen“.</translation>
    </message>
    <message>
        <source>Go on measuring at Acquire.</source>
        <translation>Messen Sie bei „Erfassen“ weiter.</translation>
    </message>
    <message>
        <source>What was measured is too coarse to place content. Go on measuring.</source>
        <translation>Was gemessen wurde, ist zu grob, um Inhalte zu platzieren. Messen Sie weiter.</translation>
    </message>
    <message>
        <source>Not all was decided on what is measured now</source>
        <translation>Nicht alles wurde anhand der jetzigen Messung entschieden</translation>
    </message>
    <message>
        <source>Steps that are out of date count with what was chosen there before.</source>
        <translation>Veraltete Schritte gelten so, wie sie zuvor gewählt wurden.</translation>
    </message>
    <message>
        <source>The test patterns fit, the photograph does not</source>
        <translation>Die Testmuster passen, das Foto nicht</translation>
    </message>
    <message>
        <source>Few patterns can miss a small part. Where another photograph differs, too, a repair looks closer.</source>
        <translation>Wenigen Mustern kann ein kleiner Teil entgehen. Weicht auch ein weiteres Foto ab, sieht eine Reparatur genauer hin.</translation>
    </message>
    <message>
        <source>This picture was perfected after the photograph.</source>
        <translation>Dieses Bild wurde nach dem Foto perfektioniert.</translation>
    </message>
    <message>
        <source>In the camera&apos;s picture it is %1 from the left and %2 from the top.</source>
        <translation>Im Kamerabild liegt er bei %1 von links und %2 von oben.</translation>
    </message>
    <message>
        <source>What was found before may have come of that: a photograph shows what is left of it.</source>
        <translation>Was davor gefunden wurde, kann daher gekommen sein: Ein Prüffoto zeigt, was davon bleibt.</translation>
    </message>
    <message>
        <source>Black. %1</source>
        <translation>Schwarz. %1</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputPlaylist</name>
    <message>
        <source>Demonstration picture</source>
        <translation>Demobild</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputProjection</name>
    <message>
        <source>Open the output again.</source>
        <translation>Öffnen Sie die Ausgabe noch einmal.</translation>
    </message>
    <message>
        <source>Relucent is projecting</source>
        <translation>Relucent projiziert</translation>
    </message>
    <message>
        <source>%1, shown without OpenGL</source>
        <translation>%1, ohne OpenGL gezeigt</translation>
    </message>
    <message>
        <source>The output goes on as before.</source>
        <translation>Die Ausgabe läuft weiter wie bisher.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputProof</name>
    <message>
        <source>No venue is open.</source>
        <translation>Es ist kein Ort geöffnet.</translation>
    </message>
    <message>
        <source>A photograph is being taken.</source>
        <translation>Ein Foto wird aufgenommen.</translation>
    </message>
    <message>
        <source>Drift is being checked.</source>
        <translation>Es wird auf Drift geprüft.</translation>
    </message>
    <message>
        <source>It is being repaired.</source>
        <translation>Es wird repariert.</translation>
    </message>
    <message>
        <source>The report is being written.</source>
        <translation>Der Bericht wird geschrieben.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Perfecting</name>
    <message>
        <source>%1 The picture is shown as before. Try again.</source>
        <translation>%1 Das Bild wird wie zuvor gezeigt. Versuchen Sie es noch einmal.</translation>
    </message>
    <message>
        <source>The photographs found nothing better. The picture is shown as before.</source>
        <translation>Die Fotos fanden nichts Besseres. Das Bild wird wie zuvor gezeigt.</translation>
    </message>
    <message>
        <source>The picture is being perfected</source>
        <translation>Das Bild wird perfektioniert</translation>
    </message>
    <message numerus="yes">
        <source>%n photograph(s) by now. Keep the room as it is.</source>
        <translation>
            <numerusform>Bisher %n Foto. Lassen Sie den Raum, wie er ist.</numerusform>
            <numerusform>Bisher %n Fotos. Lassen Sie den Raum, wie er ist.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1: %2 before, %3 now, by %n photograph(s).</source>
        <translation>
            <numerusform>%1: vorher %2, jetzt %3, durch %n Foto.</numerusform>
            <numerusform>%1: vorher %2, jetzt %3, durch %n Fotos.</numerusform>
        </translation>
    </message>
    <message>
        <source>This picture is perfected</source>
        <translation>Dieses Bild ist perfektioniert</translation>
    </message>
    <message>
        <source>The picture is as it was</source>
        <translation>Das Bild ist, wie es war</translation>
    </message>
    <message>
        <source>Not perfected</source>
        <translation>Nicht perfektioniert</translation>
    </message>
    <message>
        <source>A picture that stands can be corrected by photographs of itself, some eight of them. It is kept for this venue, placed as it is now.</source>
        <translation>Ein stehendes Bild lässt sich durch Fotos von sich selbst korrigieren, etwa acht. Es bleibt für diesen Ort erhalten, so platziert wie jetzt.</translation>
    </message>
    <message>
        <source>Perfect a picture</source>
        <translation>Bild perfektionieren</translation>
    </message>
    <message>
        <source>Perfect this picture</source>
        <translation>Dieses Bild perfektionieren</translation>
    </message>
    <message>
        <source>Stop and keep the best</source>
        <translation>Beenden und Bestes behalten</translation>
    </message>
    <message>
        <source>Show it as before</source>
        <translation>Wie zuvor zeigen</translation>
    </message>
    <message>
        <source>What the photographs corrected is dropped.</source>
        <translation>Was die Fotos korrigiert haben, wird verworfen.</translation>
    </message>
    <message>
        <source>Perfect it again</source>
        <translation>Noch einmal perfektionieren</translation>
    </message>
    <message>
        <source>No venue is open.</source>
        <translation>Es ist kein Ort geöffnet.</translation>
    </message>
    <message>
        <source>The picture is being perfected.</source>
        <translation>Das Bild wird perfektioniert.</translation>
    </message>
    <message>
        <source>perfected, %1 before, %2 now.</source>
        <translation>perfektioniert, vorher %1, jetzt %2.</translation>
    </message>
    <message>
        <source>Tried last, %1: %2</source>
        <translation>Zuletzt versucht, %1: %2</translation>
    </message>
    <message>
        <source>Slowly, as the room is not said to be clear: nothing flashes.</source>
        <translation>Langsam, da der Raum nicht als geräumt bestätigt ist: Nichts blitzt.</translation>
    </message>
    <message>
        <source>Picture: %1</source>
        <translation>Bild: %1</translation>
    </message>
    <message>
        <source>Not perfected since it changed</source>
        <translation>Seit der Änderung nicht perfektioniert</translation>
    </message>
    <message>
        <source>It was perfected for an earlier measurement, for another set, with other light or masks, or placed otherwise. That is kept, and is of no use now: perfect it once more.</source>
        <translation>Es wurde für eine frühere Messung, für eine andere Variante, mit anderem Licht, anderen Masken oder anders platziert perfektioniert. Das ist aufgehoben, nützt jetzt aber nichts: Perfektionieren Sie es noch einmal.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::PlaneView</name>
    <message>
        <source>%1 px</source>
        <translation>%1 px</translation>
    </message>
    <message>
        <source>Esc goes back</source>
        <translation>Esc führt zurück</translation>
    </message>
</context>
<context>
    <name>relucent::gui::PreviewPage</name>
    <message>
        <source>Demonstration picture</source>
        <translation>Demobild</translation>
    </message>
    <message>
        <source>Content</source>
        <translation>Inhalt</translation>
    </message>
    <message>
        <source>Change</source>
        <translation>Ändern</translation>
    </message>
    <message>
        <source>Whole</source>
        <translation>Ganz</translation>
    </message>
    <message>
        <source>Fill</source>
        <translation>Füllen</translation>
    </message>
    <message>
        <source>Stretch</source>
        <translation>Strecken</translation>
    </message>
    <message>
        <source>Place automatically</source>
        <translation>Automatisch platzieren</translation>
    </message>
    <message>
        <source>In the largest upright rectangle that can be reached</source>
        <translation>Im größten aufrechten Rechteck, das erreichbar ist</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Licht</translation>
    </message>
    <message>
        <source>May stay too dark</source>
        <translation>Darf zu dunkel bleiben</translation>
    </message>
    <message>
        <source>Share of the content that may stay too dark, percent</source>
        <translation>Anteil des Inhalts, der zu dunkel bleiben darf, Prozent</translation>
    </message>
    <message>
        <source>Lift of the blacks</source>
        <translation>Schwarzanhebung</translation>
    </message>
    <message>
        <source>Lift of the blacks, percent</source>
        <translation>Schwarzanhebung, Prozent</translation>
    </message>
    <message>
        <source>Reach</source>
        <translation>Erreichbarkeit</translation>
    </message>
    <message>
        <source>Can be reached</source>
        <translation>Erreichbar</translation>
    </message>
    <message>
        <source>Too dark to reach</source>
        <translation>Bleibt zu dunkel</translation>
    </message>
    <message>
        <source>Never black enough</source>
        <translation>Nie schwarz genug</translation>
    </message>
    <message>
        <source>Colour error</source>
        <translation>Farbfehler</translation>
    </message>
    <message>
        <source>Part of the picture gets no light from this projector.</source>
        <translation>Ein Teil des Bilds bekommt von diesem Projektor kein Licht.</translation>
    </message>
    <message>
        <source>A second could fill it.</source>
        <translation>Ein zweiter könnte ihn füllen.</translation>
    </message>
    <message>
        <source>Choose a picture</source>
        <translation>Bild wählen</translation>
    </message>
    <message>
        <source>Fit</source>
        <translation>Einpassung</translation>
    </message>
    <message>
        <source>Brightness</source>
        <translation>Helligkeit</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>Das Gemessene ist sicher.</translation>
    </message>
    <message>
        <source>Picture</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>The picture of before stays.</source>
        <translation>Das vorige Bild bleibt.</translation>
    </message>
    <message>
        <source>Preparing the preview</source>
        <translation>Vorbereitung der Vorschau</translation>
    </message>
    <message>
        <source>The corners cross over. Drag them apart.</source>
        <translation>Die Ecken überkreuzen sich. Ziehen Sie sie auseinander.</translation>
    </message>
    <message>
        <source>Corners</source>
        <translation>Ecken</translation>
    </message>
    <message>
        <source>Automatic place</source>
        <translation>Automatische Platzierung</translation>
    </message>
    <message>
        <source>Preparing</source>
        <translation>Vorbereitung</translation>
    </message>
    <message>
        <source>%1 in reach</source>
        <translation>%1 erreichbar</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>Veraltet</translation>
    </message>
    <message>
        <source>The preview is not prepared.</source>
        <translation>Die Vorschau ist nicht vorbereitet.</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>Die Seite „%1“ nutzt die Geräte.</translation>
    </message>
    <message>
        <source>Predicting</source>
        <translation>Vorhersage</translation>
    </message>
    <message>
        <source>Predicted from the measurement. Nothing is projected now.</source>
        <translation>Aus der Messung vorhergesagt. Projiziert wird gerade nichts.</translation>
    </message>
    <message>
        <source>Preview</source>
        <translation>Vorschau</translation>
    </message>
    <message>
        <source>Place the content in the camera&apos;s view and see what the audience will see before you project it.</source>
        <translation>Platzieren Sie den Inhalt im Kamerabild und sehen Sie vor dem Projizieren, was das Publikum sehen wird.</translation>
    </message>
    <message>
        <source>Audience view</source>
        <translation>Publikumssicht</translation>
    </message>
    <message>
        <source>Reachable light</source>
        <translation>Erreichbares Licht</translation>
    </message>
    <message>
        <source>Difference</source>
        <translation>Differenz</translation>
    </message>
    <message>
        <source>What the audience will see, uncorrected at the left of the divider and corrected at the right</source>
        <translation>Was das Publikum sehen wird, links der Trennlinie unkorrigiert, rechts korrigiert</translation>
    </message>
    <message>
        <source>Colour difference between what is wanted and what is predicted</source>
        <translation>Farbabstand zwischen Soll und Vorhersage</translation>
    </message>
    <message>
        <source>Methods</source>
        <translation>Methoden</translation>
    </message>
    <message>
        <source>predicted for this content; click one to use it</source>
        <translation>für diesen Inhalt vorhergesagt; zum Wählen anklicken</translation>
    </message>
    <message>
        <source>Comparison of methods</source>
        <translation>Vergleich der Methoden</translation>
    </message>
    <message>
        <source>Method</source>
        <translation>Methode</translation>
    </message>
    <message>
        <source>Notes</source>
        <translation>Hinweise</translation>
    </message>
    <message>
        <source>blind to bounces</source>
        <translation>blind für Reflexionen</translation>
    </message>
    <message>
        <source>limit of this venue</source>
        <translation>Grenze des Spielorts</translation>
    </message>
    <message>
        <source>%1 dB</source>
        <translation>%1 dB</translation>
    </message>
    <message>
        <source>%1 ms</source>
        <translation>%1 ms</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>Uncorrected</source>
        <translation>Unkorrigiert</translation>
    </message>
    <message>
        <source>Corrected, predicted</source>
        <translation>Korrigiert, vorhergesagt</translation>
    </message>
    <message>
        <source>of white</source>
        <translation>von Weiß</translation>
    </message>
    <message>
        <source>The larger this share, the brighter the picture, and the more of it stays too dark.</source>
        <translation>Je größer dieser Anteil, desto heller wird das Bild, und desto mehr davon bleibt zu dunkel.</translation>
    </message>
    <message>
        <source>Part of the picture gets no light from any projector.</source>
        <translation>Ein Teil des Bildes bekommt von keinem Projektor Licht.</translation>
    </message>
    <message>
        <source>Another one could fill it.</source>
        <translation>Ein weiterer könnte ihn füllen.</translation>
    </message>
    <message>
        <source>Go to output</source>
        <translation>Zur Ausgabe</translation>
    </message>
    <message>
        <source>under 1 ms</source>
        <translation>unter 1 ms</translation>
    </message>
    <message>
        <source>Uncorrected, too</source>
        <translation>Ebenfalls unkorrigiert</translation>
    </message>
    <message>
        <source>What was measured is too coarse to place content. Go on measuring.</source>
        <translation>Was gemessen wurde, ist zu grob, um Inhalte zu platzieren. Messen Sie weiter.</translation>
    </message>
    <message>
        <source>All of it can be reached</source>
        <translation>Alles ist erreichbar</translation>
    </message>
    <message>
        <source>no note</source>
        <translation>keine Anmerkung</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged.</source>
        <translation>Der Bildschirm des Projektors ist abgesteckt.</translation>
    </message>
    <message>
        <source>On the surface now: the corrected picture.</source>
        <translation>Jetzt auf der Fläche: das korrigierte Bild.</translation>
    </message>
    <message>
        <source>On the surface now: the uncorrected picture.</source>
        <translation>Jetzt auf der Fläche: das unkorrigierte Bild.</translation>
    </message>
    <message>
        <source>Stop shining</source>
        <translation>Beenden</translation>
    </message>
    <message>
        <source>Shine on surface</source>
        <translation>Auf die Fläche werfen</translation>
    </message>
    <message>
        <source>Shows this picture on the surface until you stop it or leave.</source>
        <translation>Zeigt dieses Bild auf der Fläche, bis Sie es beenden oder weggehen.</translation>
    </message>
    <message>
        <source>Show uncorrected</source>
        <translation>Unkorrigiert zeigen</translation>
    </message>
    <message>
        <source>Show corrected</source>
        <translation>Korrigiert zeigen</translation>
    </message>
    <message>
        <source>There is no preview yet.</source>
        <translation>Es gibt noch keine Vorschau.</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is not there. Plug it in and extend the desktop to it.</source>
        <translation>Der Bildschirm des Projektors fehlt. Stecken Sie ihn an und erweitern Sie den Desktop darauf.</translation>
    </message>
    <message>
        <source>The brightest light that can be reached; hatched where the content is out of reach</source>
        <translation>Das hellste erreichbare Licht; schraffiert, wo der Inhalt unerreichbar ist</translation>
    </message>
    <message>
        <source>Hatched: %1 cannot be reached</source>
        <translation>Schraffiert: %1 unerreichbar</translation>
    </message>
    <message>
        <source>It has been measured again since the content was placed</source>
        <translation>Seit der Inhalt platziert wurde, ist neu gemessen worden</translation>
    </message>
    <message>
        <source>The threshold has been changed since the content was placed</source>
        <translation>Seit der Inhalt platziert wurde, ist die Schwelle geändert worden</translation>
    </message>
    <message>
        <source>What you see here is predicted anew. Going to the output keeps it.</source>
        <translation>Was Sie hier sehen, ist neu vorhergesagt. Mit dem Schritt zur Ausgabe wird es gespeichert.</translation>
    </message>
    <message>
        <source>Still picture</source>
        <translation>Standbild</translation>
    </message>
    <message>
        <source>How long a still picture takes to be solved, once. Films always play by “All bounces, for films” in the quicker show engine: how fast is said at Cluster.</source>
        <translation>Wie lange ein Standbild einmal zu berechnen ist. Filme laufen immer mit „Alle Reflexe, für Filme“ im schnelleren Rechenkern der Show: Wie schnell, steht bei Cluster.</translation>
    </message>
    <message>
        <source>Of this content, where it can be reached. What Acquire expects is a mean of other pictures: the two may differ by some dB.</source>
        <translation>Für diesen Inhalt, wo er erreichbar ist. Was Messen erwartet, ist ein Mittel über andere Bilder: Beide können um einige dB auseinanderliegen.</translation>
    </message>
    <message>
        <source>blind to light between clusters</source>
        <translation>blind für Licht zwischen Clustern</translation>
    </message>
    <message>
        <source>recommended</source>
        <translation>empfohlen</translation>
    </message>
    <message>
        <source>Compare</source>
        <translation>Vergleichen</translation>
    </message>
    <message>
        <source>Hide</source>
        <translation>Ausblenden</translation>
    </message>
    <message>
        <source>This content comes to %1. Acquire expected %2 on average of three other pictures, by the recommended method.</source>
        <translation>Dieser Inhalt erreicht %1. „Erfassen“ erwartete %2, im Mittel von drei anderen Bildern, mit der empfohlenen Methode.</translation>
    </message>
    <message>
        <source>Place of a camera</source>
        <translation>Ort einer Kamera</translation>
    </message>
    <message>
        <source>no content</source>
        <translation>kein Inhalt</translation>
    </message>
    <message>
        <source>%1 dB, ΔE %2</source>
        <translation>%1 dB, ΔE %2</translation>
    </message>
    <message>
        <source>%1, counts %2</source>
        <translation>%1, zählt %2</translation>
    </message>
    <message>
        <source>Views</source>
        <translation>Ansichten</translation>
    </message>
    <message>
        <source>On the surface</source>
        <translation>Auf der Oberfläche</translation>
    </message>
    <message>
        <source>Upright from here</source>
        <translation>Von hier aufrecht</translation>
    </message>
    <message>
        <source>Weight of this view</source>
        <translation>Gewicht dieser Ansicht</translation>
    </message>
    <message>
        <source>Weight of the shown view, percent</source>
        <translation>Gewicht der gezeigten Ansicht, Prozent</translation>
    </message>
    <message>
        <source>For one viewer who moves</source>
        <translation>Für einen Betrachter, der geht</translation>
    </message>
    <message>
        <source>Where the viewer stands, from the first camera to the last</source>
        <translation>Wo der Betrachter steht, von der ersten Kamera zur letzten</translation>
    </message>
    <message>
        <source>Place in this view</source>
        <translation>Ort in dieser Ansicht</translation>
    </message>
    <message>
        <source>Weight of a view</source>
        <translation>Gewicht einer Ansicht</translation>
    </message>
    <message>
        <source>Drag the cameras to where they stand, then move the viewer.</source>
        <translation>Ziehen Sie die Kameras dahin, wo sie stehen; dann bewegen Sie den Betrachter.</translation>
    </message>
    <message>
        <source>As little as hides where projectors end</source>
        <translation>So wenig, wie die Ränder der Projektoren verbirgt</translation>
    </message>
    <message>
        <source>Place of the viewer</source>
        <translation>Ort des Betrachters</translation>
    </message>
    <message>
        <source>Contradiction</source>
        <translation>Widerspruch</translation>
    </message>
    <message>
        <source>How much worse a view is because of what the other views ask for</source>
        <translation>Um wie viel schlechter eine Ansicht ist, weil die anderen anderes verlangen</translation>
    </message>
    <message>
        <source>Comparing the views</source>
        <translation>Die Ansichten werden verglichen</translation>
    </message>
    <message>
        <source>Visibly worse because of other views: %1</source>
        <translation>Sichtbar schlechter wegen anderer Ansichten: %1</translation>
    </message>
    <message>
        <source>Visibly worse because of other views</source>
        <translation>Sichtbar schlechter wegen anderer Ansichten</translation>
    </message>
    <message>
        <source>Even</source>
        <translation>Gleich</translation>
    </message>
    <message>
        <source>One white for all pictures, as bright as most of the surface can show it.</source>
        <translation>Ein Weiß für alle Bilder, so hell, wie der größte Teil der Oberfläche es zeigen kann.</translation>
    </message>
    <message>
        <source>By picture</source>
        <translation>Je Bild</translation>
    </message>
    <message>
        <source>Each picture has the white at which the least of it is lost: dark ones become brighter, bright ones dimmer.</source>
        <translation>Jedes Bild hat das Weiß, bei dem am wenigsten von ihm verloren geht: Dunkle werden heller, helle dunkler.</translation>
    </message>
    <message>
        <source>By region</source>
        <translation>Je Bereich</translation>
    </message>
    <message>
        <source>The same for each part of the picture, smoothly from one to the next: the least is lost of all.</source>
        <translation>Dasselbe für jeden Teil des Bildes, mit weichen Übergängen: So geht am wenigsten verloren.</translation>
    </message>
    <message>
        <source>How bright white is</source>
        <translation>Wie hell Weiß ist</translation>
    </message>
    <message>
        <source>The picture is shown as before.</source>
        <translation>Das Bild wird wie zuvor gezeigt.</translation>
    </message>
    <message>
        <source>Bright</source>
        <translation>Hell</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show are as bright as can be: white on a yellow wall turns yellow.</source>
        <translation>Farben, die die Fläche nicht zeigen kann, werden so hell wie möglich: Weiß auf einer gelben Wand wird gelb.</translation>
    </message>
    <message>
        <source>Between</source>
        <translation>Dazwischen</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show become somewhat dimmer and shift less.</source>
        <translation>Farben, die die Fläche nicht zeigen kann, werden etwas dunkler und verschieben sich weniger.</translation>
    </message>
    <message>
        <source>True</source>
        <translation>Farbtreu</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show are dimmed until their hue is right: for faces and logos.</source>
        <translation>Farben, die die Fläche nicht zeigen kann, werden dunkler, bis ihr Farbton stimmt: für Gesichter und Logos.</translation>
    </message>
    <message>
        <source>Colours out of reach</source>
        <translation>Unerreichbare Farben</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show</source>
        <translation>Farben, die die Fläche nicht zeigen kann</translation>
    </message>
    <message>
        <source>Uncertainty</source>
        <translation>Unsicherheit</translation>
    </message>
    <message>
        <source>95 of 100 pixels come within this of what is predicted, in percent of white. More photographs or longer exposures make it smaller.</source>
        <translation>95 von 100 Pixeln weichen höchstens so weit von der Vorhersage ab, in Prozent von Weiß. Mehr Fotos oder längere Belichtungen verkleinern es.</translation>
    </message>
    <message>
        <source>How far the light may be from what is predicted, by the measurement&apos;s noise</source>
        <translation>Wie weit das Licht durch das Rauschen der Messung von der Vorhersage abweichen kann</translation>
    </message>
    <message>
        <source>95 of 100 pixels come within the value shown, on average %1 of white</source>
        <translation>95 von 100 Pixeln bleiben innerhalb des gezeigten Werts, im Mittel %1 von Weiß</translation>
    </message>
    <message>
        <source>Quality</source>
        <translation>Qualität</translation>
    </message>
    <message>
        <source>Detail kept</source>
        <translation>Erhaltene Details</translation>
    </message>
    <message>
        <source>Peak signal-to-noise ratio, PSNR: 20 dB looks rough, 30 dB good.</source>
        <translation>Spitzen-Signal-Rausch-Verhältnis, PSNR: 20 dB sehen grob aus, 30 dB gut.</translation>
    </message>
    <message>
        <source>Structural similarity, SSIM: 1 is all of it.</source>
        <translation>Strukturelle Ähnlichkeit, SSIM: 1 heißt alle.</translation>
    </message>
    <message>
        <source>What of it is shown</source>
        <translation>Was davon gezeigt wird</translation>
    </message>
    <message>
        <source>Mask %1</source>
        <translation>Maske %1</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1, %2</translation>
    </message>
    <message>
        <source>Masks</source>
        <translation>Masken</translation>
    </message>
    <message>
        <source>No light falls on these parts: doors, windows, where visitors sit.</source>
        <translation>Auf diese Teile fällt kein Licht: Türen, Fenster, Plätze der Besucher.</translation>
    </message>
    <message>
        <source>Draw a mask</source>
        <translation>Maske zeichnen</translation>
    </message>
    <message>
        <source>Click points in the picture, and the first one again to close. With the keyboard: arrow keys, Space, Return; Escape leaves it.</source>
        <translation>Klicken Sie Punkte im Bild an und zum Schließen noch einmal den ersten. Mit der Tastatur: Pfeiltasten, Leertaste, Eingabetaste; Escape bricht ab.</translation>
    </message>
    <message>
        <source>Straight</source>
        <translation>Gerade</translation>
    </message>
    <message>
        <source>Curved</source>
        <translation>Geschwungen</translation>
    </message>
    <message>
        <source>How the points of the mask are joined</source>
        <translation>Wie die Punkte der Maske verbunden sind</translation>
    </message>
    <message>
        <source>Feather</source>
        <translation>Weicher Rand</translation>
    </message>
    <message>
        <source>How far beyond the mask the light comes back, thousandths of the view</source>
        <translation>Wie weit jenseits der Maske das Licht zurückkehrt, in Tausendsteln der Ansicht</translation>
    </message>
    <message>
        <source>Remove the mask</source>
        <translation>Maske entfernen</translation>
    </message>
    <message>
        <source>Stop drawing</source>
        <translation>Zeichnen beenden</translation>
    </message>
    <message>
        <source>errors weighed as an eye does</source>
        <translation>Fehler, wie das Auge sie wiegt</translation>
    </message>
    <message>
        <source>No venue is open.</source>
        <translation>Es ist kein Ort geöffnet.</translation>
    </message>
    <message>
        <source>The sets are as they were.</source>
        <translation>Die Varianten sind, wie sie waren.</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>Variante</translation>
    </message>
    <message>
        <source>Without a name</source>
        <translation>Ohne Namen</translation>
    </message>
    <message>
        <source>More</source>
        <translation>Mehr</translation>
    </message>
    <message>
        <source>More for the set</source>
        <translation>Mehr zur Variante</translation>
    </message>
    <message>
        <source>Save as…</source>
        <translation>Speichern als…</translation>
    </message>
    <message>
        <source>Rename…</source>
        <translation>Umbenennen…</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>It is placed automatically.</source>
        <translation>Es ist automatisch platziert.</translation>
    </message>
    <message>
        <source>A picture is on the surface.</source>
        <translation>Ein Bild ist auf der Fläche.</translation>
    </message>
    <message>
        <source>The output is open. Close it first.</source>
        <translation>Die Ausgabe ist offen. Erst schließen.</translation>
    </message>
    <message>
        <source>Shine on %1</source>
        <translation>Auf %1 werfen</translation>
    </message>
    <message>
        <source>A rehearsal has no surface: this lights the screen %1 until you stop it or leave.</source>
        <translation>Eine Probe hat keine Fläche: Dies leuchtet auf dem Bildschirm %1, bis Sie es beenden oder weggehen.</translation>
    </message>
    <message>
        <source>Part of the picture lies where the view is left out.</source>
        <translation>Ein Teil des Bildes liegt dort, wo der Blick ausgelassen ist.</translation>
    </message>
    <message>
        <source>It stays uncorrected. Acquire says why.</source>
        <translation>Er bleibt unkorrigiert. Warum, steht bei Erfassen.</translation>
    </message>
    <message>
        <source>Predicted from the measurement. The output stays as it is.</source>
        <translation>Aus der Messung vorhergesagt. Die Ausgabe bleibt, wie sie ist.</translation>
    </message>
    <message>
        <source>The content was placed on another measurement or threshold</source>
        <translation>Der Inhalt wurde auf einer anderen Messung oder Schwelle platziert</translation>
    </message>
    <message>
        <source>To shine on the surface, close the output first.</source>
        <translation>Um das Bild auf die Fläche zu werfen, schließen Sie zuerst die Ausgabe.</translation>
    </message>
    <message>
        <source>Uncorrected, in blocks of %1 px</source>
        <translation>Unkorrigiert, in Blöcken von %1 px</translation>
    </message>
    <message>
        <source>Predicted from the measurement. Another program&apos;s show is projected.</source>
        <translation>Aus der Messung vorhergesagt. Projiziert wird die Show eines anderen Programms.</translation>
    </message>
    <message>
        <source>The preview is being prepared.</source>
        <translation>Die Vorschau wird vorbereitet.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::RenameDialog</name>
    <message>
        <source>Rename a venue</source>
        <translation>Spielort umbenennen</translation>
    </message>
    <message>
        <source>Its folder has the same name and is renamed with it. A show that starts at log-in follows.</source>
        <translation>Sein Ordner heißt ebenso und wird mit umbenannt. Eine Show, die bei der Anmeldung startet, folgt ihm.</translation>
    </message>
    <message>
        <source>Rename</source>
        <translation>Umbenennen</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Session</name>
    <message>
        <source>%1 is at work. What is chosen here can be kept when that has ended.</source>
        <translation>%1 arbeitet gerade. Was Sie hier wählen, kann danach übernommen werden.</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>Geräte in Gebrauch: %1.</translation>
    </message>
    <message>
        <source>Confirm that the room is clear.</source>
        <translation>Erst bestätigen: Raum geräumt.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::SetNameDialog</name>
    <message>
        <source>Save as a set</source>
        <translation>Als Variante speichern</translation>
    </message>
    <message>
        <source>Rename a set</source>
        <translation>Variante umbenennen</translation>
    </message>
    <message>
        <source>Day, night, school class</source>
        <translation>Tag, Nacht, Schulklasse</translation>
    </message>
    <message>
        <source>What you see becomes this set, and is changed in it from now on.</source>
        <translation>Was Sie sehen, wird diese Variante und ab jetzt in ihr geändert.</translation>
    </message>
    <message>
        <source>Playlists and controllers that call it by its present name have to be changed, too.</source>
        <translation>Wiedergabelisten und Steuerungen, die sie bei ihrem jetzigen Namen nennen, müssen auch geändert werden.</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>Speichern</translation>
    </message>
    <message>
        <source>Rename</source>
        <translation>Umbenennen</translation>
    </message>
    <message>
        <source>There is a set of this name already.</source>
        <translation>Es gibt schon eine Variante dieses Namens.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::SetTimesDialog</name>
    <message>
        <source>Sets by the time of the day</source>
        <translation>Varianten nach der Tageszeit</translation>
    </message>
    <message>
        <source>From each time on the installed show plays that set, every day, until the next time.</source>
        <translation>Ab jeder Zeit spielt die installierte Show diese Variante, täglich, bis zur nächsten Zeit.</translation>
    </message>
    <message>
        <source>From this time on</source>
        <translation>Ab dieser Zeit</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>Variante</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Hinzufügen</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Apply</source>
        <translation>Übernehmen</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1: %2</translation>
    </message>
    <message>
        <source>There are no times yet.</source>
        <translation>Es gibt noch keine Zeiten.</translation>
    </message>
    <message>
        <source>Type a time of the day, such as %1.</source>
        <translation>Eine Tageszeit eingeben, zum Beispiel %1.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::SettingsDialog</name>
    <message>
        <source>Settings</source>
        <translation>Optionen</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>Look</source>
        <translation>Aussehen</translation>
    </message>
    <message>
        <source>Dark</source>
        <translation>Dunkel</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Hell</translation>
    </message>
    <message>
        <source>Theme. The dark one is for the dark room.</source>
        <translation>Farbschema. Das dunkle ist für den dunklen Raum.</translation>
    </message>
    <message>
        <source>Dim pictures: the laptop is room light</source>
        <translation>Bilder dimmen: Der Laptop ist Raumlicht</translation>
    </message>
    <message>
        <source>As the computer</source>
        <translation>Wie der Computer</translation>
    </message>
    <message>
        <source>Language</source>
        <translation>Sprache</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>Messung</translation>
    </message>
    <message>
        <source>As quickly as the devices can, after a consent</source>
        <translation>So schnell die Geräte können, nach Zustimmung</translation>
    </message>
    <message numerus="yes">
        <source>At most %n change(s) a second</source>
        <translation>
            <numerusform>Höchstens %n Wechsel je Sekunde</numerusform>
            <numerusform>Höchstens %n Wechsel je Sekunde</numerusform>
        </translation>
    </message>
    <message>
        <source>Flashing light of the projector</source>
        <translation>Lichtblitze des Projektors</translation>
    </message>
    <message>
        <source>More than three changes a second can cause seizures. Slower measuring needs no consent.</source>
        <translation>Mehr als drei Wechsel je Sekunde können Anfälle auslösen. Langsameres Messen braucht keine Zustimmung.</translation>
    </message>
    <message>
        <source>A sound when a measurement ends</source>
        <translation>Ton am Ende einer Messung</translation>
    </message>
    <message>
        <source>New venues</source>
        <translation>Neue Spielorte</translation>
    </message>
    <message>
        <source>Folder for new venues</source>
        <translation>Ordner für neue Spielorte</translation>
    </message>
    <message>
        <source>Choose a folder</source>
        <translation>Ordner wählen</translation>
    </message>
    <message>
        <source>Folder</source>
        <translation>Ordner</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Show</name>
    <message>
        <source>A show is playing.</source>
        <translation>Eine Show läuft.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StatusPage</name>
    <message>
        <source>State</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>Updated</source>
        <translation>Aktualisiert</translation>
    </message>
    <message>
        <source>Computed on</source>
        <translation>Berechnet auf</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>Bilder</translation>
    </message>
    <message>
        <source>Late frames</source>
        <translation>Verspätete Bilder</translation>
    </message>
    <message>
        <source>Frames per second</source>
        <translation>Bilder pro Sekunde</translation>
    </message>
    <message>
        <source>Time per frame (ms)</source>
        <translation>Zeit pro Bild (ms)</translation>
    </message>
    <message>
        <source>Delay behind the viewer (ms)</source>
        <translation>Verzögerung hinter dem Betrachter (ms)</translation>
    </message>
    <message>
        <source>Clipped share</source>
        <translation>Übersteuerter Anteil</translation>
    </message>
    <message>
        <source>Steps</source>
        <translation>Schritte</translation>
    </message>
    <message>
        <source>Perfected</source>
        <translation>Perfektioniert</translation>
    </message>
    <message>
        <source>Item</source>
        <translation>Eintrag</translation>
    </message>
    <message>
        <source>Items skipped</source>
        <translation>Übersprungene Einträge</translation>
    </message>
    <message>
        <source>Failures</source>
        <translation>Fehlschläge</translation>
    </message>
    <message>
        <source>Most memory used (bytes)</source>
        <translation>Höchster Speicherbedarf (Bytes)</translation>
    </message>
    <message>
        <source>Displays</source>
        <translation>Anzeigen</translation>
    </message>
    <message>
        <source>Connector</source>
        <translation>Anschluss</translation>
    </message>
    <message>
        <source>Shining</source>
        <translation>Leuchtet</translation>
    </message>
    <message>
        <source>Drawn by</source>
        <translation>Gezeichnet mit</translation>
    </message>
    <message>
        <source>Projectors</source>
        <translation>Projektoren</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>Projektor</translation>
    </message>
    <message>
        <source>Address</source>
        <translation>Adresse</translation>
    </message>
    <message>
        <source>Answers</source>
        <translation>Antwortet</translation>
    </message>
    <message>
        <source>Problem</source>
        <translation>Problem</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>Modell</translation>
    </message>
    <message>
        <source>Power</source>
        <translation>Stromversorgung</translation>
    </message>
    <message>
        <source>Shutter</source>
        <translation>Verschluss</translation>
    </message>
    <message>
        <source>Lamp hours</source>
        <translation>Lampenstunden</translation>
    </message>
    <message>
        <source>Filter hours</source>
        <translation>Filterstunden</translation>
    </message>
    <message>
        <source>Input</source>
        <translation>Eingang</translation>
    </message>
    <message>
        <source>Signal</source>
        <translation>Signal</translation>
    </message>
    <message>
        <source>Own pixels</source>
        <translation>Eigene Pixel</translation>
    </message>
    <message>
        <source>Remarks</source>
        <translation>Bemerkungen</translation>
    </message>
    <message>
        <source>yes</source>
        <translation>ja</translation>
    </message>
    <message>
        <source>no</source>
        <translation>nein</translation>
    </message>
    <message>
        <source>Relucent: %1</source>
        <translation>Relucent: %1</translation>
    </message>
    <message>
        <source>Alarm</source>
        <translation>Alarm</translation>
    </message>
    <message>
        <source>Last night</source>
        <translation>Letzte Nacht</translation>
    </message>
    <message>
        <source>When</source>
        <translation>Wann</translation>
    </message>
    <message>
        <source>Outcome</source>
        <translation>Ergebnis</translation>
    </message>
    <message>
        <source>Pictures perfected</source>
        <translation>Perfektionierte Bilder</translation>
    </message>
    <message>
        <source>Colour error (ΔE)</source>
        <translation>Farbfehler (ΔE)</translation>
    </message>
    <message>
        <source>Predicted colour error (ΔE)</source>
        <translation>Vorhergesagter Farbfehler (ΔE)</translation>
    </message>
    <message>
        <source>Nobody was told</source>
        <translation>Niemand wurde verständigt</translation>
    </message>
    <message>
        <source>Next night</source>
        <translation>Nächste Nacht</translation>
    </message>
    <message>
        <source>Somebody has to look</source>
        <translation>Jemand muss nachsehen</translation>
    </message>
    <message>
        <source>Watched by camera</source>
        <translation>Von Kamera überwacht</translation>
    </message>
    <message>
        <source>Photographs</source>
        <translation>Aufnahmen</translation>
    </message>
    <message>
        <source>Photographs used</source>
        <translation>Verwendete Aufnahmen</translation>
    </message>
    <message>
        <source>Share that can be told</source>
        <translation>Beurteilbarer Anteil</translation>
    </message>
    <message>
        <source>Time per photograph (ms)</source>
        <translation>Zeit pro Aufnahme (ms)</translation>
    </message>
    <message>
        <source>What has changed</source>
        <translation>Was sich geändert hat</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>Art</translation>
    </message>
    <message>
        <source>How much</source>
        <translation>Wie viel</translation>
    </message>
    <message>
        <source>What happened</source>
        <translation>Was geschehen ist</translation>
    </message>
    <message>
        <source>What to do</source>
        <translation>Was zu tun ist</translation>
    </message>
    <message>
        <source>Delay of the live picture (ms)</source>
        <translation>Verzögerung des Live-Bildes (ms)</translation>
    </message>
    <message>
        <source>Streams</source>
        <translation>Streams</translation>
    </message>
    <message>
        <source>Losses</source>
        <translation>Verluste</translation>
    </message>
    <message>
        <source>Pixels</source>
        <translation>Pixel</translation>
    </message>
    <message>
        <source>Time from the sender, by its clock (ms)</source>
        <translation>Zeit vom Sender, nach dessen Uhr (ms)</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>Variante</translation>
    </message>
    <message>
        <source>Black</source>
        <translation>Schwarz</translation>
    </message>
    <message>
        <source>Frozen</source>
        <translation>Eingefroren</translation>
    </message>
    <message>
        <source>Corrected</source>
        <translation>Korrigiert</translation>
    </message>
    <message>
        <source>Brightness</source>
        <translation>Helligkeit</translation>
    </message>
    <message>
        <source>Test chart</source>
        <translation>Testbild</translation>
    </message>
    <message>
        <source>starting</source>
        <translation>startet</translation>
    </message>
    <message>
        <source>playing</source>
        <translation>läuft</translation>
    </message>
    <message>
        <source>resting until its hours</source>
        <translation>ruht bis zu ihren Stunden</translation>
    </message>
    <message>
        <source>photographing</source>
        <translation>fotografiert</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>gescheitert</translation>
    </message>
    <message>
        <source>stopped</source>
        <translation>angehalten</translation>
    </message>
    <message>
        <source>connecting</source>
        <translation>verbindet</translation>
    </message>
    <message>
        <source>asking whether it may</source>
        <translation>fragt um Erlaubnis</translation>
    </message>
    <message>
        <source>lost</source>
        <translation>verloren</translation>
    </message>
    <message>
        <source>opening</source>
        <translation>öffnet</translation>
    </message>
    <message>
        <source>watching</source>
        <translation>beobachtet</translation>
    </message>
    <message>
        <source>paused</source>
        <translation>pausiert</translation>
    </message>
    <message>
        <source>no camera</source>
        <translation>keine Kamera</translation>
    </message>
    <message>
        <source>no calibration</source>
        <translation>keine Kalibrierung</translation>
    </message>
    <message>
        <source>black, until somebody ends it</source>
        <translation>schwarz, bis jemand es beendet</translation>
    </message>
    <message>
        <source>test chart</source>
        <translation>Testbild</translation>
    </message>
    <message>
        <source>frozen, until somebody ends it</source>
        <translation>eingefroren, bis jemand es beendet</translation>
    </message>
    <message>
        <source>playing, but no display shows it</source>
        <translation>läuft, aber kein Bildschirm zeigt es</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StatusStrip</name>
    <message>
        <source>Projector</source>
        <translation>Projektor</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Kamera</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>Laufwerk</translation>
    </message>
    <message>
        <source>none chosen</source>
        <translation>nicht gewählt</translation>
    </message>
    <message>
        <source>%1 free</source>
        <translation>%1 frei</translation>
    </message>
    <message>
        <source>simulated</source>
        <translation>simuliert</translation>
    </message>
    <message>
        <source>by script</source>
        <translation>per Skript</translation>
    </message>
    <message>
        <source>%1, in use</source>
        <translation>%1, belegt</translation>
    </message>
    <message>
        <source>Saved %1</source>
        <translation>Gespeichert %1</translation>
    </message>
    <message>
        <source>Room light</source>
        <translation>Raumlicht</translation>
    </message>
    <message>
        <source>%1, unplugged</source>
        <translation>%1, nicht angesteckt</translation>
    </message>
    <message>
        <source>%1 of full light, steady</source>
        <translation>%1 des vollen Lichts, stabil</translation>
    </message>
    <message>
        <source>%1 of full light, changed</source>
        <translation>%1 des vollen Lichts, verändert</translation>
    </message>
    <message>
        <source>%1, silent</source>
        <translation>%1, stumm</translation>
    </message>
    <message numerus="yes">
        <source>%n screen(s)</source>
        <translation>
            <numerusform>%n Bildschirm</numerusform>
            <numerusform>%n Bildschirme</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n with %1, %2</source>
        <comment>projectors and their pixels</comment>
        <translation>
            <numerusform>%n mit %1, %2</numerusform>
            <numerusform>%n mit %1, %2</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n, simulated</source>
        <comment>cameras</comment>
        <translation>
            <numerusform>%n, simuliert</numerusform>
            <numerusform>%n, simuliert</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n camera(s)</source>
        <translation>
            <numerusform>%n Kamera</numerusform>
            <numerusform>%n Kameras</numerusform>
        </translation>
    </message>
    <message>
        <source>none in use</source>
        <translation>nicht in Gebrauch</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StepRail</name>
    <message>
        <source>locked</source>
        <translation>gesperrt</translation>
    </message>
    <message>
        <source>done</source>
        <translation>fertig</translation>
    </message>
    <message>
        <source>out of date</source>
        <translation>veraltet</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>gescheitert</translation>
    </message>
    <message>
        <source>current</source>
        <translation>aktuell</translation>
    </message>
    <message>
        <source>open</source>
        <translation>offen</translation>
    </message>
    <message>
        <source>Step %1, %2, %3</source>
        <translation>Schritt %1, %2, %3</translation>
    </message>
    <message>
        <source>No venue open</source>
        <translation>Kein Spielort offen</translation>
    </message>
    <message>
        <source>stopped early</source>
        <translation>vorzeitig gestoppt</translation>
    </message>
    <message>
        <source>under way</source>
        <translation>läuft</translation>
    </message>
    <message>
        <source>doubtful</source>
        <translation>zweifelhaft</translation>
    </message>
    <message>
        <source>Opens once %1 is done.</source>
        <translation>Öffnet sich, wenn „%1“ fertig ist.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StreamDialog</name>
    <message>
        <source>Add a stream</source>
        <translation>Stream hinzufügen</translation>
    </message>
    <message>
        <source>A live picture from the network, without its sound: RTSP, SRT, RTP, UDP, HTTP or RTMP. While it plays, this computer is connected to that address.</source>
        <translation>Ein Live-Bild aus dem Netz, ohne seinen Ton: RTSP, SRT, RTP, UDP, HTTP oder RTMP. Solange es spielt, ist dieser Rechner mit der Adresse verbunden.</translation>
    </message>
    <message>
        <source>Address</source>
        <translation>Adresse</translation>
    </message>
    <message>
        <source>User name and password stand before the host, as in rtsp://user:password@host. They are kept in the playlist, and shown nowhere.</source>
        <translation>Benutzername und Kennwort stehen vor dem Host, wie in rtsp://user:password@host. Sie werden in der Playlist aufbewahrt und nirgends angezeigt.</translation>
    </message>
    <message>
        <source>While it is lost</source>
        <translation>Solange er verloren ist</translation>
    </message>
    <message>
        <source>Its last picture</source>
        <translation>Sein letztes Bild</translation>
    </message>
    <message>
        <source>Black</source>
        <translation>Schwarz</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Hinzufügen</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ThresholdPage</name>
    <message>
        <source>%1 of light kept</source>
        <translation>%1 Licht behalten</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>Veraltet</translation>
    </message>
    <message>
        <source>Reading the light transport</source>
        <translation>Lesen des Lichttransports</translation>
    </message>
    <message>
        <source>Below 95 % of the light, bounces are lost.</source>
        <translation>Unter 95 % des Lichts gehen Reflexionen verloren.</translation>
    </message>
    <message>
        <source>Next: groups of pixels that can be solved on their own</source>
        <translation>Als Nächstes: Pixelgruppen, die sich einzeln lösen lassen</translation>
    </message>
    <message>
        <source>Group into clusters</source>
        <translation>Cluster bilden</translation>
    </message>
    <message>
        <source>The threshold was chosen for an earlier measurement</source>
        <translation>Die Schwelle wurde für eine frühere Messung gewählt</translation>
    </message>
    <message>
        <source>Look at it again, then go on.</source>
        <translation>Sehen Sie sie noch einmal an, dann gehen Sie weiter.</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>Das Gemessene ist sicher.</translation>
    </message>
    <message>
        <source>Threshold</source>
        <translation>Schwelle</translation>
    </message>
    <message>
        <source>Choose the faintest light worth keeping. Less is faster and smaller; too little loses the bounces.</source>
        <translation>Wählen Sie das schwächste Licht, das sich zu behalten lohnt. Weniger ist schneller und kleiner; bei zu wenig fehlen die Reflexionen.</translation>
    </message>
    <message>
        <source>Camera view</source>
        <translation>Kamerabild</translation>
    </message>
    <message>
        <source>The surface in full light</source>
        <translation>Die Oberfläche im Volllicht</translation>
    </message>
    <message>
        <source>Pixel %1, %2</source>
        <translation>Pixel %1, %2</translation>
    </message>
    <message>
        <source>Projector pixels that light the picked camera pixel</source>
        <translation>Projektorpixel, die das gewählte Kamerapixel beleuchten</translation>
    </message>
    <message>
        <source>Pick a pixel in the camera view.</source>
        <translation>Wählen Sie ein Pixel im Kamerabild.</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Kamera</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>Projektor</translation>
    </message>
    <message>
        <source>transport</source>
        <translation>Transport</translation>
    </message>
    <message>
        <source>Transport matrix</source>
        <translation>Transportmatrix</translation>
    </message>
    <message>
        <source>click an entry</source>
        <translation>Eintrag anklicken</translation>
    </message>
    <message>
        <source>Light transport matrix, camera pixels down, projector pixels across</source>
        <translation>Lichttransportmatrix, Kamerapixel senkrecht, Projektorpixel waagerecht</translation>
    </message>
    <message>
        <source>Transport value, camera signal a second</source>
        <translation>Transportwert, Kamerasignal je Sekunde</translation>
    </message>
    <message>
        <source>How much light flows through each connection</source>
        <translation>Wie viel Licht durch jede Verbindung fließt</translation>
    </message>
    <message>
        <source>drag the cut, or use the arrow keys</source>
        <translation>Schnitt ziehen oder Pfeiltasten nutzen</translation>
    </message>
    <message>
        <source>Connections</source>
        <translation>Verbindungen</translation>
    </message>
    <message>
        <source>Cut</source>
        <translation>Schnitt</translation>
    </message>
    <message>
        <source>Cut at %1, keeps %2</source>
        <translation>Schnitt bei %1, behält %2</translation>
    </message>
    <message>
        <source>Everything is kept</source>
        <translation>Alles bleibt</translation>
    </message>
    <message>
        <source>Leave out light below</source>
        <translation>Licht weglassen unter</translation>
    </message>
    <message>
        <source>One value</source>
        <translation>Ein Wert</translation>
    </message>
    <message>
        <source>What stays</source>
        <translation>Was bleibt</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Licht</translation>
    </message>
    <message>
        <source>Memory</source>
        <translation>Arbeitsspeicher</translation>
    </message>
    <message>
        <source>What is left out is put back in proportion, so that the surface keeps its brightness.</source>
        <translation>Weggelassenes wird anteilig wieder zugegeben, damit die Oberfläche ihre Helligkeit behält.</translation>
    </message>
    <message>
        <source>Picked pixel</source>
        <translation>Gewähltes Pixel</translation>
    </message>
    <message>
        <source>Lit by</source>
        <translation>Beleuchtet von</translation>
    </message>
    <message>
        <source>Strongest</source>
        <translation>Stärkstes</translation>
    </message>
    <message>
        <source>From around it</source>
        <translation>Aus der Umgebung</translation>
    </message>
    <message>
        <source>Light from elsewhere</source>
        <translation>Licht von anderswo</translation>
    </message>
    <message>
        <source>Use suggested, %1</source>
        <translation>Vorschlag nutzen, %1</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 von %2</translation>
    </message>
    <message>
        <source>Picked pixel %1, %2</source>
        <translation>Gewähltes Pixel %1, %2</translation>
    </message>
    <message numerus="yes">
        <source>%n pixel(s)</source>
        <translation>
            <numerusform>%n Pixel</numerusform>
            <numerusform>%n Pixel</numerusform>
        </translation>
    </message>
    <message>
        <source>Cut, camera signal a second</source>
        <translation>Schnitt, Kamerasignal je Sekunde</translation>
    </message>
    <message>
        <source>Use picked pixel</source>
        <translation>Gewähltes Pixel nehmen</translation>
    </message>
    <message>
        <source>For each camera pixel</source>
        <translation>Für jedes Kamerapixel</translation>
    </message>
    <message>
        <source>Suggested: three times the noise of the measurement.</source>
        <translation>Vorschlag: das Dreifache des Rauschens der Messung.</translation>
    </message>
    <message>
        <source>Suggested: keeps nearly all of the light.</source>
        <translation>Vorschlag: behält fast alles Licht.</translation>
    </message>
    <message>
        <source>%1 on average</source>
        <translation>%1 im Mittel</translation>
    </message>
    <message>
        <source>Kind of cut</source>
        <translation>Art des Schnitts</translation>
    </message>
    <message>
        <source>Share of each pixel</source>
        <translation>Anteil je Pixel</translation>
    </message>
    <message>
        <source>Share of the strongest light of each camera pixel, in tenths of a percent</source>
        <translation>Anteil am stärksten Licht jedes Kamerapixels, in Zehntelprozent</translation>
    </message>
    <message>
        <source>Below %1 of the strongest light that each camera pixel gets</source>
        <translation>Unter %1 des stärksten Lichts, das jedes Kamerapixel bekommt</translation>
    </message>
    <message>
        <source>Of each camera pixel the strongest connection always stays, however high the cut.</source>
        <translation>Von jedem Kamerapixel bleibt immer die stärkste Verbindung, wie hoch der Schnitt auch liegt.</translation>
    </message>
    <message>
        <source>“%1” is not a cut: type a number, 0 or more. The cut is still %2.</source>
        <translation>„%1“ ist kein Schnitt: Geben Sie eine Zahl ab 0 ein. Der Schnitt liegt weiter bei %2.</translation>
    </message>
    <message>
        <source>At three times the noise, %1, only %2 of the light would stay: much faint light adds up. Suggested: keep everything.</source>
        <translation>Beim Dreifachen des Rauschens, %1, blieben nur %2 des Lichts: Viel schwaches Licht summiert sich. Vorschlag: alles behalten.</translation>
    </message>
    <message>
        <source>Keep everything</source>
        <translation>Alles behalten</translation>
    </message>
    <message>
        <source>Changed: it is applied as soon as you go on.</source>
        <translation>Geändert: Es gilt, sobald Sie weitergehen.</translation>
    </message>
    <message>
        <source>What was measured is being read.</source>
        <translation>Die Messung wird gelesen.</translation>
    </message>
    <message>
        <source>Pick a pixel in a picture.</source>
        <translation>Wählen Sie ein Pixel in einem Bild.</translation>
    </message>
    <message>
        <source>It is in use.</source>
        <translation>Wird bereits verwendet.</translation>
    </message>
    <message>
        <source>No light of the picked pixel was kept.</source>
        <translation>Vom gewählten Pixel blieb kein Licht.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::TidyDialog</name>
    <message>
        <source>All</source>
        <translation>Alle</translation>
    </message>
    <message>
        <source>Of the latest measurement</source>
        <translation>Die der letzten Messung</translation>
    </message>
    <message>
        <source>None: results only</source>
        <translation>Keine: nur Ergebnisse</translation>
    </message>
    <message>
        <source>Only what nothing reads goes, and old files are compressed without loss.</source>
        <translation>Es geht nur, was nichts mehr liest; alte Dateien werden verlustfrei komprimiert.</translation>
    </message>
    <message>
        <source>Those that were set aside by measuring again go too. Nothing reads them.</source>
        <translation>Auch beim erneuten Messen beiseitegelegte Fotos gehen. Nichts liest sie.</translation>
    </message>
    <message>
        <source>All that was measured and computed stays. The photographs go.</source>
        <translation>Alles Gemessene und Berechnete bleibt. Die Fotos gehen.</translation>
    </message>
    <message>
        <source>Showing, checking and reports need results only. Other settings, and better methods of later versions, then have to photograph everything again.</source>
        <translation>Vorführen, Prüfen und Berichte brauchen nur Ergebnisse. Für andere Einstellungen und bessere Verfahren späterer Versionen muss dann alles neu fotografiert werden.</translation>
    </message>
    <message numerus="yes">
        <source>%n photograph(s)</source>
        <translation>
            <numerusform>%n Foto</numerusform>
            <numerusform>%n Fotos</numerusform>
        </translation>
    </message>
    <message>
        <source>What was freed until then is free. Nothing that is needed is lost.</source>
        <translation>Was bis dahin frei wurde, ist frei. Nichts, was gebraucht wird, ist verloren.</translation>
    </message>
    <message>
        <source>Photographs to keep</source>
        <translation>Fotos behalten</translation>
    </message>
    <message>
        <source>This venue is not measured to the end.</source>
        <translation>Dieser Spielort ist nicht zu Ende gemessen.</translation>
    </message>
    <message>
        <source>All its photographs stay: going on needs them.</source>
        <translation>Alle seine Fotos bleiben: Das Weitermessen braucht sie.</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Zurück</translation>
    </message>
    <message>
        <source>Freeing the disk</source>
        <translation>Das Laufwerk wird freigegeben</translation>
    </message>
    <message>
        <source>%1 will be removed for good.</source>
        <translation>%1 werden endgültig entfernt.</translation>
    </message>
    <message>
        <source>%1 will be freed.</source>
        <translation>%1 werden frei.</translation>
    </message>
    <message>
        <source>%1 freed, %2 removed</source>
        <translation>%1 frei geworden, %2 entfernt</translation>
    </message>
    <message>
        <source>%1 Nothing that is needed is lost.</source>
        <translation>%1 Nichts, was gebraucht wird, ist verloren.</translation>
    </message>
    <message>
        <source>frees %1</source>
        <translation>%1 werden frei</translation>
    </message>
    <message>
        <source>nothing to free</source>
        <translation>nichts frei zu machen</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Stopp</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>Free %1…</source>
        <translation>%1 freigeben…</translation>
    </message>
    <message>
        <source>Free %1</source>
        <translation>%1 freigeben</translation>
    </message>
    <message>
        <source>No photograph goes: everything stays possible.</source>
        <translation>Kein Foto geht: Alles bleibt möglich.</translation>
    </message>
    <message>
        <source>The latest measurement keeps its photographs: everything stays possible.</source>
        <translation>Die letzte Messung behält ihre Fotos: Alles bleibt möglich.</translation>
    </message>
    <message>
        <source>Looking up what could be freed. Nothing is removed yet.</source>
        <translation>Es wird nachgesehen, was frei werden kann. Noch wird nichts entfernt.</translation>
    </message>
    <message>
        <source>Free disk space</source>
        <translation>Speicherplatz schaffen</translation>
    </message>
    <message>
        <source>Disk space of %1</source>
        <translation>Speicherplatz von %1</translation>
    </message>
    <message>
        <source>Freeing space was stopped.</source>
        <translation>Das Freigeben wurde abgebrochen.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VenueNetwork</name>
    <message>
        <source>“%1” is no network address of a projector. Write its number or name, as 192.168.1.50.</source>
        <translation>„%1“ ist keine Netzwerkadresse eines Projektors. Geben Sie ihre Nummer oder ihren Namen an, etwa 192.168.1.50.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VenuePage</name>
    <message>
        <source>Unplugged. Plug it in or choose another.</source>
        <translation>Getrennt. Schließen Sie ihn an oder wählen Sie einen anderen.</translation>
    </message>
    <message>
        <source>%1, %2 by %3, chosen</source>
        <translation>%1, %2 mal %3, gewählt</translation>
    </message>
    <message>
        <source>%1, %2 by %3</source>
        <translation>%1, %2 mal %3</translation>
    </message>
    <message>
        <source>Screens</source>
        <translation>Bildschirme</translation>
    </message>
    <message>
        <source>Choose the one that shines on the surface. Its pixels are the projector&apos;s.</source>
        <translation>Wählen Sie den, der auf die Oberfläche strahlt. Seine Pixel sind die des Projektors.</translation>
    </message>
    <message>
        <source>Identify screens</source>
        <translation>Identifizieren</translation>
    </message>
    <message>
        <source>I</source>
        <translation>I</translation>
    </message>
    <message>
        <source>The projector shares your screen</source>
        <translation>Der Projektor nutzt Ihren Bildschirm mit</translation>
    </message>
    <message>
        <source>Real devices</source>
        <translation>Reale Geräte</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>Projektor</translation>
    </message>
    <message>
        <source>Glossy corner</source>
        <translation>Glänzende Ecke</translation>
    </message>
    <message>
        <source>Light bounces between two cards</source>
        <translation>Zwei Karten werfen sich Licht zu</translation>
    </message>
    <message>
        <source>Bust before a brick wall</source>
        <translation>Büste vor Ziegelwand</translation>
    </message>
    <message>
        <source>Texture, shadow and light between surfaces</source>
        <translation>Textur, Schatten und Licht zwischen Oberflächen</translation>
    </message>
    <message>
        <source>Many depths</source>
        <translation>Viele Tiefen</translation>
    </message>
    <message>
        <source>Some surfaces are out of focus</source>
        <translation>Einige Oberflächen sind unscharf</translation>
    </message>
    <message>
        <source>Dome</source>
        <translation>Kuppel</translation>
    </message>
    <message>
        <source>Every part lights every other part</source>
        <translation>Jeder Teil beleuchtet jeden anderen</translation>
    </message>
    <message>
        <source>Wine glass</source>
        <translation>Weinglas</translation>
    </message>
    <message>
        <source>Light is refracted both ways</source>
        <translation>Licht wird auf beiden Wegen gebrochen</translation>
    </message>
    <message>
        <source>Painted wall</source>
        <translation>Bemalte Wand</translation>
    </message>
    <message>
        <source>Flat, with diamonds; the easiest</source>
        <translation>Eben, mit Rauten; am einfachsten</translation>
    </message>
    <message>
        <source>%1, a first look</source>
        <translation>%1, erster Blick</translation>
    </message>
    <message>
        <source>%1, quick</source>
        <translation>%1, schnell</translation>
    </message>
    <message>
        <source>%1, usual</source>
        <translation>%1, üblich</translation>
    </message>
    <message>
        <source>%1, fine</source>
        <translation>%1, fein</translation>
    </message>
    <message>
        <source>Venue</source>
        <translation>Spielort</translation>
    </message>
    <message>
        <source>Rehearse in a simulated venue</source>
        <translation>Am simulierten Spielort proben</translation>
    </message>
    <message>
        <source>New venue by script</source>
        <translation>Neuer Spielort per Skript</translation>
    </message>
    <message>
        <source>New venue</source>
        <translation>Neuer Spielort</translation>
    </message>
    <message>
        <source>Say which screen shines, which programs show and photograph, and where the work is kept.</source>
        <translation>Geben Sie an, welcher Bildschirm strahlt, welche Programme zeigen und fotografieren und wo die Arbeit liegt.</translation>
    </message>
    <message>
        <source>Setting up</source>
        <translation>Einrichtung</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1, %2</translation>
    </message>
    <message>
        <source>simulated, %1</source>
        <translation>simuliert, %1</translation>
    </message>
    <message>
        <source>by script, %1</source>
        <translation>per Skript, %1</translation>
    </message>
    <message>
        <source>%1 is open</source>
        <translation>%1 ist offen</translation>
    </message>
    <message>
        <source>Enter opens the highlighted choice</source>
        <translation>Eingabe öffnet die markierte Auswahl</translation>
    </message>
    <message>
        <source>Check camera</source>
        <translation>Kamera prüfen</translation>
    </message>
    <message>
        <source>Start rehearsal</source>
        <translation>Probe starten</translation>
    </message>
    <message>
        <source>Nothing was changed in that folder.</source>
        <translation>In diesem Ordner wurde nichts geändert.</translation>
    </message>
    <message>
        <source>Give the venue a name.</source>
        <translation>Geben Sie dem Spielort einen Namen.</translation>
    </message>
    <message>
        <source>A name cannot hold a slash.</source>
        <translation>Ein Name darf keinen Schrägstrich enthalten.</translation>
    </message>
    <message>
        <source>There is a folder of that name. Choose another name.</source>
        <translation>Einen Ordner dieses Namens gibt es schon. Wählen Sie einen anderen Namen.</translation>
    </message>
    <message>
        <source>Choose the screen that shines on the surface.</source>
        <translation>Wählen Sie den Bildschirm, der auf die Oberfläche strahlt.</translation>
    </message>
    <message>
        <source>Free %1 or choose another folder.</source>
        <translation>Geben Sie %1 frei oder wählen Sie einen anderen Ordner.</translation>
    </message>
    <message>
        <source>Confirm that the room is clear.</source>
        <translation>Bestätigen Sie, dass der Raum geräumt ist.</translation>
    </message>
    <message>
        <source>Nothing was measured yet.</source>
        <translation>Es wurde noch nichts gemessen.</translation>
    </message>
    <message>
        <source>Programs</source>
        <translation>Programme</translation>
    </message>
    <message>
        <source>Any projector and any camera that a command can drive</source>
        <translation>Jeder Projektor und jede Kamera, die ein Befehl steuern kann</translation>
    </message>
    <message>
        <source>Photographs {exposure} seconds into the file {output}: float EXR, 16-bit PNG or TIFF</source>
        <translation>Fotografiert {exposure} Sekunden in die Datei {output}: EXR (float), PNG oder TIFF mit 16 Bit</translation>
    </message>
    <message>
        <source>Projector&apos;s pixels</source>
        <translation>Pixel des Projektors</translation>
    </message>
    <message>
        <source>Width</source>
        <translation>Breite</translation>
    </message>
    <message>
        <source>Height</source>
        <translation>Höhe</translation>
    </message>
    <message>
        <source>Rehearsal. Opened %1</source>
        <translation>Probe. Geöffnet: %1</translation>
    </message>
    <message>
        <source>Opened %1</source>
        <translation>Geöffnet: %1</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Öffnen</translation>
    </message>
    <message>
        <source>Open %1</source>
        <translation>%1 öffnen</translation>
    </message>
    <message>
        <source>Open a venue</source>
        <translation>Spielort öffnen</translation>
    </message>
    <message>
        <source>Rehearse</source>
        <translation>Proben</translation>
    </message>
    <message>
        <source>Learn every step in a simulated venue. No devices needed.</source>
        <translation>Lernen Sie jeden Schritt an einem simulierten Spielort. Keine Geräte nötig.</translation>
    </message>
    <message>
        <source>Continue where you stopped, or change the content.</source>
        <translation>Machen Sie weiter, wo Sie aufgehört haben, oder ändern Sie den Inhalt.</translation>
    </message>
    <message>
        <source>Measure a surface with a projector and a camera at this computer.</source>
        <translation>Messen Sie eine Oberfläche mit einem Projektor und einer Kamera an diesem Computer.</translation>
    </message>
    <message>
        <source>Projector and camera are driven by programs of yours.</source>
        <translation>Projektor und Kamera werden von Ihren Programmen gesteuert.</translation>
    </message>
    <message>
        <source>Recent</source>
        <translation>Zuletzt</translation>
    </message>
    <message>
        <source>No venues yet</source>
        <translation>Noch keine Spielorte</translation>
    </message>
    <message>
        <source>The venues that you measure are listed here, newest first.</source>
        <translation>Hier stehen die Spielorte, die Sie messen, die neuesten zuerst.</translation>
    </message>
    <message>
        <source>A first rehearsal takes a few minutes.</source>
        <translation>Eine erste Probe dauert einige Minuten.</translation>
    </message>
    <message>
        <source>This venue</source>
        <translation>Dieser Spielort</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Name of the venue</source>
        <translation>Name des Spielorts</translation>
    </message>
    <message>
        <source>Folder</source>
        <translation>Ordner</translation>
    </message>
    <message>
        <source>Folder that holds the venue</source>
        <translation>Ordner, der den Spielort enthält</translation>
    </message>
    <message>
        <source>Choose a folder</source>
        <translation>Ordner wählen</translation>
    </message>
    <message>
        <source>Expected</source>
        <translation>Erwartet</translation>
    </message>
    <message>
        <source>Patterns</source>
        <translation>Muster</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>Laufwerk</translation>
    </message>
    <message>
        <source>about %1</source>
        <translation>etwa %1</translation>
    </message>
    <message>
        <source>Simulated devices</source>
        <translation>Simulierte Geräte</translation>
    </message>
    <message>
        <source>Pixels of the simulated projector</source>
        <translation>Pixel des simulierten Projektors</translation>
    </message>
    <message>
        <source>More pixels show finer detail and take longer. The first time, the light of the venue is traced; later it is remembered.</source>
        <translation>Mehr Pixel zeigen feinere Details und dauern länger. Beim ersten Mal wird das Licht des Spielorts berechnet; danach ist es gespeichert.</translation>
    </message>
    <message numerus="yes">
        <source>About %n pattern(s), %1</source>
        <translation>
            <numerusform>Etwa %n Muster, %1</numerusform>
            <numerusform>Etwa %n Muster, %1</numerusform>
        </translation>
    </message>
    <message>
        <source>Shows the file {image} and ends as soon as the projector shines it</source>
        <translation>Zeigt die Datei {image} und endet, sobald der Projektor sie ausstrahlt</translation>
    </message>
    <message>
        <source>Relief, two projectors</source>
        <translation>Relief, zwei Projektoren</translation>
    </message>
    <message>
        <source>Each shines into the other&apos;s shadows</source>
        <translation>Jeder leuchtet in die Schatten des anderen</translation>
    </message>
    <message>
        <source>The projector&apos;s screen</source>
        <translation>Bildschirm des Projektors</translation>
    </message>
    <message>
        <source>Say which screen the projector is now. What was measured stays.</source>
        <translation>Geben Sie an, welcher Bildschirm der Projektor jetzt ist. Das Gemessene bleibt.</translation>
    </message>
    <message>
        <source>Nothing is measured again.</source>
        <translation>Nichts wird neu gemessen.</translation>
    </message>
    <message>
        <source>Use this screen</source>
        <translation>Diesen Bildschirm verwenden</translation>
    </message>
    <message>
        <source>Change the screen</source>
        <translation>Bildschirm ändern</translation>
    </message>
    <message>
        <source>The projector&apos;s screen %1 is not there</source>
        <translation>Der Bildschirm %1 des Projektors fehlt</translation>
    </message>
    <message>
        <source>Plug it in, or say which screen the projector is now.</source>
        <translation>Stecken Sie ihn an, oder geben Sie an, welcher Bildschirm der Projektor jetzt ist.</translation>
    </message>
    <message>
        <source>%1 is not the folder of a venue: it has no %2 in it.</source>
        <translation>%1 ist nicht der Ordner eines Spielorts: %2 ist nicht darin.</translation>
    </message>
    <message numerus="yes">
        <source>There are %n venue(s) within it: open one of them.</source>
        <translation>
            <numerusform>Darin liegt %n Spielort: Öffnen Sie ihn.</numerusform>
            <numerusform>Darin liegen %n Spielorte: Öffnen Sie einen davon.</numerusform>
        </translation>
    </message>
    <message>
        <source>Choose a venue&apos;s own folder. It has the venue&apos;s name.</source>
        <translation>Wählen Sie den Ordner eines Spielorts. Er trägt dessen Namen.</translation>
    </message>
    <message>
        <source>This folder is not a venue</source>
        <translation>Dieser Ordner ist kein Spielort</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>Nichts wurde verändert.</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>Die Geräte werden gerade bei %1 verwendet.</translation>
    </message>
    <message>
        <source>Choose another screen.</source>
        <translation>Wählen Sie einen anderen Bildschirm.</translation>
    </message>
    <message>
        <source>Only your own screen is there. Plug the projector in, and extend the desktop to it.</source>
        <translation>Nur Ihr eigener Bildschirm ist da. Stecken Sie den Projektor an, und erweitern Sie den Desktop auf ihn.</translation>
    </message>
    <message>
        <source>Nothing is measured again</source>
        <translation>Nichts wird neu gemessen</translation>
    </message>
    <message>
        <source>Measured at</source>
        <translation>Gemessen an</translation>
    </message>
    <message>
        <source>Used at</source>
        <translation>Verwendet an</translation>
    </message>
    <message>
        <source>Pixels</source>
        <translation>Pixel</translation>
    </message>
    <message>
        <source>A screen is known again by its maker&apos;s names and serial number. Where it tells none, it is known by its connector: then a cable that is plugged in elsewhere has to be said here.</source>
        <translation>Ein Bildschirm wird an Hersteller, Modell und Seriennummer wiedererkannt. Nennt er keine, dann an seinem Anschluss: Ein umgestecktes Kabel muss dann hier angegeben werden.</translation>
    </message>
    <message>
        <source>Is open</source>
        <translation>Ist offen</translation>
    </message>
    <message>
        <source>Time, by camera</source>
        <translation>Dauer, je nach Kamera</translation>
    </message>
    <message>
        <source>Industrial cameras and video devices are fast, still cameras slow.</source>
        <translation>Industriekameras und Videogeräte sind schnell, Fotokameras langsam.</translation>
    </message>
    <message>
        <source>%1 to %2</source>
        <translation>%1 bis %2</translation>
    </message>
    <message>
        <source>%1 free</source>
        <translation>%1 frei</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 von %2</translation>
    </message>
    <message>
        <source>Free the disk of what %1 does not need</source>
        <translation>Laufwerk von dem befreien, was %1 nicht braucht</translation>
    </message>
    <message>
        <source>Resume</source>
        <translation>Fortsetzen</translation>
    </message>
    <message>
        <source>Resume %1</source>
        <translation>%1 fortsetzen</translation>
    </message>
    <message>
        <source>Free space…</source>
        <translation>Platz schaffen…</translation>
    </message>
    <message>
        <source>Somebody bumps the camera</source>
        <translation>Jemand stößt an die Kamera</translation>
    </message>
    <message>
        <source>A light is switched on</source>
        <translation>Ein Licht wird eingeschaltet</translation>
    </message>
    <message>
        <source>The camera&apos;s cable comes out</source>
        <translation>Das Kamerakabel rutscht heraus</translation>
    </message>
    <message>
        <source>Surprises</source>
        <translation>Überraschungen</translation>
    </message>
    <message>
        <source>Each comes once while Acquire measures, at a moment that nobody knows. Practise what the wizard says, before it happens in front of a client.</source>
        <translation>Jede kommt einmal, während Erfassen misst, zu einem Zeitpunkt, den niemand kennt. Üben Sie, was der Assistent dann sagt, bevor es vor Kunden geschieht.</translation>
    </message>
    <message>
        <source>Measures how a surface changes what is projected on it, and corrects pictures and films until they look right there.</source>
        <translation>Misst, wie eine Oberfläche Projiziertes verändert, und korrigiert Bilder und Filme, bis sie dort richtig aussehen.</translation>
    </message>
    <message>
        <source>Easy. Measuring takes %1</source>
        <translation>Leicht. Messdauer: %1</translation>
    </message>
    <message>
        <source>Medium. Measuring takes %1</source>
        <translation>Mittel. Messdauer: %1</translation>
    </message>
    <message>
        <source>Hard. Measuring takes %1</source>
        <translation>Schwer. Messdauer: %1</translation>
    </message>
    <message>
        <source>Name of %1</source>
        <translation>Name von %1</translation>
    </message>
    <message>
        <source>Projectors</source>
        <translation>Projektoren</translation>
    </message>
    <message>
        <source>None chosen yet.</source>
        <translation>Noch keiner gewählt.</translation>
    </message>
    <message>
        <source>Add a projector</source>
        <translation>Projektor hinzufügen</translation>
    </message>
    <message>
        <source>Projector %1</source>
        <translation>Projektor %1</translation>
    </message>
    <message>
        <source>Remove projector %1</source>
        <translation>Projektor %1 entfernen</translation>
    </message>
    <message>
        <source>%1: choose its screen</source>
        <translation>%1: wählen Sie seinen Bildschirm</translation>
    </message>
    <message>
        <source>Cameras</source>
        <translation>Kameras</translation>
    </message>
    <message>
        <source>Camera %1</source>
        <translation>Kamera %1</translation>
    </message>
    <message>
        <source>Remove camera %1</source>
        <translation>Kamera %1 entfernen</translation>
    </message>
    <message>
        <source>Add one from the list, or choose it at the next step.</source>
        <translation>Fügen Sie eine aus der Liste hinzu, oder wählen Sie sie im nächsten Schritt.</translation>
    </message>
    <message>
        <source>Content is placed in the view of the first one.</source>
        <translation>Der Inhalt wird in der Ansicht der ersten platziert.</translation>
    </message>
    <message>
        <source>Add those that look at the surface.</source>
        <translation>Fügen Sie die hinzu, die auf die Oberfläche blicken.</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Remove %1</source>
        <translation>%1 entfernen</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Einfügen</translation>
    </message>
    <message>
        <source>Add %1</source>
        <translation>%1 hinzufügen</translation>
    </message>
    <message>
        <source>Say which screens shine on the surface, which cameras watch, and where the work is kept.</source>
        <translation>Sagen Sie, welche Bildschirme auf die Oberfläche strahlen, welche Kameras zusehen und wo die Arbeit liegt.</translation>
    </message>
    <message numerus="yes">
        <source>%n projector(s)</source>
        <translation>
            <numerusform>%n Projektor</numerusform>
            <numerusform>%n Projektoren</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n camera(s)</source>
        <translation>
            <numerusform>%n Kamera</numerusform>
            <numerusform>%n Kameras</numerusform>
        </translation>
    </message>
    <message>
        <source>This screen is projector %1 already.</source>
        <translation>Dieser Bildschirm ist schon Projektor %1.</translation>
    </message>
    <message>
        <source>That screen is projector %1. Choose another screen.</source>
        <translation>Dieser Bildschirm ist Projektor %1. Wählen Sie einen anderen.</translation>
    </message>
    <message>
        <source>Dome, four projectors</source>
        <translation>Kuppel, vier Projektoren</translation>
    </message>
    <message>
        <source>They overlap; two cameras watch</source>
        <translation>Sie überlappen; zwei Kameras sehen zu</translation>
    </message>
    <message>
        <source>Bust from three sides</source>
        <translation>Büste, von drei Seiten</translation>
    </message>
    <message>
        <source>Two projectors, three cameras: for an audience that walks</source>
        <translation>Zwei Projektoren, drei Kameras: für ein Publikum, das geht</translation>
    </message>
    <message>
        <source>Projector whose screen is changed</source>
        <translation>Projektor, dessen Bildschirm geändert wird</translation>
    </message>
    <message>
        <source>Network address (PJLink)</source>
        <translation>Netzwerkadresse (PJLink)</translation>
    </message>
    <message>
        <source>Password, if it has one</source>
        <translation>Passwort, wenn er eines hat</translation>
    </message>
    <message>
        <source>On the network</source>
        <translation>Im Netzwerk</translation>
    </message>
    <message>
        <source>Optional: a projector with a network address is switched on, and its lamp waited for until it is steady, before anything is measured.</source>
        <translation>Freiwillig: ein Projektor mit Netzwerkadresse wird eingeschaltet, und auf seine Lampe wird gewartet, bis sie gleichmäßig leuchtet, bevor etwas gemessen wird.</translation>
    </message>
    <message>
        <source>Find projectors</source>
        <translation>Projektoren suchen</translation>
    </message>
    <message>
        <source>Looking for projectors…</source>
        <translation>Projektoren werden gesucht …</translation>
    </message>
    <message>
        <source>None answers. Only PJLink class 2 can be searched: type the address.</source>
        <translation>Keiner antwortet. Nur PJLink Klasse 2 lässt sich suchen: tippen Sie die Adresse ein.</translation>
    </message>
    <message numerus="yes">
        <source>%n answer. Choose from the list of each.</source>
        <translation>
            <numerusform>%n antwortet. Wählen Sie ihn in der Liste.</numerusform>
            <numerusform>%n antworten. Wählen Sie in der Liste eines jeden.</numerusform>
        </translation>
    </message>
    <message>
        <source>Move to the trash</source>
        <translation>In den Papierkorb</translation>
    </message>
    <message>
        <source>Keep it</source>
        <translation>Behalten</translation>
    </message>
    <message>
        <source>Try again then.</source>
        <translation>Versuchen Sie es danach noch einmal.</translation>
    </message>
    <message>
        <source>Nothing of the venue is lost.</source>
        <translation>Vom Spielort ist nichts verloren.</translation>
    </message>
    <message>
        <source>Remove a venue</source>
        <translation>Spielort entfernen</translation>
    </message>
    <message>
        <source>“%1” goes to the trash, with its photographs, results and playlist.</source>
        <translation>„%1“ kommt in den Papierkorb, mit Fotos, Ergebnissen und Playlist.</translation>
    </message>
    <message>
        <source>Until the trash is emptied it can be taken back from there.</source>
        <translation>Bis der Papierkorb geleert wird, lässt er sich von dort zurückholen.</translation>
    </message>
    <message>
        <source>More</source>
        <translation>Mehr</translation>
    </message>
    <message>
        <source>More for %1</source>
        <translation>Mehr zu %1</translation>
    </message>
    <message>
        <source>Rename…</source>
        <translation>Umbenennen…</translation>
    </message>
    <message>
        <source>Remove…</source>
        <translation>Entfernen…</translation>
    </message>
    <message>
        <source>Setting up another</source>
        <translation>Ein anderer entsteht</translation>
    </message>
    <message>
        <source>Allow them</source>
        <translation>Erlauben</translation>
    </message>
    <message>
        <source>Open without them</source>
        <translation>Ohne sie öffnen</translation>
    </message>
    <message>
        <source>Programs of a venue</source>
        <translation>Programme eines Spielorts</translation>
    </message>
    <message>
        <source>“%1” names programs of its own as projector or camera. They would run on this computer as you, and nobody here has agreed to that yet:</source>
        <translation>„%1“ nennt eigene Programme als Projektor oder Kamera. Sie würden auf diesem Rechner in Ihrem Namen laufen, und dem hat hier noch niemand zugestimmt:</translation>
    </message>
    <message>
        <source>None of them was run. Without them everything that was measured can be looked at and shown.</source>
        <translation>Keines davon wurde gestartet. Auch ohne sie lässt sich alles Gemessene ansehen und zeigen.</translation>
    </message>
    <message>
        <source>Allow them if you know what they do, or know who made this venue.</source>
        <translation>Erlauben Sie sie, wenn Sie wissen, was sie tun, oder wer diesen Spielort angelegt hat.</translation>
    </message>
    <message>
        <source>No other screen is plugged in.</source>
        <translation>Kein anderer Bildschirm angesteckt.</translation>
    </message>
    <message>
        <source>The same steps, with a simulated projector and camera. Nothing is projected unless you choose a screen.</source>
        <translation>Dieselben Schritte, mit simuliertem Projektor und simulierter Kamera. Projiziert wird nichts, außer Sie wählen einen Bildschirm.</translation>
    </message>
    <message>
        <source>Programs of this venue</source>
        <translation>Programme dieses Spielorts</translation>
    </message>
    <message>
        <source>Say which commands drive these devices from now on. What was measured stays.</source>
        <translation>Geben Sie an, welche Befehle diese Geräte von jetzt an steuern. Das Gemessene bleibt.</translation>
    </message>
    <message>
        <source>Use these commands</source>
        <translation>Diese Befehle verwenden</translation>
    </message>
    <message>
        <source>Change the programs</source>
        <translation>Programme ändern</translation>
    </message>
    <message>
        <source>Type another command.</source>
        <translation>Geben Sie einen anderen Befehl ein.</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Kamera</translation>
    </message>
    <message>
        <source>A program that fails ends with another status than 0. What it says last is told with it. Try it in a terminal, with a file in place of {image} or {output} and seconds in place of {exposure}.</source>
        <translation>Ein Programm, das scheitert, endet mit einem anderen Status als 0. Was es zuletzt sagt, wird dazu gemeldet. Probieren Sie es in einem Terminal aus, mit einer Datei anstelle von {image} oder {output} und Sekunden anstelle von {exposure}.</translation>
    </message>
    <message>
        <source>Relucent shows the pictures on it, unless a program of yours does.</source>
        <translation>Relucent zeigt die Bilder darauf, falls es nicht ein Programm von Ihnen tut.</translation>
    </message>
    <message>
        <source>Not needed with a screen. %1</source>
        <translation>Mit einem Bildschirm nicht nötig. %1</translation>
    </message>
    <message>
        <source>Choose the projector&apos;s screen, or type the command that shows.</source>
        <translation>Wählen Sie den Bildschirm des Projektors, oder geben Sie den Befehl ein, der zeigt.</translation>
    </message>
    <message>
        <source>%1, %2, unplugged</source>
        <translation>%1, %2, ausgesteckt</translation>
    </message>
    <message>
        <source>As many as the chosen screen has.</source>
        <translation>So viele, wie der gewählte Bildschirm hat.</translation>
    </message>
    <message>
        <source>Continue</source>
        <translation>Weiter</translation>
    </message>
    <message>
        <source>A show plays on %1</source>
        <translation>Auf %1 läuft eine Show</translation>
    </message>
    <message>
        <source>Another program shows it. End it before anything is measured there: Camera has the button.</source>
        <translation>Ein anderes Programm zeigt sie. Vor dem Messen dort beenden: Die Schaltfläche steht unter „Kamera“.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VenueTidy</name>
    <message>
        <source>Try again then.</source>
        <translation>Versuchen Sie es danach noch einmal.</translation>
    </message>
    <message>
        <source>%1 is at work. Space can be freed when it has ended.</source>
        <translation>%1 arbeitet. Platz lässt sich schaffen, wenn das beendet ist.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ViewerPlan</name>
    <message>
        <source>Plan of the cameras and of the viewer, seen from above</source>
        <translation>Plan der Kameras und des Betrachters, von oben gesehen</translation>
    </message>
    <message>
        <source>Camera %1</source>
        <translation>Kamera %1</translation>
    </message>
    <message>
        <source>Viewer</source>
        <translation>Betrachter</translation>
    </message>
    <message>
        <source>%1: %2 m to the left, %3 m from the surface</source>
        <translation>%1: %2 m links, %3 m vor der Oberfläche</translation>
    </message>
    <message>
        <source>%1: %2 m to the right, %3 m from the surface</source>
        <translation>%1: %2 m rechts, %3 m vor der Oberfläche</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VtkView</name>
    <message>
        <source>This view needs OpenGL 3.2, and this computer draws without it. Everything else works: pictures and maps are shown without depth.</source>
        <translation>Diese Ansicht braucht OpenGL 3.2, und dieser Computer zeichnet ohne. Alles andere funktioniert: Bilder und Karten werden ohne Tiefe gezeigt.</translation>
    </message>
    <message>
        <source>For this view, install the graphics card&apos;s driver and start Relucent again.</source>
        <translation>Installieren Sie für diese Ansicht den Treiber der Grafikkarte und starten Sie Relucent neu.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Wizard</name>
    <message>
        <source>Not applied yet</source>
        <translation>Noch nicht angewandt</translation>
    </message>
</context>
<context>
    <name>repair.camera-moved</name>
    <message>
        <source>the view of camera {} has moved by {} and {} pixels and turned by {} degrees</source>
        <translation>der Blick der Kamera {} hat sich um {} und {} Pixel verschoben und um {} Grad gedreht</translation>
    </message>
</context>
<context>
    <name>repair.light-changed</name>
    <message>
        <source>projector {} gives {} % of the red, {} % of the green and {} % of the blue light that it gave</source>
        <translation>Projektor {} gibt {} % des roten, {} % des grünen und {} % des blauen Lichts, das er gab</translation>
    </message>
</context>
<context>
    <name>repair.light-elsewhere</name>
    <message>
        <source>in {} % of the cameras&apos; pixels light arrives otherwise than it did</source>
        <translation>in {} % der Kamerapixel kommt das Licht anders an als zuvor</translation>
    </message>
</context>
<context>
    <name>repair.picture-moved</name>
    <message>
        <source>the projected picture has moved by {} and {} pixels as camera {} sees it</source>
        <translation>das projizierte Bild hat sich, wie Kamera {2} es sieht, um {0} und {1} Pixel verschoben</translation>
    </message>
</context>
<context>
    <name>repair.room-brighter</name>
    <message>
        <source>the room is brighter by {} % of the projectors&apos; full light</source>
        <translation>der Raum ist um {} % des vollen Lichts der Projektoren heller</translation>
    </message>
</context>
<context>
    <name>repair.room-darker</name>
    <message>
        <source>the room is darker by {} % of the projectors&apos; full light</source>
        <translation>der Raum ist um {} % des vollen Lichts der Projektoren dunkler</translation>
    </message>
</context>
<context>
    <name>repair.surface-changed</name>
    <message>
        <source>{} % of what the cameras see is brighter, darker or of another colour than it was</source>
        <translation>{} % dessen, was die Kameras sehen, ist heller, dunkler oder anders gefärbt als zuvor</translation>
    </message>
</context>
<context>
    <name>report.cannot-write</name>
    <message>
        <source>the report cannot be written</source>
        <translation>der Bericht kann nicht geschrieben werden</translation>
    </message>
</context>
<context>
    <name>report.free-some-space</name>
    <message>
        <source>free some space</source>
        <translation>geben Sie Speicherplatz frei</translation>
    </message>
</context>
<context>
    <name>sentence.ended</name>
    <message>
        <source>{}.</source>
        <translation>{}.</translation>
    </message>
</context>
<context>
    <name>sentence.explained</name>
    <message>
        <source>{} ({})</source>
        <translation>{} ({})</translation>
    </message>
</context>
<context>
    <name>sentence.of-place</name>
    <message>
        <source>{}: {}</source>
        <translation>{}: {}</translation>
    </message>
</context>
<context>
    <name>sentence.with-advice</name>
    <message>
        <source>{}; {}</source>
        <translation>{}; {}</translation>
    </message>
</context>
<context>
    <name>session.cannot-end-show</name>
    <message>
        <source>the other program may not be ended from here</source>
        <translation>das andere Programm darf von hier nicht beendet werden</translation>
    </message>
</context>
<context>
    <name>session.close-other-window</name>
    <message>
        <source>go on there, or close it there first</source>
        <translation>arbeiten Sie dort weiter, oder schließen Sie ihn dort zuerst</translation>
    </message>
</context>
<context>
    <name>session.end-show-itself</name>
    <message>
        <source>hold Esc on the projector&apos;s picture for two seconds</source>
        <translation>halten Sie zwei Sekunden lang Esc am Bild des Projektors</translation>
    </message>
</context>
<context>
    <name>session.open-in-another-window</name>
    <message>
        <source>this venue is open in another window of Relucent</source>
        <translation>dieser Spielort ist in einem anderen Fenster von Relucent geöffnet</translation>
    </message>
</context>
<context>
    <name>sets.choose-name</name>
    <message>
        <source>choose another name, as day or school class</source>
        <translation>wählen Sie einen anderen Namen, etwa Tag oder Schulklasse</translation>
    </message>
</context>
<context>
    <name>sets.choose-one</name>
    <message>
        <source>choose one of {}</source>
        <translation>wählen Sie eine von {}</translation>
    </message>
</context>
<context>
    <name>sets.damaged</name>
    <message>
        <source>the sets of this calibration cannot be read</source>
        <translation>die Varianten dieser Kalibrierung sind nicht lesbar</translation>
    </message>
</context>
<context>
    <name>sets.in-use</name>
    <message>
        <source>the set &apos;{}&apos; is in use</source>
        <translation>die Variante „{}“ wird gerade verwendet</translation>
    </message>
</context>
<context>
    <name>sets.name-empty</name>
    <message>
        <source>a set needs a name</source>
        <translation>eine Variante braucht einen Namen</translation>
    </message>
</context>
<context>
    <name>sets.name-odd</name>
    <message>
        <source>the name of a set is plain text that neither begins nor ends with a space</source>
        <translation>der Name einer Variante ist einfacher Text, der weder mit einem Leerzeichen beginnt noch endet</translation>
    </message>
</context>
<context>
    <name>sets.name-taken</name>
    <message>
        <source>there is a set &apos;{}&apos; already</source>
        <translation>es gibt schon eine Variante „{}“</translation>
    </message>
</context>
<context>
    <name>sets.name-too-long</name>
    <message>
        <source>the name of a set has at most {} bytes</source>
        <translation>der Name einer Variante hat höchstens {} Bytes</translation>
    </message>
</context>
<context>
    <name>sets.of-newer-version</name>
    <message>
        <source>a newer Relucent wrote the sets of this calibration</source>
        <translation>ein neueres Relucent hat die Varianten dieser Kalibrierung geschrieben</translation>
    </message>
</context>
<context>
    <name>sets.remove-section</name>
    <message>
        <source>take &quot;sets&quot; out of the settings in {}, or copy the calibration again from where it was made</source>
        <translation>nehmen Sie „sets“ aus den Einstellungen in {}, oder kopieren Sie die Kalibrierung noch einmal von dort, wo sie entstand</translation>
    </message>
</context>
<context>
    <name>sets.save-first</name>
    <message>
        <source>this calibration has no sets yet: save one first</source>
        <translation>diese Kalibrierung hat noch keine Varianten: speichern Sie erst eine</translation>
    </message>
</context>
<context>
    <name>sets.unknown</name>
    <message>
        <source>there is no set &apos;{}&apos;</source>
        <translation>es gibt keine Variante „{}“</translation>
    </message>
</context>
<context>
    <name>sets.use-another-first</name>
    <message>
        <source>use another one first</source>
        <translation>verwenden Sie erst eine andere</translation>
    </message>
</context>
<context>
    <name>show.allow-commands</name>
    <message>
        <source>look at what it does, then open the venue in the wizard and allow its programs</source>
        <translation>Ansehen, was es tut, dann den Spielort im Assistenten öffnen und seine Programme erlauben</translation>
    </message>
</context>
<context>
    <name>show.cannot-enable-service</name>
    <message>
        <source>the service cannot be switched on ({})</source>
        <translation>der Dienst lässt sich nicht einschalten ({})</translation>
    </message>
</context>
<context>
    <name>show.cannot-remove-entry</name>
    <message>
        <source>it cannot be removed ({})</source>
        <translation>die Datei kann nicht entfernt werden ({})</translation>
    </message>
</context>
<context>
    <name>show.cannot-write-log</name>
    <message>
        <source>the log cannot be written ({})</source>
        <translation>das Protokoll kann nicht geschrieben werden ({})</translation>
    </message>
</context>
<context>
    <name>show.check-folder-permissions</name>
    <message>
        <source>check the folder&apos;s permissions</source>
        <translation>prüfen Sie die Zugriffsrechte des Ordners</translation>
    </message>
</context>
<context>
    <name>show.choose-another-log-folder</name>
    <message>
        <source>choose another folder with --log</source>
        <translation>wählen Sie mit --log einen anderen Ordner</translation>
    </message>
</context>
<context>
    <name>show.engine-lost-device</name>
    <message>
        <source>the engine lost its graphics card</source>
        <translation>die Engine hat ihr Gerät verloren</translation>
    </message>
</context>
<context>
    <name>show.no-camera</name>
    <message>
        <source>this show has no camera: its calibration names none</source>
        <translation>diese Show hat keine Kamera: Ihre Kalibrierung nennt keine</translation>
    </message>
</context>
<context>
    <name>show.no-xwayland</name>
    <message>
        <source>in a Wayland session, take QT_QPA_PLATFORM=xcb out of the environment; else take away the desktop&apos;s rules for windows of Relucent, then try again</source>
        <translation>nehmen Sie in einer Wayland-Sitzung QT_QPA_PLATFORM=xcb aus der Umgebung; sonst entfernen Sie die Regeln des Desktops für Fenster von Relucent, dann versuchen Sie es erneut</translation>
    </message>
</context>
<context>
    <name>show.projector-by-command</name>
    <message>
        <source>this calibration shows pictures by a command of its own, which does not know of the show: stop the show and use relucent-cli verify and perfect</source>
        <translation>diese Kalibrierung zeigt Bilder durch einen eigenen Befehl, der von der Show nichts weiß: die Show beenden und relucent-cli verify und perfect verwenden</translation>
    </message>
</context>
<context>
    <name>show.restore-resolution</name>
    <message>
        <source>set its resolution back in the desktop&apos;s settings, then try again</source>
        <translation>stellen Sie in den Einstellungen des Desktops wieder seine frühere Auflösung ein, dann versuchen Sie es erneut</translation>
    </message>
</context>
<context>
    <name>show.screen-asleep</name>
    <message>
        <source>the projector&apos;s screen is asleep and does not wake</source>
        <translation>der Bildschirm des Projektors schläft und lässt sich nicht wecken</translation>
    </message>
</context>
<context>
    <name>show.screen-size-changed</name>
    <message>
        <source>the projector&apos;s screen has {} pixels now and {} were calibrated</source>
        <translation>der Bildschirm des Projektors hat jetzt {} Pixel, kalibriert wurden {}</translation>
    </message>
</context>
<context>
    <name>show.start-show-again</name>
    <message>
        <source>start the show again</source>
        <translation>starten Sie die Show neu</translation>
    </message>
</context>
<context>
    <name>show.switch-off-power-saving</name>
    <message>
        <source>switch off its power saving and the screen saver in the desktop&apos;s settings, then try again</source>
        <translation>schalten Sie seinen Energiesparmodus und den Bildschirmschoner in den Einstellungen des Desktops aus, dann versuchen Sie es erneut</translation>
    </message>
</context>
<context>
    <name>show.window-elsewhere</name>
    <message>
        <source>the desktop puts the projector&apos;s picture on the screen {} instead</source>
        <translation>der Desktop stellt das Bild des Projektors stattdessen auf den Bildschirm {}</translation>
    </message>
</context>
<context>
    <name>stage.adapting-light-transport</name>
    <message>
        <source>fitting the light transport to what is seen</source>
        <translation>Lichttransport wird dem Gesehenen angepasst</translation>
    </message>
</context>
<context>
    <name>stage.algorithm-1</name>
    <message>
        <source>Algorithm 1</source>
        <translation>Algorithmus 1</translation>
    </message>
</context>
<context>
    <name>stage.assembling-light-transport</name>
    <message>
        <source>Assembling the light transport</source>
        <translation>Zusammensetzen des Lichttransports</translation>
    </message>
</context>
<context>
    <name>stage.awaiting-steady-light</name>
    <message>
        <source>Waiting until the lamps are steady</source>
        <translation>Warten, bis die Lampen gleichmäßig leuchten</translation>
    </message>
</context>
<context>
    <name>stage.black-and-full-light</name>
    <message>
        <source>black and full light</source>
        <translation>Schwarz und Volllicht</translation>
    </message>
</context>
<context>
    <name>stage.calibrating</name>
    <message>
        <source>Calibrating</source>
        <translation>Kalibrierung</translation>
    </message>
</context>
<context>
    <name>stage.capped-clusters</name>
    <message>
        <source>Clusters held to a size</source>
        <translation>Cluster mit begrenzter Größe</translation>
    </message>
</context>
<context>
    <name>stage.capping-clusters</name>
    <message>
        <source>Holding clusters to a size</source>
        <translation>Begrenzung der Clustergröße</translation>
    </message>
</context>
<context>
    <name>stage.checking-additivity</name>
    <message>
        <source>Checking that the colours of {} add up</source>
        <translation>Prüfung der Farbsumme: {}</translation>
    </message>
</context>
<context>
    <name>stage.checking-drift</name>
    <message>
        <source>Checking for drift</source>
        <translation>Prüfung auf Drift</translation>
    </message>
</context>
<context>
    <name>stage.checking-projector-and-camera</name>
    <message>
        <source>Checking projector and camera</source>
        <translation>Prüfung von Projektor und Kamera</translation>
    </message>
</context>
<context>
    <name>stage.choosing-camera-pixels</name>
    <message>
        <source>Finding the camera pixels that are needed</source>
        <translation>Suche nach den nötigen Kamerapixeln</translation>
    </message>
</context>
<context>
    <name>stage.clustering-light-transport</name>
    <message>
        <source>Clustering the light transport</source>
        <translation>Clusterbildung im Lichttransport</translation>
    </message>
</context>
<context>
    <name>stage.comparing-cluster-inverses-in-venue</name>
    <message>
        <source>Comparing the inverses of clusters in {}</source>
        <translation>Vergleich der Cluster-Inversen: {}</translation>
    </message>
</context>
<context>
    <name>stage.comparing-methods</name>
    <message>
        <source>Comparing the methods</source>
        <translation>Vergleich der Methoden</translation>
    </message>
</context>
<context>
    <name>stage.comparing-methods-in-venue</name>
    <message>
        <source>Comparing the methods in {}</source>
        <translation>Vergleich der Methoden: {}</translation>
    </message>
</context>
<context>
    <name>stage.comparing-views</name>
    <message>
        <source>Comparing what the views want</source>
        <translation>Vergleich dessen, was die Blickpunkte wollen</translation>
    </message>
</context>
<context>
    <name>stage.compensating</name>
    <message>
        <source>Compensating</source>
        <translation>Kompensation</translation>
    </message>
</context>
<context>
    <name>stage.concluding-measurement</name>
    <message>
        <source>what may be expected of the result</source>
        <translation>was vom Ergebnis zu erwarten ist</translation>
    </message>
</context>
<context>
    <name>stage.decoding</name>
    <message>
        <source>Decoding</source>
        <translation>Dekodierung</translation>
    </message>
</context>
<context>
    <name>stage.dense-patterns</name>
    <message>
        <source>patterns in blocks of {} px</source>
        <translation>Muster in Blöcken von {} px</translation>
    </message>
</context>
<context>
    <name>stage.estimating-light-transport</name>
    <message>
        <source>Estimating the light transport</source>
        <translation>Schätzung des Lichttransports</translation>
    </message>
</context>
<context>
    <name>stage.estimating-response-and-colours</name>
    <message>
        <source>Estimating response and colours</source>
        <translation>Schätzung von Kennlinie und Farben</translation>
    </message>
</context>
<context>
    <name>stage.evaluating</name>
    <message>
        <source>Evaluating</source>
        <translation>Auswertung</translation>
    </message>
</context>
<context>
    <name>stage.finding-defocus</name>
    <message>
        <source>Finding the defocus</source>
        <translation>Bestimmung des Defokus</translation>
    </message>
</context>
<context>
    <name>stage.finding-exposure</name>
    <message>
        <source>Finding the exposure</source>
        <translation>Bestimmung der Belichtung</translation>
    </message>
</context>
<context>
    <name>stage.finding-exposures</name>
    <message>
        <source>Finding the exposures</source>
        <translation>Bestimmung der Belichtungen</translation>
    </message>
</context>
<context>
    <name>stage.finding-projector-picture</name>
    <message>
        <source>Looking for the projector&apos;s picture</source>
        <translation>Suche nach dem Projektorbild</translation>
    </message>
</context>
<context>
    <name>stage.finding-shadows</name>
    <message>
        <source>Looking for shadows</source>
        <translation>Suche nach Schatten</translation>
    </message>
</context>
<context>
    <name>stage.finding-uncorrectable-pixels</name>
    <message>
        <source>Looking for what cannot be corrected</source>
        <translation>Suche nach nicht Korrigierbarem</translation>
    </message>
</context>
<context>
    <name>stage.finding-what-is-seen</name>
    <message>
        <source>Finding which part of the picture is seen</source>
        <translation>Sucht, welcher Teil des Bildes zu sehen ist</translation>
    </message>
</context>
<context>
    <name>stage.fitting-light-spread</name>
    <message>
        <source>Fitting the spread of light</source>
        <translation>Anpassung der Lichtstreuung</translation>
    </message>
</context>
<context>
    <name>stage.forming-patches</name>
    <message>
        <source>Forming patches</source>
        <translation>Bildung der Pixelbereiche</translation>
    </message>
</context>
<context>
    <name>stage.inverting-clusters</name>
    <message>
        <source>Inverting the clusters</source>
        <translation>Inversion der Cluster</translation>
    </message>
</context>
<context>
    <name>stage.inverting-light-transport</name>
    <message>
        <source>Inverting the light transport</source>
        <translation>Inversion des Lichttransports</translation>
    </message>
</context>
<context>
    <name>stage.inverting-venue</name>
    <message>
        <source>Inverting {}</source>
        <translation>Inversion: {}</translation>
    </message>
</context>
<context>
    <name>stage.joining-clusters</name>
    <message>
        <source>Joining clusters</source>
        <translation>Vereinigung der Cluster</translation>
    </message>
</context>
<context>
    <name>stage.judging-light</name>
    <message>
        <source>Judging the light</source>
        <translation>Beurteilung des Lichts</translation>
    </message>
</context>
<context>
    <name>stage.level-of-tree</name>
    <message numerus="yes">
        <source>level {} of {}: {} patterns</source>
        <comment>level {} of {}: {} pattern</comment>
        <translation>
            <numerusform>Ebene {} von {}: {} Muster</numerusform>
            <numerusform>Ebene {} von {}: {} Muster</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>stage.light-transport</name>
    <message>
        <source>light transport</source>
        <translation>Lichttransport</translation>
    </message>
</context>
<context>
    <name>stage.linearizing</name>
    <message>
        <source>Linearizing</source>
        <translation>Linearisierung</translation>
    </message>
</context>
<context>
    <name>stage.looking-for-changes</name>
    <message>
        <source>Looking for what has changed</source>
        <translation>Veränderungen werden gesucht</translation>
    </message>
</context>
<context>
    <name>stage.looking-for-hot-pixels</name>
    <message>
        <source>Looking for hot pixels of the camera</source>
        <translation>Suche nach hellen Fehlpixeln der Kamera</translation>
    </message>
</context>
<context>
    <name>stage.looking-through-camera</name>
    <message>
        <source>Looking through the camera</source>
        <translation>Blick durch die Kamera</translation>
    </message>
</context>
<context>
    <name>stage.measuring-brightness-curves</name>
    <message>
        <source>Measuring the brightness curves of {}</source>
        <translation>Messung der Helligkeitskurven: {}</translation>
    </message>
</context>
<context>
    <name>stage.measuring-camera</name>
    <message>
        <source>Measuring the camera</source>
        <translation>Messung der Kamera</translation>
    </message>
</context>
<context>
    <name>stage.measuring-latency</name>
    <message>
        <source>Measuring the latency</source>
        <translation>Messung der Latenz</translation>
    </message>
</context>
<context>
    <name>stage.measuring-light-transport</name>
    <message>
        <source>Measuring the light transport</source>
        <translation>Messung des Lichttransports</translation>
    </message>
</context>
<context>
    <name>stage.measuring-response</name>
    <message>
        <source>Measuring the response</source>
        <translation>Messung der Kennlinie</translation>
    </message>
</context>
<context>
    <name>stage.measuring-venue</name>
    <message>
        <source>Measuring {}</source>
        <translation>Messung: {}</translation>
    </message>
</context>
<context>
    <name>stage.measuring-what-changed</name>
    <message>
        <source>measuring what is no longer as it was</source>
        <translation>was nicht mehr ist wie zuvor, wird gemessen</translation>
    </message>
</context>
<context>
    <name>stage.opening-devices</name>
    <message>
        <source>Opening the devices</source>
        <translation>Öffnen der Geräte</translation>
    </message>
</context>
<context>
    <name>stage.perfecting</name>
    <message>
        <source>Correcting the picture by photographs of itself</source>
        <translation>Bild wird durch Fotos von sich selbst korrigiert</translation>
    </message>
</context>
<context>
    <name>stage.photographing-projections</name>
    <message>
        <source>Photographing the projections</source>
        <translation>Fotografieren der Projektionen</translation>
    </message>
</context>
<context>
    <name>stage.photographing-test-patterns</name>
    <message>
        <source>Photographing test patterns</source>
        <translation>Fotografieren der Testmuster</translation>
    </message>
</context>
<context>
    <name>stage.predicting-held-out-patterns</name>
    <message>
        <source>Predicting held-out patterns</source>
        <translation>Vorhersage zurückgehaltener Muster</translation>
    </message>
</context>
<context>
    <name>stage.preparing-benchmarks</name>
    <message>
        <source>Preparing the benchmarks</source>
        <translation>Vorbereitung der Benchmarks</translation>
    </message>
</context>
<context>
    <name>stage.preparing-devices</name>
    <message>
        <source>Preparing the devices</source>
        <translation>Vorbereitung der Geräte</translation>
    </message>
</context>
<context>
    <name>stage.preparing-engine</name>
    <message>
        <source>Preparing the engine</source>
        <translation>Vorbereitung des Rechenkerns</translation>
    </message>
</context>
<context>
    <name>stage.preparing-preview</name>
    <message>
        <source>Preparing the preview</source>
        <translation>Vorbereitung der Vorschau</translation>
    </message>
</context>
<context>
    <name>stage.preparing-venue</name>
    <message>
        <source>Preparing the venue</source>
        <translation>Vorbereitung des Spielorts</translation>
    </message>
</context>
<context>
    <name>stage.reading-calibration</name>
    <message>
        <source>Reading the calibration</source>
        <translation>Lesen der Kalibrierung</translation>
    </message>
</context>
<context>
    <name>stage.reading-light-transport</name>
    <message>
        <source>Reading the light transport</source>
        <translation>Lesen des Lichttransports</translation>
    </message>
</context>
<context>
    <name>stage.reading-patterns</name>
    <message>
        <source>Reading the patterns</source>
        <translation>Lesen der Muster</translation>
    </message>
</context>
<context>
    <name>stage.reading-photographs</name>
    <message>
        <source>Reading the photographs</source>
        <translation>Lesen der Fotos</translation>
    </message>
</context>
<context>
    <name>stage.reading-pictures</name>
    <message>
        <source>Reading the pictures</source>
        <translation>Lesen der Bilder</translation>
    </message>
</context>
<context>
    <name>stage.reading-response</name>
    <message>
        <source>Reading the response</source>
        <translation>Lesen der Kennlinie</translation>
    </message>
</context>
<context>
    <name>stage.reading-venue</name>
    <message>
        <source>Reading {}</source>
        <translation>Lesen: {}</translation>
    </message>
</context>
<context>
    <name>stage.remeasuring-flagged-pixels</name>
    <message numerus="yes">
        <source>measuring {} flagged pixels again</source>
        <comment>measuring {} flagged pixel again</comment>
        <translation>
            <numerusform>Neumessung von {} markierten Pixel</numerusform>
            <numerusform>Neumessung von {} markierten Pixeln</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>stage.scaling-to-flood-image</name>
    <message>
        <source>Scaling to the flood image</source>
        <translation>Skalierung auf das Volllichtbild</translation>
    </message>
</context>
<context>
    <name>stage.separating-direct-and-indirect-light</name>
    <message>
        <source>Separating direct and indirect light</source>
        <translation>Trennung von direktem und indirektem Licht</translation>
    </message>
</context>
<context>
    <name>stage.sharing-leaves</name>
    <message>
        <source>light that neighbouring pixels share</source>
        <translation>Licht, das benachbarte Pixel teilen</translation>
    </message>
</context>
<context>
    <name>stage.sharpening</name>
    <message>
        <source>Sharpening</source>
        <translation>Schärfung</translation>
    </message>
</context>
<context>
    <name>stage.solving</name>
    <message>
        <source>Solving</source>
        <translation>Berechnung der Lösung</translation>
    </message>
</context>
<context>
    <name>stage.storing-light-transport</name>
    <message>
        <source>storing the light transport</source>
        <translation>Speichern des Lichttransports</translation>
    </message>
</context>
<context>
    <name>stage.switching-projectors-on</name>
    <message>
        <source>Switching the projectors on</source>
        <translation>Projektoren werden eingeschaltet</translation>
    </message>
</context>
<context>
    <name>stage.taking-verification-photograph</name>
    <message>
        <source>Taking the verification photograph</source>
        <translation>Aufnahme des Prüffotos</translation>
    </message>
</context>
<context>
    <name>stage.test-patterns</name>
    <message>
        <source>test patterns</source>
        <translation>Testmuster</translation>
    </message>
</context>
<context>
    <name>stage.timing-engine</name>
    <message>
        <source>Timing the engine</source>
        <translation>Zeitmessung des Rechenkerns</translation>
    </message>
</context>
<context>
    <name>stage.tracing-simulated-venue</name>
    <message>
        <source>tracing the simulated venue</source>
        <translation>Lichtberechnung am simulierten Spielort</translation>
    </message>
</context>
<context>
    <name>stage.windows</name>
    <message>
        <source>Computing the windows of the inverse</source>
        <translation>Fenster</translation>
    </message>
</context>
<context>
    <name>stage.working-out-finest-blocks</name>
    <message>
        <source>working out the finest blocks</source>
        <translation>Berechnung der feinsten Blöcke</translation>
    </message>
</context>
<context>
    <name>stage.writing</name>
    <message>
        <source>Writing</source>
        <translation>Schreiben</translation>
    </message>
</context>
<context>
    <name>stage.writing-out-light-transport</name>
    <message>
        <source>Writing out the light transport</source>
        <translation>Ausschreiben des Lichttransports</translation>
    </message>
</context>
<context>
    <name>stage.writing-report</name>
    <message>
        <source>Writing the report</source>
        <translation>Schreiben des Berichts</translation>
    </message>
</context>
<context>
    <name>stage.writing-results</name>
    <message>
        <source>Writing the results</source>
        <translation>Schreiben der Ergebnisse</translation>
    </message>
</context>
<context>
    <name>stream.address-incomplete</name>
    <message>
        <source>in a stream&apos;s address the host or its port is missing or wrong</source>
        <translation>in der Adresse des Streams fehlt der Host oder sein Port, oder einer von beiden ist falsch</translation>
    </message>
</context>
<context>
    <name>stream.check-host</name>
    <message>
        <source>check the name in the address, or write the number</source>
        <translation>prüfen Sie den Namen in der Adresse, oder schreiben Sie die Nummer</translation>
    </message>
</context>
<context>
    <name>stream.check-network</name>
    <message>
        <source>check the network and the address</source>
        <translation>prüfen Sie Netz und Adresse</translation>
    </message>
</context>
<context>
    <name>stream.check-path</name>
    <message>
        <source>check what stands behind the host in the address</source>
        <translation>prüfen Sie, was in der Adresse hinter dem Host steht</translation>
    </message>
</context>
<context>
    <name>stream.check-sender</name>
    <message>
        <source>check the sender, the network, and the address</source>
        <translation>prüfen Sie Sender, Netz und Adresse</translation>
    </message>
</context>
<context>
    <name>stream.end-other</name>
    <message>
        <source>end that program, or send to another port</source>
        <translation>beenden Sie dieses Programm, oder senden Sie an einen anderen Port</translation>
    </message>
</context>
<context>
    <name>stream.ended</name>
    <message>
        <source>it has ended</source>
        <translation>er ist zu Ende</translation>
    </message>
</context>
<context>
    <name>stream.host-unknown</name>
    <message>
        <source>its host is not found</source>
        <translation>sein Host wird nicht gefunden</translation>
    </message>
</context>
<context>
    <name>stream.list-once</name>
    <message>
        <source>put it into the playlist once</source>
        <translation>nehmen Sie ihn nur einmal in die Playlist auf</translation>
    </message>
</context>
<context>
    <name>stream.no-memory</name>
    <message>
        <source>there is not enough memory for its pictures</source>
        <translation>für seine Bilder reicht der Speicher nicht</translation>
    </message>
</context>
<context>
    <name>stream.no-such-path</name>
    <message>
        <source>there is nothing at its path</source>
        <translation>unter seinem Pfad ist nichts</translation>
    </message>
</context>
<context>
    <name>stream.not-ready</name>
    <message>
        <source>{}: {}</source>
        <translation>{}: {}</translation>
    </message>
</context>
<context>
    <name>stream.not-yet</name>
    <message>
        <source>it has given no picture yet</source>
        <translation>er hat noch kein Bild geliefert</translation>
    </message>
</context>
<context>
    <name>stream.open-already</name>
    <message>
        <source>this program plays it already</source>
        <translation>dieses Programm spielt ihn schon</translation>
    </message>
</context>
<context>
    <name>stream.port-in-use</name>
    <message>
        <source>another program receives at its port</source>
        <translation>an seinem Port empfängt ein anderes Programm</translation>
    </message>
</context>
<context>
    <name>stream.refused</name>
    <message>
        <source>the connection was refused</source>
        <translation>die Verbindung wurde abgelehnt</translation>
    </message>
</context>
<context>
    <name>stream.send-h264</name>
    <message>
        <source>let it be sent as H.264 or Motion JPEG</source>
        <translation>lassen Sie ihn als H.264 oder Motion JPEG senden</translation>
    </message>
</context>
<context>
    <name>stream.silent</name>
    <message>
        <source>no picture came within {} s</source>
        <translation>binnen {} s kam kein Bild</translation>
    </message>
</context>
<context>
    <name>stream.stalled</name>
    <message>
        <source>no picture has come for {} s</source>
        <translation>seit {} s kam kein Bild</translation>
    </message>
</context>
<context>
    <name>stream.start-sender</name>
    <message>
        <source>start the sender, and check the port</source>
        <translation>starten Sie den Sender, und prüfen Sie den Port</translation>
    </message>
</context>
<context>
    <name>stream.start-sender-again</name>
    <message>
        <source>start the sender again</source>
        <translation>starten Sie den Sender erneut</translation>
    </message>
</context>
<context>
    <name>stream.unknown-hold</name>
    <message>
        <source>the stream&apos;s address ends in an unknown choice</source>
        <translation>die Adresse des Streams endet mit einer unbekannten Wahl</translation>
    </message>
</context>
<context>
    <name>stream.unknown-scheme</name>
    <message>
        <source>this is no address of a stream</source>
        <translation>das ist keine Adresse eines Streams</translation>
    </message>
</context>
<context>
    <name>stream.unreachable</name>
    <message>
        <source>its host cannot be reached</source>
        <translation>sein Host ist nicht erreichbar</translation>
    </message>
</context>
<context>
    <name>stream.unreadable</name>
    <message>
        <source>it cannot be read ({})</source>
        <translation>er kann nicht gelesen werden ({})</translation>
    </message>
</context>
<context>
    <name>stream.unusable</name>
    <message>
        <source>what comes is no video that can be shown</source>
        <translation>was kommt, ist kein Video, das gezeigt werden kann</translation>
    </message>
</context>
<context>
    <name>stream.wants-password</name>
    <message>
        <source>it wants another user name and password</source>
        <translation>er verlangt einen anderen Benutzernamen und ein anderes Kennwort</translation>
    </message>
</context>
<context>
    <name>stream.write-address</name>
    <message>
        <source>write it like {}, and in user names and passwords % and two digits for signs like @, : and /</source>
        <translation>schreiben Sie sie wie {}, und in Benutzernamen und Kennwörtern % und zwei Ziffern für Zeichen wie @, : und /</translation>
    </message>
</context>
<context>
    <name>stream.write-hold</name>
    <message>
        <source>write #hold=last or #hold=black</source>
        <translation>schreiben Sie #hold=last oder #hold=black</translation>
    </message>
</context>
<context>
    <name>stream.write-password</name>
    <message>
        <source>write them into the address before the host: {}</source>
        <translation>schreiben Sie sie in der Adresse vor den Host: {}</translation>
    </message>
</context>
<context>
    <name>stream.write-scheme</name>
    <message>
        <source>let it begin with one of {}</source>
        <translation>lassen Sie sie mit einem von diesen beginnen: {}</translation>
    </message>
</context>
<context>
    <name>venue.cannot-open-folder</name>
    <message>
        <source>the folder cannot be opened ({})</source>
        <translation>der Ordner lässt sich nicht öffnen ({})</translation>
    </message>
</context>
<context>
    <name>venue.cannot-rename</name>
    <message>
        <source>the folder cannot be renamed ({})</source>
        <translation>der Ordner lässt sich nicht umbenennen ({})</translation>
    </message>
</context>
<context>
    <name>venue.no-trash</name>
    <message>
        <source>it cannot be moved to the trash</source>
        <translation>er lässt sich nicht in den Papierkorb verschieben</translation>
    </message>
</context>
<context>
    <name>venue.remove-folder-yourself</name>
    <message>
        <source>this disk may have none: remove the folder with the file manager</source>
        <translation>dieses Laufwerk hat vielleicht keinen: entfernen Sie den Ordner mit der Dateiverwaltung</translation>
    </message>
</context>
<context>
    <name>venue.used-by-another</name>
    <message>
        <source>another program is working on this venue</source>
        <translation>ein anderes Programm arbeitet an diesem Spielort</translation>
    </message>
</context>
<context>
    <name>venue.wait-for-another</name>
    <message>
        <source>wait until it has finished, or close it, then try again</source>
        <translation>warten Sie, bis es fertig ist, oder beenden Sie es, dann versuchen Sie es noch einmal</translation>
    </message>
</context>
<context>
    <name>view.cannot-write-picture</name>
    <message>
        <source>the picture could not be written</source>
        <translation>das Bild konnte nicht geschrieben werden</translation>
    </message>
</context>
<context>
    <name>view.choose-writable-folder</name>
    <message>
        <source>choose a folder that you may write to, with free space</source>
        <translation>wählen Sie einen Ordner, in den Sie schreiben dürfen und in dem Platz ist</translation>
    </message>
</context>
<context>
    <name>wizard.allow-commands</name>
    <message>
        <source>open the venue anew and allow its programs</source>
        <translation>Den Spielort neu öffnen und seine Programme erlauben</translation>
    </message>
</context>
</TS>
