<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="it">
<context>
    <name>About</name>
    <message>
        <source>About Relucent</source>
        <translation>Informazioni su Relucent</translation>
    </message>
    <message>
        <source>Version %1, with these libraries: %2.</source>
        <translation>Versione %1, con queste librerie: %2.</translation>
    </message>
</context>
<context>
    <name>ContentFiles</name>
    <message>
        <source>Pictures and films</source>
        <translation>Immagini e filmati</translation>
    </message>
    <message>
        <source>Pictures</source>
        <translation>Immagini</translation>
    </message>
    <message>
        <source>All files</source>
        <translation>Tutti i file</translation>
    </message>
</context>
<context>
    <name>DeviceLabel</name>
    <message>
        <source>Projector %1</source>
        <translation>Proiettore %1</translation>
    </message>
    <message>
        <source>Camera %1</source>
        <translation>Fotocamera %1</translation>
    </message>
</context>
<context>
    <name>EndQuestion</name>
    <message>
        <source>A measurement is under way</source>
        <translation>È in corso una misura</translation>
    </message>
    <message>
        <source>%1 in the venue “%2”.</source>
        <translation>%1 nel luogo «%2».</translation>
    </message>
    <message>
        <source>Every photograph is on the disk. Opened again, the venue goes on from there.</source>
        <translation>Ogni foto è sul disco. Riaprendo il luogo si prosegue da lì.</translation>
    </message>
    <message>
        <source>End it for now</source>
        <translation>Terminala per ora</translation>
    </message>
    <message>
        <source>Go on measuring</source>
        <translation>Prosegui la misura</translation>
    </message>
    <message>
        <source>The show of the venue “%1”: the projector&apos;s screen goes dark.</source>
        <translation>Lo show del luogo «%1»: lo schermo del proiettore si spegne.</translation>
    </message>
    <message>
        <source>Playlist and results are on the disk. Open the output again to play the show again.</source>
        <translation>Elenco e risultati sono sul disco. Riaprire l’uscita per riprodurre di nuovo lo show.</translation>
    </message>
    <message>
        <source>A measurement and a show are under way</source>
        <translation>Sono in corso una misura e uno show</translation>
    </message>
    <message>
        <source>End both</source>
        <translation>Termina entrambi</translation>
    </message>
    <message>
        <source>Let both go on</source>
        <translation>Lascia proseguire entrambi</translation>
    </message>
    <message>
        <source>A show is playing</source>
        <translation>È in corso uno show</translation>
    </message>
    <message>
        <source>End the show</source>
        <translation>Termina lo show</translation>
    </message>
    <message>
        <source>Go on playing</source>
        <translation>Continua la riproduzione</translation>
    </message>
    <message>
        <source>The show of the venue “%1”.</source>
        <translation>Lo spettacolo del luogo «%1».</translation>
    </message>
</context>
<context>
    <name>Failure</name>
    <message>
        <source>The computer has no memory left.</source>
        <translation>Memoria del computer esaurita.</translation>
    </message>
    <message>
        <source>Close other programs, or choose fewer pixels.</source>
        <translation>Chiudere altri programmi o scegliere meno pixel.</translation>
    </message>
    <message>
        <source>Relucent made a mistake.</source>
        <translation>Errore interno di Relucent.</translation>
    </message>
    <message>
        <source>What is saved is safe. Copy the details for whoever looks after the program, then try again.</source>
        <translation>Quanto salvato è al sicuro. Copiare i dettagli per chi si occupa del programma, poi riprovare.</translation>
    </message>
    <message>
        <source>What is saved is safe. Try again.</source>
        <translation>Quanto salvato è al sicuro. Riprovare.</translation>
    </message>
    <message>
        <source>The camera does not see this projector</source>
        <translation>La fotocamera non vede questo proiettore</translation>
    </message>
    <message>
        <source>A program of this venue failed</source>
        <translation>Un programma di questo luogo è fallito</translation>
    </message>
    <message>
        <source>Another command is typed at the step Venue, by “Change the programs”.</source>
        <translation>Un altro comando si scrive al passo «Luogo», con «Cambia i programmi».</translation>
    </message>
</context>
<context>
    <name>FullDisk</name>
    <message>
        <source>The disk is full. Measuring has paused.</source>
        <translation>Il disco è pieno. La misura è in pausa.</translation>
    </message>
    <message>
        <source>Every photograph is safe. %1 are free, %2 are needed: then measuring goes on by itself.</source>
        <translation>Ogni foto è al sicuro. Sono liberi %1, ne servono %2: poi la misura prosegue da sola.</translation>
    </message>
</context>
<context>
    <name>LostDevice</name>
    <message>
        <source>The projector&apos;s screen is unplugged</source>
        <translation>Lo schermo del proiettore è scollegato</translation>
    </message>
    <message>
        <source>Everything so far is safe. Plug it in again: it goes on by itself.</source>
        <translation>Tutto ciò che è fatto è al sicuro. Ricollegarlo: prosegue da solo.</translation>
    </message>
    <message>
        <source>Everything so far is safe. Push in its cable at both ends, and do not move the tripod: it goes on by itself.</source>
        <translation>Tutto ciò che è fatto è al sicuro. Premere il cavo a entrambi i capi senza spostare il treppiede: prosegue da sola.</translation>
    </message>
    <message>
        <source>The camera does not answer</source>
        <translation>La fotocamera non risponde</translation>
    </message>
    <message>
        <source>Screen unplugged</source>
        <translation>Schermo scollegato</translation>
    </message>
    <message>
        <source>Camera silent</source>
        <translation>Fotocamera muta</translation>
    </message>
    <message>
        <source>%1: its screen is unplugged</source>
        <extracomment>%1 is a projector: its name, or &quot;Projector 2&quot;</extracomment>
        <translation>%1: il suo schermo è scollegato</translation>
    </message>
    <message>
        <source>%1 does not answer</source>
        <extracomment>%1 is a camera: its name, or &quot;Camera 2&quot;</extracomment>
        <translation>%1 non risponde</translation>
    </message>
    <message>
        <source>Everything so far is safe. Plug it in again, then resume.</source>
        <translation>Tutto ciò che è fatto è al sicuro. Ricollegarlo, poi riprendere.</translation>
    </message>
    <message>
        <source>Everything so far is safe. Push in its cable at both ends, and do not move the tripod, then resume.</source>
        <translation>Tutto ciò che è fatto è al sicuro. Premere il cavo a entrambi i capi senza spostare il treppiede, poi riprendere.</translation>
    </message>
</context>
<context>
    <name>Method</name>
    <message>
        <source>Each pixel&apos;s brightness</source>
        <translation>Luminosità di ogni pixel</translation>
    </message>
    <message>
        <source>Each pixel on its own</source>
        <translation>Ogni pixel da solo</translation>
    </message>
    <message>
        <source>Each pixel, sharpened</source>
        <translation>Ogni pixel, più nitido</translation>
    </message>
    <message>
        <source>Clusters</source>
        <translation>Cluster</translation>
    </message>
    <message>
        <source>Windows</source>
        <translation>Finestre</translation>
    </message>
    <message>
        <source>All bounces, for films</source>
        <translation>Tutti i rimbalzi, per i video</translation>
    </message>
    <message>
        <source>Uncorrected</source>
        <translation>Senza correzione</translation>
    </message>
    <message>
        <source>All bounces, solved, for stills</source>
        <translation>Rimbalzi risolti, immagini fisse</translation>
    </message>
</context>
<context>
    <name>NumberText</name>
    <message>
        <source>%1 million</source>
        <translation>%1 milioni</translation>
    </message>
    <message>
        <source>%1 billion</source>
        <translation>%1 miliardi</translation>
    </message>
</context>
<context>
    <name>Overlay</name>
    <message>
        <source>%1 frames a second, %2 ms a frame, %3 of %4 late</source>
        <translation>%1 fotogrammi al secondo, %2 ms a fotogramma, %3 di %4 in ritardo</translation>
    </message>
    <message>
        <source>not compensated</source>
        <translation>non compensata</translation>
    </message>
    <message>
        <source>frozen</source>
        <translation>congelata</translation>
    </message>
    <message>
        <source>test chart: %1</source>
        <translation>carta di test: %1</translation>
    </message>
    <message numerus="yes">
        <source>compensated, %n step(s), %1 % out of reach</source>
        <translation>
            <numerusform>compensata, %n passo, %1 % non raggiungibile</numerusform>
            <numerusform>compensata, %n passi, %1 % non raggiungibile</numerusform>
        </translation>
    </message>
    <message>
        <source>still picture</source>
        <translation>immagine fissa</translation>
    </message>
    <message>
        <source>follows a viewer within %1 ms</source>
        <translation>segue uno spettatore entro %1 ms</translation>
    </message>
    <message>
        <source>perfected by photographs</source>
        <translation>perfezionata con fotografie</translation>
    </message>
    <message>
        <source>live picture within %1 ms of its arrival</source>
        <translation>immagine dal vivo entro %1 ms dall’arrivo</translation>
    </message>
</context>
<context>
    <name>RecentVenues</name>
    <message>
        <source>Nothing measured yet</source>
        <translation>Ancora nessuna misura</translation>
    </message>
    <message>
        <source>Acquire is next</source>
        <translation>Segue Acquisizione</translation>
    </message>
    <message>
        <source>Ready to play</source>
        <translation>Pronto per riprodurre</translation>
    </message>
    <message>
        <source>Preview out of date</source>
        <translation>Anteprima da aggiornare</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Misurato</translation>
    </message>
    <message numerus="yes">
        <source>Interrupted: %n pattern(s) are safe</source>
        <translation>
            <numerusform>Interrotta: %n pattern è al sicuro</numerusform>
            <numerusform>Interrotta: %n pattern sono al sicuro</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Measured; %n newer pattern(s) are safe</source>
        <translation>
            <numerusform>Misurato; %n pattern più recente al sicuro</numerusform>
            <numerusform>Misurato; %n pattern più recenti al sicuro</numerusform>
        </translation>
    </message>
    <message>
        <source>Ended by a change</source>
        <translation>Finita per un cambiamento</translation>
    </message>
    <message>
        <source>Stopped at blocks of %1 px</source>
        <translation>Fermata a blocchi di %1 px</translation>
    </message>
    <message>
        <source>Stopped at %1 px; newer patterns: %2</source>
        <translation>Fermata a %1 px; pattern più recenti: %2</translation>
    </message>
    <message>
        <source>A show plays</source>
        <translation>È in corso uno show</translation>
    </message>
</context>
<context>
    <name>ScreenChoice</name>
    <message>
        <source>This computer</source>
        <translation>Questo computer</translation>
    </message>
    <message>
        <source>%1, %2 × %3, %4 Hz</source>
        <translation>%1, %2 × %3, %4 Hz</translation>
    </message>
    <message>
        <source>There is no other screen: the patterns cover this window while they are shown. Plug the projector in, and switch the desktop to extended screens, to keep both apart.</source>
        <translation>Non c’è un altro schermo: i pattern coprono questa finestra mentre sono mostrati. Per tenerli separati, collegare il proiettore ed estendere il desktop a più schermi.</translation>
    </message>
    <message>
        <source>This is the screen that you work on. Choose the projector&apos;s.</source>
        <translation>È lo schermo su cui si lavora. Scegliere quello del proiettore.</translation>
    </message>
    <message>
        <source>The projector was measured with %1 pixels. Set this screen to that size.</source>
        <translation>Il proiettore è stato misurato con %1 pixel. Impostare questo schermo a quella dimensione.</translation>
    </message>
    <message>
        <source>This is another projector than the one that was measured. Its light and its place differ: take a verification photograph, and measure again where that does not look as predicted.</source>
        <translation>Questo non è il proiettore che è stato misurato. La sua luce e il suo posto sono diversi: scattare una foto di verifica e misurare di nuovo se non appare come previsto.</translation>
    </message>
    <message>
        <source>Measured at %1, used at %2. If it is the same projector in the same place, everything that was measured holds; a verification photograph tells.</source>
        <translation>Misurato su %1, usato su %2. Se è lo stesso proiettore nello stesso posto, tutto ciò che è stato misurato resta valido; una foto di verifica lo mostra.</translation>
    </message>
</context>
<context>
    <name>StoppedEarly</name>
    <message>
        <source>Measuring was stopped at blocks of %1 px</source>
        <translation>La misura è stata fermata a blocchi di %1 px</translation>
    </message>
    <message>
        <source>All that follows is as coarse. Go on measuring any time.</source>
        <translation>Tutto ciò che segue è altrettanto grossolano. Si può continuare la misura in ogni momento.</translation>
    </message>
    <message>
        <source>Go on at Acquire</source>
        <translation>Continua in «Acquisizione»</translation>
    </message>
    <message>
        <source>What was measured does not fit together</source>
        <translation>Le misure non concordano</translation>
    </message>
    <message>
        <source>Corrected pictures are expected at %1: that is no better than uncorrected. Measure again.</source>
        <translation>Per le immagini corrette si prevedono %1: non meglio che senza correzione. Misurare di nuovo.</translation>
    </message>
    <message>
        <source>%1 dB</source>
        <translation>%1 dB</translation>
    </message>
    <message>
        <source>Go to Acquire</source>
        <translation>Vai a «Acquisizione»</translation>
    </message>
    <message>
        <source>Measuring ended because something had changed</source>
        <translation>La misura è finita perché qualcosa era cambiato</translation>
    </message>
    <message>
        <source>What follows is of before. See at Acquire what helps.</source>
        <translation>Ciò che segue è di prima. In «Acquisizione» è indicato che cosa aiuta.</translation>
    </message>
    <message>
        <source>%1 of the view is too bright for the camera</source>
        <translation>Il %1 della vista è troppo luminoso per la fotocamera</translation>
    </message>
    <message>
        <source>Nothing is corrected there. Close the lens a little, check the camera, then measure again.</source>
        <translation>Lì non si corregge nulla. Chiudere un po’ l’obiettivo, controllare la fotocamera, poi misurare di nuovo.</translation>
    </message>
    <message>
        <source>%1 of the view is left out</source>
        <translation>Il %1 della vista è escluso</translation>
    </message>
    <message>
        <source>Test patterns looked different there from what was measured, and nothing is corrected. See that all stands still, then measure again.</source>
        <translation>Lì i motivi di prova erano diversi da quanto misurato, e non si corregge nulla. Fare in modo che tutto resti fermo, poi misurare di nuovo.</translation>
    </message>
    <message>
        <source>Measuring was stopped before anything was told apart</source>
        <translation>La misura è stata interrotta prima di distinguere qualcosa</translation>
    </message>
    <message>
        <source>No picture can be corrected by it. Go on measuring, or use the earlier one, at Acquire.</source>
        <translation>Con questa non si può correggere alcuna immagine. Continuare a misurare o usare quella precedente, in «Acquisizione».</translation>
    </message>
    <message>
        <source>No picture can be corrected by it. Go on measuring any time.</source>
        <translation>Con questa non si può correggere alcuna immagine. Continuare a misurare in qualsiasi momento.</translation>
    </message>
    <message>
        <source>Measuring again has not ended</source>
        <translation>La nuova misura non è finita</translation>
    </message>
    <message>
        <source>What was measured is out of date: it belongs to earlier settings</source>
        <translation>La misura non è aggiornata: appartiene a impostazioni precedenti</translation>
    </message>
    <message>
        <source>It still works, and what you see follows from the earlier measurement, until the new one is ready.</source>
        <translation>La misura precedente resta utilizzabile, e ciò che si vede ne deriva, finché la nuova non è pronta.</translation>
    </message>
</context>
<context>
    <name>VenueKeeping</name>
    <message>
        <source>It is being measured.</source>
        <translation>È in corso di misura.</translation>
    </message>
    <message>
        <source>It is open. Open another venue, then come back.</source>
        <translation>È aperto. Aprire un altro luogo, poi tornare qui.</translation>
    </message>
    <message>
        <source>Give the venue a name.</source>
        <translation>Dare un nome al luogo.</translation>
    </message>
    <message>
        <source>A name cannot hold a slash.</source>
        <translation>Un nome non può contenere barre.</translation>
    </message>
    <message>
        <source>A name cannot begin with a full stop: its folder would be hidden.</source>
        <translation>Un nome non può iniziare con un punto: la sua cartella sarebbe nascosta.</translation>
    </message>
    <message>
        <source>There is a folder of that name. Choose another name.</source>
        <translation>Esiste già una cartella con quel nome. Scegliere un altro nome.</translation>
    </message>
    <message>
        <source>Its show starts at log-in. Open it, and remove the installed show at Output first.</source>
        <translation>Il suo show parte all’accesso. Aprirlo e rimuovere prima lo show installato in Uscita.</translation>
    </message>
</context>
<context>
    <name>ViewActions</name>
    <message>
        <source>Show everything</source>
        <translation>Mostra tutto</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>Salva</translation>
    </message>
    <message>
        <source>Picture as seen</source>
        <translation>Immagine a schermo</translation>
    </message>
    <message>
        <source>Save the picture</source>
        <translation>Salva l’immagine</translation>
    </message>
    <message>
        <source>Pictures (*.png)</source>
        <translation>Immagini (*.png)</translation>
    </message>
    <message>
        <source>Values</source>
        <translation>Valori</translation>
    </message>
    <message>
        <source>Save the values</source>
        <translation>Salva i valori</translation>
    </message>
    <message>
        <source>OpenEXR (*.exr)</source>
        <translation>OpenEXR (*.exr)</translation>
    </message>
    <message>
        <source>Whole screen, save</source>
        <translation>Schermo intero, salva</translation>
    </message>
    <message>
        <source>Whole screen (F11 in the picture)</source>
        <translation>Schermo intero (F11 nell’immagine)</translation>
    </message>
</context>
<context>
    <name>WindowProjector</name>
    <message>
        <source>The desktop scales this screen by %1, which blurs every pixel. Set its scale to 100 %.</source>
        <translation>Il desktop ridimensiona questo schermo di %1 volte e sfoca ogni pixel. Impostare la scala al 100 %.</translation>
    </message>
    <message>
        <source>A venue is being measured</source>
        <translation>Misura di un luogo in corso</translation>
    </message>
</context>
<context>
    <name>acquisition.alarm-skipped</name>
    <message>
        <source>accepted before pattern {}: {}</source>
        <translation>accettato prima del pattern {}: {}</translation>
    </message>
</context>
<context>
    <name>acquisition.ended-by-change</name>
    <message>
        <source>measuring ended with a change: {}; photographs from No. {} on are left out</source>
        <translation>la misura è finita con un cambiamento: {}; le foto dalla n. {} in poi sono tralasciate</translation>
    </message>
</context>
<context>
    <name>acquisition.light-drifted</name>
    <message>
        <source>The light changed by {} % between the first and the last photograph; this was compensated for, but let the projector warm up before the next time</source>
        <translation>la luce è cambiata del {} % tra la prima e l’ultima foto; se n’è tenuto conto, ma la prossima volta lasciare prima scaldare il proiettore</translation>
    </message>
</context>
<context>
    <name>acquisition.overexposed</name>
    <message>
        <source>{} % of the camera pixels are overexposed even at the shortest exposure: close the camera&apos;s aperture a little, then measure again</source>
        <translation>il {} % dei pixel della fotocamera è sovraesposto anche con l’esposizione più breve: chiudere un po’ il diaframma della fotocamera, poi misurare di nuovo</translation>
    </message>
</context>
<context>
    <name>acquisition.pixels-flagged</name>
    <message>
        <source>{} % of the camera pixels do not see what was predicted for the test patterns: check that nothing moved or flickered; these pixels are left out of the compensation</source>
        <translation>il {} % dei pixel della fotocamera vede qualcosa di diverso dal previsto nei pattern di prova: controllare che nulla si sia mosso o abbia sfarfallato; questi pixel sono esclusi dalla compensazione</translation>
    </message>
</context>
<context>
    <name>acquisition.poor-quality</name>
    <message>
        <source>What was measured does not fit together: corrected pictures are expected at {} dB, no better than uncorrected; see that projector, camera and surface stand still and that no other light changes, then measure again</source>
        <translation>Le misure non concordano: per le immagini corrette si prevedono {} dB, non meglio che senza correzione; verificare che proiettore, fotocamera e superficie stiano fermi e che nessun&apos;altra luce cambi, poi misurare di nuovo</translation>
    </message>
</context>
<context>
    <name>acquisition.stopped-early</name>
    <message>
        <source>Measuring was stopped at blocks of {} px: what is finer is missing, and pictures are compensated less sharply; go on measuring any time as long as nothing has moved</source>
        <translation>La misura è stata fermata a blocchi di {} px: ciò che è più fine manca e le immagini sono compensate con meno nitidezza; proseguire la misura in qualsiasi momento, purché nulla si sia mosso</translation>
    </message>
</context>
<context>
    <name>acquisition.stopped-with-forecast</name>
    <message numerus="yes">
        <source>Stopped at {} px blocks; {} dB expected, about {} dB with {} more photographs, {}; go on measuring any time as long as nothing has moved</source>
        <comment>Stopped at {} px blocks; {} dB expected, about {} dB with {} more photograph, {}; go on measuring any time as long as nothing has moved</comment>
        <translation>
            <numerusform>Interrotto a blocchi di {} px; {} dB attesi, circa {} dB con {} altra foto, {}; continui a misurare in qualsiasi momento finché nulla si è mosso</numerusform>
            <numerusform>Interrotto a blocchi di {} px; {} dB attesi, circa {} dB con altre {} foto, {}; continui a misurare in qualsiasi momento finché nulla si è mosso</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>acquisition.taken-again</name>
    <message numerus="yes">
        <source>{}: {} patterns from No. {} on were photographed again</source>
        <comment>{}: {} pattern from No. {} on was photographed again</comment>
        <translation>
            <numerusform>{}: {} pattern è stato rifotografato dal n. {} in poi</numerusform>
            <numerusform>{}: {} pattern sono stati rifotografati dal n. {} in poi</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>alarm.by-resuming</name>
    <message>
        <source>{} by resuming the calibration; {}</source>
        <translation>{} riprendendo la calibrazione; {}</translation>
    </message>
</context>
<context>
    <name>alarm.camera-sees-nothing</name>
    <message>
        <source>the camera sees nothing at all</source>
        <translation>la fotocamera non vede assolutamente nulla</translation>
    </message>
</context>
<context>
    <name>alarm.check-screen</name>
    <message>
        <source>check that the right screen is chosen and nothing covers the picture, then try again</source>
        <translation>controllare che sia scelto lo schermo giusto e che nulla copra l’immagine, poi riprovare</translation>
    </message>
</context>
<context>
    <name>alarm.clear-the-view</name>
    <message>
        <source>take away what is in the light or in the view, then try again</source>
        <translation>togliere ciò che si trova nella luce o nell’inquadratura, poi riprovare</translation>
    </message>
</context>
<context>
    <name>alarm.lamp-changed</name>
    <message>
        <source>the projector&apos;s light changed by {} % within a few photographs</source>
        <translation>la luce del proiettore è cambiata del {} % nel giro di poche foto</translation>
    </message>
</context>
<context>
    <name>alarm.leave-it-as-it-is</name>
    <message>
        <source>leave it as it is now, then try again: measuring begins again</source>
        <translation>lascialo com’è ora e riprova: la misura ricomincia</translation>
    </message>
</context>
<context>
    <name>alarm.light-flickers</name>
    <message>
        <source>the light flickers or was switched: photographs of one pattern differ by {} %</source>
        <translation>la luce sfarfalla o è stata accesa o spenta: le fotografie dello stesso motivo differiscono del {} %</translation>
    </message>
</context>
<context>
    <name>alarm.light-room-or-measure-again</name>
    <message>
        <source>switch on again what shone when measuring began, then try again; or stop, and measure again in the light as it is now</source>
        <translation>riaccendi ciò che illuminava all’inizio della misura e riprova; oppure ferma e misura di nuovo con la luce di adesso</translation>
    </message>
</context>
<context>
    <name>alarm.moved</name>
    <message>
        <source>a camera or projector has moved: the view of camera {} is shifted by {}, {} pixels and turned by {} degrees</source>
        <translation>una fotocamera o un proiettore si è spostato: l’inquadratura della fotocamera {} è spostata di {}, {} pixel e ruotata di {} gradi</translation>
    </message>
</context>
<context>
    <name>alarm.moved-besides</name>
    <message>
        <source>{}; besides, {}</source>
        <translation>{}; inoltre, {}</translation>
    </message>
</context>
<context>
    <name>alarm.photograph-dark</name>
    <message>
        <source>one of two photographs of a pattern is dark: the lens was covered, or the projector&apos;s picture gone</source>
        <translation>una di due fotografie di un pattern è scura: l’obiettivo era coperto, o mancava l’immagine del proiettore</translation>
    </message>
</context>
<context>
    <name>alarm.photographs-differ</name>
    <message>
        <source>photographs of one pattern differ by {} %: the light flickers, or something moved between them</source>
        <translation>le foto di uno stesso pattern differiscono del {} %: la luce sfarfalla, oppure tra l’una e l’altra qualcosa si è mosso</translation>
    </message>
</context>
<context>
    <name>alarm.picture-mirrored</name>
    <message>
        <source>the picture of projector {} appears mirrored</source>
        <translation>l’immagine del proiettore {} appare specchiata</translation>
    </message>
</context>
<context>
    <name>alarm.projector-shows-nothing</name>
    <message>
        <source>the projector shows nothing, though the room&apos;s own light is still seen</source>
        <translation>il proiettore non mostra nulla, ma la luce della sala è ancora visibile</translation>
    </message>
</context>
<context>
    <name>alarm.put-back-or-measure-again</name>
    <message>
        <source>put it back, then try again; or stop, and measure again without it</source>
        <translation>rimettilo al suo posto e riprova; oppure ferma e misura di nuovo senza</translation>
    </message>
</context>
<context>
    <name>alarm.put-it-back</name>
    <message>
        <source>put it back to within half a pixel, then try again</source>
        <translation>riportarlo in posizione entro mezzo pixel, poi riprovare</translation>
    </message>
</context>
<context>
    <name>alarm.put-it-back-and-restore-light</name>
    <message>
        <source>put it back to within half a pixel and restore the light of the room, then try again</source>
        <translation>riportarlo in posizione entro mezzo pixel e la luce della sala com’era, poi riprovare</translation>
    </message>
</context>
<context>
    <name>alarm.restore-room-light</name>
    <message>
        <source>restore the light of the room, keep doors and curtains closed, then try again</source>
        <translation>riportarla com’era, tenere chiuse porte e tende, poi riprovare</translation>
    </message>
</context>
<context>
    <name>alarm.room-brighter</name>
    <message>
        <source>the light of the room became brighter</source>
        <translation>la luce della sala è aumentata</translation>
    </message>
</context>
<context>
    <name>alarm.room-darker</name>
    <message>
        <source>the light of the room became darker</source>
        <translation>la luce della sala è diminuita</translation>
    </message>
</context>
<context>
    <name>alarm.safe-before-check</name>
    <message>
        <source>every photograph up to the previous check is safe</source>
        <translation>ogni foto fino al controllo precedente è al sicuro</translation>
    </message>
</context>
<context>
    <name>alarm.safe-before-light-transport</name>
    <message>
        <source>every photograph before the light transport is safe</source>
        <translation>ogni foto precedente al trasporto della luce è al sicuro</translation>
    </message>
</context>
<context>
    <name>alarm.something-gone</name>
    <message>
        <source>{} % of the view of camera {} are brighter than before: what stood there is gone</source>
        <translation>il {} % dell’inquadratura della fotocamera {} è più chiaro di prima: ciò che c’era non c’è più</translation>
    </message>
</context>
<context>
    <name>alarm.steady-all</name>
    <message>
        <source>see that camera, projector and surface stand still, switch off dimmed and fluorescent lamps and the projector&apos;s power saving, then try again</source>
        <translation>verificare che fotocamera, proiettore e superficie stiano fermi, spegnere le lampade con dimmer e fluorescenti, disattivare il risparmio energetico del proiettore, poi riprovare</translation>
    </message>
</context>
<context>
    <name>alarm.switch-off-dimmed-lamps</name>
    <message>
        <source>switch off dimmed and fluorescent lamps and the projector&apos;s power saving, then try again</source>
        <translation>spegnere le lampade con dimmer e fluorescenti, disattivare il risparmio energetico del proiettore, poi riprovare</translation>
    </message>
</context>
<context>
    <name>alarm.switch-off-eco-modes</name>
    <message>
        <source>switch off its automatic brightness and eco modes, let it warm up, then try again</source>
        <translation>disattivarne la luminosità automatica e le modalità eco, lasciarlo scaldare, poi riprovare</translation>
    </message>
</context>
<context>
    <name>alarm.switch-off-rear-projection</name>
    <message>
        <source>switch off the projector&apos;s rear or ceiling mode, or allow a mirrored picture, then try again</source>
        <translation>disattivare la modalità retroproiezione o soffitto del proiettore, o consentire un’immagine specchiata, poi riprovare</translation>
    </message>
</context>
<context>
    <name>alarm.uncover-lens</name>
    <message>
        <source>uncover the lens, check that the projector is on, then try again</source>
        <translation>scoprire l’obiettivo, controllare che il proiettore sia acceso, poi riprovare</translation>
    </message>
</context>
<context>
    <name>alarm.view-changed</name>
    <message>
        <source>{} % of the view of camera {} look different from before</source>
        <translation>il {} % dell’inquadratura della fotocamera {} appare diverso da prima</translation>
    </message>
</context>
<context>
    <name>alarm.wake-projector</name>
    <message>
        <source>wake the projector, switch off its and the screen&apos;s power saving, then try again</source>
        <translation>riattivare il proiettore, disattivarne il risparmio energetico e quello dello schermo, poi riprovare</translation>
    </message>
</context>
<context>
    <name>alarm.wrong-picture</name>
    <message>
        <source>projector {} does not show the picture that it is given</source>
        <translation>il proiettore {} non mostra l’immagine che gli viene inviata</translation>
    </message>
</context>
<context>
    <name>calibration.allow-writing-then-resume</name>
    <message>
        <source>check that the folder may be written to, then go on</source>
        <translation>controllare che la cartella sia scrivibile, poi proseguire</translation>
    </message>
</context>
<context>
    <name>calibration.allow-writing-then-retry</name>
    <message>
        <source>check that the folder may be written to, then try again</source>
        <translation>controllare che la cartella sia scrivibile, poi riprovare</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-list-folder</name>
    <message>
        <source>cannot look into the folder ({})</source>
        <translation>impossibile esaminare il contenuto della cartella ({})</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-move-photograph</name>
    <message>
        <source>a photograph cannot be moved ({})</source>
        <translation>impossibile spostare una foto ({})</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-open-folder</name>
    <message>
        <source>cannot open the folder ({})</source>
        <translation>impossibile aprire la cartella ({})</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-remove-photograph</name>
    <message>
        <source>a photograph cannot be removed ({})</source>
        <translation>impossibile eliminare una foto ({})</translation>
    </message>
</context>
<context>
    <name>calibration.check-path-and-permission</name>
    <message>
        <source>check the path and that you may read it</source>
        <translation>controllare il percorso e i permessi di lettura</translation>
    </message>
</context>
<context>
    <name>calibration.check-permission-or-name</name>
    <message>
        <source>check that you may read it, or choose another name</source>
        <translation>controllare di avere il permesso di lettura o scegliere un altro nome</translation>
    </message>
</context>
<context>
    <name>calibration.choose-another-or-copy-again</name>
    <message>
        <source>choose another calibration, or copy it again from where it was measured</source>
        <translation>scegliere un’altra calibrazione o copiarla di nuovo da dove è stata misurata</translation>
    </message>
</context>
<context>
    <name>calibration.disk-full</name>
    <message>
        <source>the disk is full</source>
        <translation>il disco è pieno</translation>
    </message>
</context>
<context>
    <name>calibration.give-addresses-again</name>
    <message>
        <source>give the projectors&apos; addresses again</source>
        <translation>indichi di nuovo gli indirizzi dei proiettori</translation>
    </message>
</context>
<context>
    <name>calibration.make-room-then-resume</name>
    <message>
        <source>every photograph so far is safe: free at least {} MB there, then resume</source>
        <translation>ogni foto scattata finora è al sicuro: liberare lì almeno {} MB, poi riprendere</translation>
    </message>
</context>
<context>
    <name>calibration.manifest-damaged</name>
    <message>
        <source>the file that describes the venue is damaged</source>
        <translation>il file che descrive il luogo è danneggiato</translation>
    </message>
</context>
<context>
    <name>calibration.network-unreadable</name>
    <message>
        <source>the addresses of the projectors on the network cannot be read ({})</source>
        <translation>gli indirizzi dei proiettori in rete non si possono leggere ({})</translation>
    </message>
</context>
<context>
    <name>calibration.not-a-calibration</name>
    <message>
        <source>this is not a calibration of Relucent</source>
        <translation>questa non è una calibrazione di Relucent</translation>
    </message>
</context>
<context>
    <name>calibration.result-file-missing</name>
    <message>
        <source>a file of the calibration&apos;s {} is missing</source>
        <translation>manca un file della calibrazione ({})</translation>
    </message>
</context>
<context>
    <name>calibration.result-file-size-wrong</name>
    <message>
        <source>a file of the calibration&apos;s {} has {} bytes instead of {}</source>
        <translation>un file della calibrazione ({}) ha {} byte invece di {}</translation>
    </message>
</context>
<context>
    <name>cast.check-screen</name>
    <message>
        <source>see whether the screen is on, or the window open</source>
        <translation>controllare che lo schermo sia acceso, o la finestra aperta</translation>
    </message>
</context>
<context>
    <name>cast.choice-refused</name>
    <message>
        <source>the desktop no longer gives what was chosen for it</source>
        <translation>il desktop non dà più ciò che era stato scelto</translation>
    </message>
</context>
<context>
    <name>cast.choose-again</name>
    <message>
        <source>play it again, and choose there what is shown</source>
        <translation>riprodurlo di nuovo e scegliere lì che cosa mostrare</translation>
    </message>
</context>
<context>
    <name>cast.choose-in-wizard</name>
    <message>
        <source>play it once in the wizard, on Output, and choose there; a show then takes the same</source>
        <translation>riprodurlo una volta nella procedura guidata, in «Uscita», e scegliere lì; uno show prende poi lo stesso</translation>
    </message>
</context>
<context>
    <name>cast.ended</name>
    <message>
        <source>the desktop has ended it</source>
        <translation>il desktop lo ha terminato</translation>
    </message>
</context>
<context>
    <name>cast.install-pipewire</name>
    <message>
        <source>install pipewire and wireplumber, and log in again</source>
        <translation>installare pipewire e wireplumber e accedere di nuovo</translation>
    </message>
</context>
<context>
    <name>cast.install-portal</name>
    <message>
        <source>install xdg-desktop-portal and its part for this desktop, and log in again</source>
        <translation>installare xdg-desktop-portal e la sua parte per questo desktop e accedere di nuovo</translation>
    </message>
</context>
<context>
    <name>cast.log-in-again</name>
    <message>
        <source>log in again</source>
        <translation>accedere di nuovo</translation>
    </message>
</context>
<context>
    <name>cast.no-pipewire</name>
    <message>
        <source>PipeWire, which brings the picture, does not answer</source>
        <translation>PipeWire, che porta l’immagine, non risponde</translation>
    </message>
</context>
<context>
    <name>cast.no-portal</name>
    <message>
        <source>this desktop has no portal that gives the picture of a screen</source>
        <translation>questo desktop non ha un portale che dia l’immagine di uno schermo</translation>
    </message>
</context>
<context>
    <name>cast.no-windows</name>
    <message>
        <source>this desktop gives pictures of screens, not of windows</source>
        <translation>questo desktop dà immagini di schermi, non di finestre</translation>
    </message>
</context>
<context>
    <name>cast.not-chosen</name>
    <message>
        <source>nobody has chosen in the desktop&apos;s dialog what is shown</source>
        <translation>nessuno ha scelto nella finestra di dialogo del desktop che cosa mostrare</translation>
    </message>
</context>
<context>
    <name>cast.play-screen</name>
    <message>
        <source>play the screen on which the window is</source>
        <translation>riprodurre lo schermo su cui si trova la finestra</translation>
    </message>
</context>
<context>
    <name>cast.portal-failed</name>
    <message>
        <source>the desktop&apos;s portal gives no picture ({})</source>
        <translation>il portale del desktop non dà alcuna immagine ({})</translation>
    </message>
</context>
<context>
    <name>cast.portal-silent</name>
    <message>
        <source>the desktop&apos;s portal has not answered for {} s</source>
        <translation>il portale del desktop non ha risposto per {} s</translation>
    </message>
</context>
<context>
    <name>cast.refused</name>
    <message>
        <source>it was refused in the desktop&apos;s dialog</source>
        <translation>è stato rifiutato nella finestra di dialogo del desktop</translation>
    </message>
</context>
<context>
    <name>cast.unusable</name>
    <message>
        <source>what the desktop sends is no picture that can be shown</source>
        <translation>ciò che il desktop invia non è un’immagine che si possa mostrare</translation>
    </message>
</context>
<context>
    <name>cast.update-desktop</name>
    <message>
        <source>update the desktop&apos;s portal and PipeWire</source>
        <translation>aggiornare il portale del desktop e PipeWire</translation>
    </message>
</context>
<context>
    <name>check.colour-wheel</name>
    <message>
        <source>The colours come one after the other, as through a colour wheel ({} % in {} ms): expose whole frames, multiples of {} ms.</source>
        <translation>I colori arrivano uno dopo l’altro, come da una ruota colore ({} % in {} ms): esporre fotogrammi interi, multipli di {} ms.</translation>
    </message>
</context>
<context>
    <name>check.dithering</name>
    <message>
        <source>The projector mixes greys in time, pixel by pixel ({} %): expose several whole frames, and switch its smoothing and 3D modes off.</source>
        <translation>Il proiettore mescola i grigi nel tempo, pixel per pixel ({} %): esporre più fotogrammi interi e disattivarne la levigatura e le modalità 3D.</translation>
    </message>
</context>
<context>
    <name>check.lamp-flickers</name>
    <message>
        <source>The lamp flickers within a frame, by {} % in {} ms: expose whole frames, multiples of {} ms.</source>
        <translation>La lampada sfarfalla entro un fotogramma, di {} % in {} ms: esporre fotogrammi interi, multipli di {} ms.</translation>
    </message>
</context>
<context>
    <name>check.light-even</name>
    <message>
        <source>The light is even: no flicker, colour wheel, bands or dithering is seen.</source>
        <translation>La luce è uniforme: né sfarfallio, né ruota colore, né bande, né dithering.</translation>
    </message>
</context>
<context>
    <name>check.light-unsteady</name>
    <message>
        <source>The light changes by {} % between exposures of whole frames: let the lamp warm up, and switch off dynamic brightness and the lamps in the room.</source>
        <translation>La luce cambia di {} % tra pose di fotogrammi interi: lasciare scaldare la lampada, disattivare la luminosità dinamica e spegnere le lampade della sala.</translation>
    </message>
</context>
<context>
    <name>check.no-brief-exposure</name>
    <message>
        <source>The camera cannot expose for a part of a frame, or sees too little then: flicker within a frame cannot be detected.</source>
        <translation>La fotocamera non può esporre per una parte di fotogramma, o allora vede troppo poco: lo sfarfallio entro un fotogramma non è rilevabile.</translation>
    </message>
</context>
<context>
    <name>check.other-screen-seen</name>
    <message>
        <source>The camera sees {} and not {}.</source>
        <translation>La fotocamera vede {} e non {}.</translation>
    </message>
</context>
<context>
    <name>check.picture-takes</name>
    <message>
        <source>A picture takes {} ms to appear: each one is waited for that long.</source>
        <translation>Un’immagine impiega {} ms ad apparire: ognuna viene attesa per questo tempo.</translation>
    </message>
</context>
<context>
    <name>check.pictures-late</name>
    <message numerus="yes">
        <source>Pictures arrive {} photographs late: measure the latency, so that it is waited for.</source>
        <comment>Pictures arrive {} photograph late: measure the latency, so that it is waited for.</comment>
        <translation>
            <numerusform>Le immagini arrivano in ritardo di {} foto: la latenza va misurata e attesa.</numerusform>
            <numerusform>Le immagini arrivano in ritardo di {} foto: la latenza va misurata e attesa.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>check.rolling-shutter</name>
    <message>
        <source>The camera exposes its rows one after the other (rolling shutter): brief exposures have bands of {} %. Expose whole frames, multiples of {} ms.</source>
        <translation>La fotocamera espone le righe una dopo l’altra (rolling shutter): le pose brevi hanno bande di {} %. Esporre fotogrammi interi, multipli di {} ms.</translation>
    </message>
</context>
<context>
    <name>check.screen-mirrored</name>
    <message>
        <source>The picture appears mirrored. If it is not meant to (rear projection, a mirror), switch that off in the projector&apos;s menu.</source>
        <translation>L’immagine appare specchiata. Se non è voluto (retroproiezione, uno specchio), disattivarlo nel menu del proiettore.</translation>
    </message>
</context>
<context>
    <name>check.screen-not-seen</name>
    <message>
        <source>The camera does not see {}.</source>
        <translation>La fotocamera non vede {}.</translation>
    </message>
</context>
<context>
    <name>check.screen-seen</name>
    <message>
        <source>The camera sees {}: {} % of its view follow the test pattern.</source>
        <translation>La fotocamera vede {}: {} % dell’inquadratura segue il pattern di prova.</translation>
    </message>
</context>
<context>
    <name>check.white-changes</name>
    <message>
        <source>White changes by {} % from photograph to photograph: expose whole frames of the projector, multiples of {} ms, and switch its dynamic brightness off.</source>
        <translation>Il bianco cambia di {} % da una foto all’altra: esporre fotogrammi interi del proiettore, multipli di {} ms, e disattivarne la luminosità dinamica.</translation>
    </message>
</context>
<context>
    <name>compensation.draw-masks-of-cameras</name>
    <message>
        <source>draw masks in the views of the cameras that measured this calibration</source>
        <translation>disegnare le maschere nelle viste delle fotocamere che hanno misurato questa calibrazione</translation>
    </message>
</context>
<context>
    <name>compensation.mask-crosses-itself</name>
    <message>
        <source>its outline crosses itself</source>
        <translation>il suo contorno incrocia sé stesso</translation>
    </message>
</context>
<context>
    <name>compensation.mask-encloses-nothing</name>
    <message>
        <source>its outline encloses nothing</source>
        <translation>il suo contorno non racchiude nulla</translation>
    </message>
</context>
<context>
    <name>compensation.mask-feather-out-of-range</name>
    <message>
        <source>its feather must lie between 0 and half of the view&apos;s larger side</source>
        <translation>il suo bordo sfumato deve stare tra 0 e metà del lato maggiore della vista</translation>
    </message>
</context>
<context>
    <name>compensation.mask-not-finite</name>
    <message>
        <source>its points must be finite numbers</source>
        <translation>i suoi punti devono essere numeri finiti</translation>
    </message>
</context>
<context>
    <name>compensation.mask-of-no-camera</name>
    <message>
        <source>a mask was drawn in the view of camera {}, but there are {} cameras</source>
        <translation>una maschera è stata disegnata nella vista della fotocamera {}, ma le fotocamere sono {}</translation>
    </message>
</context>
<context>
    <name>compensation.mask-outside-view</name>
    <message>
        <source>its points must lie within the view, from 0 to 1 along both sides</source>
        <translation>i suoi punti devono stare nella vista, da 0 a 1 lungo entrambi i lati</translation>
    </message>
</context>
<context>
    <name>compensation.mask-point-twice</name>
    <message>
        <source>two points of its outline are the same</source>
        <translation>due punti del suo contorno coincidono</translation>
    </message>
</context>
<context>
    <name>compensation.mask-too-few-points</name>
    <message>
        <source>its outline needs three points at least</source>
        <translation>il suo contorno richiede almeno tre punti</translation>
    </message>
</context>
<context>
    <name>compensation.mask-too-many-points</name>
    <message>
        <source>its outline may have {} points at most</source>
        <translation>il suo contorno può avere al massimo {} punti</translation>
    </message>
</context>
<context>
    <name>compensation.masks-cover-everything</name>
    <message>
        <source>the masks cover the whole picture</source>
        <translation>le maschere coprono tutta l’immagine</translation>
    </message>
</context>
<context>
    <name>compensation.of-mask</name>
    <message>
        <source>mask {}: {}</source>
        <translation>maschera {}: {}</translation>
    </message>
</context>
<context>
    <name>compensation.shrink-masks</name>
    <message>
        <source>make a mask smaller, or remove one</source>
        <translation>rimpicciolire una maschera o rimuoverne una</translation>
    </message>
</context>
<context>
    <name>content.choose-picture-folder</name>
    <message>
        <source>choose a folder with PNG, JPEG, TIFF or EXR files</source>
        <translation>scegliere una cartella con file PNG, JPEG, TIFF o EXR</translation>
    </message>
</context>
<context>
    <name>content.choose-supported-picture</name>
    <message>
        <source>choose a PNG, JPEG, TIFF or EXR picture</source>
        <translation>scegliere un’immagine PNG, JPEG, TIFF o EXR</translation>
    </message>
</context>
<context>
    <name>content.connect-capture-device</name>
    <message>
        <source>plug it in, close other programs that use it, and try again</source>
        <translation>collegarlo, chiudere altri programmi che lo usano e riprovare</translation>
    </message>
</context>
<context>
    <name>content.log-in-to-xorg</name>
    <message>
        <source>log in to a desktop, or play files</source>
        <translation>accedere a un desktop, o riprodurre file</translation>
    </message>
</context>
<context>
    <name>content.no-pictures</name>
    <message>
        <source>no pictures in this folder</source>
        <translation>nessuna immagine in questa cartella</translation>
    </message>
</context>
<context>
    <name>content.no-x-server</name>
    <message>
        <source>the live picture of a screen needs an X server, and none answers</source>
        <translation>l’immagine dal vivo di uno schermo richiede un server X e nessuno risponde</translation>
    </message>
</context>
<context>
    <name>content.nothing-captured</name>
    <message>
        <source>the capture device gives no picture</source>
        <translation>il dispositivo di acquisizione non fornisce immagini</translation>
    </message>
</context>
<context>
    <name>content.open-first</name>
    <message>
        <source>open it first</source>
        <translation>aprirla prima</translation>
    </message>
</context>
<context>
    <name>content.open-first-or-choose</name>
    <message>
        <source>open it first; there are: {}</source>
        <translation>aprirla prima; ci sono: {}</translation>
    </message>
</context>
<context>
    <name>content.picture-unreadable</name>
    <message>
        <source>not a picture that can be read</source>
        <translation>non è un’immagine leggibile</translation>
    </message>
</context>
<context>
    <name>content.sequence-empty</name>
    <message>
        <source>the sequence has no pictures</source>
        <translation>la sequenza non ha immagini</translation>
    </message>
</context>
<context>
    <name>content.unknown-window</name>
    <message>
        <source>there is no window &apos;{}&apos;</source>
        <translation>non c’è nessuna finestra «{}»</translation>
    </message>
</context>
<context>
    <name>device.aim-uncover-and-expose-longer</name>
    <message>
        <source>aim it at the projection, take off its lens cap, and expose longer</source>
        <translation>puntarla sulla proiezione, togliere il tappo dell’obiettivo e usare un’esposizione più lunga</translation>
    </message>
</context>
<context>
    <name>device.allow-command-more-time</name>
    <message>
        <source>check the device, or allow the command more time: {}</source>
        <translation>controllare il dispositivo o concedere più tempo al comando: {}</translation>
    </message>
</context>
<context>
    <name>device.another-program-holds-camera</name>
    <message>
        <source>another program holds the camera</source>
        <translation>un altro programma sta usando la fotocamera</translation>
    </message>
</context>
<context>
    <name>device.ask-for-fewer-pixels</name>
    <message>
        <source>ask for that or less</source>
        <translation>richiedere quella dimensione o una minore</translation>
    </message>
</context>
<context>
    <name>device.ask-for-given-size</name>
    <message>
        <source>ask for the size that it gives</source>
        <translation>richiedere la dimensione che fornisce</translation>
    </message>
</context>
<context>
    <name>device.ask-for-listed-size</name>
    <message>
        <source>ask for a size that it has: v4l2-ctl --list-formats-ext names them</source>
        <translation>richiedere una dimensione disponibile: v4l2-ctl --list-formats-ext le elenca</translation>
    </message>
</context>
<context>
    <name>device.automatic-exposure-stays</name>
    <message>
        <source>the video device&apos;s automatic exposure cannot be switched off</source>
        <translation>impossibile disattivare l’esposizione automatica del dispositivo video</translation>
    </message>
</context>
<context>
    <name>device.automatic-focus-stays</name>
    <message>
        <source>the video device&apos;s automatic focus cannot be switched off</source>
        <translation>impossibile disattivare la messa a fuoco automatica del dispositivo video</translation>
    </message>
</context>
<context>
    <name>device.automatic-function-stays</name>
    <message>
        <source>{} cannot be switched off</source>
        <translation>impossibile disattivare {}</translation>
    </message>
</context>
<context>
    <name>device.automatic-iso</name>
    <message>
        <source>the camera chooses its sensitivity itself (automatic ISO)</source>
        <translation>la fotocamera sceglie da sola la sensibilità (ISO automatico)</translation>
    </message>
</context>
<context>
    <name>device.automatic-white-balance-stays</name>
    <message>
        <source>the video device&apos;s automatic white balance cannot be switched off</source>
        <translation>impossibile disattivare il bilanciamento automatico del bianco del dispositivo video</translation>
    </message>
</context>
<context>
    <name>device.battery-empty</name>
    <message>
        <source>the camera&apos;s battery seems to be empty ({} % when it was last asked)</source>
        <translation>la batteria della fotocamera sembra scarica ({} % all’ultima lettura)</translation>
    </message>
</context>
<context>
    <name>device.battery-low</name>
    <message>
        <source>has {} % left in its battery: a measurement needs a full one or a mains adapter</source>
        <translation>ha il {} % di batteria: una misura richiede la batteria piena o un alimentatore</translation>
    </message>
</context>
<context>
    <name>device.built-without-genicam</name>
    <message>
        <source>this build of Relucent does not know GenICam cameras</source>
        <translation>questa build di Relucent non supporta le fotocamere GenICam</translation>
    </message>
</context>
<context>
    <name>device.built-without-gphoto</name>
    <message>
        <source>this build of Relucent does not know DSLR and mirrorless cameras</source>
        <translation>questa build di Relucent non supporta le fotocamere reflex (DSLR) e mirrorless</translation>
    </message>
</context>
<context>
    <name>device.camera-asleep</name>
    <message>
        <source>the camera is there but does not answer, it may be asleep</source>
        <translation>la fotocamera è presente ma non risponde, forse è in standby</translation>
    </message>
</context>
<context>
    <name>device.camera-command-empty</name>
    <message>
        <source>the camera&apos;s command is empty</source>
        <translation>il comando della fotocamera è vuoto</translation>
    </message>
</context>
<context>
    <name>device.camera-command-lacks</name>
    <message>
        <source>the camera&apos;s command does not contain {}</source>
        <translation>nel comando della fotocamera manca {}</translation>
    </message>
</context>
<context>
    <name>device.camera-given-up</name>
    <message>
        <source>the camera does not answer</source>
        <translation>la fotocamera non risponde</translation>
    </message>
</context>
<context>
    <name>device.camera-given-up-advice</name>
    <message>
        <source>push in its cable at both ends and switch it on, then go on: every photograph so far is kept</source>
        <translation>inserire il cavo a entrambi i capi e accenderla, poi proseguire: tutte le foto già scattate sono conservate</translation>
    </message>
</context>
<context>
    <name>device.camera-gone</name>
    <message>
        <source>the camera has been unplugged or switched off, or has fallen asleep</source>
        <translation>la fotocamera è stata scollegata o spenta, oppure è andata in standby</translation>
    </message>
</context>
<context>
    <name>device.camera-no-longer-answers</name>
    <message>
        <source>the camera no longer answers ({}: {})</source>
        <translation>la fotocamera non risponde più ({}: {})</translation>
    </message>
</context>
<context>
    <name>device.camera-not-back</name>
    <message>
        <source>the camera has been gone for {} s: {}</source>
        <translation>la fotocamera è assente da {} s: {}</translation>
    </message>
</context>
<context>
    <name>device.camera-refuses</name>
    <message>
        <source>the camera refuses ({}: {})</source>
        <translation>la fotocamera rifiuta ({}: {})</translation>
    </message>
</context>
<context>
    <name>device.camera-sends-no-stream</name>
    <message>
        <source>the camera sends no stream</source>
        <translation>la fotocamera non invia alcun flusso</translation>
    </message>
</context>
<context>
    <name>device.camera-size-out-of-range</name>
    <message>
        <source>a camera of {} pixels is impossible: each side is {} to {}</source>
        <translation>una fotocamera di {} pixel è impossibile: ogni lato ne ha da {} a {}</translation>
    </message>
</context>
<context>
    <name>device.camera-stays-busy</name>
    <message>
        <source>the camera stays busy</source>
        <translation>la fotocamera resta occupata</translation>
    </message>
</context>
<context>
    <name>device.camera-twice</name>
    <message>
        <source>{} is camera {} and camera {}: choose another camera, or one with a serial number of its own</source>
        <translation>{} è la fotocamera {} e la fotocamera {}: scegliere un&apos;altra fotocamera, o una con un proprio numero di serie</translation>
    </message>
</context>
<context>
    <name>device.cannot-create-temporary-folder</name>
    <message>
        <source>cannot create a temporary folder ({})</source>
        <translation>impossibile creare una cartella temporanea ({})</translation>
    </message>
</context>
<context>
    <name>device.cannot-remove-file</name>
    <message>
        <source>cannot remove the file ({})</source>
        <translation>impossibile eliminare il file ({})</translation>
    </message>
</context>
<context>
    <name>device.cannot-reopen-video-device</name>
    <message>
        <source>the video device cannot be opened again</source>
        <translation>impossibile riaprire il dispositivo video</translation>
    </message>
</context>
<context>
    <name>device.cannot-start-command</name>
    <message>
        <source>the command cannot be started ({})</source>
        <translation>impossibile avviare il comando ({})</translation>
    </message>
</context>
<context>
    <name>device.cannot-write-recording</name>
    <message>
        <source>the recording cannot be written ({})</source>
        <translation>impossibile scrivere la registrazione ({})</translation>
    </message>
</context>
<context>
    <name>device.card-full</name>
    <message>
        <source>the camera has no room left for a photograph: its memory card is full</source>
        <translation>la fotocamera non ha più spazio per una foto: la scheda di memoria è piena</translation>
    </message>
</context>
<context>
    <name>device.change-or-empty-card</name>
    <message>
        <source>change or empty the memory card</source>
        <translation>sostituire o svuotare la scheda di memoria</translation>
    </message>
</context>
<context>
    <name>device.charge-or-change-battery</name>
    <message>
        <source>charge or change the battery, or better, use a mains adapter, and switch the camera on again</source>
        <translation>caricare o sostituire la batteria (meglio usare un alimentatore di rete) e riaccendere la fotocamera</translation>
    </message>
</context>
<context>
    <name>device.check-cable-and-power</name>
    <message>
        <source>check its cable and its power</source>
        <translation>controllare il cavo e l’alimentazione</translation>
    </message>
</context>
<context>
    <name>device.check-cable-and-power-saving</name>
    <message>
        <source>check its cable, and switch off its power saving</source>
        <translation>controllare il cavo e disattivare il risparmio energetico</translation>
    </message>
</context>
<context>
    <name>device.check-cable-network-and-programs</name>
    <message>
        <source>check the camera&apos;s cable and network card, and that no other program uses it</source>
        <translation>controllare il cavo e la scheda di rete della fotocamera, e che nessun altro programma la usi</translation>
    </message>
</context>
<context>
    <name>device.check-cable-power-address</name>
    <message>
        <source>check its cable, its power and its address; `relucent-cli devices` lists what is there</source>
        <translation>controllare il cavo, l’alimentazione e l’indirizzo; `relucent-cli devices` elenca i dispositivi presenti</translation>
    </message>
</context>
<context>
    <name>device.check-projector-and-aim</name>
    <message>
        <source>check that the projector is on and shows that output, aim the camera at it, and take its cap off; or choose another screen</source>
        <translation>controllare che il proiettore sia acceso e mostri quell’uscita, puntare la fotocamera sulla proiezione e togliere il tappo dell’obiettivo; oppure scegliere un altro schermo</translation>
    </message>
</context>
<context>
    <name>device.check-projector-or-aim-another</name>
    <message>
        <source>check that this projector is on and shows that output, and aim a camera at it; or remove it from the venue</source>
        <translation>verificare che questo proiettore sia acceso e mostri quell&apos;uscita, e puntarvi una fotocamera; oppure rimuoverlo dal luogo</translation>
    </message>
</context>
<context>
    <name>device.choose-gain-in-range</name>
    <message>
        <source>choose a gain from {} to {}</source>
        <translation>la fotocamera consente valori da {} a {}</translation>
    </message>
</context>
<context>
    <name>device.choose-offered-iso</name>
    <message>
        <source>choose one of those that it has: {}</source>
        <translation>valori disponibili: {}</translation>
    </message>
</context>
<context>
    <name>device.choose-or-aim-at-screen</name>
    <message>
        <source>choose {}, or aim the camera at {}</source>
        <translation>scegliere {} o puntare la fotocamera su {}</translation>
    </message>
</context>
<context>
    <name>device.choose-readable-pixel-format</name>
    <message>
        <source>it has {}; unpacked Mono, Bayer and RGB of 8 to 16 bits are read</source>
        <translation>formati disponibili: {}; vengono letti Mono, Bayer e RGB non impacchettati (unpacked) da 8 a 16 bit</translation>
    </message>
</context>
<context>
    <name>device.claimed-exposures-invalid</name>
    <message>
        <source>the camera claims exposures of {} to {} s</source>
        <translation>la fotocamera dichiara esposizioni da {} a {} s</translation>
    </message>
</context>
<context>
    <name>device.close-menus-and-live-view</name>
    <message>
        <source>close its menus and its playback, and leave live view</source>
        <translation>chiuderne i menu e la riproduzione, e terminare il live view</translation>
    </message>
</context>
<context>
    <name>device.close-menus-and-restart</name>
    <message>
        <source>close its menus, and switch it off and on</source>
        <translation>chiuderne i menu, poi spegnerla e riaccenderla</translation>
    </message>
</context>
<context>
    <name>device.close-other-program</name>
    <message>
        <source>close the other program, a camera viewer or a second Relucent perhaps</source>
        <translation>chiudere l’altro programma, forse un visualizzatore della fotocamera o un secondo Relucent</translation>
    </message>
</context>
<context>
    <name>device.close-other-programs</name>
    <message>
        <source>close other programs and try again</source>
        <translation>chiudere altri programmi e riprovare</translation>
    </message>
</context>
<context>
    <name>device.colour-filter-not-bayer</name>
    <message>
        <source>the camera&apos;s colour filter is not a Bayer filter</source>
        <translation>il filtro colore della fotocamera non è un filtro Bayer</translation>
    </message>
</context>
<context>
    <name>device.command-failed</name>
    <message>
        <source>the command failed with status {}</source>
        <translation>il comando non è riuscito, con stato {}</translation>
    </message>
</context>
<context>
    <name>device.command-failed-saying</name>
    <message>
        <source>the command failed with status {}, saying &quot;{}&quot;</source>
        <translation>il comando non è riuscito, con stato {} e il messaggio «{}»</translation>
    </message>
</context>
<context>
    <name>device.command-killed</name>
    <message>
        <source>the command was killed by signal {}</source>
        <translation>il comando è stato terminato dal segnale {}</translation>
    </message>
</context>
<context>
    <name>device.command-killed-saying</name>
    <message>
        <source>the command was killed by signal {}, saying &quot;{}&quot;</source>
        <translation>il comando è stato terminato dal segnale {}, con il messaggio «{}»</translation>
    </message>
</context>
<context>
    <name>device.command-too-long</name>
    <message>
        <source>the command took longer than {} s</source>
        <translation>il comando ha impiegato più di {} s</translation>
    </message>
</context>
<context>
    <name>device.command-too-long-saying</name>
    <message>
        <source>the command took longer than {} s, saying &quot;{}&quot;</source>
        <translation>il comando ha impiegato più di {} s, con il messaggio «{}»</translation>
    </message>
</context>
<context>
    <name>device.command-without-consent</name>
    <message>
        <source>the calibration runs a program to which nobody at this computer has agreed: {}</source>
        <translation>la calibrazione avvia un programma a cui nessuno ha acconsentito su questo computer: {}</translation>
    </message>
</context>
<context>
    <name>device.command-wrote-nothing</name>
    <message>
        <source>the command ended well but wrote nothing, not {}</source>
        <translation>il comando è terminato correttamente ma non ha scritto nulla, nemmeno {}</translation>
    </message>
</context>
<context>
    <name>device.command-wrote-something-else</name>
    <message>
        <source>the command ended well but wrote {}, not {}</source>
        <translation>il comando è terminato correttamente ma ha scritto {} e non {}</translation>
    </message>
</context>
<context>
    <name>device.copy-or-retake-photograph</name>
    <message>
        <source>copy it again, or take the photograph again; a camera newer than this LibRaw needs DNG files</source>
        <translation>copiarlo di nuovo o scattare di nuovo la foto; una fotocamera più recente di questa versione di LibRaw richiede file DNG</translation>
    </message>
</context>
<context>
    <name>device.delivers-8-bits</name>
    <message>
        <source>delivers 8 bits: dark places stay uncertain</source>
        <translation>fornisce 8 bit: le zone scure restano incerte</translation>
    </message>
</context>
<context>
    <name>device.develop-linearly</name>
    <message>
        <source>develop the files linearly, as 16-bit TIFF, or use another camera</source>
        <translation>sviluppare i file in modo lineare, come TIFF a 16 bit, o usare un’altra fotocamera</translation>
    </message>
</context>
<context>
    <name>device.exposure-range-invalid</name>
    <message>
        <source>the shortest exposure must be above zero and no longer than the longest</source>
        <translation>l’esposizione più breve deve essere maggiore di zero e non superare la più lunga</translation>
    </message>
</context>
<context>
    <name>device.exposure-refused</name>
    <message>
        <source>the camera was asked to expose {} s but exposes {} s</source>
        <translation>alla fotocamera è stata richiesta un’esposizione di {} s ma resta a {} s</translation>
    </message>
</context>
<context>
    <name>device.exposure-time-cannot-be-set</name>
    <message>
        <source>the camera&apos;s exposure time cannot be set</source>
        <translation>il tempo di esposizione della fotocamera non è impostabile</translation>
    </message>
</context>
<context>
    <name>device.exposure-time-fixed</name>
    <message>
        <source>the camera exposes {} s whatever exposure it is asked for</source>
        <translation>la fotocamera resta a {} s qualunque esposizione le venga richiesta</translation>
    </message>
</context>
<context>
    <name>device.focuses-by-itself</name>
    <message>
        <source>focuses by itself: switch its lens to manual focus</source>
        <translation>mette a fuoco da sola: passare l’obiettivo alla messa a fuoco manuale</translation>
    </message>
</context>
<context>
    <name>device.free-space-or-record-elsewhere</name>
    <message>
        <source>free some space, or record elsewhere</source>
        <translation>liberare spazio o registrare altrove</translation>
    </message>
</context>
<context>
    <name>device.free-space-or-set-tmpdir</name>
    <message>
        <source>free some space there, or set TMPDIR to a folder that you may write to</source>
        <translation>liberare spazio lì o indicare in TMPDIR una cartella in cui è consentito scrivere</translation>
    </message>
</context>
<context>
    <name>device.gain-out-of-range</name>
    <message>
        <source>a gain of {} is wanted</source>
        <translation>è richiesto un guadagno di {}</translation>
    </message>
</context>
<context>
    <name>device.gain-refused</name>
    <message>
        <source>was asked for a gain of {} but uses {}</source>
        <translation>ha ricevuto la richiesta di un guadagno di {} e resta a {}</translation>
    </message>
</context>
<context>
    <name>device.genicam-missing</name>
    <message>
        <source>GigE Vision and USB3 Vision cameras: this build lacks Aravis; install libaravis-dev and build again</source>
        <translation>Telecamere GigE Vision e USB3 Vision: a questo programma manca Aravis; installare libaravis-dev e ricompilarlo</translation>
    </message>
</context>
<context>
    <name>device.gphoto-missing</name>
    <message>
        <source>DSLR and mirrorless cameras: this build lacks libgphoto2 or LibRaw; install libgphoto2-dev and libraw-dev and build again</source>
        <translation>Reflex e mirrorless: a questo programma manca libgphoto2 o LibRaw; installare libgphoto2-dev e libraw-dev e ricompilarlo</translation>
    </message>
</context>
<context>
    <name>device.held-by-desktop</name>
    <message>
        <source>another program is using the camera, usually the desktop, which mounts it like a memory stick</source>
        <translation>un altro programma sta usando la fotocamera, di solito il desktop, che la monta come una chiavetta USB</translation>
    </message>
</context>
<context>
    <name>device.install-aravis</name>
    <message>
        <source>install Aravis (libaravis-dev) and build again, or use another kind of camera</source>
        <translation>installare Aravis (libaravis-dev) e ricompilare, o usare un altro tipo di fotocamera</translation>
    </message>
</context>
<context>
    <name>device.install-libgphoto2</name>
    <message>
        <source>install libgphoto2 and LibRaw (libgphoto2-dev, libraw-dev) and build again, or use a command</source>
        <translation>installare libgphoto2 e LibRaw (libgphoto2-dev, libraw-dev) e ricompilare, o usare un comando</translation>
    </message>
</context>
<context>
    <name>device.iso-refused</name>
    <message>
        <source>was asked for ISO {} but uses ISO {}</source>
        <translation>ha ricevuto la richiesta ISO {} e resta a ISO {}</translation>
    </message>
</context>
<context>
    <name>device.iso-wanted-not-there</name>
    <message>
        <source>ISO {} is wanted and the camera does not have it</source>
        <translation>è richiesto ISO {} e la fotocamera non lo ha</translation>
    </message>
</context>
<context>
    <name>device.lift-exposure-limits</name>
    <message>
        <source>switch its automatic exposure and its frame rate limit off</source>
        <translation>disattivarne l’esposizione automatica e il limite di frequenza dei fotogrammi</translation>
    </message>
</context>
<context>
    <name>device.longest-exposure-overstated</name>
    <message>
        <source>claims exposures up to {} s but reaches only {} s</source>
        <translation>dichiara esposizioni fino a {} s ma resta a {} s</translation>
    </message>
</context>
<context>
    <name>device.may-fire-flash</name>
    <message>
        <source>may fire its flash: close it</source>
        <translation>può far scattare il flash: chiuderlo</translation>
    </message>
</context>
<context>
    <name>device.may-take-dark-frame</name>
    <message>
        <source>may take a dark frame after long exposures, which doubles their time</source>
        <translation>può acquisire un’immagine nera dopo le esposizioni lunghe, raddoppiandone il tempo</translation>
    </message>
</context>
<context>
    <name>device.may-take-several-photographs</name>
    <message>
        <source>may take several photographs at once: switch it to single shots</source>
        <translation>può scattare più fotografie insieme: passare allo scatto singolo</translation>
    </message>
</context>
<context>
    <name>device.mode-dial-not-manual</name>
    <message>
        <source>the camera&apos;s mode dial is set to {}, where the camera chooses exposures itself</source>
        <translation>la ghiera dei modi della fotocamera è su {}, dove la fotocamera sceglie da sola le esposizioni</translation>
    </message>
</context>
<context>
    <name>device.name-camera-by-port</name>
    <message>
        <source>name one by its port: gphoto2:{} or gphoto2:{}</source>
        <translation>indicarne una con la sua porta: gphoto2:{} o gphoto2:{}</translation>
    </message>
</context>
<context>
    <name>device.name-connected-camera</name>
    <message>
        <source>name that one: gphoto2:{}</source>
        <translation>indicare quella: gphoto2:{}</translation>
    </message>
</context>
<context>
    <name>device.no-capture-times</name>
    <message>
        <source>does not say when pictures were captured: some are dropped before each photograph</source>
        <translation>non dice quando le immagini sono state acquisite: alcune vengono scartate prima di ogni fotografia</translation>
    </message>
</context>
<context>
    <name>device.no-contrast</name>
    <message>
        <source>the camera sees no difference between white and black</source>
        <translation>la fotocamera non vede differenza tra bianco e nero</translation>
    </message>
</context>
<context>
    <name>device.no-focus</name>
    <message>
        <source>the camera could not focus and took no photograph ({})</source>
        <translation>la fotocamera non ha messo a fuoco e non ha scattato alcuna foto ({})</translation>
    </message>
</context>
<context>
    <name>device.no-genicam-camera-answers</name>
    <message>
        <source>no GenICam camera &apos;{}&apos; answers</source>
        <translation>nessuna fotocamera GenICam «{}» risponde</translation>
    </message>
</context>
<context>
    <name>device.no-photograph-came</name>
    <message>
        <source>a photograph was asked for and none came</source>
        <translation>è stata richiesta una foto e non ne è arrivata nessuna</translation>
    </message>
</context>
<context>
    <name>device.no-raw-file-sent</name>
    <message>
        <source>the camera sent {} and no raw file</source>
        <translation>la fotocamera ha inviato {} e nessun file RAW</translation>
    </message>
</context>
<context>
    <name>device.no-raw-files</name>
    <message>
        <source>the camera does not deliver raw files</source>
        <translation>la fotocamera non fornisce file RAW</translation>
    </message>
</context>
<context>
    <name>device.no-readable-pixel-format</name>
    <message>
        <source>none of the camera&apos;s pixel formats can be read</source>
        <translation>nessuno dei formati pixel della fotocamera è leggibile</translation>
    </message>
</context>
<context>
    <name>device.no-software-trigger</name>
    <message>
        <source>has no software trigger: each photograph may wait for one more exposure</source>
        <translation>non ha scatto via software: ogni fotografia può attendere un’esposizione in più</translation>
    </message>
</context>
<context>
    <name>device.no-video-pictures</name>
    <message>
        <source>the video device sends no pictures</source>
        <translation>il dispositivo video non invia immagini</translation>
    </message>
</context>
<context>
    <name>device.only-other-camera-connected</name>
    <message>
        <source>no camera of this name is plugged in, but {} is</source>
        <translation>nessuna fotocamera con questo nome è collegata, ma è presente {}</translation>
    </message>
</context>
<context>
    <name>device.other-screen-seen</name>
    <message>
        <source>the camera sees {}, not {}</source>
        <translation>la fotocamera vede {} e non {}</translation>
    </message>
</context>
<context>
    <name>device.part-of-sensor-lost</name>
    <message>
        <source>the camera does not go back to the part of the sensor that it had</source>
        <translation>la fotocamera non torna alla parte del sensore che aveva</translation>
    </message>
</context>
<context>
    <name>device.parts-lost-on-the-way</name>
    <message>
        <source>parts of the photograph were lost on the way</source>
        <translation>parti della foto sono andate perse durante la trasmissione</translation>
    </message>
</context>
<context>
    <name>device.photograph-attempts-failed</name>
    <message>
        <source>{} attempts at a photograph failed: {}</source>
        <translation>{} tentativi di scattare una foto non sono riusciti: {}</translation>
    </message>
</context>
<context>
    <name>device.photograph-exceeds-sensor</name>
    <message>
        <source>{} pixels are wanted and the camera has {}</source>
        <translation>sono richiesti {} pixel e la fotocamera ne ha {}</translation>
    </message>
</context>
<context>
    <name>device.photograph-format-changed</name>
    <message>
        <source>the photograph has {} pixels as {} where {} as {} were agreed</source>
        <translation>la foto ha {} pixel in formato {} mentre erano concordati {} in formato {}</translation>
    </message>
</context>
<context>
    <name>device.photograph-larger-than-announced</name>
    <message>
        <source>the photograph is larger than the camera announced</source>
        <translation>la foto è più grande di quanto annunciato dalla fotocamera</translation>
    </message>
</context>
<context>
    <name>device.photograph-not-finished</name>
    <message>
        <source>the photograph was not finished</source>
        <translation>la foto non è stata completata</translation>
    </message>
</context>
<context>
    <name>device.photograph-size-refused</name>
    <message>
        <source>{} pixels are wanted and the camera gives {}</source>
        <translation>sono richiesti {} pixel e la fotocamera ne fornisce {}</translation>
    </message>
</context>
<context>
    <name>device.photograph-size-unexpected</name>
    <message>
        <source>the photograph has {} pixels where {} were announced</source>
        <translation>la foto ha {} pixel mentre ne erano annunciati {}</translation>
    </message>
</context>
<context>
    <name>device.photograph-timed-out</name>
    <message>
        <source>no photograph came within {} s</source>
        <translation>nessuna foto è arrivata entro {} s</translation>
    </message>
</context>
<context>
    <name>device.photograph-truncated</name>
    <message>
        <source>a photograph of {} pixels as {} came with {} of {} bytes</source>
        <translation>una foto di {} pixel in formato {} è arrivata con {} byte su {}</translation>
    </message>
</context>
<context>
    <name>device.picture-not-settled</name>
    <message>
        <source>a new picture has not fully appeared after {} frames</source>
        <translation>una nuova immagine non è completa dopo {} fotogrammi</translation>
    </message>
</context>
<context>
    <name>device.pixel-format-lost</name>
    <message>
        <source>the camera has forgotten the pixel format that it was set to</source>
        <translation>la fotocamera ha perso il formato pixel che le era stato impostato</translation>
    </message>
</context>
<context>
    <name>device.pixel-format-not-offered</name>
    <message>
        <source>the camera has no pixel format {} that can be read</source>
        <translation>la fotocamera non ha un formato pixel {} leggibile</translation>
    </message>
</context>
<context>
    <name>device.projector-command-empty</name>
    <message>
        <source>the projector&apos;s command is empty</source>
        <translation>il comando del proiettore è vuoto</translation>
    </message>
</context>
<context>
    <name>device.projector-command-lacks</name>
    <message>
        <source>the projector&apos;s command does not contain {}</source>
        <translation>nel comando del proiettore manca {}</translation>
    </message>
</context>
<context>
    <name>device.projector-size-out-of-range</name>
    <message>
        <source>a projector of {} pixels is impossible: each side is {} to {}</source>
        <translation>un proiettore di {} pixel è impossibile: ogni lato ne ha da {} a {}</translation>
    </message>
</context>
<context>
    <name>device.projector-unseen</name>
    <message>
        <source>no camera sees what is shown on {}</source>
        <translation>nessuna fotocamera vede ciò che è mostrato su {}</translation>
    </message>
</context>
<context>
    <name>device.push-cable-in</name>
    <message>
        <source>push in the camera&apos;s cable at both ends</source>
        <translation>inserire il cavo della fotocamera a entrambi i capi</translation>
    </message>
</context>
<context>
    <name>device.raw-file-empty</name>
    <message>
        <source>it is empty</source>
        <translation>è vuoto</translation>
    </message>
</context>
<context>
    <name>device.raw-file-incomplete</name>
    <message>
        <source>parts of it are missing</source>
        <translation>ne mancano delle parti</translation>
    </message>
</context>
<context>
    <name>device.raw-file-unreadable</name>
    <message>
        <source>the raw file cannot be read ({})</source>
        <translation>impossibile leggere il file RAW ({})</translation>
    </message>
</context>
<context>
    <name>device.raw-file-without-sensor-values</name>
    <message>
        <source>the raw file does not hold the sensor&apos;s own values</source>
        <translation>il file RAW non contiene i valori originali del sensore</translation>
    </message>
</context>
<context>
    <name>device.reconnect-same-camera</name>
    <message>
        <source>connect the camera that the measurement was begun with</source>
        <translation>collegare la fotocamera con cui è iniziata la misura</translation>
    </message>
</context>
<context>
    <name>device.reconnected-camera-size-differs</name>
    <message>
        <source>the camera came back with {} pixels instead of {}</source>
        <translation>la fotocamera è tornata con {} pixel invece di {}</translation>
    </message>
</context>
<context>
    <name>device.release-from-desktop</name>
    <message>
        <source>make the desktop release it with `gio mount -s gphoto2` (or eject it in the file manager) and close photo programs</source>
        <translation>farla rilasciare dal desktop con `gio mount -s gphoto2` (o espellerla nel gestore dei file) e chiudere i programmi di fotografia</translation>
    </message>
</context>
<context>
    <name>device.remove-file-by-hand</name>
    <message>
        <source>remove it by hand, then try again</source>
        <translation>eliminarlo a mano, poi riprovare</translation>
    </message>
</context>
<context>
    <name>device.request-refused</name>
    <message>
        <source>the camera refused what it was asked for ({})</source>
        <translation>la fotocamera ha rifiutato quanto richiesto ({})</translation>
    </message>
</context>
<context>
    <name>device.restart-or-change-pixel-format</name>
    <message>
        <source>switch the camera off and on, or choose another of its pixel formats</source>
        <translation>spegnere e riaccendere la fotocamera o scegliere un altro dei suoi formati pixel</translation>
    </message>
</context>
<context>
    <name>device.restart-with-default-settings</name>
    <message>
        <source>switch it off and on, load its default settings with its maker&apos;s program, and try again</source>
        <translation>spegnerla e riaccenderla, caricarne le impostazioni predefinite con il programma del produttore e riprovare</translation>
    </message>
</context>
<context>
    <name>device.run-command-in-terminal</name>
    <message>
        <source>run it in a terminal to find out why: {}</source>
        <translation>eseguirlo in un terminale per scoprirne la causa: {}</translation>
    </message>
</context>
<context>
    <name>device.screen-loses-picture</name>
    <message>
        <source>the projector&apos;s screen keeps losing its picture</source>
        <translation>lo schermo del proiettore perde ripetutamente l’immagine</translation>
    </message>
</context>
<context>
    <name>device.screen-not-seen</name>
    <message>
        <source>the camera does not see what is shown on {}</source>
        <translation>la fotocamera non vede ciò che è mostrato su {}</translation>
    </message>
</context>
<context>
    <name>device.screen-twice</name>
    <message>
        <source>screen {} is projector {} and projector {}: choose another screen</source>
        <translation>lo schermo {} è il proiettore {} e il proiettore {}: scegliere un altro schermo</translation>
    </message>
</context>
<context>
    <name>device.sees-no-colours</name>
    <message>
        <source>sees no colours: brightness can be compensated, colours cannot</source>
        <translation>non vede i colori: si può compensare la luminosità, non i colori</translation>
    </message>
</context>
<context>
    <name>device.set-iso-100</name>
    <message>
        <source>set it to ISO 100 by hand</source>
        <translation>impostarla a mano su ISO 100</translation>
    </message>
</context>
<context>
    <name>device.set-manual-exposure-mode</name>
    <message>
        <source>set its exposure mode to timed and manual, or update its firmware</source>
        <translation>impostarne la modalità di esposizione su temporizzata e manuale o aggiornarne il firmware</translation>
    </message>
</context>
<context>
    <name>device.several-cameras-of-model</name>
    <message>
        <source>{} cameras of this model are plugged in</source>
        <translation>sono collegate {} fotocamere di questo modello</translation>
    </message>
</context>
<context>
    <name>device.shortest-exposure-understated</name>
    <message>
        <source>claims exposures from {} s but does not go below {} s</source>
        <translation>dichiara esposizioni a partire da {} s ma resta a {} s</translation>
    </message>
</context>
<context>
    <name>device.simulated-camera-unplugged</name>
    <message>
        <source>the camera&apos;s cable is out</source>
        <translation>il cavo della fotocamera è staccato</translation>
    </message>
</context>
<context>
    <name>device.steady-view-and-expose-briefly</name>
    <message>
        <source>check that the camera&apos;s view is steady and its exposure short, and switch the projector&apos;s smoothing of motion off</source>
        <translation>controllare che l’inquadratura della fotocamera sia stabile e l’esposizione breve, e disattivare la compensazione del movimento del proiettore</translation>
    </message>
</context>
<context>
    <name>device.switch-off-automatic-exposure</name>
    <message>
        <source>switch its automatic exposure off; a camera without manual exposure cannot be used</source>
        <translation>disattivarne l’esposizione automatica; una fotocamera senza esposizione manuale non è utilizzabile</translation>
    </message>
</context>
<context>
    <name>device.switch-off-with-makers-program</name>
    <message>
        <source>switch it off with the camera maker&apos;s program, or use another camera</source>
        <translation>disattivarlo con il programma del produttore della fotocamera o usare un’altra fotocamera</translation>
    </message>
</context>
<context>
    <name>device.switch-off-with-v4l2-ctl</name>
    <message>
        <source>switch it off with v4l2-ctl (--list-ctrls names what it has), or use another camera</source>
        <translation>disattivarlo con v4l2-ctl (--list-ctrls elenca i controlli disponibili) o usare un’altra fotocamera</translation>
    </message>
</context>
<context>
    <name>device.switch-on-and-keep-awake</name>
    <message>
        <source>check its cable, switch it on and disable its automatic power-off</source>
        <translation>controllare il cavo, accenderla e disattivarne lo spegnimento automatico</translation>
    </message>
</context>
<context>
    <name>device.switch-quality-to-raw</name>
    <message>
        <source>switch its picture quality to RAW by hand; a camera without RAW cannot be used</source>
        <translation>impostarne a mano la qualità d’immagine su RAW; una fotocamera senza RAW non è utilizzabile</translation>
    </message>
</context>
<context>
    <name>device.switch-to-full-size-raw</name>
    <message>
        <source>switch the camera to full-size RAW (no sRAW, mRAW, no linear DNG)</source>
        <translation>impostare la fotocamera su RAW a dimensione piena (né sRAW, né mRAW, né DNG lineare)</translation>
    </message>
</context>
<context>
    <name>device.switch-to-manual-focus</name>
    <message>
        <source>switch its lens to manual focus</source>
        <translation>impostarne l’obiettivo sulla messa a fuoco manuale</translation>
    </message>
</context>
<context>
    <name>device.switches-itself-off</name>
    <message>
        <source>switches itself off after a while: switch that off</source>
        <translation>si spegne da sola dopo un po’: disattivarlo</translation>
    </message>
</context>
<context>
    <name>device.take-photograph-by-hand</name>
    <message>
        <source>switch its lens to manual focus, close its menus, and take a photograph by hand to see what it complains of</source>
        <translation>impostarne l’obiettivo sulla messa a fuoco manuale, chiuderne i menu e scattare una foto a mano per vedere quale problema segnala</translation>
    </message>
</context>
<context>
    <name>device.then-go-on</name>
    <message>
        <source>{}, then go on: every photograph so far is kept</source>
        <translation>{}, poi proseguire: ogni foto scattata finora è conservata</translation>
    </message>
</context>
<context>
    <name>device.trial-photograph-failed</name>
    <message>
        <source>the camera was asked for a photograph and took none</source>
        <translation>alla fotocamera è stata richiesta una foto e non ne ha scattata nessuna</translation>
    </message>
</context>
<context>
    <name>device.turn-dial-or-change-camera</name>
    <message>
        <source>turn its mode dial to M; a camera without manual exposure cannot be used</source>
        <translation>ruotarne la ghiera dei modi su M; una fotocamera che ne è priva non è utilizzabile</translation>
    </message>
</context>
<context>
    <name>device.turn-dial-to-m</name>
    <message>
        <source>turn it to M</source>
        <translation>ruotarla su M</translation>
    </message>
</context>
<context>
    <name>device.use-manual-exposure-camera</name>
    <message>
        <source>use a camera with manual exposure</source>
        <translation>usare una fotocamera con esposizione manuale</translation>
    </message>
</context>
<context>
    <name>device.video-device</name>
    <message>
        <source>video device</source>
        <translation>dispositivo video</translation>
    </message>
</context>
<context>
    <name>device.video-device-in-use</name>
    <message>
        <source>the video device cannot be opened: another program may be using it</source>
        <translation>impossibile aprire il dispositivo video: forse un altro programma lo sta usando</translation>
    </message>
</context>
<context>
    <name>device.video-device-missing</name>
    <message>
        <source>no such video device is plugged in</source>
        <translation>quel dispositivo video non è collegato</translation>
    </message>
</context>
<context>
    <name>device.video-device-unplugged</name>
    <message>
        <source>the video device has been unplugged</source>
        <translation>il dispositivo video è stato scollegato</translation>
    </message>
</context>
<context>
    <name>device.video-exposure-not-settable</name>
    <message>
        <source>the video device has no exposure that can be set</source>
        <translation>il dispositivo video non ha un’esposizione impostabile</translation>
    </message>
</context>
<context>
    <name>device.video-size-refused</name>
    <message>
        <source>{} pixels are wanted and the video device gives {}</source>
        <translation>sono richiesti {} pixel e il dispositivo video ne fornisce {}</translation>
    </message>
</context>
<context>
    <name>device.wake-camera</name>
    <message>
        <source>press its shutter button half way or switch it off and on, and disable its automatic power-off</source>
        <translation>premere a metà il pulsante di scatto, oppure spegnerla e riaccenderla, e disattivarne lo spegnimento automatico</translation>
    </message>
</context>
<context>
    <name>device.write-announced-size</name>
    <message>
        <source>let the command write that size, or begin again with the size that the camera delivers</source>
        <translation>far scrivere al comando quella dimensione o ricominciare con la dimensione fornita dalla fotocamera</translation>
    </message>
</context>
<context>
    <name>device.write-photograph-to-output</name>
    <message>
        <source>let it write the photograph to {output}: {}</source>
        <translation>fare in modo che scriva la foto in {output}: {}</translation>
    </message>
</context>
<context>
    <name>disk.cannot-create-folder</name>
    <message>
        <source>cannot create the folder ({})</source>
        <translation>impossibile creare la cartella ({})</translation>
    </message>
</context>
<context>
    <name>disk.cannot-open</name>
    <message>
        <source>cannot open ({})</source>
        <translation>impossibile aprire ({})</translation>
    </message>
</context>
<context>
    <name>disk.cannot-read</name>
    <message>
        <source>cannot read ({})</source>
        <translation>impossibile leggere ({})</translation>
    </message>
</context>
<context>
    <name>disk.cannot-write</name>
    <message>
        <source>cannot write ({})</source>
        <translation>impossibile scrivere ({})</translation>
    </message>
</context>
<context>
    <name>disk.check-disk-and-cable</name>
    <message>
        <source>check the disk and its cable</source>
        <translation>controllare il disco e il suo cavo</translation>
    </message>
</context>
<context>
    <name>disk.check-path</name>
    <message>
        <source>check the path</source>
        <translation>controllare il percorso</translation>
    </message>
</context>
<context>
    <name>disk.check-path-and-disk</name>
    <message>
        <source>check the path and the disk</source>
        <translation>controllare il percorso e il disco</translation>
    </message>
</context>
<context>
    <name>disk.choose-scratch-folder</name>
    <message>
        <source>let the environment variable TMPDIR name a folder on a disk that you may write to; what has been photographed is safe</source>
        <translation>indicare nella variabile d’ambiente TMPDIR una cartella su un disco in cui si può scrivere; ciò che è stato fotografato è al sicuro</translation>
    </message>
</context>
<context>
    <name>disk.choose-writable-folder</name>
    <message>
        <source>choose a folder that you may write to, or ask for the permission</source>
        <translation>scegliere una cartella in cui è consentito scrivere o chiedere il permesso</translation>
    </message>
</context>
<context>
    <name>disk.free-scratch-room</name>
    <message>
        <source>free some space there; what has been photographed is safe</source>
        <translation>liberare spazio in quel punto; ciò che è stato fotografato è al sicuro</translation>
    </message>
</context>
<context>
    <name>disk.free-space-or-check-disk</name>
    <message>
        <source>free some space there or check the disk, then try again</source>
        <translation>liberare spazio lì o controllare il disco, poi riprovare</translation>
    </message>
</context>
<context>
    <name>disk.free-space-or-choose-another</name>
    <message>
        <source>free some space there or choose another disk, then try again</source>
        <translation>liberare spazio lì o scegliere un altro disco, poi riprovare</translation>
    </message>
</context>
<context>
    <name>disk.no-scratch-room</name>
    <message>
        <source>there is no room for intermediate results ({})</source>
        <translation>non c’è spazio per i risultati intermedi ({})</translation>
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
        <translation>meno di un minuto</translation>
    </message>
</context>
<context>
    <name>engine.compute-on-processor</name>
    <message>
        <source>compute on the processor instead</source>
        <translation>far svolgere il lavoro al processore</translation>
    </message>
</context>
<context>
    <name>engine.graphics-buffer-too-large</name>
    <message>
        <source>the graphics card can hold {} MB in one piece, but {} MB are needed</source>
        <translation>la scheda grafica raggiunge {} MB alla volta mentre servono {} MB</translation>
    </message>
</context>
<context>
    <name>engine.graphics-card-lost</name>
    <message>
        <source>the graphics card was lost</source>
        <translation>la scheda grafica non è più disponibile</translation>
    </message>
</context>
<context>
    <name>engine.graphics-card-unusable</name>
    <message>
        <source>the graphics card cannot be used</source>
        <translation>la scheda grafica non è utilizzabile</translation>
    </message>
</context>
<context>
    <name>engine.graphics-memory-exhausted</name>
    <message>
        <source>the graphics card has no {} MB of memory left</source>
        <translation>la scheda grafica non ha più {} MB di memoria liberi</translation>
    </message>
</context>
<context>
    <name>engine.install-driver</name>
    <message>
        <source>install the graphics card&apos;s driver, or compute on the processor</source>
        <translation>installare il driver della scheda grafica o far svolgere il lavoro al processore</translation>
    </message>
</context>
<context>
    <name>engine.no-graphics-card</name>
    <message>
        <source>there is no graphics card with OpenGL 4.3 and compute shaders</source>
        <translation>non c’è una scheda grafica con OpenGL 4.3 e compute shader</translation>
    </message>
</context>
<context>
    <name>engine.no-libegl-or-libopengl</name>
    <message>
        <source>there is no libEGL or no libOpenGL, which open graphics cards without a display</source>
        <translation>manca libEGL o libOpenGL, che aprono le schede grafiche senza schermo</translation>
    </message>
</context>
<context>
    <name>engine.no-opengl</name>
    <message>
        <source>there is no OpenGL 4.3 with compute shaders</source>
        <translation>OpenGL 4.3 con compute shader non è disponibile</translation>
    </message>
</context>
<context>
    <name>import.camera-taken-as-linear</name>
    <message>
        <source>The camera is taken to be linear, and one photograph counts as one second of exposure</source>
        <translation>la fotocamera è assunta lineare, e una foto conta come un secondo di esposizione</translation>
    </message>
</context>
<context>
    <name>import.lit-share</name>
    <message>
        <source>The projector lights {} % of the camera&apos;s pixels</source>
        <translation>il proiettore illumina il {} % dei pixel della fotocamera</translation>
    </message>
</context>
<context>
    <name>import.paired-by-time</name>
    <message>
        <source>The photographs were paired with the patterns in the order in which they were taken, from {} to {}, which is not that of their names</source>
        <translation>le foto sono state abbinate ai pattern nell’ordine di scatto, da {} a {}, che non è quello dei nomi</translation>
    </message>
</context>
<context>
    <name>import.patterns-and-photographs-grey</name>
    <message>
        <source>Patterns and photographs are grey: colours are not told apart, and T&apos;s blocks are neutral</source>
        <translation>pattern e foto sono grigi: i colori non si distinguono e i blocchi di T sono neutri</translation>
    </message>
</context>
<context>
    <name>import.patterns-black-and-white</name>
    <message>
        <source>The patterns hold black and white only: the projector&apos;s response is assumed to be a gamma of 2.2</source>
        <translation>i pattern contengono solo bianco e nero: la risposta del proiettore è assunta come potenza di 2,2</translation>
    </message>
</context>
<context>
    <name>import.patterns-grey</name>
    <message>
        <source>The patterns are grey: how colours mix was not measured, and T&apos;s blocks are diagonal</source>
        <translation>i pattern sono grigi: il mescolarsi dei colori non è stato misurato e i blocchi di T sono diagonali</translation>
    </message>
</context>
<context>
    <name>import.photographs-are-jpeg</name>
    <message>
        <source>The photographs are JPEG: they were made linear by the curve of sRGB, which cameras follow only roughly; develop them linearly, as TIFF or EXR, to measure more exactly</source>
        <translation>le foto sono JPEG: sono state linearizzate con la curva sRGB, che le fotocamere seguono solo approssimativamente; svilupparle linearmente, come TIFF o EXR, per misurare con più esattezza</translation>
    </message>
</context>
<context>
    <name>import.photographs-grey</name>
    <message>
        <source>The photographs are grey: what each of the projector&apos;s colours contributes is known in brightness only</source>
        <translation>le foto sono grigie: il contributo di ogni colore del proiettore è noto solo in luminosità</translation>
    </message>
</context>
<context>
    <name>linearization.choose-overlapping-exposures</name>
    <message>
        <source>set them to ranges of exposure times that overlap</source>
        <translation>impostarle su intervalli di tempi di esposizione che si sovrappongano</translation>
    </message>
</context>
<context>
    <name>linearization.halves-brighter-than-whole</name>
    <message>
        <source>{}: two halves of a picture are {} % brighter than the whole; switch off the dynamic iris, dynamic contrast and any picture mode that adapts to the content</source>
        <translation>{}: due metà di un’immagine sono più luminose del {} % rispetto all’insieme; disattivare l’iride dinamica, il contrasto dinamico e ogni modalità immagine che si adatta al contenuto</translation>
    </message>
</context>
<context>
    <name>linearization.halves-darker-than-whole</name>
    <message>
        <source>{}: two halves of a picture are {} % darker than the whole; switch off the dynamic iris, dynamic contrast and any picture mode that adapts to the content</source>
        <translation>{}: due metà di un’immagine sono più scure del {} % rispetto all’insieme; disattivare l’iride dinamica, il contrasto dinamico e ogni modalità immagine che si adatta al contenuto</translation>
    </message>
</context>
<context>
    <name>linearization.highlights-overexposed</name>
    <message>
        <source>{}: some highlights are overexposed even at {} s, the shortest exposure, and will not be compensated; close the aperture or add a grey filter if they matter</source>
        <translation>{}: alcune alte luci sono sovraesposte anche a {} s, l’esposizione più breve, e non verranno compensate; chiudere il diaframma o aggiungere un filtro grigio se sono importanti</translation>
    </message>
</context>
<context>
    <name>linearization.light-flickers</name>
    <message>
        <source>{}: the light changes by {} % from one photograph to the next; switch off the projector&apos;s dynamic lamp modes and other lamps nearby, and choose exposure times that are multiples of the mains period</source>
        <translation>{}: la luce cambia del {} % da una foto alla successiva; disattivare le modalità dinamiche della lampada del proiettore, spegnere le altre lampade vicine e scegliere tempi di esposizione multipli del periodo di rete</translation>
    </message>
</context>
<context>
    <name>linearization.no-common-exposure</name>
    <message>
        <source>the cameras have no exposure time in common</source>
        <translation>le fotocamere non hanno tempi di esposizione in comune</translation>
    </message>
</context>
<context>
    <name>linearization.overexposed</name>
    <message>
        <source>{}: the projection is overexposed even at {} s, the shortest exposure; close the aperture, lower the gain or add a grey filter</source>
        <translation>{}: la proiezione è sovraesposta anche a {} s, l’esposizione più breve; chiudere il diaframma, ridurre il guadagno o aggiungere un filtro grigio</translation>
    </message>
</context>
<context>
    <name>linearization.response-uneven</name>
    <message>
        <source>{}: the brightness curves are not the same everywhere in its picture, by up to {} % of white; switch off uniformity correction, local dimming and edge blending in the projector</source>
        <translation>{}: le curve di luminosità non sono uguali in tutta l’immagine, con differenze fino al {} % del bianco; disattivare la correzione di uniformità, l’attenuazione locale e la fusione dei bordi nel proiettore</translation>
    </message>
</context>
<context>
    <name>linearization.underexposed</name>
    <message>
        <source>{}: the projection reaches only {} % of the camera&apos;s range at {} s, the longest exposure; open the aperture or raise the gain</source>
        <translation>{}: la proiezione raggiunge solo il {} % della gamma della fotocamera a {} s, l’esposizione più lunga; aprire il diaframma o aumentare il guadagno</translation>
    </message>
</context>
<context>
    <name>linearization.white-brighter-than-colours</name>
    <message>
        <source>{}: white is {} % brighter than red, green and blue together; switch off the white segment (often called brilliant colour or bright mode) and choose a picture mode for video or sRGB</source>
        <translation>{}: il bianco è più luminoso del {} % rispetto a rosso, verde e blu insieme; disattivare il segmento bianco (spesso chiamato «Brilliant Color» o modalità luminosa) e scegliere una modalità immagine per video o sRGB</translation>
    </message>
</context>
<context>
    <name>linearization.white-darker-than-colours</name>
    <message>
        <source>{}: white is {} % darker than red, green and blue together; switch off power saving, colour management and dynamic picture modes</source>
        <translation>{}: il bianco è più scuro del {} % rispetto a rosso, verde e blu insieme; disattivare il risparmio energetico, la gestione del colore e le modalità immagine dinamiche</translation>
    </message>
</context>
<context>
    <name>masks.draw-again</name>
    <message>
        <source>draw it again, or correct the file</source>
        <translation>disegnarla di nuovo o correggere il file</translation>
    </message>
</context>
<context>
    <name>masks.unknown-key</name>
    <message>
        <source>mask {} has &quot;{}&quot;, which this version does not know</source>
        <translation>la maschera {} ha «{}», che questa versione non conosce</translation>
    </message>
</context>
<context>
    <name>masks.unreadable</name>
    <message>
        <source>mask {} cannot be read: it needs points as [[x, y], ...], and may have camera, outline and feather</source>
        <translation>la maschera {} non è leggibile: servono points come [[x, y], ...], e può avere camera, outline e feather</translation>
    </message>
</context>
<context>
    <name>night.hours-began</name>
    <message>
        <source>the show&apos;s hours began before it was done</source>
        <translation>le ore dello spettacolo sono iniziate prima della fine</translation>
    </message>
</context>
<context>
    <name>night.missed</name>
    <message>
        <source>it could not begin within two hours of its time: the show did not run, or the computer slept</source>
        <translation>non è potuta iniziare entro due ore dall’orario: lo spettacolo non era in funzione o il computer era sospeso</translation>
    </message>
</context>
<context>
    <name>night.not-as-predicted</name>
    <message>
        <source>the picture has a colour error of {} where {} was predicted, and no repair helped</source>
        <translation>l’immagine ha un errore di colore di {} dove era previsto {}, e nessuna riparazione ha aiutato</translation>
    </message>
</context>
<context>
    <name>night.part-not-as-predicted</name>
    <message>
        <source>a part of the surface looks otherwise than predicted, by a colour error of {}, and no repair helped</source>
        <translation>una parte della superficie non appare come previsto, con un errore di colore di {}, e nessuna riparazione è servita</translation>
    </message>
</context>
<context>
    <name>night.too-long</name>
    <message>
        <source>it was not done within six hours</source>
        <translation>non è finita entro sei ore</translation>
    </message>
</context>
<context>
    <name>perfect.camera-blinded</name>
    <message>
        <source>something blinds the camera: {} of its view is overexposed</source>
        <translation>qualcosa abbaglia la fotocamera: {} della sua immagine è sovraesposto</translation>
    </message>
</context>
<context>
    <name>perfect.camera-moved</name>
    <message>
        <source>the view of camera {} has moved by {}, {} pixels since the venue was measured</source>
        <translation>l’inquadratura della fotocamera {} si è spostata di {}, {} pixel dalla misura</translation>
    </message>
</context>
<context>
    <name>perfect.light-missing</name>
    <message>
        <source>light is missing: is the lens covered, or a projector asleep?</source>
        <translation>manca luce: l’obiettivo è coperto o un proiettore è in standby?</translation>
    </message>
</context>
<context>
    <name>perfect.something-else</name>
    <message>
        <source>the camera sees something else than expected: did somebody stand in the light, or did the room&apos;s light change?</source>
        <translation>la fotocamera vede qualcosa di diverso dal previsto: c’era qualcuno nella luce o è cambiata la luce della sala?</translation>
    </message>
</context>
<context>
    <name>pjlink.address-twice</name>
    <message>
        <source>projectors {} and {} have the same address, {}</source>
        <translation>i proiettori {} e {} hanno lo stesso indirizzo, {}</translation>
    </message>
</context>
<context>
    <name>pjlink.cannot-search</name>
    <message>
        <source>projectors cannot be searched ({})</source>
        <translation>non si possono cercare proiettori ({})</translation>
    </message>
</context>
<context>
    <name>pjlink.check-address-and-port</name>
    <message>
        <source>check the address and the port of the projector</source>
        <translation>controlli indirizzo e porta del proiettore</translation>
    </message>
</context>
<context>
    <name>pjlink.check-lens</name>
    <message>
        <source>check lens caps, shutter and input of the projector, and where the camera looks</source>
        <translation>controlli i copriobiettivi, l’otturatore e l’ingresso del proiettore, e dove guarda la fotocamera</translation>
    </message>
</context>
<context>
    <name>pjlink.check-network</name>
    <message>
        <source>check its address, its network cable, and that PJLink and the network in standby are switched on in its menu</source>
        <translation>controlli il suo indirizzo, il cavo di rete, e che PJLink e la rete in standby siano attivati nel suo menu</translation>
    </message>
</context>
<context>
    <name>pjlink.check-own-network</name>
    <message>
        <source>check this computer&apos;s network, or give the projector&apos;s address</source>
        <translation>controlli la rete di questo computer, o indichi l’indirizzo del proiettore</translation>
    </message>
</context>
<context>
    <name>pjlink.choose-class-one-authentication</name>
    <message>
        <source>choose the authentication of PJLink class 1 in its menu, or none</source>
        <translation>scelga nel suo menu l’autenticazione PJLink classe 1, o nessuna</translation>
    </message>
</context>
<context>
    <name>pjlink.closed</name>
    <message>
        <source>it closed the connection</source>
        <translation>ha chiuso la connessione</translation>
    </message>
</context>
<context>
    <name>pjlink.end-dimming</name>
    <message>
        <source>switch off its dynamic contrast, lamp dimming and eco modes, and daylight in the room; or measure without waiting for its lamp</source>
        <translation>disattivi contrasto dinamico, attenuazione della lampada e modalità eco, ed eviti la luce del giorno; oppure misuri senza attendere la sua lampada</translation>
    </message>
</context>
<context>
    <name>pjlink.frozen</name>
    <message>
        <source>projector {} freezes its picture: end that in its menu</source>
        <translation>il proiettore {} blocca la sua immagine: lo disattivi nel suo menu</translation>
    </message>
</context>
<context>
    <name>pjlink.give-password</name>
    <message>
        <source>give the PJLink password that is set in its menu</source>
        <translation>indichi la password PJLink impostata nel suo menu</translation>
    </message>
</context>
<context>
    <name>pjlink.light-drifts</name>
    <message>
        <source>the light of projector {} still drifts by {} % within {} s after {} s</source>
        <translation>la luce del proiettore {0} varia ancora del {1} % in {2} s dopo {3} s</translation>
    </message>
</context>
<context>
    <name>pjlink.light-unseen</name>
    <message>
        <source>no camera sees light of projector {}</source>
        <translation>nessuna fotocamera vede la luce del proiettore {}</translation>
    </message>
</context>
<context>
    <name>pjlink.look-at-projector</name>
    <message>
        <source>look at its lamps and its menu</source>
        <translation>guardi le sue spie e il suo menu</translation>
    </message>
</context>
<context>
    <name>pjlink.more-than-projectors</name>
    <message>
        <source>projector {} on the network is none of the {} that there are</source>
        <translation>il proiettore {} in rete non è nessuno dei {} presenti</translation>
    </message>
</context>
<context>
    <name>pjlink.newer-authentication</name>
    <message>
        <source>the projector at {} asks for its password in a way that this version does not know</source>
        <translation>il proiettore all’indirizzo {} chiede la password in un modo che questa versione non conosce</translation>
    </message>
</context>
<context>
    <name>pjlink.no-answer</name>
    <message>
        <source>the projector at {} does not answer ({})</source>
        <translation>il proiettore all’indirizzo {} non risponde ({})</translation>
    </message>
</context>
<context>
    <name>pjlink.no-signal</name>
    <message>
        <source>projector {} has no signal at its input {}: choose the input of this computer</source>
        <translation>il proiettore {} non ha segnale al suo ingresso {}: scelga l’ingresso di questo computer</translation>
    </message>
</context>
<context>
    <name>pjlink.not-native</name>
    <message>
        <source>projector {} receives {} pixels and has {}: it scales the picture, which blurs the compensation; send it its own size</source>
        <translation>il proiettore {} riceve {} pixel e ne ha {}: ridimensiona l’immagine, e la compensazione diventa sfocata; gli invii la sua dimensione</translation>
    </message>
</context>
<context>
    <name>pjlink.not-on</name>
    <message>
        <source>projector {} was told to switch on and is not on after {} s</source>
        <translation>al proiettore {} è stato detto di accendersi e dopo {} s non è acceso</translation>
    </message>
</context>
<context>
    <name>pjlink.not-pjlink</name>
    <message>
        <source>what answers at {} does not speak PJLink</source>
        <translation>ciò che risponde all’indirizzo {} non parla PJLink</translation>
    </message>
</context>
<context>
    <name>pjlink.open-shutter-by-hand</name>
    <message>
        <source>open it at the projector, and start again</source>
        <translation>lo apra sul proiettore, e ricominci</translation>
    </message>
</context>
<context>
    <name>pjlink.other-signal</name>
    <message>
        <source>projector {} receives {} pixels where {} are sent: something between scales the picture, or it shows another input</source>
        <translation>il proiettore {} riceve {} pixel mentre ne vengono inviati {}: qualcosa nel mezzo ridimensiona l’immagine, o mostra un altro ingresso</translation>
    </message>
</context>
<context>
    <name>pjlink.own-failure</name>
    <message>
        <source>the projector at {} reports a failure of its own</source>
        <translation>il proiettore all’indirizzo {} segnala un guasto proprio</translation>
    </message>
</context>
<context>
    <name>pjlink.part-cover</name>
    <message>
        <source>cover open</source>
        <translation>coperchio aperto</translation>
    </message>
</context>
<context>
    <name>pjlink.part-fan</name>
    <message>
        <source>fan</source>
        <translation>ventola</translation>
    </message>
</context>
<context>
    <name>pjlink.part-filter</name>
    <message>
        <source>filter</source>
        <translation>filtro</translation>
    </message>
</context>
<context>
    <name>pjlink.part-lamp</name>
    <message>
        <source>lamp</source>
        <translation>lampada</translation>
    </message>
</context>
<context>
    <name>pjlink.part-other</name>
    <message>
        <source>something else</source>
        <translation>altro</translation>
    </message>
</context>
<context>
    <name>pjlink.part-temperature</name>
    <message>
        <source>temperature</source>
        <translation>temperatura</translation>
    </message>
</context>
<context>
    <name>pjlink.reports-error</name>
    <message>
        <source>projector {} reports an error: {}</source>
        <translation>il proiettore {} segnala un errore: {}</translation>
    </message>
</context>
<context>
    <name>pjlink.reports-warning</name>
    <message>
        <source>projector {} warns: {}</source>
        <translation>il proiettore {} avverte: {}</translation>
    </message>
</context>
<context>
    <name>pjlink.shutter-stays-closed</name>
    <message>
        <source>the shutter of projector {} does not open</source>
        <translation>l’otturatore del proiettore {} non si apre</translation>
    </message>
</context>
<context>
    <name>pjlink.still-warming</name>
    <message>
        <source>projector {} is still warming up or cooling down after {} s</source>
        <translation>il proiettore {} si sta ancora riscaldando o raffreddando dopo {} s</translation>
    </message>
</context>
<context>
    <name>pjlink.switch-on-by-hand</name>
    <message>
        <source>look at its lamps and its menu, switch it on by hand, and start again</source>
        <translation>guardi le sue spie e il suo menu, lo accenda a mano, e ricominci</translation>
    </message>
</context>
<context>
    <name>pjlink.too-slow</name>
    <message>
        <source>nothing complete came in time</source>
        <translation>non è arrivato nulla di completo in tempo</translation>
    </message>
</context>
<context>
    <name>pjlink.wants-password</name>
    <message>
        <source>the projector at {} asks for a password</source>
        <translation>il proiettore all’indirizzo {} chiede una password</translation>
    </message>
</context>
<context>
    <name>pjlink.wrong-password</name>
    <message>
        <source>the projector at {} refuses the password</source>
        <translation>il proiettore all’indirizzo {} rifiuta la password</translation>
    </message>
</context>
<context>
    <name>reduction.binned</name>
    <message>
        <source>of the camera&apos;s {} pixels, {} are made: of the part around what is lit, every {} become one</source>
        <translation>dei {} pixel della fotocamera ne risultano {}: nella parte attorno a ciò che è illuminato, ogni {} diventano uno</translation>
    </message>
</context>
<context>
    <name>reduction.binned-for-memory</name>
    <message>
        <source>of the camera&apos;s {} pixels, {} are made: every {} become one, as there is memory for no more</source>
        <translation>dei {} pixel della fotocamera ne risultano {}: ogni {} diventano uno, perché non c’è memoria per di più</translation>
    </message>
</context>
<context>
    <name>reduction.cropped</name>
    <message>
        <source>of the camera&apos;s {} pixels, the {} around what is lit are used</source>
        <translation>dei {} pixel della fotocamera si usano i {} attorno a ciò che è illuminato</translation>
    </message>
</context>
<context>
    <name>reduction.fewer-camera-pixels</name>
    <message>
        <source>choose fewer camera pixels: automatic ones are as many as fit</source>
        <translation>scegliere meno pixel della fotocamera: in automatico sono quanti ne entrano</translation>
    </message>
</context>
<context>
    <name>reduction.memory-too-little</name>
    <message>
        <source>measuring would take {} GB of memory, and {} GB may be taken</source>
        <translation>la misura richiederebbe {} GB di memoria, e ne sono disponibili {} GB</translation>
    </message>
</context>
<context>
    <name>reduction.more-memory-or-smaller-projector</name>
    <message>
        <source>use a computer or a limit with more memory, or a projector signal of fewer pixels</source>
        <translation>usare un computer o un limite con più memoria, o un segnale del proiettore con meno pixel</translation>
    </message>
</context>
<context>
    <name>reduction.other-size</name>
    <message>
        <source>the camera delivers {} pixels where {} were calibrated</source>
        <translation>la fotocamera fornisce {} pixel, ma ne sono stati calibrati {}</translation>
    </message>
</context>
<context>
    <name>reduction.restore-camera-size</name>
    <message>
        <source>set the camera to the size that it had, or calibrate again</source>
        <translation>impostare la fotocamera sulla dimensione che aveva o calibrare di nuovo</translation>
    </message>
</context>
<context>
    <name>relucent::gui::AcquirePage</name>
    <message>
        <source>Paused, %1</source>
        <translation>In pausa, %1</translation>
    </message>
    <message>
        <source>Measuring, %1</source>
        <translation>Misura, %1</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s), %1</source>
        <translation>
            <numerusform>%n pattern, %1</numerusform>
            <numerusform>%n pattern, %1</numerusform>
        </translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Misurato</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>Da aggiornare</translation>
    </message>
    <message>
        <source>Stopped by a failure</source>
        <translation>Interrotto da errore</translation>
    </message>
    <message>
        <source>Waiting for you. Nothing is being projected.</source>
        <translation>In attesa dell’operatore. Nulla viene proiettato.</translation>
    </message>
    <message>
        <source>Every photograph is saved. Threshold opens when the last is taken.</source>
        <translation>Ogni foto è salvata. Soglia si apre dopo l’ultima.</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>I dispositivi sono in uso nel passo %1.</translation>
    </message>
    <message>
        <source>Measured in %1</source>
        <translation>Misurato in %1</translation>
    </message>
    <message>
        <source>Leave the room dark and still, then start.</source>
        <translation>Tenere la sala buia e immobile, poi avviare.</translation>
    </message>
    <message>
        <source>Show threshold</source>
        <translation>Mostra soglia</translation>
    </message>
    <message>
        <source>Resume</source>
        <translation>Riprendi</translation>
    </message>
    <message>
        <source>Start measuring</source>
        <translation>Avvia misura</translation>
    </message>
    <message>
        <source>Stop and keep</source>
        <translation>Ferma e conserva</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Pausa</translation>
    </message>
    <message>
        <source>This measurement belongs to earlier settings</source>
        <translation>Questa misura si riferisce a impostazioni precedenti</translation>
    </message>
    <message>
        <source>It still works and stays until the new one is ready.</source>
        <translation>È ancora utilizzabile e resta finché la nuova non è pronta.</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>Misura di nuovo</translation>
    </message>
    <message>
        <source>The last session ended before it was finished</source>
        <translation>L’ultima sessione si è chiusa prima della fine</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>Nulla è stato modificato.</translation>
    </message>
    <message>
        <source>Fineness</source>
        <translation>Finezza</translation>
    </message>
    <message>
        <source>Acquire</source>
        <translation>Acquisizione</translation>
    </message>
    <message>
        <source>Measure how every projector pixel lights every camera pixel. Leave the room dark and still.</source>
        <translation>Misurare come ogni pixel del proiettore illumina ogni pixel della fotocamera. Tenere la sala buia e immobile.</translation>
    </message>
    <message>
        <source>Sent to the projector</source>
        <translation>Inviato al proiettore</translation>
    </message>
    <message>
        <source>Seen by the camera</source>
        <translation>Visto dalla fotocamera</translation>
    </message>
    <message>
        <source>Pattern that the projector shows</source>
        <translation>Pattern mostrato dal proiettore</translation>
    </message>
    <message>
        <source>Last photograph</source>
        <translation>Ultima foto</translation>
    </message>
    <message>
        <source>Appears when measuring begins. Nothing is projected before you start.</source>
        <translation>Compare all’inizio della misura. Nulla viene proiettato prima dell’avvio.</translation>
    </message>
    <message>
        <source>How finely</source>
        <translation>Finezza</translation>
    </message>
    <message>
        <source>Fast</source>
        <translation>Veloce</translation>
    </message>
    <message>
        <source>a first look; misses weak bounces</source>
        <translation>un primo sguardo; perde i rimbalzi deboli</translation>
    </message>
    <message>
        <source>Usual</source>
        <translation>Normale</translation>
    </message>
    <message>
        <source>suits most surfaces</source>
        <translation>adatta a quasi tutte le superfici</translation>
    </message>
    <message>
        <source>Fine</source>
        <translation>Fine</translation>
    </message>
    <message>
        <source>glass, gloss, deep corners</source>
        <translation>vetro, lucido, angoli profondi</translation>
    </message>
    <message>
        <source>Disk still needed</source>
        <translation>Disco ancora necessario</translation>
    </message>
    <message>
        <source>Watching</source>
        <translation>Sorveglianza</translation>
    </message>
    <message>
        <source>Paused</source>
        <translation>In pausa</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>Misura in corso</translation>
    </message>
    <message>
        <source>about %1</source>
        <translation>circa %1</translation>
    </message>
    <message>
        <source>alarm beyond</source>
        <translation>allarme oltre</translation>
    </message>
    <message>
        <source>taken again</source>
        <translation>ripetuto</translation>
    </message>
    <message>
        <source>During the measurement</source>
        <translation>Durante la misura</translation>
    </message>
    <message>
        <source>light that would spoil photographs</source>
        <translation>luce che rovinerebbe le foto</translation>
    </message>
    <message>
        <source>Minutes</source>
        <translation>Minuti</translation>
    </message>
    <message>
        <source>Room light, % of full light</source>
        <translation>Luce della sala, % della piena luce</translation>
    </message>
    <message>
        <source>Room light during the measurement</source>
        <translation>Luce della sala durante la misura</translation>
    </message>
    <message>
        <source>Taken again</source>
        <translation>Ripetuto</translation>
    </message>
    <message numerus="yes">
        <source>About %n pattern(s), %1. Leave the room dark and still.</source>
        <translation>
            <numerusform>Circa %n pattern, %1. Lasciare la stanza buia e ferma.</numerusform>
            <numerusform>Circa %n pattern, %1. Lasciare la stanza buia e ferma.</numerusform>
        </translation>
    </message>
    <message>
        <source>What was measured</source>
        <translation>Ciò che è stato misurato</translation>
    </message>
    <message>
        <source>Patterns</source>
        <translation>Pattern</translation>
    </message>
    <message>
        <source>Error of the test patterns</source>
        <translation>Errore dei pattern di prova</translation>
    </message>
    <message>
        <source>Continue anyway</source>
        <translation>Continua comunque</translation>
    </message>
    <message>
        <source>Found while measuring</source>
        <translation>Rilevato durante la misura</translation>
    </message>
    <message numerus="yes">
        <source>Begins in %n second(s)</source>
        <translation>
            <numerusform>Inizia tra %n secondo</numerusform>
            <numerusform>Inizia tra %n secondi</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Measuring begins in %n second(s). Leave the room dark and still.</source>
        <translation>
            <numerusform>La misura inizia tra %n secondo. Lasciare la stanza buia e ferma.</numerusform>
            <numerusform>La misura inizia tra %n secondi. Lasciare la stanza buia e ferma.</numerusform>
        </translation>
    </message>
    <message>
        <source>Start now</source>
        <translation>Inizia ora</translation>
    </message>
    <message>
        <source>Not now</source>
        <translation>Non ora</translation>
    </message>
    <message numerus="yes">
        <source>Compared with the start every %n pattern(s). What changed is photographed again; if that does not help, the measurement pauses and asks.</source>
        <translation>
            <numerusform>Confronto con l’inizio dopo ogni pattern. Ciò che è cambiato si fotografa di nuovo; se non basta, la misura va in pausa e chiede cosa fare.</numerusform>
            <numerusform>Confronto con l’inizio ogni %n pattern. Ciò che è cambiato si fotografa di nuovo; se non basta, la misura va in pausa e chiede cosa fare.</numerusform>
        </translation>
    </message>
    <message>
        <source>Start</source>
        <translation>Inizio</translation>
    </message>
    <message>
        <source>Leave the room first</source>
        <translation>Prima lasciare la stanza</translation>
    </message>
    <message>
        <source>Time to leave the room before measuring begins</source>
        <translation>Tempo per lasciare la stanza prima che inizi la misura</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>A sound when it ends or needs me</source>
        <translation>Un suono alla fine o se serve il mio intervento</translation>
    </message>
    <message>
        <source>Ready</source>
        <translation>Pronto</translation>
    </message>
    <message>
        <source>Dark enough</source>
        <translation>Abbastanza buio</translation>
    </message>
    <message>
        <source>Room light is %1 of full light, limit %2.</source>
        <translation>La luce della stanza è il %1 della luce piena, limite %2.</translation>
    </message>
    <message>
        <source>It is too bright here</source>
        <translation>Qui c’è troppa luce</translation>
    </message>
    <message>
        <source>Room light is %1 of full light. Cover windows and lamps: less light, less noise.</source>
        <translation>La luce della stanza è il %1 della luce piena. Coprire finestre e lampade: meno luce, meno rumore.</translation>
    </message>
    <message>
        <source>Needs %1 of %2.</source>
        <translation>Servono %1 su %2.</translation>
    </message>
    <message>
        <source>Room on the disk</source>
        <translation>Spazio su disco</translation>
    </message>
    <message>
        <source>The disk is too full</source>
        <translation>Il disco è troppo pieno</translation>
    </message>
    <message>
        <source>Floodlight image</source>
        <translation>Immagine in luce piena</translation>
    </message>
    <message>
        <source>the projector fully white</source>
        <translation>il proiettore completamente bianco</translation>
    </message>
    <message>
        <source>The surface in the projector&apos;s full light</source>
        <translation>La superficie nella luce piena del proiettore</translation>
    </message>
    <message>
        <source>%1 px</source>
        <translation>%1 px</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 di %2</translation>
    </message>
    <message>
        <source>Level %1 of %2, %3 of %4 patterns.</source>
        <translation>Livello %1 di %2, %3 di %4 pattern.</translation>
    </message>
    <message>
        <source>Patterns for each block size</source>
        <translation>Pattern per dimensione di blocco</translation>
    </message>
    <message>
        <source>blocks are divided only where light needs it</source>
        <translation>i blocchi si dividono solo dove la luce lo richiede</translation>
    </message>
    <message>
        <source>Stopped at %1 px</source>
        <translation>Fermato a %1 px</translation>
    </message>
    <message>
        <source>Measuring was stopped at blocks of %1 px</source>
        <translation>La misura è stata fermata a blocchi di %1 px</translation>
    </message>
    <message>
        <source>Finer light is missing. Go on any time, if nothing has moved.</source>
        <translation>Manca la luce più fine. Proseguire in qualsiasi momento, se nulla si è mosso.</translation>
    </message>
    <message numerus="yes">
        <source>%1 dB expected, about %2 dB with %n more photograph(s), %3. Go on any time, if nothing has moved.</source>
        <translation>
            <numerusform>%1 dB attesi, circa %2 dB con %n altra foto, %3. Continui in qualsiasi momento, se nulla si è mosso.</numerusform>
            <numerusform>%1 dB attesi, circa %2 dB con altre %n foto, %3. Continui in qualsiasi momento, se nulla si è mosso.</numerusform>
        </translation>
    </message>
    <message>
        <source>Pictures expected at</source>
        <translation>Immagini attese a</translation>
    </message>
    <message>
        <source>rough</source>
        <translation>grezzo</translation>
    </message>
    <message>
        <source>fair</source>
        <translation>discreto</translation>
    </message>
    <message>
        <source>good</source>
        <translation>buono</translation>
    </message>
    <message>
        <source>very good</source>
        <translation>molto buono</translation>
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
        <translation>I dB dicono quanto l’immagine si avvicina a quella voluta, dove è raggiungibile: 20 dB appaiono grezzi, 30 dB buoni, e ogni 6 dB in più dimezzano la differenza.</translation>
    </message>
    <message>
        <source>Compensated so far</source>
        <translation>Compensato finora</translation>
    </message>
    <message>
        <source>A picture, compensated with what is measured so far</source>
        <translation>Un’immagine, compensata con quanto misurato finora</translation>
    </message>
    <message>
        <source>Appears after the first patterns, and grows sharper.</source>
        <translation>Appare dopo i primi pattern e diventa più nitida.</translation>
    </message>
    <message>
        <source>Expected now</source>
        <translation>Atteso ora</translation>
    </message>
    <message>
        <source>Blocks of %1 px. Expected now: %2. In the end: %3.</source>
        <translation>Blocchi di %1 px. Atteso ora: %2. Alla fine: %3.</translation>
    </message>
    <message>
        <source>In the end</source>
        <translation>Alla fine</translation>
    </message>
    <message>
        <source>Waiting for room on the disk. Nothing is being projected.</source>
        <translation>In attesa di spazio sul disco. Nulla viene proiettato.</translation>
    </message>
    <message>
        <source>Go on now</source>
        <translation>Prosegui ora</translation>
    </message>
    <message>
        <source>Photographs to keep</source>
        <translation>Foto da conservare</translation>
    </message>
    <message>
        <source>Photographs to keep once all is measured</source>
        <translation>Foto da conservare a misura completa</translation>
    </message>
    <message>
        <source>All</source>
        <translation>Tutte</translation>
    </message>
    <message>
        <source>Of the latest measurement</source>
        <translation>Quelle dell’ultima misura</translation>
    </message>
    <message>
        <source>None: results only</source>
        <translation>Nessuna: solo i risultati</translation>
    </message>
    <message>
        <source>Those that were set aside by measuring again are removed once all is measured.</source>
        <translation>Quelle messe da parte misurando di nuovo vengono rimosse a misura completa.</translation>
    </message>
    <message>
        <source>Removed once all is measured. Other settings then have to photograph everything again.</source>
        <translation>Rimosse a misura completa. Con altre impostazioni si deve poi fotografare tutto di nuovo.</translation>
    </message>
    <message>
        <source>Measuring with other settings then needs fewer new photographs.</source>
        <translation>Una misura con altre impostazioni richiede allora meno foto nuove.</translation>
    </message>
    <message>
        <source>Those of the last measurement were removed: all are taken again.</source>
        <translation>Quelle dell’ultima misura sono state rimosse: vengono scattate tutte di nuovo.</translation>
    </message>
    <message>
        <source>Waiting for the projector&apos;s screen.</source>
        <translation>In attesa dello schermo del proiettore.</translation>
    </message>
    <message>
        <source>Every photograph is saved. The earlier measurement is used until the new one is ready.</source>
        <translation>Ogni foto è salvata. La misura precedente vale finché la nuova non è pronta.</translation>
    </message>
    <message>
        <source>To go on measuring, confirm that the room is clear.</source>
        <translation>Per continuare la misura, confermare che la sala è sgombra.</translation>
    </message>
    <message>
        <source>Takes every photograph again. What is measured stays until then.</source>
        <translation>Scatta di nuovo ogni foto. Fino ad allora resta ciò che è misurato.</translation>
    </message>
    <message>
        <source>Measuring again has not ended</source>
        <translation>La nuova misura non è finita</translation>
    </message>
    <message>
        <source>Measuring with these settings.</source>
        <translation>Misura in corso con queste impostazioni.</translation>
    </message>
    <message>
        <source>Waiting for the camera.</source>
        <translation>In attesa della fotocamera.</translation>
    </message>
    <message>
        <source>Keep the earlier one</source>
        <translation>Tieni la precedente</translation>
    </message>
    <message>
        <source>The earlier measurement is used again, with all that followed from it.</source>
        <translation>Si usa di nuovo la misura precedente, con tutto ciò che ne è seguito.</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>Quanto misurato è al sicuro.</translation>
    </message>
    <message>
        <source>Paused, about %1 left</source>
        <translation>In pausa, ancora circa %1</translation>
    </message>
    <message>
        <source>%1 of about %2</source>
        <translation>%1 di circa %2</translation>
    </message>
    <message>
        <source>About %1 left</source>
        <translation>Ancora circa %1</translation>
    </message>
    <message>
        <source>Ends near %1. %2</source>
        <translation>Finisce verso le %1. %2</translation>
    </message>
    <message>
        <source>Put the camera back</source>
        <translation>Rimetti a posto la fotocamera</translation>
    </message>
    <message>
        <source>Test patterns are predicted from the measurement, then photographed: this is how far the two differ, the photographs&apos; noise included.</source>
        <translation>I motivi di prova vengono previsti dalla misura e poi fotografati: questa è la differenza, rumore delle foto compreso.</translation>
    </message>
    <message>
        <source>%1; light right within about %2</source>
        <translation>%1; luce esatta entro circa %2</translation>
    </message>
    <message>
        <source>Reading, %1</source>
        <translation>Lettura, %1</translation>
    </message>
    <message>
        <source>Waiting for your answer. Every photograph is saved.</source>
        <translation>In attesa di una risposta. Ogni foto è salvata.</translation>
    </message>
    <message>
        <source>Go on measuring</source>
        <translation>Prosegui la misura</translation>
    </message>
    <message>
        <source>Answer</source>
        <translation>Rispondi</translation>
    </message>
    <message>
        <source>Try again</source>
        <translation>Riprova</translation>
    </message>
    <message>
        <source>The camera is back at its place</source>
        <translation>La fotocamera è di nuovo al suo posto</translation>
    </message>
    <message>
        <source>It had moved while it measured, and looks again where it looked.</source>
        <translation>Si era spostata durante la misura e inquadra di nuovo ciò che inquadrava.</translation>
    </message>
    <message numerus="yes">
        <source>“%1” photographs %n pattern(s) again, from No. %2 on, and goes on from there.</source>
        <translation>
            <numerusform>«%1» rifotografa %n pattern dal n. %2 e prosegue da lì.</numerusform>
            <numerusform>«%1» rifotografa %n pattern dal n. %2 e prosegue da lì.</numerusform>
        </translation>
    </message>
    <message>
        <source>“%1” looks once more, and goes on.</source>
        <translation>«%1» guarda ancora una volta e prosegue.</translation>
    </message>
    <message>
        <source>“%1” keeps all as it is: what changed will be wrong, and the report says so.</source>
        <translation>«%1» lascia tutto com’è: ciò che è cambiato sarà sbagliato, e il rapporto lo dice.</translation>
    </message>
    <message>
        <source>Measuring waits for your answer.</source>
        <translation>La misura attende una risposta.</translation>
    </message>
    <message>
        <source>Kept photographs are read first.</source>
        <translation>Prima si leggono le foto conservate.</translation>
    </message>
    <message>
        <source>Nothing is being projected.</source>
        <translation>Non si proietta nulla.</translation>
    </message>
    <message>
        <source>Reading</source>
        <translation>Lettura</translation>
    </message>
    <message>
        <source>Reading, under a minute left</source>
        <translation>Lettura, meno di un minuto</translation>
    </message>
    <message>
        <source>Reading, about %1 left</source>
        <translation>Lettura, ancora circa %1</translation>
    </message>
    <message>
        <source>Paused, under a minute left</source>
        <translation>In pausa, meno di un minuto</translation>
    </message>
    <message>
        <source>Under a minute left</source>
        <translation>Ancora meno di un minuto</translation>
    </message>
    <message>
        <source>%1 expected</source>
        <translation>%1 previsti</translation>
    </message>
    <message>
        <source>To measure again, confirm that the room is clear.</source>
        <translation>Per misurare di nuovo, confermare che la sala è sgombra.</translation>
    </message>
    <message>
        <source>%1, %2 a minute</source>
        <translation>%1, %2 al minuto</translation>
    </message>
    <message>
        <source>all projectors fully white</source>
        <translation>tutti i proiettori completamente bianchi</translation>
    </message>
    <message>
        <source>Reading what was measured</source>
        <translation>Lettura di ciò che è stato misurato</translation>
    </message>
    <message>
        <source>The camera is at its place</source>
        <translation>La fotocamera è al suo posto</translation>
    </message>
    <message>
        <source>It looks where it looked. Perhaps the light flickered.</source>
        <translation>Guarda dove guardava. Forse la luce ha sfarfallato.</translation>
    </message>
    <message>
        <source>Ended by a change</source>
        <translation>Finita per un cambiamento</translation>
    </message>
    <message>
        <source>Put right what changed, then go on measuring.</source>
        <translation>Ripristinare ciò che è cambiato, poi proseguire la misura.</translation>
    </message>
    <message>
        <source>Measure again as it stands now, or put it back and go on measuring.</source>
        <translation>Misurare di nuovo così com’è ora, oppure rimettere a posto e proseguire la misura.</translation>
    </message>
    <message>
        <source>Measuring was stopped at blocks of %1 px: something had changed</source>
        <translation>La misura è stata fermata a blocchi di %1 px: qualcosa era cambiato</translation>
    </message>
    <message>
        <source>Measuring ended, and something had changed</source>
        <translation>La misura è finita, e qualcosa era cambiato</translation>
    </message>
    <message>
        <source>What was photographed since the look before is left out, all before it is kept.</source>
        <translation>Ciò che è stato fotografato dopo il controllo precedente è tralasciato, tutto il resto è conservato.</translation>
    </message>
    <message>
        <source>Working out, %1</source>
        <translation>Calcolo, %1</translation>
    </message>
    <message>
        <source>Working out the result</source>
        <translation>Calcolo del risultato</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s)</source>
        <translation>
            <numerusform>%n pattern</numerusform>
            <numerusform>%n pattern</numerusform>
        </translation>
    </message>
    <message>
        <source>Waits for an answer</source>
        <translation>Attende risposta</translation>
    </message>
    <message>
        <source>%1 too bright</source>
        <translation>%1 troppo chiaro</translation>
    </message>
    <message>
        <source>%1 left out</source>
        <translation>%1 escluso</translation>
    </message>
    <message>
        <source>Waiting for your answer.</source>
        <translation>In attesa di una risposta.</translation>
    </message>
    <message>
        <source>Stop and keep this one</source>
        <translation>Ferma e conserva questa</translation>
    </message>
    <message>
        <source>Going on has not ended</source>
        <translation>La ripresa non è finita</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s) expected, %1 of them checks; known exactly as each level begins</source>
        <translation>
            <numerusform>%n motivo previsto, di cui %1 di controllo; noto con esattezza quando inizia ogni livello</numerusform>
            <numerusform>%n motivi previsti, di cui %1 di controllo; noto con esattezza quando inizia ogni livello</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s), %1 of them checks</source>
        <translation>
            <numerusform>%n motivo, di cui %1 di controllo</numerusform>
            <numerusform>%n motivi, di cui %1 di controllo</numerusform>
        </translation>
    </message>
    <message>
        <source>Ending</source>
        <translation>In chiusura</translation>
    </message>
    <message>
        <source>Measure with these settings</source>
        <translation>Misura con queste impostazioni</translation>
    </message>
    <message>
        <source>Use the earlier one</source>
        <translation>Usa la precedente</translation>
    </message>
    <message>
        <source>Waiting</source>
        <translation>In attesa</translation>
    </message>
    <message>
        <source>Waiting, under a minute left</source>
        <translation>In attesa, meno di un minuto</translation>
    </message>
    <message>
        <source>Waiting, about %1 left</source>
        <translation>In attesa, ancora circa %1</translation>
    </message>
    <message>
        <source>Keep the new ones</source>
        <translation>Tieni le nuove</translation>
    </message>
    <message>
        <source>Keep the earlier measurement?</source>
        <translation>Tenere la misura precedente?</translation>
    </message>
    <message>
        <source>The new photographs are set aside and not used again: measuring again then takes every photograph again.</source>
        <translation>Le nuove foto vengono messe da parte e non si usano più: misurare di nuovo scatta allora di nuovo ogni foto.</translation>
    </message>
    <message>
        <source>The earlier measurement, and all that followed from it.</source>
        <translation>La misura precedente e tutto ciò che ne è seguito.</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s) kept</source>
        <translation>
            <numerusform>%n pattern conservato</numerusform>
            <numerusform>%n pattern conservati</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The photographs of %n pattern(s) are read first. Then measuring goes on where it ended.</source>
        <translation>
            <numerusform>Prima si leggono le foto di %n pattern. Poi la misura riprende da dove era finita.</numerusform>
            <numerusform>Prima si leggono le foto di %n pattern. Poi la misura riprende da dove era finita.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The photographs of %n pattern(s) are safe. Resuming gives the same result as if nothing had happened.</source>
        <translation>
            <numerusform>Le foto di %n pattern sono al sicuro. Riprendendo, il risultato è lo stesso che senza interruzione.</numerusform>
            <numerusform>Le foto di %n pattern sono al sicuro. Riprendendo, il risultato è lo stesso che senza interruzione.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The new photographs of %n pattern(s) are safe: resume any time. Until then the earlier measurement is used.</source>
        <translation>
            <numerusform>Le nuove foto di %n pattern sono al sicuro: si può riprendere in ogni momento. Fino ad allora vale la misura precedente.</numerusform>
            <numerusform>Le nuove foto di %n pattern sono al sicuro: si può riprendere in ogni momento. Fino ad allora vale la misura precedente.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The photographs of %n pattern(s) are on the disk. The pattern under way is not counted.</source>
        <translation>
            <numerusform>Le foto di %n pattern sono sul disco. Il pattern in corso non è contato.</numerusform>
            <numerusform>Le foto di %n pattern sono sul disco. Il pattern in corso non è contato.</numerusform>
        </translation>
    </message>
    <message>
        <source>Photographs</source>
        <translation>Foto</translation>
    </message>
    <message numerus="yes">
        <source>Reading the photographs of %n pattern(s): %1.</source>
        <translation>
            <numerusform>Lettura delle foto di %n pattern: %1.</numerusform>
            <numerusform>Lettura delle foto di %n pattern: %1.</numerusform>
        </translation>
    </message>
    <message>
        <source>Keep the new one</source>
        <translation>Tieni la nuova</translation>
    </message>
    <message>
        <source>Use the earlier measurement?</source>
        <translation>Usare la misura precedente?</translation>
    </message>
    <message>
        <source>%1; lit, within the dashes: %2 of the view</source>
        <translation>%1; illuminato, entro il tratteggio: %2 dell’inquadratura</translation>
    </message>
    <message>
        <source>Stopped after %1</source>
        <translation>Fermato dopo %1</translation>
    </message>
    <message>
        <source>Stopped early: light finer than blocks of %1 px is missing.</source>
        <translation>Fermato in anticipo: manca la luce più fine di blocchi di %1 px.</translation>
    </message>
    <message>
        <source>Again, not ended</source>
        <translation>Di nuovo, non finita</translation>
    </message>
    <message>
        <source>What was measured cannot be read</source>
        <translation>Quanto misurato non si può leggere</translation>
    </message>
    <message>
        <source>Use the earlier measurement, or measure again.</source>
        <translation>Usare la misura precedente o misurare di nuovo.</translation>
    </message>
    <message>
        <source>Measure again.</source>
        <translation>Misurare di nuovo.</translation>
    </message>
    <message>
        <source>%1 dB expected: what was measured does not fit together, and pictures are no better than uncorrected.</source>
        <translation>Attesi %1 dB: quanto misurato non concorda e le immagini non sono migliori che senza correzione.</translation>
    </message>
    <message>
        <source>%1 dB expected. Go on any time, if nothing has moved.</source>
        <translation>Attesi %1 dB. Continuare quando si vuole, se nulla si è mosso.</translation>
    </message>
    <message>
        <source>What was measured cannot be read.</source>
        <translation>Quanto misurato non si può leggere.</translation>
    </message>
    <message>
        <source>%1: what was photographed since the check before is taken again.</source>
        <translation>%1: ciò che è stato fotografato dal controllo precedente viene ripetuto.</translation>
    </message>
    <message>
        <source>The light of the room was another one, too: see that it is as it was.</source>
        <translation>Anche la luce della sala era diversa: assicurarsi che sia com’era.</translation>
    </message>
    <message>
        <source>Ending: what is begun is photographed to its end, and test patterns. Then all of it is kept.</source>
        <translation>In chiusura: ciò che è iniziato viene fotografato fino in fondo, con pattern di prova. Poi tutto viene conservato.</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the patterns flash.</source>
        <translation>Confermare che la sala è sgombra: i pattern lampeggiano.</translation>
    </message>
    <message>
        <source>%1: all patterns are taken again, from the first.</source>
        <translation>%1: tutti i pattern vengono ripresi, dal primo.</translation>
    </message>
    <message>
        <source>Measured in %1, and repaired since</source>
        <translation>Misurato in %1, poi riparato</translation>
    </message>
    <message>
        <source>Photographs of the repair since</source>
        <translation>Foto della riparazione successiva</translation>
    </message>
    <message>
        <source>Stopped too early</source>
        <translation>Interrotta troppo presto</translation>
    </message>
</context>
<context>
    <name>relucent::gui::AcquisitionTrace</name>
    <message>
        <source>the light flickered</source>
        <translation>la luce ha sfarfallato</translation>
    </message>
    <message>
        <source>the room light changed</source>
        <translation>la luce della sala è cambiata</translation>
    </message>
    <message>
        <source>the projector&apos;s light changed</source>
        <translation>la luce del proiettore è cambiata</translation>
    </message>
    <message>
        <source>the camera or the projector moved</source>
        <translation>fotocamera o proiettore spostati</translation>
    </message>
    <message>
        <source>the picture was not the one sent</source>
        <translation>non era l’immagine inviata</translation>
    </message>
    <message>
        <source>the camera saw nothing</source>
        <translation>la fotocamera non vedeva nulla</translation>
    </message>
    <message>
        <source>the projector showed nothing</source>
        <translation>il proiettore non mostrava nulla</translation>
    </message>
    <message>
        <source>too bright, shorter exposure</source>
        <translation>troppo chiaro, posa più breve</translation>
    </message>
    <message>
        <source>does not fit what was seen before</source>
        <translation>non concorda con quanto visto prima</translation>
    </message>
    <message>
        <source>No. %1</source>
        <translation>N. %1</translation>
    </message>
    <message>
        <source>No. %1 to %2</source>
        <translation>N. %1–%2</translation>
    </message>
    <message>
        <source>Room light</source>
        <translation>Luce della sala</translation>
    </message>
    <message>
        <source>Camera and view</source>
        <translation>Fotocamera e inquadratura</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>Proiettore</translation>
    </message>
    <message>
        <source>Flicker</source>
        <translation>Sfarfallio</translation>
    </message>
    <message>
        <source>Room light steady</source>
        <translation>Luce della sala stabile</translation>
    </message>
    <message>
        <source>Room light changed</source>
        <translation>La luce della sala è cambiata</translation>
    </message>
    <message>
        <source>%1 of full light, changed by %2 since the start.</source>
        <translation>%1 della piena luce, variata di %2 dall’inizio.</translation>
    </message>
    <message>
        <source>Camera still</source>
        <translation>Fotocamera ferma</translation>
    </message>
    <message>
        <source>The view changed</source>
        <translation>L’inquadratura è cambiata</translation>
    </message>
    <message>
        <source>The view differs by %1 from the first.</source>
        <translation>L’inquadratura differisce dalla prima di %1.</translation>
    </message>
    <message>
        <source>Projector steady</source>
        <translation>Proiettore stabile</translation>
    </message>
    <message>
        <source>The projector&apos;s light changed</source>
        <translation>La luce del proiettore è cambiata</translation>
    </message>
    <message>
        <source>Its light drifted by %1 and is corrected.</source>
        <translation>La sua luce è derivata di %1 ed è corretta.</translation>
    </message>
    <message>
        <source>No flicker</source>
        <translation>Nessuno sfarfallio</translation>
    </message>
    <message>
        <source>Photographs of one pattern agree within %1.</source>
        <translation>Le foto di uno stesso pattern concordano entro %1.</translation>
    </message>
    <message>
        <source>No difference between photographs of one pattern was found.</source>
        <translation>Nessuna differenza tra le foto di uno stesso pattern.</translation>
    </message>
    <message>
        <source>The camera or the projector moved</source>
        <translation>La fotocamera o il proiettore si è spostato</translation>
    </message>
    <message>
        <source>The picture is not the one sent</source>
        <translation>L’immagine non è quella inviata</translation>
    </message>
    <message>
        <source>The camera sees nothing</source>
        <translation>La fotocamera non vede nulla</translation>
    </message>
    <message>
        <source>The projector shows nothing</source>
        <translation>Il proiettore non mostra nulla</translation>
    </message>
    <message>
        <source>Put right</source>
        <translation>Risolto</translation>
    </message>
    <message>
        <source>Looked at again at the next check.</source>
        <translation>Si riguarda al prossimo controllo.</translation>
    </message>
    <message>
        <source>the light flickered, or something moved</source>
        <translation>la luce ha sfarfallato, o qualcosa si è mosso</translation>
    </message>
    <message>
        <source>The light flickers, or something moves</source>
        <translation>La luce sfarfalla, o qualcosa si muove</translation>
    </message>
    <message>
        <source>Not known while the view has changed.</source>
        <translation>Non si sa finché la vista è un’altra.</translation>
    </message>
    <message>
        <source>The light flickers, or was switched</source>
        <translation>La luce sfarfalla o è stata accesa o spenta</translation>
    </message>
    <message>
        <source>Photographed again</source>
        <translation>Fotografato di nuovo</translation>
    </message>
    <message>
        <source>dark: lens covered for a moment?</source>
        <translation>scura: obiettivo coperto per un istante?</translation>
    </message>
    <message>
        <source>Found since the last check.</source>
        <translation>Rilevato dopo l’ultimo controllo.</translation>
    </message>
    <message>
        <source>something in the view changed</source>
        <translation>qualcosa è cambiato nell’inquadratura</translation>
    </message>
    <message>
        <source>Something in the view changed</source>
        <translation>Qualcosa è cambiato nell’inquadratura</translation>
    </message>
    <message>
        <source>Not known while the camera sees nothing.</source>
        <translation>Non nota finché la fotocamera non vede nulla.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ActionBar</name>
    <message>
        <source>Progress of the measurement</source>
        <translation>Avanzamento della misura</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Indietro</translation>
    </message>
    <message>
        <source>Show where</source>
        <translation>Dove?</translation>
    </message>
</context>
<context>
    <name>relucent::gui::CameraPage</name>
    <message>
        <source>Choose</source>
        <translation>Scegli</translation>
    </message>
    <message>
        <source>Choose %1</source>
        <translation>Scegli %1</translation>
    </message>
    <message>
        <source>Choose the one that looks at the surface.</source>
        <translation>Scegliere quella rivolta alla superficie.</translation>
    </message>
    <message>
        <source>Looking for cameras</source>
        <translation>Ricerca delle fotocamere</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>Nulla è stato modificato.</translation>
    </message>
    <message>
        <source>Checking</source>
        <translation>Controllo</translation>
    </message>
    <message>
        <source>Checked %1</source>
        <translation>Controllata alle %1</translation>
    </message>
    <message>
        <source>Choose the camera that looks at the surface.</source>
        <translation>Scegliere la fotocamera rivolta alla superficie.</translation>
    </message>
    <message>
        <source>Opening the devices</source>
        <translation>Apertura dei dispositivi</translation>
    </message>
    <message>
        <source>%1 is too bright in every exposure.</source>
        <translation>%1 è troppo chiaro in ogni esposizione.</translation>
    </message>
    <message>
        <source>Look through the camera first.</source>
        <translation>Guardare prima attraverso la fotocamera.</translation>
    </message>
    <message>
        <source>Next: test patterns for the projector&apos;s response</source>
        <translation>Poi: pattern di test per la risposta del proiettore</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Pausa</translation>
    </message>
    <message>
        <source>Check again</source>
        <translation>Controlla di nuovo</translation>
    </message>
    <message>
        <source>Choose another camera</source>
        <translation>Cambia fotocamera</translation>
    </message>
    <message>
        <source>Focus area</source>
        <translation>Area di messa a fuoco</translation>
    </message>
    <message>
        <source>Nothing is measured at this step, so nothing is lost.</source>
        <translation>In questo passo non si misura nulla, quindi nulla va perso.</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Fotocamera</translation>
    </message>
    <message>
        <source>Frame the surface, focus, and let the exposures cover its brightest and darkest parts.</source>
        <translation>Inquadrare la superficie, mettere a fuoco e coprire con le esposizioni le parti più chiare e più scure.</translation>
    </message>
    <message>
        <source>Focus, %1 of best</source>
        <translation>Messa a fuoco, %1 del massimo</translation>
    </message>
    <message>
        <source>Camera view</source>
        <translation>Inquadratura</translation>
    </message>
    <message>
        <source>What the camera sees now</source>
        <translation>Ciò che vede ora la fotocamera</translation>
    </message>
    <message>
        <source>The camera is not being looked through.</source>
        <translation>Nessuna immagine dalla fotocamera.</translation>
    </message>
    <message>
        <source>Light in this exposure: red, green, blue</source>
        <translation>Luce in questa esposizione: rosso, verde, blu</translation>
    </message>
    <message>
        <source>Signal</source>
        <translation>Segnale</translation>
    </message>
    <message>
        <source>Focus</source>
        <translation>Messa a fuoco</translation>
    </message>
    <message>
        <source>Turn the lens until the bar stays at the mark: the best so far.</source>
        <translation>Ruotare la ghiera finché la barra resta sul segno: il massimo finora.</translation>
    </message>
    <message>
        <source>Exposures</source>
        <translation>Esposizioni</translation>
    </message>
    <message>
        <source>Checks</source>
        <translation>Controlli</translation>
    </message>
    <message>
        <source>Signal, share of full</source>
        <translation>Segnale, quota del massimo</translation>
    </message>
    <message>
        <source>Pixels</source>
        <translation>Pixel</translation>
    </message>
    <message>
        <source>The camera sees the projector</source>
        <translation>La fotocamera vede il proiettore</translation>
    </message>
    <message>
        <source>White and black differ as they should.</source>
        <translation>Bianco e nero differiscono come devono.</translation>
    </message>
    <message>
        <source>Bright parts are covered</source>
        <translation>Le parti chiare sono coperte</translation>
    </message>
    <message>
        <source>%1 is too bright in every exposure</source>
        <translation>%1 è troppo chiaro in ogni esposizione</translation>
    </message>
    <message>
        <source>Close the lens a little, or shade lamps in the view.</source>
        <translation>Chiudere un po’ il diaframma o schermare le lampade nell’inquadratura.</translation>
    </message>
    <message>
        <source>Dark parts are covered</source>
        <translation>Le parti scure sono coperte</translation>
    </message>
    <message>
        <source>%1 is too dark in every exposure</source>
        <translation>%1 è troppo scuro in ogni esposizione</translation>
    </message>
    <message>
        <source>The projector may not reach there. Where it should, open the lens.</source>
        <translation>Forse il proiettore non arriva lì. Dove dovrebbe, aprire il diaframma.</translation>
    </message>
    <message>
        <source>Keep exposures</source>
        <translation>Mantieni le esposizioni</translation>
    </message>
    <message>
        <source>too bright to tell</source>
        <translation>troppo chiaro per giudicare</translation>
    </message>
    <message>
        <source>Too bright %1</source>
        <translation>Troppo chiaro %1</translation>
    </message>
    <message>
        <source>Too dark %1</source>
        <translation>Troppo scuro %1</translation>
    </message>
    <message>
        <source>No camera is chosen yet</source>
        <translation>Nessuna fotocamera scelta</translation>
    </message>
    <message>
        <source>Camera pixels</source>
        <translation>Pixel della fotocamera</translation>
    </message>
    <message>
        <source>As many as needed: %1</source>
        <translation>Quanti ne servono: %1</translation>
    </message>
    <message>
        <source>All: %1</source>
        <translation>Tutti: %1</translation>
    </message>
    <message>
        <source>%1 become one: %2</source>
        <translation>%1 diventano uno: %2</translation>
    </message>
    <message>
        <source>Camera pixels that are used</source>
        <translation>Pixel della fotocamera utilizzati</translation>
    </message>
    <message>
        <source>Memory</source>
        <translation>Memoria</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>Disco</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>Tempo</translation>
    </message>
    <message>
        <source>More camera pixels than projector pixels show nothing more. The photographs that prove the result stay as large as they are.</source>
        <translation>Più pixel della fotocamera che del proiettore non mostrano nulla di più. Le foto che provano il risultato restano grandi come sono.</translation>
    </message>
    <message>
        <source>Mark what is sharp</source>
        <translation>Segna ciò che è nitido</translation>
    </message>
    <message>
        <source>Checked before. Check again if camera or projector were moved.</source>
        <translation>Già controllato. Controllare di nuovo se fotocamera o proiettore sono stati spostati.</translation>
    </message>
    <message>
        <source>Continue</source>
        <translation>Continua</translation>
    </message>
    <message>
        <source>Exposure times</source>
        <translation>Tempi di esposizione</translation>
    </message>
    <message>
        <source>The projector&apos;s picture: the camera sees %1 of it</source>
        <translation>L’immagine del proiettore: la fotocamera ne vede %1</translation>
    </message>
    <message>
        <source>at the left</source>
        <translation>a sinistra</translation>
    </message>
    <message>
        <source>at the right</source>
        <translation>a destra</translation>
    </message>
    <message>
        <source>at the top</source>
        <translation>in alto</translation>
    </message>
    <message>
        <source>at the bottom</source>
        <translation>in basso</translation>
    </message>
    <message>
        <source>Missing are places within it: in shadow, or too dark for the camera.</source>
        <translation>Mancano punti al suo interno: in ombra o troppo scuri per la fotocamera.</translation>
    </message>
    <message>
        <source>Missing: %1. Aim the camera there, or move it back.</source>
        <translation>Manca: %1. Puntare lì la fotocamera o allontanarla.</translation>
    </message>
    <message>
        <source>%1 of the projector&apos;s picture is seen</source>
        <translation>Si vede %1 dell’immagine del proiettore</translation>
    </message>
    <message>
        <source>%1 of projector %2&apos;s picture is seen</source>
        <translation>Si vede %1 dell’immagine del proiettore %2</translation>
    </message>
    <message>
        <source>Every exposure is a multiple of %1</source>
        <translation>Ogni esposizione è un multiplo di %1</translation>
    </message>
    <message>
        <source>The projector&apos;s light changes as quickly as that: each photograph has all of it.</source>
        <translation>La luce del proiettore cambia a quel ritmo: ogni foto la contiene tutta.</translation>
    </message>
    <message>
        <source>Allow any exposure</source>
        <translation>Consenti ogni esposizione</translation>
    </message>
    <message>
        <source>Exposures shorter than %1 flicker</source>
        <translation>Le esposizioni più brevi di %1 sfarfallano</translation>
    </message>
    <message>
        <source>The projector&apos;s light changes within that time.</source>
        <translation>La luce del proiettore cambia in quel tempo.</translation>
    </message>
    <message>
        <source>Use multiples of %1</source>
        <translation>Usa multipli di %1</translation>
    </message>
    <message>
        <source>Checked before</source>
        <translation>Già controllato</translation>
    </message>
    <message>
        <source>These exposures are kept. “Check again” looks through the camera.</source>
        <translation>Queste esposizioni sono conservate. «Controlla di nuovo» guarda attraverso la fotocamera.</translation>
    </message>
    <message>
        <source>Not checked yet</source>
        <translation>Non ancora controllato</translation>
    </message>
    <message>
        <source>Missing: %1. A simulated camera stays where it stands: go on, what it does not see is left as it is.</source>
        <translation>Manca: %1. Una fotocamera simulata resta dov’è: proseguire, ciò che non vede resta com’è.</translation>
    </message>
    <message>
        <source>Exposures as measured</source>
        <translation>Esposizioni della misura</translation>
    </message>
    <message>
        <source>Camera %1: %2 is too bright in every exposure.</source>
        <translation>Fotocamera %1: %2 è troppo chiaro in ogni esposizione.</translation>
    </message>
    <message>
        <source>What %1 sees now</source>
        <translation>Ciò che %1 vede ora</translation>
    </message>
    <message>
        <source>Focus %1</source>
        <translation>Fuoco %1</translation>
    </message>
    <message numerus="yes">
        <source>%n projector(s): %1</source>
        <translation>
            <numerusform>%n proiettore: %1</numerusform>
            <numerusform>%n proiettori: %1</numerusform>
        </translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Luce</translation>
    </message>
    <message>
        <source>Overlap</source>
        <translation>Sovrapposizione</translation>
    </message>
    <message>
        <source>how many projectors light each place</source>
        <translation>quanti proiettori illuminano ogni punto</translation>
    </message>
    <message>
        <source>Checks done</source>
        <translation>Controlli completati</translation>
    </message>
    <message>
        <source>%1 of every picture is seen</source>
        <translation>Si vede il %1 di ogni immagine</translation>
    </message>
    <message>
        <source>Exposures, kept</source>
        <translation>Esposizioni, conservate</translation>
    </message>
    <message>
        <source>Check again to look with another one.</source>
        <translation>Verificare di nuovo per guardare con un’altra.</translation>
    </message>
    <message>
        <source>Exposures, paused</source>
        <translation>Esposizioni, in pausa</translation>
    </message>
    <message>
        <source>places within it</source>
        <translation>punti al suo interno</translation>
    </message>
    <message>
        <source>All of the view, by one exposure or another.</source>
        <translation>Tutta l’inquadratura, con l’una o l’altra esposizione.</translation>
    </message>
    <message>
        <source>All but %1 of the view, by one exposure or another.</source>
        <translation>Tutta l’inquadratura tranne %1, con l’una o l’altra esposizione.</translation>
    </message>
    <message>
        <source>%1 too bright</source>
        <translation>%1 troppo chiaro</translation>
    </message>
    <message>
        <source>Keep the former camera</source>
        <translation>Tieni la fotocamera di prima</translation>
    </message>
    <message>
        <source>exposure %1, click to judge focus</source>
        <translation>esposizione %1, clic per valutare il fuoco</translation>
    </message>
    <message>
        <source>Checks under way</source>
        <translation>Controlli in corso</translation>
    </message>
    <message>
        <source>Stop the checks</source>
        <translation>Interrompi i controlli</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the checks begin with that.</source>
        <translation>Confermare che la sala è sgombra: con questo iniziano i controlli.</translation>
    </message>
    <message>
        <source>as it was seen last, exposure %1</source>
        <translation>come visto l’ultima volta, esposizione %1</translation>
    </message>
    <message>
        <source>%1 of full light was too bright in every exposure. “Check again” looks through the camera.</source>
        <translation>%1 della luce piena era troppo chiaro in ogni esposizione. “Controlla di nuovo” guarda attraverso la fotocamera.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::CameraRows</name>
    <message>
        <source>Cameras</source>
        <translation>Fotocamere</translation>
    </message>
    <message>
        <source>Look again</source>
        <translation>Cerca di nuovo</translation>
    </message>
    <message>
        <source>Looking for cameras</source>
        <translation>Ricerca delle fotocamere</translation>
    </message>
    <message>
        <source>Cannot be used: %1</source>
        <translation>Non utilizzabile: %1</translation>
    </message>
    <message numerus="yes">
        <source>%1 pixels, %n bit(s), exposures %2 to %3</source>
        <translation>
            <numerusform>%1 pixel, %n bit, esposizioni da %2 a %3</numerusform>
            <numerusform>%1 pixel, %n bit, esposizioni da %2 a %3</numerusform>
        </translation>
    </message>
    <message>
        <source>Recommended: it tells faint light apart best</source>
        <translation>Consigliata: distingue meglio la luce debole</translation>
    </message>
    <message>
        <source>Fewer bits: faint light is told apart less well</source>
        <translation>Meno bit: la luce debole si distingue peggio</translation>
    </message>
    <message>
        <source>Recommended: its exposures cover most, from bright to dark</source>
        <translation>Consigliata: le sue esposizioni coprono di più, dal chiaro allo scuro</translation>
    </message>
    <message>
        <source>Fewer exposures: bright and dark are harder to cover</source>
        <translation>Meno esposizioni: chiari e scuri sono più difficili da coprire</translation>
    </message>
    <message>
        <source>Recommended: it has most pixels</source>
        <translation>Consigliata: ha più pixel</translation>
    </message>
    <message>
        <source>Fewer pixels than the first</source>
        <translation>Meno pixel della prima</translation>
    </message>
    <message>
        <source>As suitable as the first</source>
        <translation>Adatta quanto la prima</translation>
    </message>
    <message>
        <source>No camera answers. Check its cable and its power, and close other programs that use it.</source>
        <translation>Nessuna fotocamera risponde. Controllare il cavo e l’alimentazione, e chiudere altri programmi che la usano.</translation>
    </message>
    <message>
        <source>These are found here: webcams and other video devices, industrial cameras by GigE Vision or USB3 Vision, and still cameras on USB.</source>
        <translation>Qui si trovano: webcam e altri dispositivi video, telecamere industriali con GigE Vision o USB3 Vision e fotocamere su USB.</translation>
    </message>
    <message>
        <source>Any other is driven by a program of yours: go Back and choose “New venue by script”. The guide (F1) tells how cameras are set up.</source>
        <translation>Qualsiasi altra è pilotata da un programma proprio: «Indietro», poi «Nuovo luogo da script». La guida (F1) spiega come si preparano le fotocamere.</translation>
    </message>
    <message>
        <source>Any other is driven by a program of yours. The guide (F1) tells how cameras are set up.</source>
        <translation>Qualsiasi altra è pilotata da un programma proprio. La guida (F1) spiega come si preparano le fotocamere.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ClusterPage</name>
    <message>
        <source>What is measured is safe.</source>
        <translation>Quanto misurato è al sicuro.</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>Da aggiornare</translation>
    </message>
    <message>
        <source>Grouping again</source>
        <translation>Nuovo raggruppamento</translation>
    </message>
    <message>
        <source>Grouping</source>
        <translation>Raggruppamento</translation>
    </message>
    <message>
        <source>Reading the light transport</source>
        <translation>Lettura del trasporto della luce</translation>
    </message>
    <message>
        <source>Preview content</source>
        <translation>Anteprima contenuto</translation>
    </message>
    <message>
        <source>The clusters that are kept belong to an earlier threshold</source>
        <translation>I cluster conservati si riferiscono a una soglia precedente</translation>
    </message>
    <message>
        <source>What you see here has been grouped again. Going on keeps it.</source>
        <translation>Quanto si vede qui è raggruppato di nuovo. Proseguendo viene conservato.</translation>
    </message>
    <message>
        <source>Cluster</source>
        <translation>Cluster</translation>
    </message>
    <message>
        <source>Cluster map</source>
        <translation>Mappa cluster</translation>
    </message>
    <message>
        <source>click a pixel</source>
        <translation>clic su un pixel</translation>
    </message>
    <message>
        <source>Error map</source>
        <translation>Mappa errori</translation>
    </message>
    <message>
        <source>Flat</source>
        <translation>Piana</translation>
    </message>
    <message>
        <source>Relief</source>
        <translation>Rilievo</translation>
    </message>
    <message>
        <source>Cluster sizes</source>
        <translation>Dimensioni dei cluster</translation>
    </message>
    <message>
        <source>Projector pixels in the cluster</source>
        <translation>Pixel del proiettore nel cluster</translation>
    </message>
    <message>
        <source>Clusters</source>
        <translation>Cluster</translation>
    </message>
    <message>
        <source>%1, %2: in no cluster</source>
        <translation>%1, %2: in nessun cluster</translation>
    </message>
    <message>
        <source>Error map, median %1</source>
        <translation>Mappa errori, mediana %1</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>Distanza</translation>
    </message>
    <message>
        <source>small, sharp</source>
        <translation>piccoli, nitidi</translation>
    </message>
    <message>
        <source>large, fast</source>
        <translation>grandi, veloci</translation>
    </message>
    <message>
        <source>Share of the brightest</source>
        <translation>Quota del più luminoso</translation>
    </message>
    <message>
        <source>more detail</source>
        <translation>più dettaglio</translation>
    </message>
    <message>
        <source>more speed</source>
        <translation>più velocità</translation>
    </message>
    <message>
        <source>Largest cluster</source>
        <translation>Cluster più grande</translation>
    </message>
    <message>
        <source>fast</source>
        <translation>veloce</translation>
    </message>
    <message>
        <source>exact</source>
        <translation>esatto</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>Risultato</translation>
    </message>
    <message>
        <source>Light kept in clusters</source>
        <translation>Luce conservata nei cluster</translation>
    </message>
    <message>
        <source>Median error</source>
        <translation>Errore mediano</translation>
    </message>
    <message>
        <source>%1 px</source>
        <translation>%1 px</translation>
    </message>
    <message>
        <source>%1 of light</source>
        <translation>%1 della luce</translation>
    </message>
    <message numerus="yes">
        <source>%n cluster(s)</source>
        <translation>
            <numerusform>%n cluster</numerusform>
            <numerusform>%n cluster</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n cluster(s), median %1 px</source>
        <translation>
            <numerusform>%n cluster, mediana %1 px</numerusform>
            <numerusform>%n cluster, mediana %1 px</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1, %2: %n projector pixel(s), error %3</source>
        <translation>
            <numerusform>%1, %2: %n pixel del proiettore, errore %3</numerusform>
            <numerusform>%1, %2: %n pixel del proiettore, errore %3</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Cluster map, %n cluster(s), largest %1</source>
        <translation>
            <numerusform>Mappa cluster, %n cluster, il più grande %1</numerusform>
            <numerusform>Mappa cluster, %n cluster, il più grande %1</numerusform>
        </translation>
    </message>
    <message>
        <source>95 % of pixels below</source>
        <translation>95 % dei pixel sotto</translation>
    </message>
    <message numerus="yes">
        <source>%1, %2: %n projector pixel(s)</source>
        <translation>
            <numerusform>%1, %2: %n pixel del proiettore</numerusform>
            <numerusform>%1, %2: %n pixel del proiettore</numerusform>
        </translation>
    </message>
    <message>
        <source>error</source>
        <translation>errore</translation>
    </message>
    <message>
        <source>limit %1</source>
        <translation>limite %1</translation>
    </message>
    <message>
        <source>over %1</source>
        <translation>oltre %1</translation>
    </message>
    <message>
        <source>about %1</source>
        <translation>circa %1</translation>
    </message>
    <message>
        <source>Cut off by the size limit</source>
        <translation>Tagliata dal limite</translation>
    </message>
    <message>
        <source>Films, frames a second</source>
        <translation>Video, fotogrammi al secondo</translation>
    </message>
    <message>
        <source>What this computer manages in Full HD with the light that Threshold keeps. The groups make no difference to it: films are solved in overlapping windows.</source>
        <translation>Quanto riesce a fare questo computer in Full HD con la luce che Soglia conserva. I gruppi non lo cambiano: i video sono risolti in finestre che si sovrappongono.</translation>
    </message>
    <message>
        <source>Without a size limit, one cluster would cover %1 of the picture.</source>
        <translation>Senza limite di dimensione, un cluster coprirebbe %1 dell’immagine.</translation>
    </message>
    <message>
        <source>The surface is blurred across neighbouring pixels, so groups join up. The limit keeps them apart.</source>
        <translation>La superficie è sfocata tra pixel vicini, quindi i gruppi si uniscono. Il limite li tiene separati.</translation>
    </message>
    <message>
        <source>The clusters that are kept belong to an earlier measurement</source>
        <translation>I cluster conservati si riferiscono a una misura precedente</translation>
    </message>
    <message>
        <source>Films are shown by “All bounces, for films”, whatever the clusters are. Clusters tell which places light each other, and can be compared at Preview.</source>
        <translation>I video usano «Tutti i rimbalzi, per i video», quali che siano i cluster. I cluster dicono quali punti si illuminano a vicenda e si confrontano nell’anteprima.</translation>
    </message>
    <message>
        <source>See which parts of the surface light each other, and split them into groups that can be solved on their own.</source>
        <translation>Vedere quali parti della superficie si illuminano a vicenda e dividerle in gruppi risolvibili da soli.</translation>
    </message>
    <message>
        <source>Grouped anew</source>
        <translation>Raggruppato di nuovo</translation>
    </message>
    <message>
        <source>Changed: it is applied as soon as you go on.</source>
        <translation>Modificato: si applica appena si prosegue.</translation>
    </message>
    <message>
        <source>What was measured is too coarse to group. Go on measuring.</source>
        <translation>Ciò che è misurato è troppo grossolano per formare gruppi. Continuare la misura.</translation>
    </message>
    <message>
        <source>No light is strong enough to group.</source>
        <translation>Nessuna luce è abbastanza forte per formare gruppi.</translation>
    </message>
    <message>
        <source>Reliefs need OpenGL, which is not there.</source>
        <translation>I rilievi richiedono OpenGL, che manca.</translation>
    </message>
    <message>
        <source>An error of %1 is normal here.</source>
        <translation>Un errore di %1 è normale qui.</translation>
    </message>
    <message>
        <source>Grouping drops the blur of the lens on purpose: little where it is sharp, 70 to 80 % where it is blurred. Look for patches that stand out from their surroundings.</source>
        <translation>Il raggruppamento scarta di proposito la sfocatura dell’obiettivo: poco dove è nitido, dal 70 all’80 % dove è sfocato. Cercare le zone che spiccano sul resto.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::CornerView</name>
    <message>
        <source>Top left corner, %1, %2.</source>
        <translation>Angolo in alto a sinistra, %1, %2.</translation>
    </message>
    <message>
        <source>Top right corner, %1, %2.</source>
        <translation>Angolo in alto a destra, %1, %2.</translation>
    </message>
    <message>
        <source>Bottom right corner, %1, %2.</source>
        <translation>Angolo in basso a destra, %1, %2.</translation>
    </message>
    <message>
        <source>Bottom left corner, %1, %2.</source>
        <translation>Angolo in basso a sinistra, %1, %2.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::DevicePage</name>
    <message>
        <source>A show is playing</source>
        <translation>Uno show è in corso</translation>
    </message>
    <message>
        <source>What is begun here shines in its place. The show is seen again once it has ended.</source>
        <translation>Ciò che si avvia qui viene proiettato al suo posto. Lo show si rivede quando è finito.</translation>
    </message>
    <message>
        <source>Another program plays a show of this venue</source>
        <translation>Un altro programma sta riproducendo uno show di questo luogo</translation>
    </message>
    <message>
        <source>The show plays on.</source>
        <translation>Lo show continua.</translation>
    </message>
    <message>
        <source>End that show</source>
        <translation>Termina quello show</translation>
    </message>
    <message>
        <source>End the show</source>
        <translation>Termina lo show</translation>
    </message>
    <message>
        <source>Let it play</source>
        <translation>Lascialo continuare</translation>
    </message>
    <message>
        <source>The show that another program plays of this venue: the projector&apos;s screen goes dark.</source>
        <translation>Lo show di questo luogo riprodotto da un altro programma: lo schermo del proiettore diventa nero.</translation>
    </message>
    <message>
        <source>Venue and playlist stay. An installed show starts again at the next log-in.</source>
        <translation>Luogo e playlist restano. Uno show installato riparte al prossimo accesso.</translation>
    </message>
    <message>
        <source>Its pictures shine on the projector whatever is shown from here, and may come between patterns that are measured.</source>
        <translation>Le sue immagini sono sul proiettore qualunque cosa si mostri da qui, e possono comparire tra i motivi misurati.</translation>
    </message>
    <message>
        <source>It is ending</source>
        <translation>Sta terminando</translation>
    </message>
    <message>
        <source>The show that another program plays of another venue: the projector&apos;s screen goes dark.</source>
        <translation>Lo show di un altro luogo che un altro programma riproduce: lo schermo del proiettore si spegne.</translation>
    </message>
    <message>
        <source>Another program plays a show of another venue on this projector</source>
        <translation>Un altro programma sta riproducendo uno show di un altro luogo su questo proiettore</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged. Plug it in again: the show comes back by itself.</source>
        <translation>Lo schermo del proiettore è scollegato. Ricollegarlo: lo show torna da solo.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::DeviceSelector</name>
    <message>
        <source>Projector that is shown</source>
        <translation>Proiettore mostrato</translation>
    </message>
    <message>
        <source>Camera that is shown</source>
        <translation>Fotocamera mostrata</translation>
    </message>
</context>
<context>
    <name>relucent::gui::EndingDialog</name>
    <message>
        <source>Ending</source>
        <translation>Chiusura</translation>
    </message>
    <message>
        <source>Ending…</source>
        <translation>Chiusura…</translation>
    </message>
    <message>
        <source>Everything that was measured is safe. The devices finish what they are doing, which can take half a minute; then this window closes by itself.</source>
        <translation>Tutto ciò che è stato misurato è al sicuro. I dispositivi finiscono ciò che stanno facendo, il che può richiedere mezzo minuto; poi questa finestra si chiude da sola.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::FailureDialog</name>
    <message>
        <source>The disk did not do what was asked</source>
        <translation>Il disco non ha fatto quanto richiesto</translation>
    </message>
    <message>
        <source>The memory is full</source>
        <translation>La memoria è piena</translation>
    </message>
    <message>
        <source>A file cannot be read</source>
        <translation>Impossibile leggere un file</translation>
    </message>
    <message>
        <source>This cannot be done as it is</source>
        <translation>Così com’è non è possibile</translation>
    </message>
    <message>
        <source>The computation failed</source>
        <translation>Il calcolo non è riuscito</translation>
    </message>
    <message>
        <source>What happened</source>
        <translation>Cosa è successo</translation>
    </message>
    <message>
        <source>What is safe</source>
        <translation>Cosa è al sicuro</translation>
    </message>
    <message>
        <source>What to do</source>
        <translation>Cosa fare</translation>
    </message>
    <message>
        <source>Copy details</source>
        <translation>Copia dettagli</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Chiudi</translation>
    </message>
    <message>
        <source>What it ends</source>
        <translation>Che cosa termina</translation>
    </message>
    <message>
        <source>What happens</source>
        <translation>Che cosa accade</translation>
    </message>
    <message>
        <source>A device did not do what was asked</source>
        <translation>Un dispositivo non ha fatto quanto richiesto</translation>
    </message>
</context>
<context>
    <name>relucent::gui::FlashConsent</name>
    <message>
        <source>The projector shows patterns that change as quickly as the devices can, perhaps more than 3 times a second.</source>
        <translation>Il proiettore mostra pattern che cambiano alla massima velocità dei dispositivi, forse più di 3 volte al secondo.</translation>
    </message>
    <message>
        <source>The room is clear</source>
        <translation>La sala è sgombra</translation>
    </message>
    <message>
        <source>Flashing light</source>
        <translation>Luce lampeggiante</translation>
    </message>
    <message>
        <source>The room is clear and everyone here knows</source>
        <translation>La sala è sgombra e tutti i presenti sono avvisati</translation>
    </message>
    <message>
        <source>Flashing light can cause seizures. Clear the room and cover the entrance.</source>
        <translation>La luce lampeggiante può causare crisi epilettiche. Sgombrare la sala e coprire l’ingresso.</translation>
    </message>
    <message numerus="yes">
        <source>The projector shows patterns that change about %n time(s) a second, and at times more often.</source>
        <translation>
            <numerusform>Il proiettore mostra pattern che cambiano circa una volta al secondo, a tratti più spesso.</numerusform>
            <numerusform>Il proiettore mostra pattern che cambiano circa %n volte al secondo, a tratti più spesso.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::gui::HelpWindow</name>
    <message>
        <source>Help</source>
        <translation>Guida</translation>
    </message>
    <message>
        <source>Search the guide</source>
        <translation>Cerca nella guida</translation>
    </message>
    <message>
        <source>Pages of the guide</source>
        <translation>Pagine della guida</translation>
    </message>
    <message>
        <source>The page</source>
        <translation>Pagina</translation>
    </message>
    <message>
        <source>No page holds these words.</source>
        <translation>Nessuna pagina contiene queste parole.</translation>
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
        <translation>Linee nitide? Allora è la risoluzione nativa del proiettore.</translation>
    </message>
    <message>
        <source>Screen %1</source>
        <translation>Schermo %1</translation>
    </message>
</context>
<context>
    <name>relucent::gui::LinearizePage</name>
    <message>
        <source>The photographs of this step are still in the folder.</source>
        <translation>Le foto di questo passo sono ancora nella cartella.</translation>
    </message>
    <message>
        <source>Measuring, %1</source>
        <translation>Misura, %1</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Misurato</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>Da aggiornare</translation>
    </message>
    <message>
        <source>Stopped by a failure</source>
        <translation>Interrotto da errore</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>I dispositivi sono in uso nel passo %1.</translation>
    </message>
    <message>
        <source>The colours do not add up. Continuing is recorded in the report.</source>
        <translation>I colori non si sommano. Proseguendo, viene annotato nel rapporto.</translation>
    </message>
    <message>
        <source>Measured in %1</source>
        <translation>Misurato in %1</translation>
    </message>
    <message>
        <source>Plan acquisition</source>
        <translation>Prepara acquisizione</translation>
    </message>
    <message>
        <source>Continue anyway</source>
        <translation>Continua comunque</translation>
    </message>
    <message>
        <source>Measure response</source>
        <translation>Misura risposta</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Ferma</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>Misura di nuovo</translation>
    </message>
    <message>
        <source>These curves belong to earlier settings</source>
        <translation>Queste curve si riferiscono a impostazioni precedenti</translation>
    </message>
    <message>
        <source>They still work and stay until the new ones are measured.</source>
        <translation>Sono ancora utilizzabili e restano finché le nuove non sono misurate.</translation>
    </message>
    <message>
        <source>Levels</source>
        <translation>Livelli</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>Nulla è stato modificato.</translation>
    </message>
    <message>
        <source>Try again</source>
        <translation>Riprova</translation>
    </message>
    <message>
        <source>Every photograph that was taken is on the disk. Trying again goes on from there.</source>
        <translation>Ogni foto scattata è sul disco. Riprovando si prosegue da lì.</translation>
    </message>
    <message>
        <source>Linearize</source>
        <translation>Linearità</translation>
    </message>
    <message>
        <source>Measure how much light each step of the projector&apos;s three colours really gives.</source>
        <translation>Misurare quanta luce dà davvero ogni livello dei tre colori del proiettore.</translation>
    </message>
    <message>
        <source>Red</source>
        <translation>Rosso</translation>
    </message>
    <message>
        <source>Green</source>
        <translation>Verde</translation>
    </message>
    <message>
        <source>Blue</source>
        <translation>Blu</translation>
    </message>
    <message>
        <source>Sent to the projector</source>
        <translation>Inviato al proiettore</translation>
    </message>
    <message>
        <source>Seen by the camera</source>
        <translation>Visto dalla fotocamera</translation>
    </message>
    <message>
        <source>Pattern that the projector shows</source>
        <translation>Pattern mostrato dal proiettore</translation>
    </message>
    <message>
        <source>Last photograph</source>
        <translation>Ultima foto</translation>
    </message>
    <message>
        <source>Appears when measuring begins.</source>
        <translation>Compare all’inizio della misura.</translation>
    </message>
    <message>
        <source>%1, photograph %2</source>
        <translation>%1, foto %2</translation>
    </message>
    <message>
        <source>Response of the projector</source>
        <translation>Risposta del proiettore</translation>
    </message>
    <message>
        <source>Level sent to the projector</source>
        <translation>Livello inviato al proiettore</translation>
    </message>
    <message>
        <source>Light, % of full</source>
        <translation>Luce, % del massimo</translation>
    </message>
    <message>
        <source>Light of every level, three colours</source>
        <translation>Luce di ogni livello, tre colori</translation>
    </message>
    <message>
        <source>as it is measured</source>
        <translation>durante la misura</translation>
    </message>
    <message numerus="yes">
        <source>%n level(s) a colour, drift removed</source>
        <translation>
            <numerusform>%n livello per colore, deriva rimossa</numerusform>
            <numerusform>%n livelli per colore, deriva rimossa</numerusform>
        </translation>
    </message>
    <message>
        <source>not measured yet</source>
        <translation>non ancora misurata</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>Risultato</translation>
    </message>
    <message>
        <source>Exposures</source>
        <translation>Esposizioni</translation>
    </message>
    <message>
        <source>Chosen for this venue</source>
        <translation>Scelte per questo luogo</translation>
    </message>
    <message>
        <source>Measure with</source>
        <translation>Misura con</translation>
    </message>
    <message>
        <source>Levels a colour</source>
        <translation>Livelli per colore</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>Misura in corso</translation>
    </message>
    <message>
        <source>Not measured yet</source>
        <translation>Non ancora misurato</translation>
    </message>
    <message>
        <source>Whether the colours add up, the camera is linear and every level is brighter than the one below is told when all levels are measured.</source>
        <translation>Solo dopo la misura di tutti i livelli si sa se i colori si sommano, se la fotocamera è lineare e se ogni livello è più chiaro del precedente.</translation>
    </message>
    <message>
        <source>The colours add up</source>
        <translation>I colori si sommano</translation>
    </message>
    <message>
        <source>Red, green and blue together give white within %1.</source>
        <translation>Rosso, verde e blu insieme danno il bianco entro %1.</translation>
    </message>
    <message>
        <source>The colours do not add up</source>
        <translation>I colori non si sommano</translation>
    </message>
    <message>
        <source>White differs by %1 from its colours. Turn off “brilliant” or “dynamic” in the projector&apos;s menu, then measure again.</source>
        <translation>Il bianco differisce di %1 dai suoi colori. Disattivare «brillante» o «dinamico» nel menu del proiettore, poi misurare di nuovo.</translation>
    </message>
    <message>
        <source>The camera is linear</source>
        <translation>La fotocamera è lineare</translation>
    </message>
    <message>
        <source>The camera&apos;s curve is known</source>
        <translation>La curva della fotocamera è nota</translation>
    </message>
    <message>
        <source>Doubling the exposure doubles the signal.</source>
        <translation>Raddoppiando l’esposizione raddoppia il segnale.</translation>
    </message>
    <message>
        <source>Its photographs are brought back to linear light.</source>
        <translation>Le sue foto vengono riportate a luce lineare.</translation>
    </message>
    <message>
        <source>Curves rise everywhere</source>
        <translation>Le curve salgono ovunque</translation>
    </message>
    <message>
        <source>No level is darker than the one below it.</source>
        <translation>Nessun livello è più scuro del precedente.</translation>
    </message>
    <message>
        <source>Found while measuring</source>
        <translation>Rilevato durante la misura</translation>
    </message>
    <message numerus="yes">
        <source>About %n test pattern(s)</source>
        <translation>
            <numerusform>Circa %n pattern di test</numerusform>
            <numerusform>Circa %n pattern di test</numerusform>
        </translation>
    </message>
    <message>
        <source>Go on now</source>
        <translation>Prosegui ora</translation>
    </message>
    <message>
        <source>Measuring with these settings. Stop to change them.</source>
        <translation>Misura in corso con queste impostazioni. Fermarla per cambiarle.</translation>
    </message>
    <message>
        <source>Keep the earlier one</source>
        <translation>Tieni la precedente</translation>
    </message>
    <message>
        <source>The earlier curves are used again, with all that followed from them.</source>
        <translation>Si usano di nuovo le curve precedenti, con tutto ciò che ne è seguito.</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>Quanto misurato è al sicuro.</translation>
    </message>
    <message>
        <source>Black level</source>
        <translation>Livello del nero</translation>
    </message>
    <message>
        <source>Contrast</source>
        <translation>Contrasto</translation>
    </message>
    <message>
        <source>%1 of full light</source>
        <translation>%1 della luce piena</translation>
    </message>
    <message>
        <source>Colours within %1</source>
        <translation>Colori entro %1</translation>
    </message>
    <message>
        <source>How far each level&apos;s light is from the fitted curve</source>
        <translation>Quanto dista dalla curva la luce di ogni livello</translation>
    </message>
    <message>
        <source>within ±%1</source>
        <translation>entro ±%1</translation>
    </message>
    <message>
        <source>One test pattern shows many levels side by side, so few patterns are enough.</source>
        <translation>Un pattern di prova mostra molti livelli affiancati: bastano pochi pattern.</translation>
    </message>
    <message>
        <source>Off the curve</source>
        <translation>Scarto dalla curva</translation>
    </message>
    <message>
        <source>Residuals: what was photographed, less the curve that was fitted to it.</source>
        <translation>Residui: ciò che è stato fotografato meno la curva adattata.</translation>
    </message>
    <message>
        <source>Off the curve, % of full</source>
        <translation>Scarto dalla curva, % del massimo</translation>
    </message>
    <message>
        <source>Stopping after the photograph under way.</source>
        <translation>Si ferma dopo la foto in corso.</translation>
    </message>
    <message>
        <source>To measure again, confirm that the room is clear.</source>
        <translation>Per misurare di nuovo, confermare che la sala è sgombra.</translation>
    </message>
    <message>
        <source>Colours off by %1</source>
        <translation>Colori fuori di %1</translation>
    </message>
    <message>
        <source>The photographs contradict each other. See that nothing covers the lens, then measure again.</source>
        <translation>Le fotografie si contraddicono. Controllare che nulla copra l’obiettivo, poi misurare di nuovo.</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the patterns flash.</source>
        <translation>Confermare che la sala è sgombra: i pattern lampeggiano.</translation>
    </message>
    <message>
        <source>The photographs contradict each other</source>
        <translation>Le fotografie si contraddicono</translation>
    </message>
    <message>
        <source>White differs by %1 from its colours, and levels by up to %2 from their curve: no picture mode does that. Something covered the lens or the picture, or the light changed. Nothing else is told from these photographs; measure again.</source>
        <translation>Il bianco differisce del %1 dai suoi colori, e i livelli fino al %2 dalla loro curva: nessuna modalità d’immagine fa questo. Qualcosa copriva l’obiettivo o l’immagine, oppure la luce è cambiata. Da queste fotografie non si ricava altro; misurare di nuovo.</translation>
    </message>
    <message>
        <source>The camera sees hardly any light of the projector</source>
        <translation>La fotocamera non vede quasi luce dal proiettore</translation>
    </message>
    <message>
        <source>See that nothing covers the lens or the picture. What is photographed meanwhile is lost: stop, and measure again.</source>
        <translation>Controllare che nulla copra l’obiettivo o l’immagine. Ciò che viene fotografato nel frattempo è perso: fermare e misurare di nuovo.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MainWindow</name>
    <message>
        <source>Dim pictures</source>
        <translation>Attenua immagini</translation>
    </message>
    <message>
        <source>Pictures dimmed</source>
        <translation>Immagini attenuate</translation>
    </message>
    <message>
        <source>Settings</source>
        <translation>Opzioni</translation>
    </message>
    <message>
        <source>Help</source>
        <translation>Guida</translation>
    </message>
    <message>
        <source>F1</source>
        <translation>F1</translation>
    </message>
    <message>
        <source>Less light from this screen falls into the room (F9)</source>
        <translation>Meno luce di questo schermo cade nella sala (F9)</translation>
    </message>
    <message>
        <source>Undone: %1</source>
        <translation>Annullato: %1</translation>
    </message>
    <message>
        <source>Nothing to undo here</source>
        <translation>Qui non c’è nulla da annullare</translation>
    </message>
    <message>
        <source>Done again: %1</source>
        <translation>Ripristinato: %1</translation>
    </message>
    <message>
        <source>Nothing to do again</source>
        <translation>Nulla da ripristinare</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MaskEditing</name>
    <message>
        <source>This is no mask: %1.</source>
        <translation>Questa non è una maschera: %1.</translation>
    </message>
    <message>
        <source>New mask</source>
        <translation>Nuova maschera</translation>
    </message>
    <message>
        <source>Outline of a mask</source>
        <translation>Contorno di una maschera</translation>
    </message>
    <message>
        <source>Feather of a mask</source>
        <translation>Bordo sfumato di una maschera</translation>
    </message>
    <message>
        <source>Removed mask</source>
        <translation>Maschera rimossa</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MaskView</name>
    <message numerus="yes">
        <source>Drawing a mask: %n point(s). Space sets one at %1, %2. Return closes it, Escape leaves it.</source>
        <translation>
            <numerusform>Disegno di una maschera: %n punto. Spazio ne mette uno a %1, %2. Invio la chiude, Esc la abbandona.</numerusform>
            <numerusform>Disegno di una maschera: %n punti. Spazio ne mette uno a %1, %2. Invio la chiude, Esc la abbandona.</numerusform>
        </translation>
    </message>
    <message>
        <source>Point %1 of %2, %3, %4.</source>
        <translation>Punto %1 di %2, %3, %4.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MatrixView</name>
    <message>
        <source>camera %1
projector %2</source>
        <translation>fotocamera %1
proiettore %2</translation>
    </message>
    <message>
        <source>%1
%2</source>
        <translation>%1
%2</translation>
    </message>
    <message>
        <source>transport</source>
        <translation>trasporto</translation>
    </message>
    <message>
        <source>projector x, y</source>
        <translation>proiettore x, y</translation>
    </message>
    <message>
        <source>projector line</source>
        <translation>linea proiettore</translation>
    </message>
    <message>
        <source>camera x, y</source>
        <translation>fotocamera x, y</translation>
    </message>
    <message>
        <source>camera line</source>
        <translation>linea fotocamera</translation>
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
        <translation>Nome</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Annulla</translation>
    </message>
    <message>
        <source>Type a name.</source>
        <translation>Inserire un nome.</translation>
    </message>
    <message>
        <source>It has this name.</source>
        <translation>Ha già questo nome.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Nights</name>
    <message>
        <source>The venue was as it was measured.</source>
        <translation>Il luogo era come è stato misurato.</translation>
    </message>
    <message>
        <source>Repaired.</source>
        <translation>Riparata.</translation>
    </message>
    <message>
        <source>Something has changed, and no better picture came of a repair.</source>
        <translation>Qualcosa è cambiato e una riparazione non ha dato un’immagine migliore.</translation>
    </message>
    <message>
        <source>%1 dB</source>
        <translation>%1 dB</translation>
    </message>
    <message>
        <source>Photographed</source>
        <translation>Fotografato</translation>
    </message>
    <message>
        <source>Predicted</source>
        <translation>Previsto</translation>
    </message>
    <message>
        <source>Repaired</source>
        <translation>Riparata</translation>
    </message>
    <message>
        <source>Alarm</source>
        <translation>Allarme</translation>
    </message>
    <message>
        <source>Days before the last night</source>
        <translation>Giorni prima dell’ultima notte</translation>
    </message>
    <message>
        <source>Colour error ΔE</source>
        <translation>Errore di colore ΔE</translation>
    </message>
    <message numerus="yes">
        <source>%n night(s).</source>
        <translation>
            <numerusform>%n notte.</numerusform>
            <numerusform>%n notti.</numerusform>
        </translation>
    </message>
    <message>
        <source>Photographed: %1 to %2, last %3.</source>
        <translation>Fotografato: da %1 a %2, l’ultimo %3.</translation>
    </message>
    <message>
        <source>Repairs: %1. Alarms: %2.</source>
        <translation>Riparazioni: %1. Allarmi: %2.</translation>
    </message>
    <message>
        <source>Left out: %1</source>
        <translation>Saltata: %1</translation>
    </message>
    <message>
        <source>Alarm: %1</source>
        <translation>Allarme: %1</translation>
    </message>
    <message numerus="yes">
        <source>%n picture(s) perfected.</source>
        <translation>
            <numerusform>%n immagine perfezionata.</numerusform>
            <numerusform>%n immagini perfezionate.</numerusform>
        </translation>
    </message>
    <message>
        <source>Photographed: %1, predicted: %2.</source>
        <translation>Fotografato: %1, previsto: %2.</translation>
    </message>
    <message>
        <source>Nobody was told: %1</source>
        <translation>Nessuno è stato avvisato: %1</translation>
    </message>
    <message>
        <source>Quality, dB</source>
        <translation>Qualità, dB</translation>
    </message>
</context>
<context>
    <name>relucent::gui::NightsDialog</name>
    <message>
        <source>Quality over weeks</source>
        <translation>Qualità nelle settimane</translation>
    </message>
    <message>
        <source>Colour error</source>
        <translation>Errore di colore</translation>
    </message>
    <message>
        <source>What the photograph of each night&apos;s proof came to, beside what was predicted.</source>
        <translation>Il risultato della foto di verifica di ogni notte, accanto a quanto previsto.</translation>
    </message>
    <message>
        <source>Quality of the picture, night by night</source>
        <translation>Qualità dell’immagine, notte per notte</translation>
    </message>
    <message>
        <source>What came of each night, the last one first</source>
        <translation>L’esito di ogni notte, l’ultima per prima</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Chiudi</translation>
    </message>
    <message>
        <source>Quality</source>
        <translation>Qualità</translation>
    </message>
    <message>
        <source>Colour error: CIEDE2000, less is better. Quality: peak signal-to-noise ratio, PSNR, in dB; more is better.</source>
        <translation>Errore di colore: CIEDE2000, meno è meglio. Qualità: rapporto segnale-rumore di picco, PSNR, in dB; più è meglio.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::NightsPart</name>
    <message>
        <source>Every night</source>
        <translation>Ogni notte</translation>
    </message>
    <message>
        <source>Quality over weeks</source>
        <translation>Qualità nelle settimane</translation>
    </message>
    <message>
        <source>A chart of all nights, and what came of each.</source>
        <translation>Un grafico di tutte le notti e l’esito di ciascuna.</translation>
    </message>
    <message>
        <source>There was no night yet</source>
        <translation>Non c’è ancora stata nessuna notte</translation>
    </message>
    <message>
        <source>Somebody has to look, %1</source>
        <translation>Qualcuno deve controllare, %1</translation>
    </message>
    <message>
        <source>Left out, %1</source>
        <translation>Saltata, %1</translation>
    </message>
    <message>
        <source>All is well, %1</source>
        <translation>Tutto bene, %1</translation>
    </message>
    <message>
        <source>Look after the picture</source>
        <translation>Curare l’immagine</translation>
    </message>
    <message>
        <source>never</source>
        <translation>mai</translation>
    </message>
    <message>
        <source>at %1</source>
        <translation>alle %1</translation>
    </message>
    <message>
        <source>A show can look after the picture by itself at night: it checks, repairs, perfects and proves, and tells here what came of it. Its camera has to stay where it is.</source>
        <translation>Uno show può prendersi cura da solo dell’immagine di notte: controlla, ripara, perfeziona e dimostra, e dice qui l’esito. La sua telecamera deve restare dov’è.</translation>
    </message>
    <message>
        <source>No show of a rehearsal is looked after.</source>
        <translation>Lo show di una prova non viene curato.</translation>
    </message>
    <message>
        <source>The installed show has its first one at %1, if it plays by then. Its camera has to stay where it is.</source>
        <translation>Lo show installato ha la prima alle %1, se per allora è in corso. La sua fotocamera deve restare dov’è.</translation>
    </message>
    <message>
        <source>A night is under way</source>
        <translation>Una notte è in corso</translation>
    </message>
    <message>
        <source>The show makes way while its picture is looked after. What comes of it is told here.</source>
        <translation>Lo show fa posto mentre ci si occupa della sua immagine. L’esito verrà indicato qui.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::NudgeDialog</name>
    <message>
        <source>fits</source>
        <translation>a posto</translation>
    </message>
    <message>
        <source>Turn the camera to the right and down.</source>
        <translation>Ruotare la fotocamera a destra e in basso.</translation>
    </message>
    <message>
        <source>Turn the camera to the right and up.</source>
        <translation>Ruotare la fotocamera a destra e in alto.</translation>
    </message>
    <message>
        <source>Turn the camera to the left and down.</source>
        <translation>Ruotare la fotocamera a sinistra e in basso.</translation>
    </message>
    <message>
        <source>Turn the camera to the left and up.</source>
        <translation>Ruotare la fotocamera a sinistra e in alto.</translation>
    </message>
    <message>
        <source>Turn the camera to the right.</source>
        <translation>Ruotare la fotocamera a destra.</translation>
    </message>
    <message>
        <source>Turn the camera to the left.</source>
        <translation>Ruotare la fotocamera a sinistra.</translation>
    </message>
    <message>
        <source>Turn the camera down.</source>
        <translation>Ruotare la fotocamera in basso.</translation>
    </message>
    <message>
        <source>Turn the camera up.</source>
        <translation>Ruotare la fotocamera in alto.</translation>
    </message>
    <message>
        <source>Tilt the camera clockwise.</source>
        <translation>Inclinare la fotocamera in senso orario.</translation>
    </message>
    <message>
        <source>Tilt the camera anticlockwise.</source>
        <translation>Inclinare la fotocamera in senso antiorario.</translation>
    </message>
    <message>
        <source>What the camera saw, and what it sees now</source>
        <translation>Ciò che la fotocamera vedeva e ciò che vede ora</translation>
    </message>
    <message>
        <source>The projector shows full light. Left of the line stands what the camera saw when the venue was measured, right of it what it sees now.</source>
        <translation>Il proiettore mostra luce piena. A sinistra della linea c’è ciò che la fotocamera vedeva durante la misurazione, a destra ciò che vede ora.</translation>
    </message>
    <message>
        <source>Sideways</source>
        <translation>Di lato</translation>
    </message>
    <message>
        <source>Up and down</source>
        <translation>Su e giù</translation>
    </message>
    <message>
        <source>Tilt</source>
        <translation>Inclinazione</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Chiudi</translation>
    </message>
    <message>
        <source>Opening the devices</source>
        <translation>Apertura dei dispositivi</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Misurato</translation>
    </message>
    <message>
        <source>Now</source>
        <translation>Ora</translation>
    </message>
    <message>
        <source>%1 px to the right</source>
        <translation>%1 px a destra</translation>
    </message>
    <message>
        <source>%1 px to the left</source>
        <translation>%1 px a sinistra</translation>
    </message>
    <message>
        <source>%1 px down</source>
        <translation>%1 px in basso</translation>
    </message>
    <message>
        <source>%1 px up</source>
        <translation>%1 px in alto</translation>
    </message>
    <message>
        <source>%1°</source>
        <translation>%1°</translation>
    </message>
    <message>
        <source>Looking through the camera</source>
        <translation>Osservazione con la fotocamera</translation>
    </message>
    <message>
        <source>The camera looks where it looked.</source>
        <translation>La fotocamera guarda dove guardava.</translation>
    </message>
    <message>
        <source>Fasten it, look once more, and close this window.</source>
        <translation>Fissarla, guardare ancora una volta e chiudere questa finestra.</translation>
    </message>
    <message>
        <source>The arrow shows where. If the projector was bumped instead, move its picture the other way.</source>
        <translation>La freccia indica dove. Se invece è stato urtato il proiettore, spostarne l’immagine nell’altro verso.</translation>
    </message>
    <message>
        <source>What is seen is not the view that was measured.</source>
        <translation>Ciò che si vede non è la vista che è stata misurata.</translation>
    </message>
    <message>
        <source>Turn the camera until both halves look alike. If they do, the light or the surface has changed.</source>
        <translation>Ruotare la fotocamera finché le due metà si somigliano. Se si somigliano già, è cambiata la luce o la superficie.</translation>
    </message>
    <message>
        <source>Put the camera back</source>
        <translation>Rimetti a posto la fotocamera</translation>
    </message>
    <message>
        <source>In a rehearsal it comes back by itself while you look.</source>
        <translation>In una prova torna da sola mentre si guarda.</translation>
    </message>
    <message>
        <source>%1° clockwise</source>
        <translation>%1° in senso orario</translation>
    </message>
    <message>
        <source>%1° anticlockwise</source>
        <translation>%1° in senso antiorario</translation>
    </message>
    <message>
        <source>If the projector was bumped instead, move its picture the other way.</source>
        <translation>Se è stato urtato il proiettore, spostare la sua immagine nel senso opposto.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputPage</name>
    <message>
        <source>Projector&apos;s screen</source>
        <translation>Schermo del proiettore</translation>
    </message>
    <message>
        <source>This screen</source>
        <translation>Questo schermo</translation>
    </message>
    <message>
        <source>%1: measured ΔE %2, predicted %3</source>
        <translation>%1: ΔE misurato %2, previsto %3</translation>
    </message>
    <message>
        <source>Not photographed yet</source>
        <translation>Ancora nessuna foto</translation>
    </message>
    <message>
        <source>One photograph shows whether the surface looks as predicted.</source>
        <translation>Una foto mostra se la superficie appare come previsto.</translation>
    </message>
    <message>
        <source>Corrected</source>
        <translation>Corretta</translation>
    </message>
    <message>
        <source>Original</source>
        <translation>Originale</translation>
    </message>
    <message>
        <source>%1 of the picture can be reached.</source>
        <translation>%1 dell’immagine è raggiungibile.</translation>
    </message>
    <message>
        <source>The surface looks as predicted</source>
        <translation>La superficie appare come previsto</translation>
    </message>
    <message>
        <source>The camera or projector may have moved.</source>
        <translation>Fotocamera o proiettore potrebbero essersi spostati.</translation>
    </message>
    <message>
        <source>Error of the test patterns: %1, when measured %2. %3 of the view changed.</source>
        <translation>Errore dei pattern di test: %1, alla misura %2. %3 dell’inquadratura è cambiato.</translation>
    </message>
    <message>
        <source>The measurement still holds</source>
        <translation>La misura è ancora valida</translation>
    </message>
    <message>
        <source>Verification</source>
        <translation>Verifica</translation>
    </message>
    <message>
        <source>Take verification photograph</source>
        <translation>Scatta foto di verifica</translation>
    </message>
    <message>
        <source>Ctrl+Shift+V</source>
        <translation>Ctrl+Shift+V</translation>
    </message>
    <message>
        <source>Check for drift</source>
        <translation>Controlla deriva</translation>
    </message>
    <message>
        <source>Photographs the test patterns of the measurement again, ten or so.</source>
        <translation>Fotografa di nuovo una decina di pattern di test della misura.</translation>
    </message>
    <message>
        <source>Hand over</source>
        <translation>Consegna</translation>
    </message>
    <message>
        <source>Save report</source>
        <translation>Salva rapporto</translation>
    </message>
    <message>
        <source>Installed. The show starts at the next log-in, without camera or wizard.</source>
        <translation>Installato. Lo show parte al prossimo accesso, senza fotocamera né procedura guidata.</translation>
    </message>
    <message>
        <source>Playlist</source>
        <translation>Playlist</translation>
    </message>
    <message>
        <source>The picture stands in its middle, pixel for pixel.</source>
        <translation>L’immagine sta al centro, pixel per pixel.</translation>
    </message>
    <message>
        <source>Still pictures: %1</source>
        <translation>Immagini fisse: %1</translation>
    </message>
    <message>
        <source>Films and cross-fades use windows and steps, which are quick enough.</source>
        <translation>Video e dissolvenze usano finestre e passi, abbastanza veloci.</translation>
    </message>
    <message>
        <source>Make the list again.</source>
        <translation>Ricreare la playlist.</translation>
    </message>
    <message>
        <source>Black</source>
        <translation>Nero</translation>
    </message>
    <message>
        <source>Frozen</source>
        <translation>Congelata</translation>
    </message>
    <message>
        <source>Playing</source>
        <translation>In riproduzione</translation>
    </message>
    <message>
        <source>Add a picture or a film to the playlist.</source>
        <translation>Aggiungere un’immagine o un video alla playlist.</translation>
    </message>
    <message>
        <source>Choose the projector&apos;s screen.</source>
        <translation>Scegliere lo schermo del proiettore.</translation>
    </message>
    <message>
        <source>Playing. Hold A to compare.</source>
        <translation>In riproduzione. Tenere premuto A per confrontare.</translation>
    </message>
    <message>
        <source>Take a verification photograph, or install without proof.</source>
        <translation>Scattare una foto di verifica o installare senza verifica.</translation>
    </message>
    <message>
        <source>Nothing is projected before you open the output.</source>
        <translation>Nulla viene proiettato prima di aprire l’uscita.</translation>
    </message>
    <message>
        <source>Install show</source>
        <translation>Installa show</translation>
    </message>
    <message>
        <source>Install without proof</source>
        <translation>Installa senza verifica</translation>
    </message>
    <message>
        <source>Open output</source>
        <translation>Apri uscita</translation>
    </message>
    <message>
        <source>Play</source>
        <translation>Riproduci</translation>
    </message>
    <message>
        <source>Freeze</source>
        <translation>Congela</translation>
    </message>
    <message>
        <source>Show again</source>
        <translation>Mostra di nuovo</translation>
    </message>
    <message>
        <source>Close output</source>
        <translation>Chiudi uscita</translation>
    </message>
    <message>
        <source>Add to the playlist</source>
        <translation>Aggiungi alla playlist</translation>
    </message>
    <message>
        <source>Remove from the playlist</source>
        <translation>Rimuovi dalla playlist</translation>
    </message>
    <message>
        <source>Order of the playlist</source>
        <translation>Ordine della playlist</translation>
    </message>
    <message>
        <source>Repeat</source>
        <translation>Ripeti</translation>
    </message>
    <message>
        <source>Cross-fade</source>
        <translation>Dissolvenza</translation>
    </message>
    <message>
        <source>The calibration is as it was.</source>
        <translation>La calibrazione è rimasta com’era.</translation>
    </message>
    <message>
        <source>Output</source>
        <translation>Uscita</translation>
    </message>
    <message>
        <source>Play corrected content, prove that it works with one photograph, and hand the venue over.</source>
        <translation>Riprodurre il contenuto con la correzione, verificarla con una foto e consegnare il luogo.</translation>
    </message>
    <message>
        <source>Playback</source>
        <translation>Riproduzione</translation>
    </message>
    <message>
        <source>frames a second</source>
        <translation>fotogrammi/s</translation>
    </message>
    <message>
        <source>frame time</source>
        <translation>per fotogramma</translation>
    </message>
    <message>
        <source>frames late</source>
        <translation>in ritardo</translation>
    </message>
    <message>
        <source>Seconds</source>
        <translation>Secondi</translation>
    </message>
    <message>
        <source>Frame time, ms</source>
        <translation>Tempo per fotogramma, ms</translation>
    </message>
    <message>
        <source>Frame times of the last minute</source>
        <translation>Tempi per fotogramma dell’ultimo minuto</translation>
    </message>
    <message>
        <source>%1 ms</source>
        <translation>%1 ms</translation>
    </message>
    <message>
        <source>closed</source>
        <translation>chiusa</translation>
    </message>
    <message>
        <source>on %1</source>
        <translation>su %1</translation>
    </message>
    <message>
        <source>still picture, on %1</source>
        <translation>immagine fissa, su %1</translation>
    </message>
    <message>
        <source>On the projector now</source>
        <translation>Ora sul proiettore</translation>
    </message>
    <message>
        <source>What the projector shows</source>
        <translation>Ciò che mostra il proiettore</translation>
    </message>
    <message>
        <source>Photograph of the surface</source>
        <translation>Foto della superficie</translation>
    </message>
    <message>
        <source>What was wanted at the left of the divider, the photograph at the right</source>
        <translation>A sinistra del divisore il desiderato, a destra la foto</translation>
    </message>
    <message>
        <source>No verification photograph has been taken.</source>
        <translation>Nessuna foto di verifica scattata.</translation>
    </message>
    <message>
        <source>Photograph against wanted</source>
        <translation>Foto e desiderato</translation>
    </message>
    <message>
        <source>colour difference</source>
        <translation>differenza di colore</translation>
    </message>
    <message>
        <source>Colour difference between the photograph and what was wanted</source>
        <translation>Differenza di colore tra la foto e il desiderato</translation>
    </message>
    <message>
        <source>A verification photograph shows here what is left to see.</source>
        <translation>Una foto di verifica mostra qui l’errore ancora visibile.</translation>
    </message>
    <message>
        <source>taken %1</source>
        <translation>scattata alle %1</translation>
    </message>
    <message>
        <source>Wanted</source>
        <translation>Desiderato</translation>
    </message>
    <message>
        <source>Photograph</source>
        <translation>Foto</translation>
    </message>
    <message>
        <source>Delete removes an item, Ctrl+Up and Ctrl+Down move it. Files can be dropped here.</source>
        <translation>Canc rimuove un elemento, Ctrl+Su e Ctrl+Giù lo spostano. I file si possono trascinare qui.</translation>
    </message>
    <message>
        <source>%1, playing</source>
        <translation>%1, in riproduzione</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Aggiungi</translation>
    </message>
    <message>
        <source>Add files to the playlist</source>
        <translation>Aggiungi file alla playlist</translation>
    </message>
    <message>
        <source>Move up</source>
        <translation>Sposta su</translation>
    </message>
    <message>
        <source>Move down</source>
        <translation>Sposta giù</translation>
    </message>
    <message>
        <source>Cross-fade, tenths of a second</source>
        <translation>Dissolvenza, decimi di secondo</translation>
    </message>
    <message>
        <source>Add pictures or films</source>
        <translation>Aggiungi immagini o video</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>Skipped: %1</source>
        <translation>Saltato: %1</translation>
    </message>
    <message>
        <source>This screen&apos;s resolution is not that of the projector that was measured.</source>
        <translation>La risoluzione di questo schermo non è quella del proiettore misurato.</translation>
    </message>
    <message>
        <source>Written to %1, and for paper to report.pdf beside it.</source>
        <translation>Scritto in %1 e, per la carta, in report.pdf accanto.</translation>
    </message>
    <message>
        <source>The projector is another screen now</source>
        <translation>Il proiettore ora è un altro schermo</translation>
    </message>
    <message>
        <source>Show installed</source>
        <translation>Show installato</translation>
    </message>
    <message>
        <source>Installed at %1: the show starts at the next log-in. Hold A to compare.</source>
        <translation>Installato alle %1: lo show parte al prossimo accesso. Tenere premuto A per confrontare.</translation>
    </message>
    <message>
        <source>The output will cover this window. Esc closes the output.</source>
        <translation>L’uscita coprirà questa finestra. Esc chiude l’uscita.</translation>
    </message>
    <message>
        <source>Install again</source>
        <translation>Installa di nuovo</translation>
    </message>
    <message>
        <source>The projector&apos;s screen %1 is not there. Plug it in, or choose another.</source>
        <translation>Lo schermo %1 del proiettore non c’è. Collegarlo o sceglierne un altro.</translation>
    </message>
    <message>
        <source>Choose a screen for projector %1.</source>
        <translation>Scegliere uno schermo per il proiettore %1.</translation>
    </message>
    <message numerus="yes">
        <source>Each of the %n projector(s) needs a screen of its own. Plug in another one.</source>
        <translation>
            <numerusform>Il proiettore richiede uno schermo proprio. Collegarne uno.</numerusform>
            <numerusform>Ciascuno dei %n proiettori richiede uno schermo proprio. Collegarne un altro.</numerusform>
        </translation>
    </message>
    <message>
        <source>There is one screen only. Plug the projector in and extend the desktop to it, or choose this screen.</source>
        <translation>C’è un solo schermo. Collegare il proiettore ed estendervi il desktop, oppure scegliere questo schermo.</translation>
    </message>
    <message>
        <source>still picture, %1 of the pixels at their limit</source>
        <translation>immagine fissa, %1 dei pixel al limite</translation>
    </message>
    <message>
        <source>%1 fps, %2 ms, %3 of the pixels at their limit</source>
        <translation>%1 fps, %2 ms, %3 dei pixel al limite</translation>
    </message>
    <message>
        <source>Screen unplugged</source>
        <translation>Schermo scollegato</translation>
    </message>
    <message>
        <source>The surface does not look as predicted. Find out whether something moved.</source>
        <translation>La superficie non appare come previsto. Verificare se qualcosa si è mosso.</translation>
    </message>
    <message>
        <source>Something has changed since it was measured. Measure again, then install.</source>
        <translation>Qualcosa è cambiato dalla misura. Misurare di nuovo, poi installare.</translation>
    </message>
    <message>
        <source>Install anyway</source>
        <translation>Installa comunque</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>Misura di nuovo</translation>
    </message>
    <message>
        <source>Aim again</source>
        <translation>Punta di nuovo</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged</source>
        <translation>Lo schermo del proiettore è scollegato</translation>
    </message>
    <message>
        <source>Nothing is lost. Plug it in again: the show comes back by itself.</source>
        <translation>Nulla è perduto. Ricollegarlo: lo show torna da solo.</translation>
    </message>
    <message>
        <source>The camera&apos;s view has moved by %1 px sideways and %2 px up or down.</source>
        <translation>La vista della fotocamera si è spostata di %1 px di lato e %2 px in altezza.</translation>
    </message>
    <message>
        <source>Shows full light, and where the camera has to be turned to look where it looked.</source>
        <translation>Mostra luce piena e dove ruotare la fotocamera perché guardi dove guardava.</translation>
    </message>
    <message>
        <source>Limit for %1 frames a second: %2 ms</source>
        <translation>Limite per %1 immagini al secondo: %2 ms</translation>
    </message>
    <message>
        <source>the processor</source>
        <translation>il processore</translation>
    </message>
    <message>
        <source>Next test chart (T)</source>
        <translation>Prossima carta di test (T)</translation>
    </message>
    <message>
        <source>Figures over the picture (O)</source>
        <translation>Cifre sull’immagine (O)</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>I dispositivi sono in uso nel passo %1.</translation>
    </message>
    <message>
        <source>Put the camera back</source>
        <translation>Rimetti a posto la fotocamera</translation>
    </message>
    <message>
        <source>On this page only</source>
        <translation>Solo su questa pagina</translation>
    </message>
    <message>
        <source>The photograph is out of date</source>
        <translation>La foto non è aggiornata</translation>
    </message>
    <message>
        <source>Another venue&apos;s show starts at log-in. Installing this one replaces it.</source>
        <translation>Lo show di un altro luogo parte all’accesso. Installare questo lo sostituisce.</translation>
    </message>
    <message>
        <source>Another venue&apos;s show starts at log-in. This is a rehearsal, which is not installed.</source>
        <translation>Lo show di un altro luogo parte all’accesso. Questa è una prova, che non si installa.</translation>
    </message>
    <message>
        <source>Once installed, the show starts at every log-in, without camera or wizard.</source>
        <translation>Una volta installato, lo show parte a ogni accesso, senza fotocamera né procedura guidata.</translation>
    </message>
    <message>
        <source>This is a rehearsal with simulated devices: its show is not installed. That of a real venue starts at every log-in.</source>
        <translation>Questa è una prova con dispositivi simulati: il suo show non si installa. Quello di un luogo reale parte a ogni accesso.</translation>
    </message>
    <message>
        <source>Remove installed show</source>
        <translation>Rimuovi lo show installato</translation>
    </message>
    <message>
        <source>It does not start at log-in any more. Venue and playlist stay.</source>
        <translation>Non parte più all’accesso. Luogo ed elenco restano.</translation>
    </message>
    <message>
        <source>Proof out of date</source>
        <translation>Verifica da aggiornare</translation>
    </message>
    <message>
        <source>Take a verification photograph: it proves that the venue is measured well.</source>
        <translation>Scattare una foto di verifica: dimostra che il luogo è misurato bene.</translation>
    </message>
    <message>
        <source>This rehearsal plays on this page only: nothing is projected.</source>
        <translation>Questa prova gira solo su questa pagina: nulla viene proiettato.</translation>
    </message>
    <message>
        <source>Black: the show goes on unseen until you show it again.</source>
        <translation>Nero: lo show prosegue non visto finché non lo si mostra di nuovo.</translation>
    </message>
    <message>
        <source>Frozen: this picture stands until you press Play.</source>
        <translation>Congelata: questa immagine resta finché non si preme Riproduci.</translation>
    </message>
    <message>
        <source>Rehearsed to the end. A simulated venue is not installed. Hold A to compare.</source>
        <translation>Provato fino in fondo. Un luogo simulato non si installa. Tenere premuto A per confrontare.</translation>
    </message>
    <message>
        <source>The verification photograph is out of date</source>
        <translation>La foto di verifica non è aggiornata</translation>
    </message>
    <message>
        <source>taken %1, out of date</source>
        <translation>scattata alle %1, da aggiornare</translation>
    </message>
    <message>
        <source>No screen chosen</source>
        <translation>Nessuno schermo scelto</translation>
    </message>
    <message>
        <source>%1, unplugged</source>
        <translation>%1, scollegato</translation>
    </message>
    <message>
        <source>Not to be proved yet</source>
        <translation>Ancora da non verificare</translation>
    </message>
    <message>
        <source>What it was taken of has been measured or chosen anew since, or is another set. Take it again to prove what is shown now.</source>
        <translation>Ciò che mostra è stato nel frattempo misurato o scelto di nuovo, o è un’altra variante. Scattarla ancora per verificare ciò che si vede ora.</translation>
    </message>
    <message>
        <source>As predicted, but errors are plain to see</source>
        <translation>Come previsto, ma gli errori si vedono chiaramente</translation>
    </message>
    <message>
        <source>Nothing has moved: the prediction itself is coarse. Measuring finer or darker content helps.</source>
        <translation>Nulla si è spostato: la previsione stessa è grossolana. Aiutano una misura più fine o contenuti più scuri.</translation>
    </message>
    <message>
        <source>Waiting for the projector&apos;s screen to come back.</source>
        <translation>In attesa che torni lo schermo del proiettore.</translation>
    </message>
    <message>
        <source>What plays is not what was measured or chosen last. Show that first.</source>
        <translation>Ciò che si vede non è quanto misurato o scelto per ultimo. Mostrarlo prima.</translation>
    </message>
    <message>
        <source>Look at it first</source>
        <translation>Guardarla prima</translation>
    </message>
    <message>
        <source>What was measured or chosen since is not on the projector yet.</source>
        <translation>Ciò che è stato misurato o scelto dopo non è ancora sul proiettore.</translation>
    </message>
    <message>
        <source>What was measured or chosen since is not on the projector yet. Steps that are out of date count with what was chosen there before.</source>
        <translation>Ciò che è stato misurato o scelto dopo non è ancora sul proiettore. I passi non aggiornati valgono come scelti prima.</translation>
    </message>
    <message>
        <source>The screen %1 is unplugged. Nothing is projected.</source>
        <translation>Lo schermo %1 è scollegato. Nulla viene proiettato.</translation>
    </message>
    <message>
        <source>Camera %1: %2, as predicted</source>
        <translation>Fotocamera %1: %2, come previsto</translation>
    </message>
    <message>
        <source>Camera %1: %2, not as predicted</source>
        <translation>Fotocamera %1: %2, non come previsto</translation>
    </message>
    <message>
        <source>The view of camera %3 has moved by %1 px sideways and %2 px up or down.</source>
        <translation>La vista della fotocamera %3 si è spostata di %1 px di lato e %2 px in verticale.</translation>
    </message>
    <message>
        <source>Camera %1 or a projector may have moved.</source>
        <translation>La fotocamera %1 o un proiettore può essersi mosso.</translation>
    </message>
    <message>
        <source>Something has changed. Repair the calibration.</source>
        <translation>Qualcosa è cambiato. Riparare la calibrazione.</translation>
    </message>
    <message>
        <source>Something has changed since it was measured. Repair the calibration: only that is measured again.</source>
        <translation>Qualcosa è cambiato dalla misura. Riparare la calibrazione: solo questo viene misurato di nuovo.</translation>
    </message>
    <message>
        <source>Repair the calibration</source>
        <translation>Ripara la calibrazione</translation>
    </message>
    <message>
        <source>Nothing to repair</source>
        <translation>Niente da riparare</translation>
    </message>
    <message>
        <source>The venue is as it was measured.</source>
        <translation>Il luogo è come è stato misurato.</translation>
    </message>
    <message>
        <source>Not repaired</source>
        <translation>Non riparata</translation>
    </message>
    <message>
        <source>No better picture came of it: the measurement is used as before.</source>
        <translation>L’immagine non è migliorata: la misura si usa come prima.</translation>
    </message>
    <message>
        <source>Repaired, %1</source>
        <translation>Riparata, %1</translation>
    </message>
    <message>
        <source>Colour error of a photographed picture: %1 before, %2 now.</source>
        <translation>Errore di colore di un’immagine fotografata: prima %1, ora %2.</translation>
    </message>
    <message>
        <source>Finds what has changed, measures only that again, and keeps it if a photograph of the picture is better by it.</source>
        <translation>Trova ciò che è cambiato, misura di nuovo solo questo e lo mantiene se una fotografia dell’immagine ne risulta migliore.</translation>
    </message>
    <message>
        <source>Use the measurement before</source>
        <translation>Usa la misura precedente</translation>
    </message>
    <message>
        <source>Takes the repair back.</source>
        <translation>Annulla la riparazione.</translation>
    </message>
    <message>
        <source>arrival to light</source>
        <translation>dall’arrivo alla luce</translation>
    </message>
    <message>
        <source>From a live picture&apos;s arrival at this computer until the projectors have it: the longest of the last five seconds. The way there is not in it.</source>
        <translation>Dall’arrivo di un’immagine dal vivo a questo computer finché i proiettori la ricevono: il massimo degli ultimi cinque secondi. Il percorso fin qui non è compreso.</translation>
    </message>
    <message>
        <source>Connecting to %1</source>
        <translation>Connessione a %1</translation>
    </message>
    <message>
        <source>Lost: %1. %2</source>
        <translation>Perso: %1. %2</translation>
    </message>
    <message>
        <source>Add a stream</source>
        <translation>Aggiungi un flusso</translation>
    </message>
    <message>
        <source>A live picture from the network, as cameras and encoders send it.</source>
        <translation>Un’immagine dal vivo dalla rete, come la inviano telecamere e codificatori.</translation>
    </message>
    <message>
        <source>Nothing has moved: of the light only %1 is kept at Threshold, so that bounces are missing, in the prediction too. Keep more of it.</source>
        <translation>Nulla si è mosso: alla soglia resta solo il %1 della luce, così che mancano riflessi, anche nella previsione. Conservarne di più.</translation>
    </message>
    <message>
        <source>The show of another venue will no longer start at log-in.</source>
        <translation>Lo show di un altro luogo non partirà più all’accesso.</translation>
    </message>
    <message>
        <source>The show of this venue will no longer start at log-in.</source>
        <translation>Lo show di questo luogo non partirà più all’accesso.</translation>
    </message>
    <message>
        <source>Venue and playlist stay. It can be installed again from its venue&apos;s Output.</source>
        <translation>Luogo ed elenco restano. Può essere installato di nuovo dall’Uscita del suo luogo.</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Rimuovi</translation>
    </message>
    <message>
        <source>Keep</source>
        <translation>Mantieni</translation>
    </message>
    <message>
        <source>To end it, hold Esc for two seconds at the projector&apos;s screen.</source>
        <translation>Per terminarlo, tenere premuto Esc per due secondi sullo schermo del proiettore.</translation>
    </message>
    <message>
        <source>Test chart</source>
        <translation>Carta di test</translation>
    </message>
    <message>
        <source>A test chart is on the surface. T shows the next one, then the playlist.</source>
        <translation>Sulla superficie c’è una carta di test. T mostra la prossima, poi la playlist.</translation>
    </message>
    <message>
        <source>Show the playlist</source>
        <translation>Mostra la playlist</translation>
    </message>
    <message>
        <source>A test chart is on the surface</source>
        <translation>Sulla superficie c’è una carta di test</translation>
    </message>
    <message>
        <source>The playlist runs on unseen until you show it again.</source>
        <translation>La playlist prosegue non vista finché non la si mostra di nuovo.</translation>
    </message>
    <message>
        <source>Times of sets</source>
        <translation>Orari delle varianti</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>Variante</translation>
    </message>
    <message>
        <source>Times of the day…</source>
        <translation>Orari del giorno…</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1: %2</translation>
    </message>
    <message>
        <source>The installed show plays this one all day.</source>
        <translation>Lo show installato mostra questa per tutto il giorno.</translation>
    </message>
    <message>
        <source>The picture is being perfected.</source>
        <translation>L’immagine è in perfezionamento.</translation>
    </message>
    <message>
        <source>The output is being opened.</source>
        <translation>L’uscita si sta aprendo.</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged.</source>
        <translation>Schermo del proiettore scollegato.</translation>
    </message>
    <message>
        <source>There is nothing else on the list.</source>
        <translation>Nella lista non c’è altro.</translation>
    </message>
    <message>
        <source>The playlist is empty.</source>
        <translation>La playlist è vuota.</translation>
    </message>
    <message>
        <source>There is no other set.</source>
        <translation>Non c’è un’altra variante.</translation>
    </message>
    <message>
        <source>The show changes by itself, here too: %1</source>
        <translation>Lo show cambia da solo, anche qui: %1</translation>
    </message>
    <message>
        <source>Choose in the desktop&apos;s dialog what to show as %1</source>
        <translation>Scegliere nella finestra di dialogo del desktop che cosa mostra %1</translation>
    </message>
    <message>
        <source>Add a screen or window</source>
        <translation>Aggiungi uno schermo o una finestra</translation>
    </message>
    <message>
        <source>The live picture of a screen of this computer, or of a window on it.</source>
        <translation>L’immagine dal vivo di uno schermo di questo computer, o di una finestra su di esso.</translation>
    </message>
    <message>
        <source>A screen, chosen in the desktop&apos;s dialog</source>
        <translation>Uno schermo, scelto nella finestra di dialogo del desktop</translation>
    </message>
    <message>
        <source>A window, chosen in the desktop&apos;s dialog</source>
        <translation>Una finestra, scelta nella finestra di dialogo del desktop</translation>
    </message>
    <message>
        <source>Screen %1</source>
        <translation>Schermo %1</translation>
    </message>
    <message>
        <source>Window %1</source>
        <translation>Finestra %1</translation>
    </message>
    <message>
        <source>There is no desktop whose screens could be shown.</source>
        <translation>Non c’è alcun desktop i cui schermi si possano mostrare.</translation>
    </message>
    <message>
        <source>The camera is back at its place</source>
        <translation>La fotocamera è di nuovo al suo posto</translation>
    </message>
    <message>
        <source>Put the camera back, or repair the calibration.</source>
        <translation>Rimettere a posto la fotocamera o riparare la calibrazione.</translation>
    </message>
    <message>
        <source>Perfecting</source>
        <translation>Perfezionamento</translation>
    </message>
    <message>
        <source>Photographing</source>
        <translation>Scatto in corso</translation>
    </message>
    <message>
        <source>Checking for drift</source>
        <translation>Controllo della deriva</translation>
    </message>
    <message>
        <source>Repairing</source>
        <translation>Riparazione</translation>
    </message>
    <message>
        <source>The output is closed. Patterns to be photographed are projected.</source>
        <translation>L’uscita è chiusa. Si proiettano motivi da fotografare.</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Ferma</translation>
    </message>
    <message>
        <source>Not as predicted</source>
        <translation>Non come previsto</translation>
    </message>
    <message>
        <source>The output is closed. The devices are in use at %1.</source>
        <translation>L’uscita è chiusa. I dispositivi sono in uso nel passo %1.</translation>
    </message>
    <message>
        <source>Show the current correction</source>
        <translation>Mostra la correzione attuale</translation>
    </message>
    <message>
        <source>The projector still shows another correction. Show the current one, then take the photograph.</source>
        <translation>Il proiettore mostra ancora un’altra correzione. Mostrare quella attuale, poi scattare la foto.</translation>
    </message>
    <message>
        <source>Another correction</source>
        <translation>Altra correzione</translation>
    </message>
    <message>
        <source>The camera&apos;s view has moved. Put it back, then photograph again.</source>
        <translation>L’inquadratura si è spostata. Rimettere a posto la fotocamera, poi fotografare di nuovo.</translation>
    </message>
    <message>
        <source>The show still plays another correction</source>
        <translation>Lo show usa ancora un’altra correzione</translation>
    </message>
    <message>
        <source>Another correction plays. Show the current one first.</source>
        <translation>È in riproduzione un’altra correzione. Mostrare prima quella attuale.</translation>
    </message>
    <message>
        <source>Another correction still plays.</source>
        <translation>È ancora in riproduzione un’altra correzione.</translation>
    </message>
    <message>
        <source>Covered by %1</source>
        <translation>Coperto da %1</translation>
    </message>
    <message>
        <source>The projector shows the light of another step: %1</source>
        <translation>Il proiettore mostra la luce di un altro passo: %1</translation>
    </message>
    <message>
        <source>The show goes on behind it, and is seen again when that has ended.</source>
        <translation>Lo show continua dietro e si rivede quando è terminato.</translation>
    </message>
    <message>
        <source>The light of another step is before the show.</source>
        <translation>La luce di un altro passo è davanti allo show.</translation>
    </message>
    <message>
        <source>Time of a picture</source>
        <translation>Durata di un’immagine</translation>
    </message>
    <message>
        <source>%1, skipped</source>
        <translation>%1, saltato</translation>
    </message>
    <message>
        <source>Seconds that the chosen picture stands</source>
        <translation>Secondi per cui resta l’immagine scelta</translation>
    </message>
    <message>
        <source> s</source>
        <translation> s</translation>
    </message>
    <message>
        <source>Picture stands for</source>
        <translation>L’immagine resta per</translation>
    </message>
    <message>
        <source>Photographed %1.</source>
        <translation>Fotografata: %1.</translation>
    </message>
    <message>
        <source>Photographed %1, before the last check for drift.</source>
        <translation>Fotografata: %1, prima dell’ultimo controllo della deriva.</translation>
    </message>
    <message>
        <source>The surface looked as predicted then</source>
        <translation>La superficie appariva allora come previsto</translation>
    </message>
    <message>
        <source>Checked %1.</source>
        <translation>Controllato: %1.</translation>
    </message>
    <message>
        <source>Hold A for the original, Ctrl+P freezes, B makes it black, T shows test charts, O figures.</source>
        <translation>Tenere A per l’originale, Ctrl+P ferma, B rende nero, T mostra carte di test, O cifre.</translation>
    </message>
    <message>
        <source>No program here opens it: open it by hand, or take it to another computer.</source>
        <translation>Nessun programma qui lo apre: aprirlo a mano, o portarlo su un altro computer.</translation>
    </message>
    <message>
        <source>Picture: %1</source>
        <translation>Immagine: %1</translation>
    </message>
    <message>
        <source>The check was ended: the room is not said to be clear</source>
        <translation>Il controllo è stato interrotto: la sala non è più confermata sgombra</translation>
    </message>
    <message>
        <source>It came to no result. Check again when the room is clear.</source>
        <translation>Non ha dato alcun risultato. Controllare di nuovo quando la sala è sgombra.</translation>
    </message>
    <message>
        <source>The repair was ended: the room is not said to be clear</source>
        <translation>La riparazione è stata interrotta: la sala non è più confermata sgombra</translation>
    </message>
    <message>
        <source>The measurement is used as before. Repair again when the room is clear.</source>
        <translation>La misura resta in uso come prima. Riparare di nuovo quando la sala è sgombra.</translation>
    </message>
    <message>
        <source>The output is closed. A picture to be photographed is projected.</source>
        <translation>L’uscita è chiusa. Si proietta un’immagine da fotografare.</translation>
    </message>
    <message>
        <source>The room is brighter by %1 of full light.</source>
        <translation>La sala è più chiara del %1 della luce piena.</translation>
    </message>
    <message>
        <source>The room is darker by %1 of full light.</source>
        <translation>La sala è più scura del %1 della luce piena.</translation>
    </message>
    <message>
        <source>The projector gives %1 of the light that it gave.</source>
        <translation>Il proiettore dà il %1 della luce che dava.</translation>
    </message>
    <message>
        <source>The output is closed. Nothing is projected from here.</source>
        <translation>L’uscita è chiusa. Da qui non si proietta nulla.</translation>
    </message>
    <message>
        <source>A photograph is being taken.</source>
        <translation>Si sta scattando una fotografia.</translation>
    </message>
    <message>
        <source>Slowly, as the room is not said to be clear: nothing flashes.</source>
        <translation>Lentamente, perché la sala non è confermata sgombra: nulla lampeggia.</translation>
    </message>
    <message>
        <source>It plays this playlist with the measurement that is in use by then.</source>
        <translation>Riproduce questa playlist con la misura in uso in quel momento.</translation>
    </message>
    <message>
        <source>The output is closed here. Another program plays a show of this venue.</source>
        <translation>L’uscita è chiusa qui. Un altro programma sta riproducendo uno show di questo luogo.</translation>
    </message>
    <message>
        <source>Hardly anything fits. Put the camera back or repair the calibration; if neither helps, aim and measure again.</source>
        <translation>Quasi nulla corrisponde. Rimettere la fotocamera al suo posto o riparare la calibrazione; se non basta, puntare e misurare di nuovo.</translation>
    </message>
    <message>
        <source>Almost nothing of the projector&apos;s light is seen. Look at the lens and at the projector, then check again.</source>
        <translation>Della luce del proiettore non si vede quasi nulla. Controllare obiettivo e proiettore, poi verificare di nuovo.</translation>
    </message>
    <message>
        <source>Installed. The show starts at the next log-in, without wizard. The camera stays: at night it looks after the picture.</source>
        <translation>Installato. Lo show parte al prossimo accesso, senza procedura guidata. La fotocamera resta: di notte bada all’immagine.</translation>
    </message>
    <message>
        <source>Another program plays</source>
        <translation>Riproduce un altro programma</translation>
    </message>
    <message>
        <source>Hardly anything fits. Put the camera back, repair the calibration, or aim and measure again.</source>
        <translation>Quasi nulla corrisponde. Rimettere la fotocamera al suo posto, riparare la calibrazione, oppure puntare e misurare di nuovo.</translation>
    </message>
    <message>
        <source>Another program plays a show of this venue.</source>
        <translation>Un altro programma sta riproducendo uno show di questo luogo.</translation>
    </message>
    <message>
        <source>The room&apos;s light has changed. Restore it and check again, or repair the calibration.</source>
        <translation>La luce della sala è cambiata. Ripristinarla e verificare di nuovo, oppure riparare la calibrazione.</translation>
    </message>
    <message>
        <source>The camera looks elsewhere</source>
        <translation>La fotocamera guarda altrove</translation>
    </message>
    <message>
        <source>It was left %1 px from where it looked when it was measured. Put it back, or repair the calibration.</source>
        <translation>È rimasta a %1 px da dove guardava durante la misura. Rimetterla al suo posto o riparare la calibrazione.</translation>
    </message>
    <message>
        <source>Put the camera back, or measure again.</source>
        <translation>Rimettere a posto la fotocamera o misurare di nuovo.</translation>
    </message>
    <message>
        <source>Something has changed. Measure again.</source>
        <translation>Qualcosa è cambiato. Misurare di nuovo.</translation>
    </message>
    <message>
        <source>Hardly anything fits. Put the camera back, or aim and measure again.</source>
        <translation>Quasi nulla corrisponde. Rimettere la fotocamera al suo posto, oppure puntare e misurare di nuovo.</translation>
    </message>
    <message>
        <source>Keep the repaired one</source>
        <translation>Tieni la riparata</translation>
    </message>
    <message>
        <source>Use the measurement before?</source>
        <translation>Usare la misura precedente?</translation>
    </message>
    <message>
        <source>What was repaired is measured again if you repair once more.</source>
        <translation>Ciò che è stato riparato viene misurato di nuovo se si ripara un’altra volta.</translation>
    </message>
    <message>
        <source>The measurement from before the repair is used as it was, with all that followed from it.</source>
        <translation>La misura precedente alla riparazione viene usata com’era, con tutto ciò che ne seguiva.</translation>
    </message>
    <message>
        <source>Screen %1, which this plays on</source>
        <translation>Schermo %1, su cui si riproduce</translation>
    </message>
    <message>
        <source>They are larger than predicted. A check for drift tells whether something has moved.</source>
        <translation>Sono maggiori del previsto. Un controllo della deriva mostra se qualcosa si è mosso.</translation>
    </message>
    <message>
        <source>Once installed, the show starts at every log-in, without wizard. The camera stays: at night it looks after the picture.</source>
        <translation>Una volta installato, lo show parte a ogni accesso, senza procedura guidata. La fotocamera resta: di notte si prende cura dell’immagine.</translation>
    </message>
    <message>
        <source>Take a verification photograph. What was found before is not settled.</source>
        <translation>Scattare una foto di verifica. Ciò che è stato trovato prima non è risolto.</translation>
    </message>
    <message>
        <source>The surface did not look as predicted. Open the output: it leads to what helps.</source>
        <translation>La superficie non appariva come previsto. Aprire l’uscita: porta a ciò che aiuta.</translation>
    </message>
    <message>
        <source>Black: the frozen picture stands unseen until you show it again.</source>
        <translation>Nero: l’immagine ferma resta nascosta finché non la si mostra di nuovo.</translation>
    </message>
    <message>
        <source>still picture, perfected by photographs</source>
        <translation>immagine fissa, perfezionata con fotografie</translation>
    </message>
    <message>
        <source>Nothing has moved: part of the picture is out of the projector&apos;s reach, in a shadow, darker than its black or brighter than its white there. Another picture, or another place for it, helps.</source>
        <translation>Nulla si è mosso: parte dell’immagine è fuori dalla portata del proiettore, in un’ombra, più scura del suo nero o più chiara del suo bianco in quel punto. Aiuta un’altra immagine o un’altra posizione.</translation>
    </message>
    <message>
        <source>Errors are plain to see</source>
        <translation>Gli errori si vedono chiaramente</translation>
    </message>
    <message>
        <source>The frozen picture stands unseen until you show it again.</source>
        <translation>L’immagine bloccata resta, non vista, finché non la si mostra di nuovo.</translation>
    </message>
    <message>
        <source>The output is closed here. Another program plays a show of another venue on this projector.</source>
        <translation>L’uscita è chiusa qui. Un altro programma sta riproducendo uno show di un altro luogo su questo proiettore.</translation>
    </message>
    <message>
        <source>Another program plays a show of another venue on this projector.</source>
        <translation>Un altro programma sta riproducendo uno show di un altro luogo su questo proiettore.</translation>
    </message>
    <message>
        <source>Two shows at once</source>
        <translation>Due show insieme</translation>
    </message>
    <message>
        <source>The output is open here and in another program: whose picture is seen is not known. End one.</source>
        <translation>L’uscita è aperta qui e in un altro programma: non si sa quale immagine si veda. Terminarne una.</translation>
    </message>
    <message>
        <source>Perhaps under another program&apos;s picture</source>
        <translation>Forse sotto l’immagine di un altro programma</translation>
    </message>
    <message>
        <source>Black: the test chart stands unseen. T shows the next one, then the playlist.</source>
        <translation>Nero: la carta di test resta, non vista. T mostra la successiva, poi la lista.</translation>
    </message>
    <message>
        <source>Hide the figures</source>
        <translation>Nascondi le cifre</translation>
    </message>
    <message>
        <source>Figures are on the surface</source>
        <translation>Ci sono cifre sulla superficie</translation>
    </message>
    <message>
        <source>Whoever is in the room reads them over the picture.</source>
        <translation>Chi è in sala le legge sopra l’immagine.</translation>
    </message>
    <message>
        <source>Installed as it is. %1</source>
        <translation>Installato così com’è. %1</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the patterns flash.</source>
        <translation>Confermare che la sala è sgombra: i pattern lampeggiano.</translation>
    </message>
    <message>
        <source>No picture has come yet: black</source>
        <translation>Non è ancora arrivata alcuna immagine: nero</translation>
    </message>
    <message>
        <source>The live picture is lost: black</source>
        <translation>L’immagine dal vivo è persa: nero</translation>
    </message>
    <message>
        <source>The live picture is lost: its last one stands</source>
        <translation>L’immagine dal vivo è persa: resta l’ultima</translation>
    </message>
    <message>
        <source>A film plays to its end.</source>
        <translation>Un filmato viene riprodotto fino alla fine.</translation>
    </message>
    <message>
        <source>A part of the surface looks otherwise than predicted, by ΔE %1.</source>
        <translation>Una parte della superficie non appare come previsto: ΔE %1.</translation>
    </message>
    <message>
        <source>Installed, but the show cannot start with what was measured last.</source>
        <translation>Installato, ma lo show non può iniziare con l’ultima misura.</translation>
    </message>
    <message>
        <source>Go on measuring, or use the earlier one, at Acquire.</source>
        <translation>Continuare a misurare o usare quella precedente, in «Acquisizione».</translation>
    </message>
    <message>
        <source>Go on measuring at Acquire.</source>
        <translation>Continuare in «Acquisizione».</translation>
    </message>
    <message>
        <source>What was measured is too coarse to place content. Go on measuring.</source>
        <translation>Ciò che è misurato è troppo grossolano per collocare contenuti. Continuare la misura.</translation>
    </message>
    <message>
        <source>Not all was decided on what is measured now</source>
        <translation>Non tutto è stato deciso sulla misura attuale</translation>
    </message>
    <message>
        <source>Steps that are out of date count with what was chosen there before.</source>
        <translation>I passi non aggiornati valgono come scelti prima.</translation>
    </message>
    <message>
        <source>The test patterns fit, the photograph does not</source>
        <translation>I pattern di prova corrispondono, la foto no</translation>
    </message>
    <message>
        <source>Few patterns can miss a small part. Where another photograph differs, too, a repair looks closer.</source>
        <translation>Pochi pattern possono non vedere una piccola parte. Se anche un’altra foto differisce, una riparazione guarda più da vicino.</translation>
    </message>
    <message>
        <source>This picture was perfected after the photograph.</source>
        <translation>Questa immagine è stata perfezionata dopo la foto.</translation>
    </message>
    <message>
        <source>In the camera&apos;s picture it is %1 from the left and %2 from the top.</source>
        <translation>Nell’immagine della fotocamera è al %1 da sinistra e al %2 dall’alto.</translation>
    </message>
    <message>
        <source>What was found before may have come of that: a photograph shows what is left of it.</source>
        <translation>Ciò che era stato trovato prima può esserne venuto: una foto di verifica mostra che cosa ne resta.</translation>
    </message>
    <message>
        <source>Black. %1</source>
        <translation>Nero. %1</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputPlaylist</name>
    <message>
        <source>Demonstration picture</source>
        <translation>Immagine dimostrativa</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputProjection</name>
    <message>
        <source>Open the output again.</source>
        <translation>Aprire di nuovo l’uscita.</translation>
    </message>
    <message>
        <source>Relucent is projecting</source>
        <translation>Relucent sta proiettando</translation>
    </message>
    <message>
        <source>%1, shown without OpenGL</source>
        <translation>%1, mostrato senza OpenGL</translation>
    </message>
    <message>
        <source>The output goes on as before.</source>
        <translation>L’uscita continua come prima.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputProof</name>
    <message>
        <source>No venue is open.</source>
        <translation>Nessun luogo è aperto.</translation>
    </message>
    <message>
        <source>A photograph is being taken.</source>
        <translation>Si sta scattando una foto.</translation>
    </message>
    <message>
        <source>Drift is being checked.</source>
        <translation>Si sta controllando la deriva.</translation>
    </message>
    <message>
        <source>It is being repaired.</source>
        <translation>Riparazione in corso.</translation>
    </message>
    <message>
        <source>The report is being written.</source>
        <translation>Si sta scrivendo il rapporto.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Perfecting</name>
    <message>
        <source>%1 The picture is shown as before. Try again.</source>
        <translation>%1 L’immagine è mostrata come prima. Riprovare.</translation>
    </message>
    <message>
        <source>The photographs found nothing better. The picture is shown as before.</source>
        <translation>Le fotografie non hanno trovato nulla di meglio. L’immagine è mostrata come prima.</translation>
    </message>
    <message>
        <source>The picture is being perfected</source>
        <translation>Perfezionamento dell’immagine in corso</translation>
    </message>
    <message numerus="yes">
        <source>%n photograph(s) by now. Keep the room as it is.</source>
        <translation>
            <numerusform>%n fotografia finora. Lasciare la sala com’è.</numerusform>
            <numerusform>%n fotografie finora. Lasciare la sala com’è.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1: %2 before, %3 now, by %n photograph(s).</source>
        <translation>
            <numerusform>%1: prima %2, ora %3, con %n fotografia.</numerusform>
            <numerusform>%1: prima %2, ora %3, con %n fotografie.</numerusform>
        </translation>
    </message>
    <message>
        <source>This picture is perfected</source>
        <translation>Questa immagine è perfezionata</translation>
    </message>
    <message>
        <source>The picture is as it was</source>
        <translation>L’immagine è com’era</translation>
    </message>
    <message>
        <source>Not perfected</source>
        <translation>Non perfezionata</translation>
    </message>
    <message>
        <source>A picture that stands can be corrected by photographs of itself, some eight of them. It is kept for this venue, placed as it is now.</source>
        <translation>Un’immagine fissa può essere corretta con fotografie di se stessa, circa otto. Resta per questo luogo, collocata come ora.</translation>
    </message>
    <message>
        <source>Perfect a picture</source>
        <translation>Perfezionare un’immagine</translation>
    </message>
    <message>
        <source>Perfect this picture</source>
        <translation>Perfeziona questa immagine</translation>
    </message>
    <message>
        <source>Stop and keep the best</source>
        <translation>Ferma e tieni il migliore</translation>
    </message>
    <message>
        <source>Show it as before</source>
        <translation>Mostra come prima</translation>
    </message>
    <message>
        <source>What the photographs corrected is dropped.</source>
        <translation>Ciò che le fotografie hanno corretto viene scartato.</translation>
    </message>
    <message>
        <source>Perfect it again</source>
        <translation>Perfeziona di nuovo</translation>
    </message>
    <message>
        <source>No venue is open.</source>
        <translation>Nessun luogo è aperto.</translation>
    </message>
    <message>
        <source>The picture is being perfected.</source>
        <translation>L’immagine è in perfezionamento.</translation>
    </message>
    <message>
        <source>perfected, %1 before, %2 now.</source>
        <translation>perfezionata, prima %1, ora %2.</translation>
    </message>
    <message>
        <source>Tried last, %1: %2</source>
        <translation>Ultimo tentativo, %1: %2</translation>
    </message>
    <message>
        <source>Slowly, as the room is not said to be clear: nothing flashes.</source>
        <translation>Lentamente, perché la sala non è confermata sgombra: nulla lampeggia.</translation>
    </message>
    <message>
        <source>Picture: %1</source>
        <translation>Immagine: %1</translation>
    </message>
    <message>
        <source>Not perfected since it changed</source>
        <translation>Non perfezionata dopo il cambiamento</translation>
    </message>
    <message>
        <source>It was perfected for an earlier measurement, for another set, with other light or masks, or placed otherwise. That is kept, and is of no use now: perfect it once more.</source>
        <translation>È stata perfezionata per una misura precedente, per un’altra variante, con altra luce o altre maschere, o posizionata in altro modo. Resta conservato, ma ora non serve: va perfezionata ancora una volta.</translation>
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
        <translation>Esc torna indietro</translation>
    </message>
</context>
<context>
    <name>relucent::gui::PreviewPage</name>
    <message>
        <source>Demonstration picture</source>
        <translation>Immagine dimostrativa</translation>
    </message>
    <message>
        <source>Content</source>
        <translation>Contenuto</translation>
    </message>
    <message>
        <source>Change</source>
        <translation>Cambia</translation>
    </message>
    <message>
        <source>Whole</source>
        <translation>Adatta</translation>
    </message>
    <message>
        <source>Fill</source>
        <translation>Riempi</translation>
    </message>
    <message>
        <source>Stretch</source>
        <translation>Deforma</translation>
    </message>
    <message>
        <source>Place automatically</source>
        <translation>Posiziona in automatico</translation>
    </message>
    <message>
        <source>In the largest upright rectangle that can be reached</source>
        <translation>Nel più grande rettangolo diritto raggiungibile</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Luce</translation>
    </message>
    <message>
        <source>May stay too dark</source>
        <translation>Può restare troppo scuro</translation>
    </message>
    <message>
        <source>Share of the content that may stay too dark, percent</source>
        <translation>Quota del contenuto che può restare troppo scura, in percento</translation>
    </message>
    <message>
        <source>Lift of the blacks</source>
        <translation>Sollevamento dei neri</translation>
    </message>
    <message>
        <source>Lift of the blacks, percent</source>
        <translation>Sollevamento dei neri, in percento</translation>
    </message>
    <message>
        <source>Reach</source>
        <translation>Raggiungibilità</translation>
    </message>
    <message>
        <source>Can be reached</source>
        <translation>Raggiungibile</translation>
    </message>
    <message>
        <source>Too dark to reach</source>
        <translation>Troppo scuro</translation>
    </message>
    <message>
        <source>Never black enough</source>
        <translation>Mai abbastanza nero</translation>
    </message>
    <message>
        <source>Colour error</source>
        <translation>Errore di colore</translation>
    </message>
    <message>
        <source>Part of the picture gets no light from this projector.</source>
        <translation>Parte dell’immagine non riceve luce da questo proiettore.</translation>
    </message>
    <message>
        <source>A second could fill it.</source>
        <translation>Un secondo proiettore potrebbe coprirla.</translation>
    </message>
    <message>
        <source>Choose a picture</source>
        <translation>Scegli un’immagine</translation>
    </message>
    <message>
        <source>Fit</source>
        <translation>Adattamento</translation>
    </message>
    <message>
        <source>Brightness</source>
        <translation>Luminosità</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>Quanto misurato è al sicuro.</translation>
    </message>
    <message>
        <source>Picture</source>
        <translation>Immagine</translation>
    </message>
    <message>
        <source>The picture of before stays.</source>
        <translation>Resta l’immagine precedente.</translation>
    </message>
    <message>
        <source>Preparing the preview</source>
        <translation>Preparazione dell’anteprima</translation>
    </message>
    <message>
        <source>The corners cross over. Drag them apart.</source>
        <translation>Gli angoli si incrociano. Trascinarli per separarli.</translation>
    </message>
    <message>
        <source>Corners</source>
        <translation>Angoli</translation>
    </message>
    <message>
        <source>Automatic place</source>
        <translation>Posizione automatica</translation>
    </message>
    <message>
        <source>Preparing</source>
        <translation>Preparazione</translation>
    </message>
    <message>
        <source>%1 in reach</source>
        <translation>%1 raggiungibile</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>Da aggiornare</translation>
    </message>
    <message>
        <source>The preview is not prepared.</source>
        <translation>L’anteprima non è preparata.</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>I dispositivi sono in uso nel passo %1.</translation>
    </message>
    <message>
        <source>Predicting</source>
        <translation>Previsione</translation>
    </message>
    <message>
        <source>Predicted from the measurement. Nothing is projected now.</source>
        <translation>Previsto dalla misura. Ora non viene proiettato nulla.</translation>
    </message>
    <message>
        <source>Preview</source>
        <translation>Anteprima</translation>
    </message>
    <message>
        <source>Place the content in the camera&apos;s view and see what the audience will see before you project it.</source>
        <translation>Posizionare il contenuto nell’inquadratura e vedere ciò che vedrà il pubblico, prima di proiettarlo.</translation>
    </message>
    <message>
        <source>Audience view</source>
        <translation>Vista del pubblico</translation>
    </message>
    <message>
        <source>Reachable light</source>
        <translation>Luce raggiungibile</translation>
    </message>
    <message>
        <source>Difference</source>
        <translation>Differenza</translation>
    </message>
    <message>
        <source>What the audience will see, uncorrected at the left of the divider and corrected at the right</source>
        <translation>Ciò che vedrà il pubblico, a sinistra del divisore senza correzione e a destra con correzione</translation>
    </message>
    <message>
        <source>Colour difference between what is wanted and what is predicted</source>
        <translation>Differenza di colore tra il desiderato e il previsto</translation>
    </message>
    <message>
        <source>Methods</source>
        <translation>Metodi</translation>
    </message>
    <message>
        <source>predicted for this content; click one to use it</source>
        <translation>previsti per questo contenuto; clic su uno per usarlo</translation>
    </message>
    <message>
        <source>Comparison of methods</source>
        <translation>Confronto dei metodi</translation>
    </message>
    <message>
        <source>Method</source>
        <translation>Metodo</translation>
    </message>
    <message>
        <source>Notes</source>
        <translation>Note</translation>
    </message>
    <message>
        <source>blind to bounces</source>
        <translation>ignora i rimbalzi</translation>
    </message>
    <message>
        <source>limit of this venue</source>
        <translation>limite di questo luogo</translation>
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
        <translation>Senza correzione</translation>
    </message>
    <message>
        <source>Corrected, predicted</source>
        <translation>Con correzione, prevista</translation>
    </message>
    <message>
        <source>of white</source>
        <translation>del bianco</translation>
    </message>
    <message>
        <source>The larger this share, the brighter the picture, and the more of it stays too dark.</source>
        <translation>Più grande è questa quota, più l’immagine è luminosa e più ne resta troppo scura.</translation>
    </message>
    <message>
        <source>Part of the picture gets no light from any projector.</source>
        <translation>Una parte dell’immagine non riceve luce da alcun proiettore.</translation>
    </message>
    <message>
        <source>Another one could fill it.</source>
        <translation>Un altro potrebbe coprirla.</translation>
    </message>
    <message>
        <source>Go to output</source>
        <translation>Vai all’uscita</translation>
    </message>
    <message>
        <source>under 1 ms</source>
        <translation>meno di 1 ms</translation>
    </message>
    <message>
        <source>Uncorrected, too</source>
        <translation>Anche questo non corretto</translation>
    </message>
    <message>
        <source>What was measured is too coarse to place content. Go on measuring.</source>
        <translation>Ciò che è misurato è troppo grossolano per collocare contenuti. Continuare la misura.</translation>
    </message>
    <message>
        <source>All of it can be reached</source>
        <translation>Tutto è raggiungibile</translation>
    </message>
    <message>
        <source>no note</source>
        <translation>nessuna nota</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged.</source>
        <translation>Lo schermo del proiettore è scollegato.</translation>
    </message>
    <message>
        <source>On the surface now: the corrected picture.</source>
        <translation>Ora sulla superficie: l’immagine corretta.</translation>
    </message>
    <message>
        <source>On the surface now: the uncorrected picture.</source>
        <translation>Ora sulla superficie: l’immagine senza correzione.</translation>
    </message>
    <message>
        <source>Stop shining</source>
        <translation>Interrompi</translation>
    </message>
    <message>
        <source>Shine on surface</source>
        <translation>Proietta sulla superficie</translation>
    </message>
    <message>
        <source>Shows this picture on the surface until you stop it or leave.</source>
        <translation>Mostra questa immagine sulla superficie finché non si ferma o si esce.</translation>
    </message>
    <message>
        <source>Show uncorrected</source>
        <translation>Mostra senza correzione</translation>
    </message>
    <message>
        <source>Show corrected</source>
        <translation>Mostra corretta</translation>
    </message>
    <message>
        <source>There is no preview yet.</source>
        <translation>Non c’è ancora un’anteprima.</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is not there. Plug it in and extend the desktop to it.</source>
        <translation>Lo schermo del proiettore non c’è. Collegarlo ed estendervi il desktop.</translation>
    </message>
    <message>
        <source>The brightest light that can be reached; hatched where the content is out of reach</source>
        <translation>La luce più intensa raggiungibile; tratteggiato dove il contenuto è irraggiungibile</translation>
    </message>
    <message>
        <source>Hatched: %1 cannot be reached</source>
        <translation>Tratteggiato: %1 irraggiungibile</translation>
    </message>
    <message>
        <source>It has been measured again since the content was placed</source>
        <translation>È stato misurato di nuovo da quando il contenuto è stato posizionato</translation>
    </message>
    <message>
        <source>The threshold has been changed since the content was placed</source>
        <translation>La soglia è cambiata da quando il contenuto è stato posizionato</translation>
    </message>
    <message>
        <source>What you see here is predicted anew. Going to the output keeps it.</source>
        <translation>Ciò che si vede qui è previsto di nuovo. Andando all’uscita viene conservato.</translation>
    </message>
    <message>
        <source>Still picture</source>
        <translation>Imm. fissa</translation>
    </message>
    <message>
        <source>How long a still picture takes to be solved, once. Films always play by “All bounces, for films” in the quicker show engine: how fast is said at Cluster.</source>
        <translation>Quanto richiede il calcolo di un’immagine fissa, una volta sola. I video usano sempre «Tutti i rimbalzi, per i video» nel motore più rapido dello show: la velocità è indicata in Cluster.</translation>
    </message>
    <message>
        <source>Of this content, where it can be reached. What Acquire expects is a mean of other pictures: the two may differ by some dB.</source>
        <translation>Di questo contenuto, dove è raggiungibile. Ciò che la misura prevede è una media di altre immagini: i due possono differire di alcuni dB.</translation>
    </message>
    <message>
        <source>blind to light between clusters</source>
        <translation>cieco tra i cluster</translation>
    </message>
    <message>
        <source>recommended</source>
        <translation>consigliato</translation>
    </message>
    <message>
        <source>Compare</source>
        <translation>Confronta</translation>
    </message>
    <message>
        <source>Hide</source>
        <translation>Nascondi</translation>
    </message>
    <message>
        <source>This content comes to %1. Acquire expected %2 on average of three other pictures, by the recommended method.</source>
        <translation>Questo contenuto raggiunge %1. «Acquisizione» prevedeva %2 in media su altre tre immagini, con il metodo consigliato.</translation>
    </message>
    <message>
        <source>Place of a camera</source>
        <translation>Posto di una fotocamera</translation>
    </message>
    <message>
        <source>no content</source>
        <translation>nessun contenuto</translation>
    </message>
    <message>
        <source>%1 dB, ΔE %2</source>
        <translation>%1 dB, ΔE %2</translation>
    </message>
    <message>
        <source>%1, counts %2</source>
        <translation>%1, conta %2</translation>
    </message>
    <message>
        <source>Views</source>
        <translation>Viste</translation>
    </message>
    <message>
        <source>On the surface</source>
        <translation>Sulla superficie</translation>
    </message>
    <message>
        <source>Upright from here</source>
        <translation>Dritto da qui</translation>
    </message>
    <message>
        <source>Weight of this view</source>
        <translation>Peso di questa vista</translation>
    </message>
    <message>
        <source>Weight of the shown view, percent</source>
        <translation>Peso della vista mostrata, percento</translation>
    </message>
    <message>
        <source>For one viewer who moves</source>
        <translation>Per uno spettatore che si muove</translation>
    </message>
    <message>
        <source>Where the viewer stands, from the first camera to the last</source>
        <translation>Dove sta lo spettatore, dalla prima fotocamera all&apos;ultima</translation>
    </message>
    <message>
        <source>Place in this view</source>
        <translation>Posto in questa vista</translation>
    </message>
    <message>
        <source>Weight of a view</source>
        <translation>Peso di una vista</translation>
    </message>
    <message>
        <source>Drag the cameras to where they stand, then move the viewer.</source>
        <translation>Trascinare le fotocamere dove si trovano, poi spostare lo spettatore.</translation>
    </message>
    <message>
        <source>As little as hides where projectors end</source>
        <translation>Il minimo che nasconde i bordi dei proiettori</translation>
    </message>
    <message>
        <source>Place of the viewer</source>
        <translation>Posizione dello spettatore</translation>
    </message>
    <message>
        <source>Contradiction</source>
        <translation>Contraddizione</translation>
    </message>
    <message>
        <source>How much worse a view is because of what the other views ask for</source>
        <translation>Quanto peggiora una vista per ciò che chiedono le altre</translation>
    </message>
    <message>
        <source>Comparing the views</source>
        <translation>Confronto delle viste</translation>
    </message>
    <message>
        <source>Visibly worse because of other views: %1</source>
        <translation>Visibilmente peggio per le altre viste: %1</translation>
    </message>
    <message>
        <source>Visibly worse because of other views</source>
        <translation>Visibilmente peggio per le altre viste</translation>
    </message>
    <message>
        <source>Even</source>
        <translation>Uniforme</translation>
    </message>
    <message>
        <source>One white for all pictures, as bright as most of the surface can show it.</source>
        <translation>Un bianco per tutte le immagini, luminoso quanto la maggior parte della superficie può mostrarlo.</translation>
    </message>
    <message>
        <source>By picture</source>
        <translation>Per immagine</translation>
    </message>
    <message>
        <source>Each picture has the white at which the least of it is lost: dark ones become brighter, bright ones dimmer.</source>
        <translation>Ogni immagine ha il bianco con cui ne va perso il meno: quelle scure diventano più luminose, quelle chiare meno.</translation>
    </message>
    <message>
        <source>By region</source>
        <translation>Per zona</translation>
    </message>
    <message>
        <source>The same for each part of the picture, smoothly from one to the next: the least is lost of all.</source>
        <translation>Lo stesso per ogni parte dell’immagine, con passaggi graduali: è così che va perso il meno.</translation>
    </message>
    <message>
        <source>How bright white is</source>
        <translation>Quanto è luminoso il bianco</translation>
    </message>
    <message>
        <source>The picture is shown as before.</source>
        <translation>L’immagine è mostrata come prima.</translation>
    </message>
    <message>
        <source>Bright</source>
        <translation>Luminoso</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show are as bright as can be: white on a yellow wall turns yellow.</source>
        <translation>I colori che la superficie non può mostrare sono il più luminosi possibile: il bianco su una parete gialla diventa giallo.</translation>
    </message>
    <message>
        <source>Between</source>
        <translation>Intermedio</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show become somewhat dimmer and shift less.</source>
        <translation>I colori che la superficie non può mostrare diventano un po’ più scuri e cambiano meno.</translation>
    </message>
    <message>
        <source>True</source>
        <translation>Fedele</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show are dimmed until their hue is right: for faces and logos.</source>
        <translation>I colori che la superficie non può mostrare vengono scuriti finché la tonalità è giusta: per volti e loghi.</translation>
    </message>
    <message>
        <source>Colours out of reach</source>
        <translation>Colori fuori portata</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show</source>
        <translation>Colori che la superficie non può mostrare</translation>
    </message>
    <message>
        <source>Uncertainty</source>
        <translation>Incertezza</translation>
    </message>
    <message>
        <source>95 of 100 pixels come within this of what is predicted, in percent of white. More photographs or longer exposures make it smaller.</source>
        <translation>95 pixel su 100 si scostano al massimo di tanto da quanto previsto, in percentuale del bianco. Più foto o esposizioni più lunghe la riducono.</translation>
    </message>
    <message>
        <source>How far the light may be from what is predicted, by the measurement&apos;s noise</source>
        <translation>Quanto la luce può scostarsi da quanto previsto per il rumore della misura</translation>
    </message>
    <message>
        <source>95 of 100 pixels come within the value shown, on average %1 of white</source>
        <translation>95 pixel su 100 restano entro il valore mostrato, in media %1 del bianco</translation>
    </message>
    <message>
        <source>Quality</source>
        <translation>Qualità</translation>
    </message>
    <message>
        <source>Detail kept</source>
        <translation>Dettaglio conservato</translation>
    </message>
    <message>
        <source>Peak signal-to-noise ratio, PSNR: 20 dB looks rough, 30 dB good.</source>
        <translation>Rapporto segnale-rumore di picco, PSNR: 20 dB appaiono grezzi, 30 dB buoni.</translation>
    </message>
    <message>
        <source>Structural similarity, SSIM: 1 is all of it.</source>
        <translation>Somiglianza strutturale, SSIM: 1 significa tutto.</translation>
    </message>
    <message>
        <source>What of it is shown</source>
        <translation>Che cosa ne viene mostrato</translation>
    </message>
    <message>
        <source>Mask %1</source>
        <translation>Maschera %1</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1, %2</translation>
    </message>
    <message>
        <source>Masks</source>
        <translation>Maschere</translation>
    </message>
    <message>
        <source>No light falls on these parts: doors, windows, where visitors sit.</source>
        <translation>Su queste parti non cade luce: porte, finestre, posti dei visitatori.</translation>
    </message>
    <message>
        <source>Draw a mask</source>
        <translation>Disegna una maschera</translation>
    </message>
    <message>
        <source>Click points in the picture, and the first one again to close. With the keyboard: arrow keys, Space, Return; Escape leaves it.</source>
        <translation>Fare clic su punti dell’immagine, e di nuovo sul primo per chiudere. Con la tastiera: frecce, Spazio, Invio; Esc abbandona.</translation>
    </message>
    <message>
        <source>Straight</source>
        <translation>Dritto</translation>
    </message>
    <message>
        <source>Curved</source>
        <translation>Curvo</translation>
    </message>
    <message>
        <source>How the points of the mask are joined</source>
        <translation>Come sono uniti i punti della maschera</translation>
    </message>
    <message>
        <source>Feather</source>
        <translation>Bordo sfumato</translation>
    </message>
    <message>
        <source>How far beyond the mask the light comes back, thousandths of the view</source>
        <translation>Fin dove torna la luce oltre la maschera, in millesimi della vista</translation>
    </message>
    <message>
        <source>Remove the mask</source>
        <translation>Rimuovi la maschera</translation>
    </message>
    <message>
        <source>Stop drawing</source>
        <translation>Termina il disegno</translation>
    </message>
    <message>
        <source>errors weighed as an eye does</source>
        <translation>errori pesati come fa l’occhio</translation>
    </message>
    <message>
        <source>No venue is open.</source>
        <translation>Nessun luogo è aperto.</translation>
    </message>
    <message>
        <source>The sets are as they were.</source>
        <translation>Le varianti sono rimaste com’erano.</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>Variante</translation>
    </message>
    <message>
        <source>Without a name</source>
        <translation>Senza nome</translation>
    </message>
    <message>
        <source>More</source>
        <translation>Altro</translation>
    </message>
    <message>
        <source>More for the set</source>
        <translation>Altro per la variante</translation>
    </message>
    <message>
        <source>Save as…</source>
        <translation>Salva come…</translation>
    </message>
    <message>
        <source>Rename…</source>
        <translation>Rinomina…</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Rimuovi</translation>
    </message>
    <message>
        <source>It is placed automatically.</source>
        <translation>È posizionata in automatico.</translation>
    </message>
    <message>
        <source>A picture is on the surface.</source>
        <translation>Un’immagine è sulla superficie.</translation>
    </message>
    <message>
        <source>The output is open. Close it first.</source>
        <translation>L’uscita è aperta. Prima chiuderla.</translation>
    </message>
    <message>
        <source>Shine on %1</source>
        <translation>Proietta su %1</translation>
    </message>
    <message>
        <source>A rehearsal has no surface: this lights the screen %1 until you stop it or leave.</source>
        <translation>Una prova non ha superficie: questo illumina lo schermo %1 finché non si ferma o si esce.</translation>
    </message>
    <message>
        <source>Part of the picture lies where the view is left out.</source>
        <translation>Parte dell’immagine cade dove la vista è esclusa.</translation>
    </message>
    <message>
        <source>It stays uncorrected. Acquire says why.</source>
        <translation>Resta non corretta. Acquisizione dice perché.</translation>
    </message>
    <message>
        <source>Predicted from the measurement. The output stays as it is.</source>
        <translation>Previsto dalla misura. L’uscita resta com’è.</translation>
    </message>
    <message>
        <source>The content was placed on another measurement or threshold</source>
        <translation>Il contenuto è stato posizionato su un’altra misura o un’altra soglia</translation>
    </message>
    <message>
        <source>To shine on the surface, close the output first.</source>
        <translation>Per proiettare sulla superficie, chiudere prima l’uscita.</translation>
    </message>
    <message>
        <source>Uncorrected, in blocks of %1 px</source>
        <translation>Non corretta, a blocchi di %1 px</translation>
    </message>
    <message>
        <source>Predicted from the measurement. Another program&apos;s show is projected.</source>
        <translation>Previsto dalla misura. Viene proiettato lo show di un altro programma.</translation>
    </message>
    <message>
        <source>The preview is being prepared.</source>
        <translation>L’anteprima è in preparazione.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::RenameDialog</name>
    <message>
        <source>Rename a venue</source>
        <translation>Rinomina un luogo</translation>
    </message>
    <message>
        <source>Its folder has the same name and is renamed with it. A show that starts at log-in follows.</source>
        <translation>La sua cartella ha lo stesso nome e viene rinominata con esso. Uno show che parte all’accesso lo segue.</translation>
    </message>
    <message>
        <source>Rename</source>
        <translation>Rinomina</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Session</name>
    <message>
        <source>%1 is at work. What is chosen here can be kept when that has ended.</source>
        <translation>%1 è al lavoro. Ciò che si sceglie qui si potrà conservare quando ha finito.</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>Dispositivi in uso in %1.</translation>
    </message>
    <message>
        <source>Confirm that the room is clear.</source>
        <translation>Confermare che la sala è sgombra.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::SetNameDialog</name>
    <message>
        <source>Save as a set</source>
        <translation>Salva come variante</translation>
    </message>
    <message>
        <source>Rename a set</source>
        <translation>Rinomina una variante</translation>
    </message>
    <message>
        <source>Day, night, school class</source>
        <translation>Giorno, notte, scolaresca</translation>
    </message>
    <message>
        <source>What you see becomes this set, and is changed in it from now on.</source>
        <translation>Ciò che si vede diventa questa variante, e da ora in poi si modifica in essa.</translation>
    </message>
    <message>
        <source>Playlists and controllers that call it by its present name have to be changed, too.</source>
        <translation>Vanno modificati anche le playlist e i controller che la chiamano con il nome attuale.</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>Salva</translation>
    </message>
    <message>
        <source>Rename</source>
        <translation>Rinomina</translation>
    </message>
    <message>
        <source>There is a set of this name already.</source>
        <translation>Esiste già una variante con questo nome.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::SetTimesDialog</name>
    <message>
        <source>Sets by the time of the day</source>
        <translation>Varianti secondo l’ora del giorno</translation>
    </message>
    <message>
        <source>From each time on the installed show plays that set, every day, until the next time.</source>
        <translation>Da ogni orario lo show installato mostra quella variante, ogni giorno, fino all’orario successivo.</translation>
    </message>
    <message>
        <source>From this time on</source>
        <translation>Da quest’ora</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>Variante</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Aggiungi</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Rimuovi</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Annulla</translation>
    </message>
    <message>
        <source>Apply</source>
        <translation>Applica</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1: %2</translation>
    </message>
    <message>
        <source>There are no times yet.</source>
        <translation>Non ci sono ancora orari.</translation>
    </message>
    <message>
        <source>Type a time of the day, such as %1.</source>
        <translation>Digitare un’ora del giorno, per esempio %1.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::SettingsDialog</name>
    <message>
        <source>Settings</source>
        <translation>Opzioni</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Chiudi</translation>
    </message>
    <message>
        <source>Look</source>
        <translation>Aspetto</translation>
    </message>
    <message>
        <source>Dark</source>
        <translation>Scuro</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Chiaro</translation>
    </message>
    <message>
        <source>Theme. The dark one is for the dark room.</source>
        <translation>Tema. Quello scuro è per la sala buia.</translation>
    </message>
    <message>
        <source>Dim pictures: the laptop is room light</source>
        <translation>Attenua immagini: il portatile illumina la sala</translation>
    </message>
    <message>
        <source>As the computer</source>
        <translation>Come il computer</translation>
    </message>
    <message>
        <source>Language</source>
        <translation>Lingua</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>Misura</translation>
    </message>
    <message>
        <source>As quickly as the devices can, after a consent</source>
        <translation>Alla massima velocità dei dispositivi, previo consenso</translation>
    </message>
    <message numerus="yes">
        <source>At most %n change(s) a second</source>
        <translation>
            <numerusform>Al massimo %n cambio al secondo</numerusform>
            <numerusform>Al massimo %n cambi al secondo</numerusform>
        </translation>
    </message>
    <message>
        <source>Flashing light of the projector</source>
        <translation>Luce lampeggiante del proiettore</translation>
    </message>
    <message>
        <source>More than three changes a second can cause seizures. Slower measuring needs no consent.</source>
        <translation>Più di tre cambi al secondo possono causare crisi epilettiche. Una misura più lenta non richiede consenso.</translation>
    </message>
    <message>
        <source>A sound when a measurement ends</source>
        <translation>Un suono alla fine di una misura</translation>
    </message>
    <message>
        <source>New venues</source>
        <translation>Nuovi luoghi</translation>
    </message>
    <message>
        <source>Folder for new venues</source>
        <translation>Cartella per i nuovi luoghi</translation>
    </message>
    <message>
        <source>Choose a folder</source>
        <translation>Scegli una cartella</translation>
    </message>
    <message>
        <source>Folder</source>
        <translation>Cartella</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Show</name>
    <message>
        <source>A show is playing.</source>
        <translation>Uno show è in riproduzione.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StatusPage</name>
    <message>
        <source>State</source>
        <translation>Stato</translation>
    </message>
    <message>
        <source>Updated</source>
        <translation>Aggiornato</translation>
    </message>
    <message>
        <source>Computed on</source>
        <translation>Calcolato su</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>Fotogrammi</translation>
    </message>
    <message>
        <source>Late frames</source>
        <translation>Fotogrammi in ritardo</translation>
    </message>
    <message>
        <source>Frames per second</source>
        <translation>Fotogrammi al secondo</translation>
    </message>
    <message>
        <source>Time per frame (ms)</source>
        <translation>Tempo per fotogramma (ms)</translation>
    </message>
    <message>
        <source>Delay behind the viewer (ms)</source>
        <translation>Ritardo rispetto allo spettatore (ms)</translation>
    </message>
    <message>
        <source>Clipped share</source>
        <translation>Parte tagliata</translation>
    </message>
    <message>
        <source>Steps</source>
        <translation>Passi</translation>
    </message>
    <message>
        <source>Perfected</source>
        <translation>Perfezionata</translation>
    </message>
    <message>
        <source>Item</source>
        <translation>Elemento</translation>
    </message>
    <message>
        <source>Items skipped</source>
        <translation>Elementi saltati</translation>
    </message>
    <message>
        <source>Failures</source>
        <translation>Guasti</translation>
    </message>
    <message>
        <source>Most memory used (bytes)</source>
        <translation>Memoria massima usata (byte)</translation>
    </message>
    <message>
        <source>Displays</source>
        <translation>Schermi</translation>
    </message>
    <message>
        <source>Connector</source>
        <translation>Connettore</translation>
    </message>
    <message>
        <source>Shining</source>
        <translation>Illuminato</translation>
    </message>
    <message>
        <source>Drawn by</source>
        <translation>Disegnato da</translation>
    </message>
    <message>
        <source>Projectors</source>
        <translation>Proiettori</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>Proiettore</translation>
    </message>
    <message>
        <source>Address</source>
        <translation>Indirizzo</translation>
    </message>
    <message>
        <source>Answers</source>
        <translation>Risponde</translation>
    </message>
    <message>
        <source>Problem</source>
        <translation>Problema</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Nome</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>Modello</translation>
    </message>
    <message>
        <source>Power</source>
        <translation>Alimentazione</translation>
    </message>
    <message>
        <source>Shutter</source>
        <translation>Otturatore</translation>
    </message>
    <message>
        <source>Lamp hours</source>
        <translation>Ore della lampada</translation>
    </message>
    <message>
        <source>Filter hours</source>
        <translation>Ore del filtro</translation>
    </message>
    <message>
        <source>Input</source>
        <translation>Ingresso</translation>
    </message>
    <message>
        <source>Signal</source>
        <translation>Segnale</translation>
    </message>
    <message>
        <source>Own pixels</source>
        <translation>Pixel propri</translation>
    </message>
    <message>
        <source>Remarks</source>
        <translation>Osservazioni</translation>
    </message>
    <message>
        <source>yes</source>
        <translation>sì</translation>
    </message>
    <message>
        <source>no</source>
        <translation>no</translation>
    </message>
    <message>
        <source>Relucent: %1</source>
        <translation>Relucent: %1</translation>
    </message>
    <message>
        <source>Alarm</source>
        <translation>Allarme</translation>
    </message>
    <message>
        <source>Last night</source>
        <translation>Ultima notte</translation>
    </message>
    <message>
        <source>When</source>
        <translation>Quando</translation>
    </message>
    <message>
        <source>Outcome</source>
        <translation>Esito</translation>
    </message>
    <message>
        <source>Pictures perfected</source>
        <translation>Immagini perfezionate</translation>
    </message>
    <message>
        <source>Colour error (ΔE)</source>
        <translation>Errore di colore (ΔE)</translation>
    </message>
    <message>
        <source>Predicted colour error (ΔE)</source>
        <translation>Errore di colore previsto (ΔE)</translation>
    </message>
    <message>
        <source>Nobody was told</source>
        <translation>Nessuno è stato avvisato</translation>
    </message>
    <message>
        <source>Next night</source>
        <translation>Prossima notte</translation>
    </message>
    <message>
        <source>Somebody has to look</source>
        <translation>Qualcuno deve controllare</translation>
    </message>
    <message>
        <source>Watched by camera</source>
        <translation>Sorvegliato dalla fotocamera</translation>
    </message>
    <message>
        <source>Photographs</source>
        <translation>Fotografie</translation>
    </message>
    <message>
        <source>Photographs used</source>
        <translation>Fotografie usate</translation>
    </message>
    <message>
        <source>Share that can be told</source>
        <translation>Parte valutabile</translation>
    </message>
    <message>
        <source>Time per photograph (ms)</source>
        <translation>Tempo per fotografia (ms)</translation>
    </message>
    <message>
        <source>What has changed</source>
        <translation>Che cosa è cambiato</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>Tipo</translation>
    </message>
    <message>
        <source>How much</source>
        <translation>Quanto</translation>
    </message>
    <message>
        <source>What happened</source>
        <translation>Che cosa è successo</translation>
    </message>
    <message>
        <source>What to do</source>
        <translation>Che cosa fare</translation>
    </message>
    <message>
        <source>Delay of the live picture (ms)</source>
        <translation>Ritardo dell’immagine dal vivo (ms)</translation>
    </message>
    <message>
        <source>Streams</source>
        <translation>Flussi</translation>
    </message>
    <message>
        <source>Losses</source>
        <translation>Interruzioni</translation>
    </message>
    <message>
        <source>Pixels</source>
        <translation>Pixel</translation>
    </message>
    <message>
        <source>Time from the sender, by its clock (ms)</source>
        <translation>Tempo dal mittente, secondo il suo orologio (ms)</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>Variante</translation>
    </message>
    <message>
        <source>Black</source>
        <translation>Nero</translation>
    </message>
    <message>
        <source>Frozen</source>
        <translation>Congelata</translation>
    </message>
    <message>
        <source>Corrected</source>
        <translation>Corretta</translation>
    </message>
    <message>
        <source>Brightness</source>
        <translation>Luminosità</translation>
    </message>
    <message>
        <source>Test chart</source>
        <translation>Carta di test</translation>
    </message>
    <message>
        <source>starting</source>
        <translation>in avvio</translation>
    </message>
    <message>
        <source>playing</source>
        <translation>in riproduzione</translation>
    </message>
    <message>
        <source>resting until its hours</source>
        <translation>a riposo fino al suo orario</translation>
    </message>
    <message>
        <source>photographing</source>
        <translation>sta fotografando</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>non riuscito</translation>
    </message>
    <message>
        <source>stopped</source>
        <translation>fermato</translation>
    </message>
    <message>
        <source>connecting</source>
        <translation>in connessione</translation>
    </message>
    <message>
        <source>asking whether it may</source>
        <translation>chiede il permesso</translation>
    </message>
    <message>
        <source>lost</source>
        <translation>perso</translation>
    </message>
    <message>
        <source>opening</source>
        <translation>in apertura</translation>
    </message>
    <message>
        <source>watching</source>
        <translation>osserva</translation>
    </message>
    <message>
        <source>paused</source>
        <translation>in pausa</translation>
    </message>
    <message>
        <source>no camera</source>
        <translation>nessuna fotocamera</translation>
    </message>
    <message>
        <source>no calibration</source>
        <translation>nessuna calibrazione</translation>
    </message>
    <message>
        <source>black, until somebody ends it</source>
        <translation>nero, finché qualcuno non lo termina</translation>
    </message>
    <message>
        <source>test chart</source>
        <translation>carta di test</translation>
    </message>
    <message>
        <source>frozen, until somebody ends it</source>
        <translation>fermo, finché qualcuno non lo termina</translation>
    </message>
    <message>
        <source>playing, but no display shows it</source>
        <translation>in riproduzione, ma nessuno schermo lo mostra</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StatusStrip</name>
    <message>
        <source>Projector</source>
        <translation>Proiettore</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Fotocamera</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>Disco</translation>
    </message>
    <message>
        <source>none chosen</source>
        <translation>da scegliere</translation>
    </message>
    <message>
        <source>%1 free</source>
        <translation>%1 liberi</translation>
    </message>
    <message>
        <source>simulated</source>
        <translation>simulazione</translation>
    </message>
    <message>
        <source>by script</source>
        <translation>da script</translation>
    </message>
    <message>
        <source>%1, in use</source>
        <translation>%1, in uso</translation>
    </message>
    <message>
        <source>Saved %1</source>
        <translation>Salvato alle %1</translation>
    </message>
    <message>
        <source>Room light</source>
        <translation>Luce ambiente</translation>
    </message>
    <message>
        <source>%1, unplugged</source>
        <translation>%1, scollegato</translation>
    </message>
    <message>
        <source>%1 of full light, steady</source>
        <translation>%1 della luce piena, stabile</translation>
    </message>
    <message>
        <source>%1 of full light, changed</source>
        <translation>%1 della luce piena, cambiata</translation>
    </message>
    <message>
        <source>%1, silent</source>
        <translation>%1, muta</translation>
    </message>
    <message numerus="yes">
        <source>%n screen(s)</source>
        <translation>
            <numerusform>%n schermo</numerusform>
            <numerusform>%n schermi</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n with %1, %2</source>
        <comment>projectors and their pixels</comment>
        <translation>
            <numerusform>%n con %1, %2</numerusform>
            <numerusform>%n con %1, %2</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n, simulated</source>
        <comment>cameras</comment>
        <translation>
            <numerusform>%n, simulata</numerusform>
            <numerusform>%n, simulate</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n camera(s)</source>
        <translation>
            <numerusform>%n fotocamera</numerusform>
            <numerusform>%n fotocamere</numerusform>
        </translation>
    </message>
    <message>
        <source>none in use</source>
        <translation>non in uso</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StepRail</name>
    <message>
        <source>locked</source>
        <translation>bloccato</translation>
    </message>
    <message>
        <source>done</source>
        <translation>completato</translation>
    </message>
    <message>
        <source>out of date</source>
        <translation>da aggiornare</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>non riuscito</translation>
    </message>
    <message>
        <source>current</source>
        <translation>attuale</translation>
    </message>
    <message>
        <source>open</source>
        <translation>aperto</translation>
    </message>
    <message>
        <source>Step %1, %2, %3</source>
        <translation>Passo %1, %2, %3</translation>
    </message>
    <message>
        <source>No venue open</source>
        <translation>Nessun luogo aperto</translation>
    </message>
    <message>
        <source>stopped early</source>
        <translation>fermato in anticipo</translation>
    </message>
    <message>
        <source>under way</source>
        <translation>in corso</translation>
    </message>
    <message>
        <source>doubtful</source>
        <translation>dubbio</translation>
    </message>
    <message>
        <source>Opens once %1 is done.</source>
        <translation>Si apre quando «%1» è fatto.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StreamDialog</name>
    <message>
        <source>Add a stream</source>
        <translation>Aggiungi un flusso</translation>
    </message>
    <message>
        <source>A live picture from the network, without its sound: RTSP, SRT, RTP, UDP, HTTP or RTMP. While it plays, this computer is connected to that address.</source>
        <translation>Un’immagine dal vivo dalla rete, senza audio: RTSP, SRT, RTP, UDP, HTTP o RTMP. Durante la riproduzione questo computer è connesso a quell’indirizzo.</translation>
    </message>
    <message>
        <source>Address</source>
        <translation>Indirizzo</translation>
    </message>
    <message>
        <source>User name and password stand before the host, as in rtsp://user:password@host. They are kept in the playlist, and shown nowhere.</source>
        <translation>Nome utente e password stanno prima dell’host, come in rtsp://user:password@host. Restano nella playlist e non vengono mostrati da nessuna parte.</translation>
    </message>
    <message>
        <source>While it is lost</source>
        <translation>Mentre è interrotto</translation>
    </message>
    <message>
        <source>Its last picture</source>
        <translation>La sua ultima immagine</translation>
    </message>
    <message>
        <source>Black</source>
        <translation>Nero</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Annulla</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Aggiungi</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ThresholdPage</name>
    <message>
        <source>%1 of light kept</source>
        <translation>Luce conservata %1</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>Da aggiornare</translation>
    </message>
    <message>
        <source>Reading the light transport</source>
        <translation>Lettura del trasporto della luce</translation>
    </message>
    <message>
        <source>Below 95 % of the light, bounces are lost.</source>
        <translation>Sotto il 95 % della luce si perdono i rimbalzi.</translation>
    </message>
    <message>
        <source>Next: groups of pixels that can be solved on their own</source>
        <translation>Poi: gruppi di pixel risolvibili da soli</translation>
    </message>
    <message>
        <source>Group into clusters</source>
        <translation>Raggruppa in cluster</translation>
    </message>
    <message>
        <source>The threshold was chosen for an earlier measurement</source>
        <translation>La soglia è stata scelta per una misura precedente</translation>
    </message>
    <message>
        <source>Look at it again, then go on.</source>
        <translation>Ricontrollarla, poi proseguire.</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>Quanto misurato è al sicuro.</translation>
    </message>
    <message>
        <source>Threshold</source>
        <translation>Soglia</translation>
    </message>
    <message>
        <source>Choose the faintest light worth keeping. Less is faster and smaller; too little loses the bounces.</source>
        <translation>Scegliere la luce più debole da conservare. Meno luce è più veloce e compatta; troppo poca perde i rimbalzi.</translation>
    </message>
    <message>
        <source>Camera view</source>
        <translation>Inquadratura</translation>
    </message>
    <message>
        <source>The surface in full light</source>
        <translation>La superficie in piena luce</translation>
    </message>
    <message>
        <source>Pixel %1, %2</source>
        <translation>Pixel %1, %2</translation>
    </message>
    <message>
        <source>Projector pixels that light the picked camera pixel</source>
        <translation>Pixel del proiettore che illuminano il pixel selezionato della fotocamera</translation>
    </message>
    <message>
        <source>Pick a pixel in the camera view.</source>
        <translation>Selezionare un pixel nell’inquadratura.</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Fotocamera</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>Proiettore</translation>
    </message>
    <message>
        <source>transport</source>
        <translation>trasporto</translation>
    </message>
    <message>
        <source>Transport matrix</source>
        <translation>Matrice di trasporto</translation>
    </message>
    <message>
        <source>click an entry</source>
        <translation>clic su un elemento</translation>
    </message>
    <message>
        <source>Light transport matrix, camera pixels down, projector pixels across</source>
        <translation>Matrice di trasporto della luce, pixel della fotocamera in verticale, pixel del proiettore in orizzontale</translation>
    </message>
    <message>
        <source>Transport value, camera signal a second</source>
        <translation>Valore di trasporto, segnale della fotocamera al secondo</translation>
    </message>
    <message>
        <source>How much light flows through each connection</source>
        <translation>Quanta luce passa per ogni connessione</translation>
    </message>
    <message>
        <source>drag the cut, or use the arrow keys</source>
        <translation>trascinare il taglio o usare i tasti freccia</translation>
    </message>
    <message>
        <source>Connections</source>
        <translation>Connessioni</translation>
    </message>
    <message>
        <source>Cut</source>
        <translation>Taglio</translation>
    </message>
    <message>
        <source>Cut at %1, keeps %2</source>
        <translation>Taglio a %1, conserva %2</translation>
    </message>
    <message>
        <source>Everything is kept</source>
        <translation>Si conserva tutto</translation>
    </message>
    <message>
        <source>Leave out light below</source>
        <translation>Escludi la luce sotto</translation>
    </message>
    <message>
        <source>One value</source>
        <translation>Un valore</translation>
    </message>
    <message>
        <source>What stays</source>
        <translation>Cosa resta</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Luce</translation>
    </message>
    <message>
        <source>Memory</source>
        <translation>Memoria</translation>
    </message>
    <message>
        <source>What is left out is put back in proportion, so that the surface keeps its brightness.</source>
        <translation>Quanto escluso viene restituito in proporzione, così la superficie mantiene la sua luminosità.</translation>
    </message>
    <message>
        <source>Picked pixel</source>
        <translation>Pixel selezionato</translation>
    </message>
    <message>
        <source>Lit by</source>
        <translation>Illuminato da</translation>
    </message>
    <message>
        <source>Strongest</source>
        <translation>Più forte</translation>
    </message>
    <message>
        <source>From around it</source>
        <translation>Dai dintorni</translation>
    </message>
    <message>
        <source>Light from elsewhere</source>
        <translation>Luce da altrove</translation>
    </message>
    <message>
        <source>Use suggested, %1</source>
        <translation>Usa suggerito, %1</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 di %2</translation>
    </message>
    <message>
        <source>Picked pixel %1, %2</source>
        <translation>Pixel selezionato %1, %2</translation>
    </message>
    <message numerus="yes">
        <source>%n pixel(s)</source>
        <translation>
            <numerusform>%n pixel</numerusform>
            <numerusform>%n pixel</numerusform>
        </translation>
    </message>
    <message>
        <source>Cut, camera signal a second</source>
        <translation>Taglio, segnale della fotocamera al secondo</translation>
    </message>
    <message>
        <source>Use picked pixel</source>
        <translation>Usa il pixel selezionato</translation>
    </message>
    <message>
        <source>For each camera pixel</source>
        <translation>Per pixel della fotocamera</translation>
    </message>
    <message>
        <source>Suggested: three times the noise of the measurement.</source>
        <translation>Suggerito: tre volte il rumore della misurazione.</translation>
    </message>
    <message>
        <source>Suggested: keeps nearly all of the light.</source>
        <translation>Suggerito: conserva quasi tutta la luce.</translation>
    </message>
    <message>
        <source>%1 on average</source>
        <translation>%1 in media</translation>
    </message>
    <message>
        <source>Kind of cut</source>
        <translation>Tipo di taglio</translation>
    </message>
    <message>
        <source>Share of each pixel</source>
        <translation>Quota di ogni pixel</translation>
    </message>
    <message>
        <source>Share of the strongest light of each camera pixel, in tenths of a percent</source>
        <translation>Quota della luce più forte di ogni pixel della fotocamera, in decimi di percento</translation>
    </message>
    <message>
        <source>Below %1 of the strongest light that each camera pixel gets</source>
        <translation>Sotto %1 della luce più forte che riceve ogni pixel della fotocamera</translation>
    </message>
    <message>
        <source>Of each camera pixel the strongest connection always stays, however high the cut.</source>
        <translation>Di ogni pixel della fotocamera resta sempre il collegamento più forte, per quanto alto sia il taglio.</translation>
    </message>
    <message>
        <source>“%1” is not a cut: type a number, 0 or more. The cut is still %2.</source>
        <translation>«%1» non è un taglio: scrivere un numero da 0 in su. Il taglio è ancora %2.</translation>
    </message>
    <message>
        <source>At three times the noise, %1, only %2 of the light would stay: much faint light adds up. Suggested: keep everything.</source>
        <translation>Al triplo del rumore, %1, resterebbe solo %2 della luce: molta luce debole si somma. Suggerimento: conservare tutto.</translation>
    </message>
    <message>
        <source>Keep everything</source>
        <translation>Conserva tutto</translation>
    </message>
    <message>
        <source>Changed: it is applied as soon as you go on.</source>
        <translation>Modificato: si applica appena si prosegue.</translation>
    </message>
    <message>
        <source>What was measured is being read.</source>
        <translation>La misura è in lettura.</translation>
    </message>
    <message>
        <source>Pick a pixel in a picture.</source>
        <translation>Selezionare un pixel in un’immagine.</translation>
    </message>
    <message>
        <source>It is in use.</source>
        <translation>È in uso.</translation>
    </message>
    <message>
        <source>No light of the picked pixel was kept.</source>
        <translation>Del pixel scelto non è rimasta luce.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::TidyDialog</name>
    <message>
        <source>All</source>
        <translation>Tutte</translation>
    </message>
    <message>
        <source>Of the latest measurement</source>
        <translation>Quelle dell’ultima misura</translation>
    </message>
    <message>
        <source>None: results only</source>
        <translation>Nessuna: solo risultati</translation>
    </message>
    <message>
        <source>Only what nothing reads goes, and old files are compressed without loss.</source>
        <translation>Va via solo ciò che nulla legge; i vecchi file sono compressi senza perdita.</translation>
    </message>
    <message>
        <source>Those that were set aside by measuring again go too. Nothing reads them.</source>
        <translation>Vanno via anche quelle messe da parte misurando di nuovo. Nulla le legge.</translation>
    </message>
    <message>
        <source>All that was measured and computed stays. The photographs go.</source>
        <translation>Tutto ciò che è misurato e calcolato resta. Le foto vanno via.</translation>
    </message>
    <message>
        <source>Showing, checking and reports need results only. Other settings, and better methods of later versions, then have to photograph everything again.</source>
        <translation>Per proiettare, controllare e fare rapporti bastano i risultati. Altre impostazioni, e metodi migliori di versioni future, dovranno poi fotografare tutto di nuovo.</translation>
    </message>
    <message numerus="yes">
        <source>%n photograph(s)</source>
        <translation>
            <numerusform>%n foto</numerusform>
            <numerusform>%n foto</numerusform>
        </translation>
    </message>
    <message>
        <source>What was freed until then is free. Nothing that is needed is lost.</source>
        <translation>Quanto liberato fin lì è libero. Nulla di necessario è andato perso.</translation>
    </message>
    <message>
        <source>Photographs to keep</source>
        <translation>Foto da conservare</translation>
    </message>
    <message>
        <source>This venue is not measured to the end.</source>
        <translation>Questo luogo non è misurato fino in fondo.</translation>
    </message>
    <message>
        <source>All its photographs stay: going on needs them.</source>
        <translation>Tutte le sue foto restano: servono per continuare.</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Indietro</translation>
    </message>
    <message>
        <source>Freeing the disk</source>
        <translation>Si libera il disco</translation>
    </message>
    <message>
        <source>%1 will be removed for good.</source>
        <translation>Saranno rimosse per sempre: %1.</translation>
    </message>
    <message>
        <source>%1 will be freed.</source>
        <translation>Saranno liberati %1.</translation>
    </message>
    <message>
        <source>%1 freed, %2 removed</source>
        <translation>%1 liberati, %2 rimosse</translation>
    </message>
    <message>
        <source>%1 Nothing that is needed is lost.</source>
        <translation>%1 Nulla di necessario è andato perso.</translation>
    </message>
    <message>
        <source>frees %1</source>
        <translation>libera %1</translation>
    </message>
    <message>
        <source>nothing to free</source>
        <translation>nulla da liberare</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Annulla</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Ferma</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Chiudi</translation>
    </message>
    <message>
        <source>Free %1…</source>
        <translation>Libera %1…</translation>
    </message>
    <message>
        <source>Free %1</source>
        <translation>Libera %1</translation>
    </message>
    <message>
        <source>No photograph goes: everything stays possible.</source>
        <translation>Nessuna foto va via: tutto resta possibile.</translation>
    </message>
    <message>
        <source>The latest measurement keeps its photographs: everything stays possible.</source>
        <translation>L’ultima misura conserva le sue foto: tutto resta possibile.</translation>
    </message>
    <message>
        <source>Looking up what could be freed. Nothing is removed yet.</source>
        <translation>Ricerca di ciò che si può liberare. Non si rimuove ancora nulla.</translation>
    </message>
    <message>
        <source>Free disk space</source>
        <translation>Libera spazio su disco</translation>
    </message>
    <message>
        <source>Disk space of %1</source>
        <translation>Spazio su disco di %1</translation>
    </message>
    <message>
        <source>Freeing space was stopped.</source>
        <translation>La liberazione di spazio è stata interrotta.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VenueNetwork</name>
    <message>
        <source>“%1” is no network address of a projector. Write its number or name, as 192.168.1.50.</source>
        <translation>«%1» non è l’indirizzo di rete di un proiettore. Scriva il numero o il nome, come 192.168.1.50.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VenuePage</name>
    <message>
        <source>Unplugged. Plug it in or choose another.</source>
        <translation>Scollegato. Collegarlo o sceglierne un altro.</translation>
    </message>
    <message>
        <source>%1, %2 by %3, chosen</source>
        <translation>%1, %2 per %3, scelto</translation>
    </message>
    <message>
        <source>%1, %2 by %3</source>
        <translation>%1, %2 per %3</translation>
    </message>
    <message>
        <source>Screens</source>
        <translation>Schermi</translation>
    </message>
    <message>
        <source>Choose the one that shines on the surface. Its pixels are the projector&apos;s.</source>
        <translation>Scegliere quello che illumina la superficie. I suoi pixel sono quelli del proiettore.</translation>
    </message>
    <message>
        <source>Identify screens</source>
        <translation>Identifica schermi</translation>
    </message>
    <message>
        <source>I</source>
        <translation>I</translation>
    </message>
    <message>
        <source>The projector shares your screen</source>
        <translation>Il proiettore condivide lo schermo di lavoro</translation>
    </message>
    <message>
        <source>Real devices</source>
        <translation>Dispositivi reali</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>Proiettore</translation>
    </message>
    <message>
        <source>Glossy corner</source>
        <translation>Angolo lucido</translation>
    </message>
    <message>
        <source>Light bounces between two cards</source>
        <translation>La luce rimbalza tra due cartoncini</translation>
    </message>
    <message>
        <source>Bust before a brick wall</source>
        <translation>Busto e muro di mattoni</translation>
    </message>
    <message>
        <source>Texture, shadow and light between surfaces</source>
        <translation>Trama, ombra e luce tra superfici</translation>
    </message>
    <message>
        <source>Many depths</source>
        <translation>Molte profondità</translation>
    </message>
    <message>
        <source>Some surfaces are out of focus</source>
        <translation>Alcune superfici sono fuori fuoco</translation>
    </message>
    <message>
        <source>Dome</source>
        <translation>Cupola</translation>
    </message>
    <message>
        <source>Every part lights every other part</source>
        <translation>Ogni parte illumina tutte le altre</translation>
    </message>
    <message>
        <source>Wine glass</source>
        <translation>Calice di vetro</translation>
    </message>
    <message>
        <source>Light is refracted both ways</source>
        <translation>La luce è rifratta nei due sensi</translation>
    </message>
    <message>
        <source>Painted wall</source>
        <translation>Parete dipinta</translation>
    </message>
    <message>
        <source>Flat, with diamonds; the easiest</source>
        <translation>Piana, con rombi; la più facile</translation>
    </message>
    <message>
        <source>%1, a first look</source>
        <translation>%1, un primo sguardo</translation>
    </message>
    <message>
        <source>%1, quick</source>
        <translation>%1, veloce</translation>
    </message>
    <message>
        <source>%1, usual</source>
        <translation>%1, normale</translation>
    </message>
    <message>
        <source>%1, fine</source>
        <translation>%1, fine</translation>
    </message>
    <message>
        <source>Venue</source>
        <translation>Luogo</translation>
    </message>
    <message>
        <source>Rehearse in a simulated venue</source>
        <translation>Prova in un luogo simulato</translation>
    </message>
    <message>
        <source>New venue by script</source>
        <translation>Nuovo luogo da script</translation>
    </message>
    <message>
        <source>New venue</source>
        <translation>Nuovo luogo</translation>
    </message>
    <message>
        <source>Say which screen shines, which programs show and photograph, and where the work is kept.</source>
        <translation>Indicare quale schermo illumina, quali programmi mostrano e fotografano e dove conservare il lavoro.</translation>
    </message>
    <message>
        <source>Setting up</source>
        <translation>Configurazione</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1, %2</translation>
    </message>
    <message>
        <source>simulated, %1</source>
        <translation>simulazione, %1</translation>
    </message>
    <message>
        <source>by script, %1</source>
        <translation>da script, %1</translation>
    </message>
    <message>
        <source>%1 is open</source>
        <translation>%1 è aperto</translation>
    </message>
    <message>
        <source>Enter opens the highlighted choice</source>
        <translation>Invio apre la scelta evidenziata</translation>
    </message>
    <message>
        <source>Check camera</source>
        <translation>Controlla fotocamera</translation>
    </message>
    <message>
        <source>Start rehearsal</source>
        <translation>Inizia prova</translation>
    </message>
    <message>
        <source>Nothing was changed in that folder.</source>
        <translation>In quella cartella nulla è cambiato.</translation>
    </message>
    <message>
        <source>Give the venue a name.</source>
        <translation>Dare un nome al luogo.</translation>
    </message>
    <message>
        <source>A name cannot hold a slash.</source>
        <translation>Un nome non può contenere barre.</translation>
    </message>
    <message>
        <source>There is a folder of that name. Choose another name.</source>
        <translation>Esiste già una cartella con quel nome. Scegliere un altro nome.</translation>
    </message>
    <message>
        <source>Choose the screen that shines on the surface.</source>
        <translation>Scegliere lo schermo che illumina la superficie.</translation>
    </message>
    <message>
        <source>Free %1 or choose another folder.</source>
        <translation>Liberare %1 o scegliere un’altra cartella.</translation>
    </message>
    <message>
        <source>Confirm that the room is clear.</source>
        <translation>Confermare che la sala è sgombra.</translation>
    </message>
    <message>
        <source>Nothing was measured yet.</source>
        <translation>Non è stato ancora misurato nulla.</translation>
    </message>
    <message>
        <source>Programs</source>
        <translation>Programmi</translation>
    </message>
    <message>
        <source>Any projector and any camera that a command can drive</source>
        <translation>Qualsiasi proiettore e fotocamera pilotabili da un comando</translation>
    </message>
    <message>
        <source>Photographs {exposure} seconds into the file {output}: float EXR, 16-bit PNG or TIFF</source>
        <translation>Fotografa per {exposure} secondi nel file {output}: EXR float, PNG o TIFF a 16 bit</translation>
    </message>
    <message>
        <source>Projector&apos;s pixels</source>
        <translation>Pixel del proiettore</translation>
    </message>
    <message>
        <source>Width</source>
        <translation>Larghezza</translation>
    </message>
    <message>
        <source>Height</source>
        <translation>Altezza</translation>
    </message>
    <message>
        <source>Rehearsal. Opened %1</source>
        <translation>Prova. Aperto il %1</translation>
    </message>
    <message>
        <source>Opened %1</source>
        <translation>Aperto il %1</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Apri</translation>
    </message>
    <message>
        <source>Open %1</source>
        <translation>Apri %1</translation>
    </message>
    <message>
        <source>Open a venue</source>
        <translation>Apri un luogo</translation>
    </message>
    <message>
        <source>Rehearse</source>
        <translation>Prova</translation>
    </message>
    <message>
        <source>Learn every step in a simulated venue. No devices needed.</source>
        <translation>Imparare ogni passo in un luogo simulato. Senza dispositivi.</translation>
    </message>
    <message>
        <source>Continue where you stopped, or change the content.</source>
        <translation>Riprendere da dove ci si era fermati o cambiare il contenuto.</translation>
    </message>
    <message>
        <source>Measure a surface with a projector and a camera at this computer.</source>
        <translation>Misurare una superficie con proiettore e fotocamera collegati a questo computer.</translation>
    </message>
    <message>
        <source>Projector and camera are driven by programs of yours.</source>
        <translation>Proiettore e fotocamera sono pilotati da programmi propri.</translation>
    </message>
    <message>
        <source>Recent</source>
        <translation>Recenti</translation>
    </message>
    <message>
        <source>No venues yet</source>
        <translation>Ancora nessun luogo</translation>
    </message>
    <message>
        <source>The venues that you measure are listed here, newest first.</source>
        <translation>I luoghi misurati sono elencati qui, i più recenti per primi.</translation>
    </message>
    <message>
        <source>A first rehearsal takes a few minutes.</source>
        <translation>Una prima prova dura pochi minuti.</translation>
    </message>
    <message>
        <source>This venue</source>
        <translation>Questo luogo</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Nome</translation>
    </message>
    <message>
        <source>Name of the venue</source>
        <translation>Nome del luogo</translation>
    </message>
    <message>
        <source>Folder</source>
        <translation>Cartella</translation>
    </message>
    <message>
        <source>Folder that holds the venue</source>
        <translation>Cartella che contiene il luogo</translation>
    </message>
    <message>
        <source>Choose a folder</source>
        <translation>Scegli una cartella</translation>
    </message>
    <message>
        <source>Expected</source>
        <translation>Stima</translation>
    </message>
    <message>
        <source>Patterns</source>
        <translation>Pattern</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>Disco</translation>
    </message>
    <message>
        <source>about %1</source>
        <translation>circa %1</translation>
    </message>
    <message>
        <source>Simulated devices</source>
        <translation>Dispositivi simulati</translation>
    </message>
    <message>
        <source>Pixels of the simulated projector</source>
        <translation>Pixel del proiettore simulato</translation>
    </message>
    <message>
        <source>More pixels show finer detail and take longer. The first time, the light of the venue is traced; later it is remembered.</source>
        <translation>Più pixel mostrano dettagli più fini e richiedono più tempo. La prima volta si traccia la luce del luogo; poi resta memorizzata.</translation>
    </message>
    <message numerus="yes">
        <source>About %n pattern(s), %1</source>
        <translation>
            <numerusform>Circa %n pattern, %1</numerusform>
            <numerusform>Circa %n pattern, %1</numerusform>
        </translation>
    </message>
    <message>
        <source>Shows the file {image} and ends as soon as the projector shines it</source>
        <translation>Mostra il file {image} e termina appena il proiettore lo emette</translation>
    </message>
    <message>
        <source>Relief, two projectors</source>
        <translation>Rilievo, due proiettori</translation>
    </message>
    <message>
        <source>Each shines into the other&apos;s shadows</source>
        <translation>Ciascuno illumina le ombre dell’altro</translation>
    </message>
    <message>
        <source>The projector&apos;s screen</source>
        <translation>Lo schermo del proiettore</translation>
    </message>
    <message>
        <source>Say which screen the projector is now. What was measured stays.</source>
        <translation>Indicare quale schermo è ora il proiettore. Le misure restano.</translation>
    </message>
    <message>
        <source>Nothing is measured again.</source>
        <translation>Nulla viene misurato di nuovo.</translation>
    </message>
    <message>
        <source>Use this screen</source>
        <translation>Usa questo schermo</translation>
    </message>
    <message>
        <source>Change the screen</source>
        <translation>Cambia lo schermo</translation>
    </message>
    <message>
        <source>The projector&apos;s screen %1 is not there</source>
        <translation>Lo schermo %1 del proiettore non c’è</translation>
    </message>
    <message>
        <source>Plug it in, or say which screen the projector is now.</source>
        <translation>Collegarlo o indicare quale schermo è ora il proiettore.</translation>
    </message>
    <message>
        <source>%1 is not the folder of a venue: it has no %2 in it.</source>
        <translation>%1 non è la cartella di un luogo: non contiene %2.</translation>
    </message>
    <message numerus="yes">
        <source>There are %n venue(s) within it: open one of them.</source>
        <translation>
            <numerusform>Contiene %n luogo: aprirlo.</numerusform>
            <numerusform>Contiene %n luoghi: aprirne uno.</numerusform>
        </translation>
    </message>
    <message>
        <source>Choose a venue&apos;s own folder. It has the venue&apos;s name.</source>
        <translation>Scegliere la cartella di un luogo. Porta il nome del luogo.</translation>
    </message>
    <message>
        <source>This folder is not a venue</source>
        <translation>Questa cartella non è un luogo</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>Non è stato cambiato nulla.</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>I dispositivi sono in uso in %1.</translation>
    </message>
    <message>
        <source>Choose another screen.</source>
        <translation>Scegliere un altro schermo.</translation>
    </message>
    <message>
        <source>Only your own screen is there. Plug the projector in, and extend the desktop to it.</source>
        <translation>C’è solo il vostro schermo. Collegare il proiettore ed estendervi il desktop.</translation>
    </message>
    <message>
        <source>Nothing is measured again</source>
        <translation>Nulla viene misurato di nuovo</translation>
    </message>
    <message>
        <source>Measured at</source>
        <translation>Misurato su</translation>
    </message>
    <message>
        <source>Used at</source>
        <translation>Usato su</translation>
    </message>
    <message>
        <source>Pixels</source>
        <translation>Pixel</translation>
    </message>
    <message>
        <source>A screen is known again by its maker&apos;s names and serial number. Where it tells none, it is known by its connector: then a cable that is plugged in elsewhere has to be said here.</source>
        <translation>Uno schermo viene riconosciuto dal produttore e dal numero di serie. Se non li fornisce, dal connettore: allora un cavo collegato altrove va indicato qui.</translation>
    </message>
    <message>
        <source>Is open</source>
        <translation>È aperto</translation>
    </message>
    <message>
        <source>Time, by camera</source>
        <translation>Tempo, secondo la fotocamera</translation>
    </message>
    <message>
        <source>Industrial cameras and video devices are fast, still cameras slow.</source>
        <translation>Le telecamere industriali e i dispositivi video sono veloci, le fotocamere lente.</translation>
    </message>
    <message>
        <source>%1 to %2</source>
        <translation>da %1 a %2</translation>
    </message>
    <message>
        <source>%1 free</source>
        <translation>%1 liberi</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 di %2</translation>
    </message>
    <message>
        <source>Free the disk of what %1 does not need</source>
        <translation>Liberare il disco da ciò che non serve a %1</translation>
    </message>
    <message>
        <source>Resume</source>
        <translation>Riprendi</translation>
    </message>
    <message>
        <source>Resume %1</source>
        <translation>Riprendi %1</translation>
    </message>
    <message>
        <source>Free space…</source>
        <translation>Libera spazio…</translation>
    </message>
    <message>
        <source>Somebody bumps the camera</source>
        <translation>Qualcuno urta la fotocamera</translation>
    </message>
    <message>
        <source>A light is switched on</source>
        <translation>Si accende una luce</translation>
    </message>
    <message>
        <source>The camera&apos;s cable comes out</source>
        <translation>Il cavo della fotocamera si stacca</translation>
    </message>
    <message>
        <source>Surprises</source>
        <translation>Sorprese</translation>
    </message>
    <message>
        <source>Each comes once while Acquire measures, at a moment that nobody knows. Practise what the wizard says, before it happens in front of a client.</source>
        <translation>Ognuna arriva una volta mentre Acquisizione misura, in un momento che nessuno conosce. Esercitarsi su ciò che dice la procedura guidata, prima che accada davanti a un cliente.</translation>
    </message>
    <message>
        <source>Measures how a surface changes what is projected on it, and corrects pictures and films until they look right there.</source>
        <translation>Misura come una superficie cambia ciò che vi si proietta e corregge immagini e filmati finché appaiono giusti.</translation>
    </message>
    <message>
        <source>Easy. Measuring takes %1</source>
        <translation>Facile. Durata della misura: %1</translation>
    </message>
    <message>
        <source>Medium. Measuring takes %1</source>
        <translation>Medio. Durata della misura: %1</translation>
    </message>
    <message>
        <source>Hard. Measuring takes %1</source>
        <translation>Difficile. Durata della misura: %1</translation>
    </message>
    <message>
        <source>Name of %1</source>
        <translation>Nome di %1</translation>
    </message>
    <message>
        <source>Projectors</source>
        <translation>Proiettori</translation>
    </message>
    <message>
        <source>None chosen yet.</source>
        <translation>Nessuno ancora scelto.</translation>
    </message>
    <message>
        <source>Add a projector</source>
        <translation>Aggiungi un proiettore</translation>
    </message>
    <message>
        <source>Projector %1</source>
        <translation>Proiettore %1</translation>
    </message>
    <message>
        <source>Remove projector %1</source>
        <translation>Rimuovi il proiettore %1</translation>
    </message>
    <message>
        <source>%1: choose its screen</source>
        <translation>%1: scegliere il suo schermo</translation>
    </message>
    <message>
        <source>Cameras</source>
        <translation>Fotocamere</translation>
    </message>
    <message>
        <source>Camera %1</source>
        <translation>Fotocamera %1</translation>
    </message>
    <message>
        <source>Remove camera %1</source>
        <translation>Rimuovi la fotocamera %1</translation>
    </message>
    <message>
        <source>Add one from the list, or choose it at the next step.</source>
        <translation>Aggiungerne una dall&apos;elenco, o sceglierla al passo successivo.</translation>
    </message>
    <message>
        <source>Content is placed in the view of the first one.</source>
        <translation>Il contenuto si colloca nella vista della prima.</translation>
    </message>
    <message>
        <source>Add those that look at the surface.</source>
        <translation>Aggiungere quelle che guardano la superficie.</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Rimuovi</translation>
    </message>
    <message>
        <source>Remove %1</source>
        <translation>Rimuovi %1</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Aggiungi</translation>
    </message>
    <message>
        <source>Add %1</source>
        <translation>Aggiungi %1</translation>
    </message>
    <message>
        <source>Say which screens shine on the surface, which cameras watch, and where the work is kept.</source>
        <translation>Indicare quali schermi illuminano la superficie, quali fotocamere guardano e dove conservare il lavoro.</translation>
    </message>
    <message numerus="yes">
        <source>%n projector(s)</source>
        <translation>
            <numerusform>%n proiettore</numerusform>
            <numerusform>%n proiettori</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n camera(s)</source>
        <translation>
            <numerusform>%n fotocamera</numerusform>
            <numerusform>%n fotocamere</numerusform>
        </translation>
    </message>
    <message>
        <source>This screen is projector %1 already.</source>
        <translation>Questo schermo è già il proiettore %1.</translation>
    </message>
    <message>
        <source>That screen is projector %1. Choose another screen.</source>
        <translation>Quello schermo è il proiettore %1. Sceglierne un altro.</translation>
    </message>
    <message>
        <source>Dome, four projectors</source>
        <translation>Cupola, quattro proiettori</translation>
    </message>
    <message>
        <source>They overlap; two cameras watch</source>
        <translation>Si sovrappongono; due fotocamere guardano</translation>
    </message>
    <message>
        <source>Bust from three sides</source>
        <translation>Busto visto da tre lati</translation>
    </message>
    <message>
        <source>Two projectors, three cameras: for an audience that walks</source>
        <translation>Due proiettori, tre fotocamere: per un pubblico che cammina</translation>
    </message>
    <message>
        <source>Projector whose screen is changed</source>
        <translation>Proiettore di cui si cambia lo schermo</translation>
    </message>
    <message>
        <source>Network address (PJLink)</source>
        <translation>Indirizzo di rete (PJLink)</translation>
    </message>
    <message>
        <source>Password, if it has one</source>
        <translation>Password, se ne ha una</translation>
    </message>
    <message>
        <source>On the network</source>
        <translation>In rete</translation>
    </message>
    <message>
        <source>Optional: a projector with a network address is switched on, and its lamp waited for until it is steady, before anything is measured.</source>
        <translation>Facoltativo: un proiettore con un indirizzo di rete viene acceso, e si attende che la sua lampada sia stabile, prima di misurare.</translation>
    </message>
    <message>
        <source>Find projectors</source>
        <translation>Cerca proiettori</translation>
    </message>
    <message>
        <source>Looking for projectors…</source>
        <translation>Ricerca di proiettori…</translation>
    </message>
    <message>
        <source>None answers. Only PJLink class 2 can be searched: type the address.</source>
        <translation>Nessuno risponde. Si può cercare solo PJLink classe 2: scriva l’indirizzo.</translation>
    </message>
    <message numerus="yes">
        <source>%n answer. Choose from the list of each.</source>
        <translation>
            <numerusform>%n risponde. Lo scelga nella lista.</numerusform>
            <numerusform>%n rispondono. Scelga nella lista di ciascuno.</numerusform>
        </translation>
    </message>
    <message>
        <source>Move to the trash</source>
        <translation>Sposta nel cestino</translation>
    </message>
    <message>
        <source>Keep it</source>
        <translation>Mantienilo</translation>
    </message>
    <message>
        <source>Try again then.</source>
        <translation>Riprovare dopo.</translation>
    </message>
    <message>
        <source>Nothing of the venue is lost.</source>
        <translation>Del luogo non si è perso nulla.</translation>
    </message>
    <message>
        <source>Remove a venue</source>
        <translation>Rimuovi un luogo</translation>
    </message>
    <message>
        <source>“%1” goes to the trash, with its photographs, results and playlist.</source>
        <translation>«%1» va nel cestino, con foto, risultati e playlist.</translation>
    </message>
    <message>
        <source>Until the trash is emptied it can be taken back from there.</source>
        <translation>Finché il cestino non viene svuotato, lo si può recuperare da lì.</translation>
    </message>
    <message>
        <source>More</source>
        <translation>Altro</translation>
    </message>
    <message>
        <source>More for %1</source>
        <translation>Altro per %1</translation>
    </message>
    <message>
        <source>Rename…</source>
        <translation>Rinomina…</translation>
    </message>
    <message>
        <source>Remove…</source>
        <translation>Rimuovi…</translation>
    </message>
    <message>
        <source>Setting up another</source>
        <translation>Se ne configura un altro</translation>
    </message>
    <message>
        <source>Allow them</source>
        <translation>Consentirli</translation>
    </message>
    <message>
        <source>Open without them</source>
        <translation>Aprire senza</translation>
    </message>
    <message>
        <source>Programs of a venue</source>
        <translation>Programmi di un luogo</translation>
    </message>
    <message>
        <source>“%1” names programs of its own as projector or camera. They would run on this computer as you, and nobody here has agreed to that yet:</source>
        <translation>«%1» indica programmi propri come proiettore o fotocamera. Verrebbero eseguiti su questo computer a tuo nome, e qui nessuno vi ha ancora acconsentito:</translation>
    </message>
    <message>
        <source>None of them was run. Without them everything that was measured can be looked at and shown.</source>
        <translation>Nessuno è stato eseguito. Senza di essi tutto ciò che è stato misurato si può guardare e mostrare.</translation>
    </message>
    <message>
        <source>Allow them if you know what they do, or know who made this venue.</source>
        <translation>Consentili se sai che cosa fanno o chi ha fatto questo luogo.</translation>
    </message>
    <message>
        <source>No other screen is plugged in.</source>
        <translation>Nessun altro schermo collegato.</translation>
    </message>
    <message>
        <source>The same steps, with a simulated projector and camera. Nothing is projected unless you choose a screen.</source>
        <translation>Gli stessi passi, con proiettore e fotocamera simulati. Nulla viene proiettato, a meno che non si scelga uno schermo.</translation>
    </message>
    <message>
        <source>Programs of this venue</source>
        <translation>Programmi di questo luogo</translation>
    </message>
    <message>
        <source>Say which commands drive these devices from now on. What was measured stays.</source>
        <translation>Indicare quali comandi pilotano d’ora in poi questi dispositivi. Le misure restano.</translation>
    </message>
    <message>
        <source>Use these commands</source>
        <translation>Usa questi comandi</translation>
    </message>
    <message>
        <source>Change the programs</source>
        <translation>Cambia i programmi</translation>
    </message>
    <message>
        <source>Type another command.</source>
        <translation>Scrivere un altro comando.</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Fotocamera</translation>
    </message>
    <message>
        <source>A program that fails ends with another status than 0. What it says last is told with it. Try it in a terminal, with a file in place of {image} or {output} and seconds in place of {exposure}.</source>
        <translation>Un programma che fallisce termina con uno stato diverso da 0, e si riporta l’ultima cosa che dice. Provarlo in un terminale, con un file al posto di {image} o {output} e i secondi al posto di {exposure}.</translation>
    </message>
    <message>
        <source>Relucent shows the pictures on it, unless a program of yours does.</source>
        <translation>Relucent vi mostra le immagini, se non lo fa un proprio programma.</translation>
    </message>
    <message>
        <source>Not needed with a screen. %1</source>
        <translation>Non serve con uno schermo. %1</translation>
    </message>
    <message>
        <source>Choose the projector&apos;s screen, or type the command that shows.</source>
        <translation>Scegliere lo schermo del proiettore, o scrivere il comando che mostra.</translation>
    </message>
    <message>
        <source>%1, %2, unplugged</source>
        <translation>%1, %2, scollegato</translation>
    </message>
    <message>
        <source>As many as the chosen screen has.</source>
        <translation>Tanti quanti ne ha lo schermo scelto.</translation>
    </message>
    <message>
        <source>Continue</source>
        <translation>Continua</translation>
    </message>
    <message>
        <source>A show plays on %1</source>
        <translation>È in corso uno show su %1</translation>
    </message>
    <message>
        <source>Another program shows it. End it before anything is measured there: Camera has the button.</source>
        <translation>Lo mostra un altro programma. Terminarlo prima di misurare lì: il pulsante è in Fotocamera.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VenueTidy</name>
    <message>
        <source>Try again then.</source>
        <translation>Riprovare dopo.</translation>
    </message>
    <message>
        <source>%1 is at work. Space can be freed when it has ended.</source>
        <translation>%1 è al lavoro. Lo spazio si potrà liberare alla fine.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ViewerPlan</name>
    <message>
        <source>Plan of the cameras and of the viewer, seen from above</source>
        <translation>Pianta delle fotocamere e dello spettatore, vista dall&apos;alto</translation>
    </message>
    <message>
        <source>Camera %1</source>
        <translation>Fotocamera %1</translation>
    </message>
    <message>
        <source>Viewer</source>
        <translation>Spettatore</translation>
    </message>
    <message>
        <source>%1: %2 m to the left, %3 m from the surface</source>
        <translation>%1: %2 m a sinistra, a %3 m dalla superficie</translation>
    </message>
    <message>
        <source>%1: %2 m to the right, %3 m from the surface</source>
        <translation>%1: %2 m a destra, a %3 m dalla superficie</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VtkView</name>
    <message>
        <source>This view needs OpenGL 3.2, and this computer draws without it. Everything else works: pictures and maps are shown without depth.</source>
        <translation>Questa vista richiede OpenGL 3.2 e questo computer disegna senza. Tutto il resto funziona: immagini e mappe sono mostrate senza profondità.</translation>
    </message>
    <message>
        <source>For this view, install the graphics card&apos;s driver and start Relucent again.</source>
        <translation>Per questa vista, installare il driver della scheda grafica e riavviare Relucent.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Wizard</name>
    <message>
        <source>Not applied yet</source>
        <translation>Non ancora applicato</translation>
    </message>
</context>
<context>
    <name>repair.camera-moved</name>
    <message>
        <source>the view of camera {} has moved by {} and {} pixels and turned by {} degrees</source>
        <translation>la vista della camera {} si è spostata di {} e {} pixel e ruotata di {} gradi</translation>
    </message>
</context>
<context>
    <name>repair.light-changed</name>
    <message>
        <source>projector {} gives {} % of the red, {} % of the green and {} % of the blue light that it gave</source>
        <translation>il proiettore {} dà il {} % della luce rossa, il {} % della verde e il {} % della blu che dava</translation>
    </message>
</context>
<context>
    <name>repair.light-elsewhere</name>
    <message>
        <source>in {} % of the cameras&apos; pixels light arrives otherwise than it did</source>
        <translation>nel {} % dei pixel delle camere la luce arriva in modo diverso da prima</translation>
    </message>
</context>
<context>
    <name>repair.picture-moved</name>
    <message>
        <source>the projected picture has moved by {} and {} pixels as camera {} sees it</source>
        <translation>l’immagine proiettata si è spostata di {} e {} pixel, vista dalla camera {}</translation>
    </message>
</context>
<context>
    <name>repair.room-brighter</name>
    <message>
        <source>the room is brighter by {} % of the projectors&apos; full light</source>
        <translation>la sala è più chiara del {} % della luce piena dei proiettori</translation>
    </message>
</context>
<context>
    <name>repair.room-darker</name>
    <message>
        <source>the room is darker by {} % of the projectors&apos; full light</source>
        <translation>la sala è più scura del {} % della luce piena dei proiettori</translation>
    </message>
</context>
<context>
    <name>repair.surface-changed</name>
    <message>
        <source>{} % of what the cameras see is brighter, darker or of another colour than it was</source>
        <translation>il {} % di ciò che vedono le camere è più chiaro, più scuro o di un altro colore rispetto a prima</translation>
    </message>
</context>
<context>
    <name>report.cannot-write</name>
    <message>
        <source>the report cannot be written</source>
        <translation>impossibile scrivere il rapporto</translation>
    </message>
</context>
<context>
    <name>report.free-some-space</name>
    <message>
        <source>free some space</source>
        <translation>liberare spazio</translation>
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
        <translation>l’altro programma non può essere terminato da qui</translation>
    </message>
</context>
<context>
    <name>session.close-other-window</name>
    <message>
        <source>go on there, or close it there first</source>
        <translation>continuare lì, oppure chiuderlo prima lì</translation>
    </message>
</context>
<context>
    <name>session.end-show-itself</name>
    <message>
        <source>hold Esc on the projector&apos;s picture for two seconds</source>
        <translation>tenere premuto Esc per due secondi sull’immagine del proiettore</translation>
    </message>
</context>
<context>
    <name>session.open-in-another-window</name>
    <message>
        <source>this venue is open in another window of Relucent</source>
        <translation>questo luogo è aperto in un’altra finestra di Relucent</translation>
    </message>
</context>
<context>
    <name>sets.choose-name</name>
    <message>
        <source>choose another name, as day or school class</source>
        <translation>scegliere un altro nome, come giorno o scolaresca</translation>
    </message>
</context>
<context>
    <name>sets.choose-one</name>
    <message>
        <source>choose one of {}</source>
        <translation>scegliere tra {}</translation>
    </message>
</context>
<context>
    <name>sets.damaged</name>
    <message>
        <source>the sets of this calibration cannot be read</source>
        <translation>le varianti di questa calibrazione non sono leggibili</translation>
    </message>
</context>
<context>
    <name>sets.in-use</name>
    <message>
        <source>the set &apos;{}&apos; is in use</source>
        <translation>la variante «{}» è in uso</translation>
    </message>
</context>
<context>
    <name>sets.name-empty</name>
    <message>
        <source>a set needs a name</source>
        <translation>una variante deve avere un nome</translation>
    </message>
</context>
<context>
    <name>sets.name-odd</name>
    <message>
        <source>the name of a set is plain text that neither begins nor ends with a space</source>
        <translation>il nome di una variante è testo semplice che non inizia né finisce con uno spazio</translation>
    </message>
</context>
<context>
    <name>sets.name-taken</name>
    <message>
        <source>there is a set &apos;{}&apos; already</source>
        <translation>esiste già una variante «{}»</translation>
    </message>
</context>
<context>
    <name>sets.name-too-long</name>
    <message>
        <source>the name of a set has at most {} bytes</source>
        <translation>il nome di una variante ha al massimo {} byte</translation>
    </message>
</context>
<context>
    <name>sets.of-newer-version</name>
    <message>
        <source>a newer Relucent wrote the sets of this calibration</source>
        <translation>un Relucent più recente ha scritto le varianti di questa calibrazione</translation>
    </message>
</context>
<context>
    <name>sets.remove-section</name>
    <message>
        <source>take &quot;sets&quot; out of the settings in {}, or copy the calibration again from where it was made</source>
        <translation>togliere «sets» dalle impostazioni in {}, o copiare di nuovo la calibrazione da dove è stata fatta</translation>
    </message>
</context>
<context>
    <name>sets.save-first</name>
    <message>
        <source>this calibration has no sets yet: save one first</source>
        <translation>questa calibrazione non ha ancora varianti: salvarne prima una</translation>
    </message>
</context>
<context>
    <name>sets.unknown</name>
    <message>
        <source>there is no set &apos;{}&apos;</source>
        <translation>non esiste una variante «{}»</translation>
    </message>
</context>
<context>
    <name>sets.use-another-first</name>
    <message>
        <source>use another one first</source>
        <translation>usarne prima un’altra</translation>
    </message>
</context>
<context>
    <name>show.allow-commands</name>
    <message>
        <source>look at what it does, then open the venue in the wizard and allow its programs</source>
        <translation>guarda che cosa fa, poi apri il luogo nell’assistente e consenti i suoi programmi</translation>
    </message>
</context>
<context>
    <name>show.cannot-enable-service</name>
    <message>
        <source>the service cannot be switched on ({})</source>
        <translation>impossibile attivare il servizio ({})</translation>
    </message>
</context>
<context>
    <name>show.cannot-remove-entry</name>
    <message>
        <source>it cannot be removed ({})</source>
        <translation>impossibile eliminarlo ({})</translation>
    </message>
</context>
<context>
    <name>show.cannot-write-log</name>
    <message>
        <source>the log cannot be written ({})</source>
        <translation>impossibile scrivere il log ({})</translation>
    </message>
</context>
<context>
    <name>show.check-folder-permissions</name>
    <message>
        <source>check the folder&apos;s permissions</source>
        <translation>controllare i permessi della cartella</translation>
    </message>
</context>
<context>
    <name>show.choose-another-log-folder</name>
    <message>
        <source>choose another folder with --log</source>
        <translation>scegliere un’altra cartella con --log</translation>
    </message>
</context>
<context>
    <name>show.engine-lost-device</name>
    <message>
        <source>the engine lost its graphics card</source>
        <translation>il motore ha perso il suo dispositivo</translation>
    </message>
</context>
<context>
    <name>show.no-camera</name>
    <message>
        <source>this show has no camera: its calibration names none</source>
        <translation>questo spettacolo non ha una fotocamera: la sua calibrazione non ne indica nessuna</translation>
    </message>
</context>
<context>
    <name>show.no-xwayland</name>
    <message>
        <source>in a Wayland session, take QT_QPA_PLATFORM=xcb out of the environment; else take away the desktop&apos;s rules for windows of Relucent, then try again</source>
        <translation>in una sessione Wayland togliere QT_QPA_PLATFORM=xcb dall’ambiente; altrimenti togliere le regole del desktop per le finestre di Relucent, poi riprovare</translation>
    </message>
</context>
<context>
    <name>show.projector-by-command</name>
    <message>
        <source>this calibration shows pictures by a command of its own, which does not know of the show: stop the show and use relucent-cli verify and perfect</source>
        <translation>questa calibrazione mostra le immagini con un proprio comando, che non sa dello spettacolo: ferma lo spettacolo e usa relucent-cli verify e perfect</translation>
    </message>
</context>
<context>
    <name>show.restore-resolution</name>
    <message>
        <source>set its resolution back in the desktop&apos;s settings, then try again</source>
        <translation>ripristinarne la risoluzione nelle impostazioni del desktop, poi riprovare</translation>
    </message>
</context>
<context>
    <name>show.screen-asleep</name>
    <message>
        <source>the projector&apos;s screen is asleep and does not wake</source>
        <translation>lo schermo del proiettore è in standby e non si riattiva</translation>
    </message>
</context>
<context>
    <name>show.screen-size-changed</name>
    <message>
        <source>the projector&apos;s screen has {} pixels now and {} were calibrated</source>
        <translation>lo schermo del proiettore ora ha {} pixel e ne sono stati calibrati {}</translation>
    </message>
</context>
<context>
    <name>show.start-show-again</name>
    <message>
        <source>start the show again</source>
        <translation>avviare di nuovo lo show</translation>
    </message>
</context>
<context>
    <name>show.switch-off-power-saving</name>
    <message>
        <source>switch off its power saving and the screen saver in the desktop&apos;s settings, then try again</source>
        <translation>disattivarne il risparmio energetico e il salvaschermo nelle impostazioni del desktop, poi riprovare</translation>
    </message>
</context>
<context>
    <name>show.window-elsewhere</name>
    <message>
        <source>the desktop puts the projector&apos;s picture on the screen {} instead</source>
        <translation>il desktop mette invece l’immagine del proiettore sullo schermo {}</translation>
    </message>
</context>
<context>
    <name>stage.adapting-light-transport</name>
    <message>
        <source>fitting the light transport to what is seen</source>
        <translation>adattamento del trasporto di luce a ciò che si vede</translation>
    </message>
</context>
<context>
    <name>stage.algorithm-1</name>
    <message>
        <source>Algorithm 1</source>
        <translation>Algoritmo 1</translation>
    </message>
</context>
<context>
    <name>stage.assembling-light-transport</name>
    <message>
        <source>Assembling the light transport</source>
        <translation>Composizione del trasporto della luce</translation>
    </message>
</context>
<context>
    <name>stage.awaiting-steady-light</name>
    <message>
        <source>Waiting until the lamps are steady</source>
        <translation>Attesa che le lampade siano stabili</translation>
    </message>
</context>
<context>
    <name>stage.black-and-full-light</name>
    <message>
        <source>black and full light</source>
        <translation>nero e piena luce</translation>
    </message>
</context>
<context>
    <name>stage.calibrating</name>
    <message>
        <source>Calibrating</source>
        <translation>Calibrazione</translation>
    </message>
</context>
<context>
    <name>stage.capped-clusters</name>
    <message>
        <source>Clusters held to a size</source>
        <translation>Cluster di dimensione limitata</translation>
    </message>
</context>
<context>
    <name>stage.capping-clusters</name>
    <message>
        <source>Holding clusters to a size</source>
        <translation>Limitazione dei cluster</translation>
    </message>
</context>
<context>
    <name>stage.checking-additivity</name>
    <message>
        <source>Checking that the colours of {} add up</source>
        <translation>Controllo dell’additività dei colori: {}</translation>
    </message>
</context>
<context>
    <name>stage.checking-drift</name>
    <message>
        <source>Checking for drift</source>
        <translation>Controllo della deriva</translation>
    </message>
</context>
<context>
    <name>stage.checking-projector-and-camera</name>
    <message>
        <source>Checking projector and camera</source>
        <translation>Controllo di proiettore e fotocamera</translation>
    </message>
</context>
<context>
    <name>stage.choosing-camera-pixels</name>
    <message>
        <source>Finding the camera pixels that are needed</source>
        <translation>Ricerca dei pixel della fotocamera necessari</translation>
    </message>
</context>
<context>
    <name>stage.clustering-light-transport</name>
    <message>
        <source>Clustering the light transport</source>
        <translation>Raggruppamento del trasporto della luce</translation>
    </message>
</context>
<context>
    <name>stage.comparing-cluster-inverses-in-venue</name>
    <message>
        <source>Comparing the inverses of clusters in {}</source>
        <translation>Confronto delle inverse dei cluster: {}</translation>
    </message>
</context>
<context>
    <name>stage.comparing-methods</name>
    <message>
        <source>Comparing the methods</source>
        <translation>Confronto dei metodi</translation>
    </message>
</context>
<context>
    <name>stage.comparing-methods-in-venue</name>
    <message>
        <source>Comparing the methods in {}</source>
        <translation>Confronto dei metodi: {}</translation>
    </message>
</context>
<context>
    <name>stage.comparing-views</name>
    <message>
        <source>Comparing what the views want</source>
        <translation>Confronto di ciò che chiede ogni vista</translation>
    </message>
</context>
<context>
    <name>stage.compensating</name>
    <message>
        <source>Compensating</source>
        <translation>Compensazione</translation>
    </message>
</context>
<context>
    <name>stage.concluding-measurement</name>
    <message>
        <source>what may be expected of the result</source>
        <translation>che cosa ci si può attendere dal risultato</translation>
    </message>
</context>
<context>
    <name>stage.decoding</name>
    <message>
        <source>Decoding</source>
        <translation>Decodifica</translation>
    </message>
</context>
<context>
    <name>stage.dense-patterns</name>
    <message>
        <source>patterns in blocks of {} px</source>
        <translation>pattern a blocchi di {} px</translation>
    </message>
</context>
<context>
    <name>stage.estimating-light-transport</name>
    <message>
        <source>Estimating the light transport</source>
        <translation>Stima del trasporto della luce</translation>
    </message>
</context>
<context>
    <name>stage.estimating-response-and-colours</name>
    <message>
        <source>Estimating response and colours</source>
        <translation>Stima della risposta e dei colori</translation>
    </message>
</context>
<context>
    <name>stage.evaluating</name>
    <message>
        <source>Evaluating</source>
        <translation>Valutazione</translation>
    </message>
</context>
<context>
    <name>stage.finding-defocus</name>
    <message>
        <source>Finding the defocus</source>
        <translation>Ricerca della sfocatura</translation>
    </message>
</context>
<context>
    <name>stage.finding-exposure</name>
    <message>
        <source>Finding the exposure</source>
        <translation>Ricerca dell’esposizione</translation>
    </message>
</context>
<context>
    <name>stage.finding-exposures</name>
    <message>
        <source>Finding the exposures</source>
        <translation>Ricerca delle esposizioni</translation>
    </message>
</context>
<context>
    <name>stage.finding-projector-picture</name>
    <message>
        <source>Looking for the projector&apos;s picture</source>
        <translation>Ricerca dell’immagine del proiettore</translation>
    </message>
</context>
<context>
    <name>stage.finding-shadows</name>
    <message>
        <source>Looking for shadows</source>
        <translation>Ricerca delle ombre</translation>
    </message>
</context>
<context>
    <name>stage.finding-uncorrectable-pixels</name>
    <message>
        <source>Looking for what cannot be corrected</source>
        <translation>Ricerca di ciò che non è correggibile</translation>
    </message>
</context>
<context>
    <name>stage.finding-what-is-seen</name>
    <message>
        <source>Finding which part of the picture is seen</source>
        <translation>Ricerca della parte visibile dell’immagine</translation>
    </message>
</context>
<context>
    <name>stage.fitting-light-spread</name>
    <message>
        <source>Fitting the spread of light</source>
        <translation>Modello della diffusione della luce</translation>
    </message>
</context>
<context>
    <name>stage.forming-patches</name>
    <message>
        <source>Forming patches</source>
        <translation>Formazione delle zone</translation>
    </message>
</context>
<context>
    <name>stage.inverting-clusters</name>
    <message>
        <source>Inverting the clusters</source>
        <translation>Inversione dei cluster</translation>
    </message>
</context>
<context>
    <name>stage.inverting-light-transport</name>
    <message>
        <source>Inverting the light transport</source>
        <translation>Inversione del trasporto della luce</translation>
    </message>
</context>
<context>
    <name>stage.inverting-venue</name>
    <message>
        <source>Inverting {}</source>
        <translation>Inversione: {}</translation>
    </message>
</context>
<context>
    <name>stage.joining-clusters</name>
    <message>
        <source>Joining clusters</source>
        <translation>Unione dei cluster</translation>
    </message>
</context>
<context>
    <name>stage.judging-light</name>
    <message>
        <source>Judging the light</source>
        <translation>Valutazione della luce</translation>
    </message>
</context>
<context>
    <name>stage.level-of-tree</name>
    <message numerus="yes">
        <source>level {} of {}: {} patterns</source>
        <comment>level {} of {}: {} pattern</comment>
        <translation>
            <numerusform>livello {} di {}: {} pattern</numerusform>
            <numerusform>livello {} di {}: {} pattern</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>stage.light-transport</name>
    <message>
        <source>light transport</source>
        <translation>trasporto della luce</translation>
    </message>
</context>
<context>
    <name>stage.linearizing</name>
    <message>
        <source>Linearizing</source>
        <translation>Linearizzazione</translation>
    </message>
</context>
<context>
    <name>stage.looking-for-changes</name>
    <message>
        <source>Looking for what has changed</source>
        <translation>Ricerca di ciò che è cambiato</translation>
    </message>
</context>
<context>
    <name>stage.looking-for-hot-pixels</name>
    <message>
        <source>Looking for hot pixels of the camera</source>
        <translation>Ricerca dei pixel caldi della fotocamera</translation>
    </message>
</context>
<context>
    <name>stage.looking-through-camera</name>
    <message>
        <source>Looking through the camera</source>
        <translation>Osservazione con la fotocamera</translation>
    </message>
</context>
<context>
    <name>stage.measuring-brightness-curves</name>
    <message>
        <source>Measuring the brightness curves of {}</source>
        <translation>Misura delle curve di luminosità: {}</translation>
    </message>
</context>
<context>
    <name>stage.measuring-camera</name>
    <message>
        <source>Measuring the camera</source>
        <translation>Misura della fotocamera</translation>
    </message>
</context>
<context>
    <name>stage.measuring-latency</name>
    <message>
        <source>Measuring the latency</source>
        <translation>Misura della latenza</translation>
    </message>
</context>
<context>
    <name>stage.measuring-light-transport</name>
    <message>
        <source>Measuring the light transport</source>
        <translation>Misura del trasporto della luce</translation>
    </message>
</context>
<context>
    <name>stage.measuring-response</name>
    <message>
        <source>Measuring the response</source>
        <translation>Misura della risposta</translation>
    </message>
</context>
<context>
    <name>stage.measuring-venue</name>
    <message>
        <source>Measuring {}</source>
        <translation>Misura: {}</translation>
    </message>
</context>
<context>
    <name>stage.measuring-what-changed</name>
    <message>
        <source>measuring what is no longer as it was</source>
        <translation>misura di ciò che non è più come prima</translation>
    </message>
</context>
<context>
    <name>stage.opening-devices</name>
    <message>
        <source>Opening the devices</source>
        <translation>Apertura dei dispositivi</translation>
    </message>
</context>
<context>
    <name>stage.perfecting</name>
    <message>
        <source>Correcting the picture by photographs of itself</source>
        <translation>Correzione dell’immagine con fotografie di se stessa</translation>
    </message>
</context>
<context>
    <name>stage.photographing-projections</name>
    <message>
        <source>Photographing the projections</source>
        <translation>Foto delle proiezioni</translation>
    </message>
</context>
<context>
    <name>stage.photographing-test-patterns</name>
    <message>
        <source>Photographing test patterns</source>
        <translation>Foto dei pattern di test</translation>
    </message>
</context>
<context>
    <name>stage.predicting-held-out-patterns</name>
    <message>
        <source>Predicting held-out patterns</source>
        <translation>Previsione dei pattern di controllo</translation>
    </message>
</context>
<context>
    <name>stage.preparing-benchmarks</name>
    <message>
        <source>Preparing the benchmarks</source>
        <translation>Preparazione dei benchmark</translation>
    </message>
</context>
<context>
    <name>stage.preparing-devices</name>
    <message>
        <source>Preparing the devices</source>
        <translation>Preparazione dei dispositivi</translation>
    </message>
</context>
<context>
    <name>stage.preparing-engine</name>
    <message>
        <source>Preparing the engine</source>
        <translation>Preparazione del motore</translation>
    </message>
</context>
<context>
    <name>stage.preparing-preview</name>
    <message>
        <source>Preparing the preview</source>
        <translation>Preparazione dell’anteprima</translation>
    </message>
</context>
<context>
    <name>stage.preparing-venue</name>
    <message>
        <source>Preparing the venue</source>
        <translation>Preparazione del luogo</translation>
    </message>
</context>
<context>
    <name>stage.reading-calibration</name>
    <message>
        <source>Reading the calibration</source>
        <translation>Lettura della calibrazione</translation>
    </message>
</context>
<context>
    <name>stage.reading-light-transport</name>
    <message>
        <source>Reading the light transport</source>
        <translation>Lettura del trasporto della luce</translation>
    </message>
</context>
<context>
    <name>stage.reading-patterns</name>
    <message>
        <source>Reading the patterns</source>
        <translation>Lettura dei pattern</translation>
    </message>
</context>
<context>
    <name>stage.reading-photographs</name>
    <message>
        <source>Reading the photographs</source>
        <translation>Lettura delle foto</translation>
    </message>
</context>
<context>
    <name>stage.reading-pictures</name>
    <message>
        <source>Reading the pictures</source>
        <translation>Lettura delle immagini</translation>
    </message>
</context>
<context>
    <name>stage.reading-response</name>
    <message>
        <source>Reading the response</source>
        <translation>Lettura della risposta</translation>
    </message>
</context>
<context>
    <name>stage.reading-venue</name>
    <message>
        <source>Reading {}</source>
        <translation>Lettura: {}</translation>
    </message>
</context>
<context>
    <name>stage.remeasuring-flagged-pixels</name>
    <message numerus="yes">
        <source>measuring {} flagged pixels again</source>
        <comment>measuring {} flagged pixel again</comment>
        <translation>
            <numerusform>nuova misura di {} pixel segnalato</numerusform>
            <numerusform>nuova misura di {} pixel segnalati</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>stage.scaling-to-flood-image</name>
    <message>
        <source>Scaling to the flood image</source>
        <translation>Adeguamento all’immagine a piena luce</translation>
    </message>
</context>
<context>
    <name>stage.separating-direct-and-indirect-light</name>
    <message>
        <source>Separating direct and indirect light</source>
        <translation>Separazione di luce diretta e indiretta</translation>
    </message>
</context>
<context>
    <name>stage.sharing-leaves</name>
    <message>
        <source>light that neighbouring pixels share</source>
        <translation>luce condivisa dai pixel vicini</translation>
    </message>
</context>
<context>
    <name>stage.sharpening</name>
    <message>
        <source>Sharpening</source>
        <translation>Aumento nitidezza</translation>
    </message>
</context>
<context>
    <name>stage.solving</name>
    <message>
        <source>Solving</source>
        <translation>Soluzione</translation>
    </message>
</context>
<context>
    <name>stage.storing-light-transport</name>
    <message>
        <source>storing the light transport</source>
        <translation>salvataggio del trasporto della luce</translation>
    </message>
</context>
<context>
    <name>stage.switching-projectors-on</name>
    <message>
        <source>Switching the projectors on</source>
        <translation>Accensione dei proiettori</translation>
    </message>
</context>
<context>
    <name>stage.taking-verification-photograph</name>
    <message>
        <source>Taking the verification photograph</source>
        <translation>Scatto della foto di verifica</translation>
    </message>
</context>
<context>
    <name>stage.test-patterns</name>
    <message>
        <source>test patterns</source>
        <translation>pattern di test</translation>
    </message>
</context>
<context>
    <name>stage.timing-engine</name>
    <message>
        <source>Timing the engine</source>
        <translation>Misura dei tempi del motore</translation>
    </message>
</context>
<context>
    <name>stage.tracing-simulated-venue</name>
    <message>
        <source>tracing the simulated venue</source>
        <translation>tracciamento del luogo simulato</translation>
    </message>
</context>
<context>
    <name>stage.windows</name>
    <message>
        <source>Computing the windows of the inverse</source>
        <translation>Finestre</translation>
    </message>
</context>
<context>
    <name>stage.working-out-finest-blocks</name>
    <message>
        <source>working out the finest blocks</source>
        <translation>calcolo dei blocchi più fini</translation>
    </message>
</context>
<context>
    <name>stage.writing</name>
    <message>
        <source>Writing</source>
        <translation>Scrittura</translation>
    </message>
</context>
<context>
    <name>stage.writing-out-light-transport</name>
    <message>
        <source>Writing out the light transport</source>
        <translation>Scrittura per esteso del trasporto della luce</translation>
    </message>
</context>
<context>
    <name>stage.writing-report</name>
    <message>
        <source>Writing the report</source>
        <translation>Scrittura del rapporto</translation>
    </message>
</context>
<context>
    <name>stage.writing-results</name>
    <message>
        <source>Writing the results</source>
        <translation>Scrittura dei risultati</translation>
    </message>
</context>
<context>
    <name>stream.address-incomplete</name>
    <message>
        <source>in a stream&apos;s address the host or its port is missing or wrong</source>
        <translation>nell’indirizzo del flusso l’host o la sua porta mancano o sono errati</translation>
    </message>
</context>
<context>
    <name>stream.check-host</name>
    <message>
        <source>check the name in the address, or write the number</source>
        <translation>controllare il nome nell’indirizzo o scrivere il numero</translation>
    </message>
</context>
<context>
    <name>stream.check-network</name>
    <message>
        <source>check the network and the address</source>
        <translation>controllare la rete e l’indirizzo</translation>
    </message>
</context>
<context>
    <name>stream.check-path</name>
    <message>
        <source>check what stands behind the host in the address</source>
        <translation>controllare che cosa segue l’host nell’indirizzo</translation>
    </message>
</context>
<context>
    <name>stream.check-sender</name>
    <message>
        <source>check the sender, the network, and the address</source>
        <translation>controllare il mittente, la rete e l’indirizzo</translation>
    </message>
</context>
<context>
    <name>stream.end-other</name>
    <message>
        <source>end that program, or send to another port</source>
        <translation>chiudere quel programma o inviare a un’altra porta</translation>
    </message>
</context>
<context>
    <name>stream.ended</name>
    <message>
        <source>it has ended</source>
        <translation>è terminato</translation>
    </message>
</context>
<context>
    <name>stream.host-unknown</name>
    <message>
        <source>its host is not found</source>
        <translation>il suo host non si trova</translation>
    </message>
</context>
<context>
    <name>stream.list-once</name>
    <message>
        <source>put it into the playlist once</source>
        <translation>inserirlo una sola volta nella playlist</translation>
    </message>
</context>
<context>
    <name>stream.no-memory</name>
    <message>
        <source>there is not enough memory for its pictures</source>
        <translation>la memoria non basta per le sue immagini</translation>
    </message>
</context>
<context>
    <name>stream.no-such-path</name>
    <message>
        <source>there is nothing at its path</source>
        <translation>non c’è nulla al suo percorso</translation>
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
        <translation>non ha ancora dato alcuna immagine</translation>
    </message>
</context>
<context>
    <name>stream.open-already</name>
    <message>
        <source>this program plays it already</source>
        <translation>questo programma lo riproduce già</translation>
    </message>
</context>
<context>
    <name>stream.port-in-use</name>
    <message>
        <source>another program receives at its port</source>
        <translation>un altro programma riceve sulla sua porta</translation>
    </message>
</context>
<context>
    <name>stream.refused</name>
    <message>
        <source>the connection was refused</source>
        <translation>la connessione è stata rifiutata</translation>
    </message>
</context>
<context>
    <name>stream.send-h264</name>
    <message>
        <source>let it be sent as H.264 or Motion JPEG</source>
        <translation>farlo inviare come H.264 o Motion JPEG</translation>
    </message>
</context>
<context>
    <name>stream.silent</name>
    <message>
        <source>no picture came within {} s</source>
        <translation>nessuna immagine è arrivata entro {} s</translation>
    </message>
</context>
<context>
    <name>stream.stalled</name>
    <message>
        <source>no picture has come for {} s</source>
        <translation>nessuna immagine è arrivata da {} s</translation>
    </message>
</context>
<context>
    <name>stream.start-sender</name>
    <message>
        <source>start the sender, and check the port</source>
        <translation>avviare il mittente e controllare la porta</translation>
    </message>
</context>
<context>
    <name>stream.start-sender-again</name>
    <message>
        <source>start the sender again</source>
        <translation>riavviare il mittente</translation>
    </message>
</context>
<context>
    <name>stream.unknown-hold</name>
    <message>
        <source>the stream&apos;s address ends in an unknown choice</source>
        <translation>l’indirizzo del flusso termina con una scelta sconosciuta</translation>
    </message>
</context>
<context>
    <name>stream.unknown-scheme</name>
    <message>
        <source>this is no address of a stream</source>
        <translation>questo non è l’indirizzo di un flusso</translation>
    </message>
</context>
<context>
    <name>stream.unreachable</name>
    <message>
        <source>its host cannot be reached</source>
        <translation>il suo host non è raggiungibile</translation>
    </message>
</context>
<context>
    <name>stream.unreadable</name>
    <message>
        <source>it cannot be read ({})</source>
        <translation>non può essere letto ({})</translation>
    </message>
</context>
<context>
    <name>stream.unusable</name>
    <message>
        <source>what comes is no video that can be shown</source>
        <translation>ciò che arriva non è un video che si possa mostrare</translation>
    </message>
</context>
<context>
    <name>stream.wants-password</name>
    <message>
        <source>it wants another user name and password</source>
        <translation>chiede un altro nome utente e un’altra password</translation>
    </message>
</context>
<context>
    <name>stream.write-address</name>
    <message>
        <source>write it like {}, and in user names and passwords % and two digits for signs like @, : and /</source>
        <translation>scriverlo come {}, e in nomi utente e password % e due cifre per segni come @, : e /</translation>
    </message>
</context>
<context>
    <name>stream.write-hold</name>
    <message>
        <source>write #hold=last or #hold=black</source>
        <translation>scrivere #hold=last o #hold=black</translation>
    </message>
</context>
<context>
    <name>stream.write-password</name>
    <message>
        <source>write them into the address before the host: {}</source>
        <translation>scriverli nell’indirizzo prima dell’host: {}</translation>
    </message>
</context>
<context>
    <name>stream.write-scheme</name>
    <message>
        <source>let it begin with one of {}</source>
        <translation>farlo iniziare con uno di questi: {}</translation>
    </message>
</context>
<context>
    <name>venue.cannot-open-folder</name>
    <message>
        <source>the folder cannot be opened ({})</source>
        <translation>la cartella non si può aprire ({})</translation>
    </message>
</context>
<context>
    <name>venue.cannot-rename</name>
    <message>
        <source>the folder cannot be renamed ({})</source>
        <translation>la cartella non si può rinominare ({})</translation>
    </message>
</context>
<context>
    <name>venue.no-trash</name>
    <message>
        <source>it cannot be moved to the trash</source>
        <translation>non si può spostare nel cestino</translation>
    </message>
</context>
<context>
    <name>venue.remove-folder-yourself</name>
    <message>
        <source>this disk may have none: remove the folder with the file manager</source>
        <translation>questo disco forse non ne ha uno: rimuovere la cartella con il gestore di file</translation>
    </message>
</context>
<context>
    <name>venue.used-by-another</name>
    <message>
        <source>another program is working on this venue</source>
        <translation>un altro programma sta lavorando su questo luogo</translation>
    </message>
</context>
<context>
    <name>venue.wait-for-another</name>
    <message>
        <source>wait until it has finished, or close it, then try again</source>
        <translation>attendere che abbia finito o chiuderlo, poi riprovare</translation>
    </message>
</context>
<context>
    <name>view.cannot-write-picture</name>
    <message>
        <source>the picture could not be written</source>
        <translation>impossibile scrivere l’immagine</translation>
    </message>
</context>
<context>
    <name>view.choose-writable-folder</name>
    <message>
        <source>choose a folder that you may write to, with free space</source>
        <translation>scegliere una cartella in cui è consentito scrivere, con spazio libero</translation>
    </message>
</context>
<context>
    <name>wizard.allow-commands</name>
    <message>
        <source>open the venue anew and allow its programs</source>
        <translation>riapri il luogo e consenti i suoi programmi</translation>
    </message>
</context>
</TS>
