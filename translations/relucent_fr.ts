<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="fr">
<context>
    <name>About</name>
    <message>
        <source>About Relucent</source>
        <translation>À propos de Relucent</translation>
    </message>
    <message>
        <source>Version %1, with these libraries: %2.</source>
        <translation>Version %1, avec ces bibliothèques&#x202f;: %2.</translation>
    </message>
</context>
<context>
    <name>ContentFiles</name>
    <message>
        <source>Pictures and films</source>
        <translation>Images et vidéos</translation>
    </message>
    <message>
        <source>Pictures</source>
        <translation>Images</translation>
    </message>
    <message>
        <source>All files</source>
        <translation>Tous les fichiers</translation>
    </message>
</context>
<context>
    <name>DeviceLabel</name>
    <message>
        <source>Projector %1</source>
        <translation>Projecteur %1</translation>
    </message>
    <message>
        <source>Camera %1</source>
        <translation>Caméra %1</translation>
    </message>
</context>
<context>
    <name>EndQuestion</name>
    <message>
        <source>A measurement is under way</source>
        <translation>Une mesure est en cours</translation>
    </message>
    <message>
        <source>%1 in the venue “%2”.</source>
        <translation>%1 dans le lieu «&#x202f;%2&#x202f;».</translation>
    </message>
    <message>
        <source>Every photograph is on the disk. Opened again, the venue goes on from there.</source>
        <translation>Toutes les photos sont sur le disque. À la réouverture, le lieu reprend là où il en était.</translation>
    </message>
    <message>
        <source>End it for now</source>
        <translation>L’arrêter pour l’instant</translation>
    </message>
    <message>
        <source>Go on measuring</source>
        <translation>Continuer la mesure</translation>
    </message>
    <message>
        <source>The show of the venue “%1”: the projector&apos;s screen goes dark.</source>
        <translation>La diffusion du lieu « %1 » : l’écran du projecteur s’éteint.</translation>
    </message>
    <message>
        <source>Playlist and results are on the disk. Open the output again to play the show again.</source>
        <translation>La liste et les résultats sont sur le disque. Rouvrez la sortie pour relancer la diffusion.</translation>
    </message>
    <message>
        <source>A measurement and a show are under way</source>
        <translation>Une mesure et une diffusion sont en cours</translation>
    </message>
    <message>
        <source>End both</source>
        <translation>Arrêter les deux</translation>
    </message>
    <message>
        <source>Let both go on</source>
        <translation>Laisser les deux continuer</translation>
    </message>
    <message>
        <source>A show is playing</source>
        <translation>Une diffusion est en cours</translation>
    </message>
    <message>
        <source>End the show</source>
        <translation>Arrêter la diffusion</translation>
    </message>
    <message>
        <source>Go on playing</source>
        <translation>Continuer la lecture</translation>
    </message>
    <message>
        <source>The show of the venue “%1”.</source>
        <translation>Le spectacle du lieu « %1 ».</translation>
    </message>
</context>
<context>
    <name>Failure</name>
    <message>
        <source>The computer has no memory left.</source>
        <translation>L’ordinateur n’a plus de mémoire.</translation>
    </message>
    <message>
        <source>Close other programs, or choose fewer pixels.</source>
        <translation>Fermez d’autres programmes ou choisissez moins de pixels.</translation>
    </message>
    <message>
        <source>Relucent made a mistake.</source>
        <translation>Relucent a commis une erreur.</translation>
    </message>
    <message>
        <source>What is saved is safe. Copy the details for whoever looks after the program, then try again.</source>
        <translation>Ce qui est enregistré est en sécurité. Copiez les détails pour la personne qui s’occupe du programme, puis réessayez.</translation>
    </message>
    <message>
        <source>What is saved is safe. Try again.</source>
        <translation>Ce qui est enregistré est en sécurité. Réessayez.</translation>
    </message>
    <message>
        <source>The camera does not see this projector</source>
        <translation>La caméra ne voit pas ce projecteur</translation>
    </message>
    <message>
        <source>A program of this venue failed</source>
        <translation>Un programme de ce lieu a échoué</translation>
    </message>
    <message>
        <source>Another command is typed at the step Venue, by “Change the programs”.</source>
        <translation>Une autre commande se saisit à l’étape « Lieu », par « Changer les programmes ».</translation>
    </message>
</context>
<context>
    <name>FullDisk</name>
    <message>
        <source>The disk is full. Measuring has paused.</source>
        <translation>Le disque est plein. La mesure est en pause.</translation>
    </message>
    <message>
        <source>Every photograph is safe. %1 are free, %2 are needed: then measuring goes on by itself.</source>
        <translation>Toutes les photos sont en sécurité. %1 sont libres, il en faut %2&#x202f;: la mesure reprend alors d’elle-même.</translation>
    </message>
</context>
<context>
    <name>LostDevice</name>
    <message>
        <source>The projector&apos;s screen is unplugged</source>
        <translation>L’écran du projecteur est débranché</translation>
    </message>
    <message>
        <source>Everything so far is safe. Plug it in again: it goes on by itself.</source>
        <translation>Tout ce qui est fait est en sécurité. Rebranchez-le&#xa0;: la suite reprend d’elle-même.</translation>
    </message>
    <message>
        <source>Everything so far is safe. Push in its cable at both ends, and do not move the tripod: it goes on by itself.</source>
        <translation>Tout ce qui est fait est en sécurité. Enfoncez le câble aux deux bouts sans déplacer le trépied : la suite reprend d’elle-même.</translation>
    </message>
    <message>
        <source>The camera does not answer</source>
        <translation>La caméra ne répond pas</translation>
    </message>
    <message>
        <source>Screen unplugged</source>
        <translation>Écran débranché</translation>
    </message>
    <message>
        <source>Camera silent</source>
        <translation>Caméra muette</translation>
    </message>
    <message>
        <source>%1: its screen is unplugged</source>
        <extracomment>%1 is a projector: its name, or &quot;Projector 2&quot;</extracomment>
        <translation>%1 : son écran est débranché</translation>
    </message>
    <message>
        <source>%1 does not answer</source>
        <extracomment>%1 is a camera: its name, or &quot;Camera 2&quot;</extracomment>
        <translation>%1 ne répond pas</translation>
    </message>
    <message>
        <source>Everything so far is safe. Plug it in again, then resume.</source>
        <translation>Tout ce qui est fait est en sécurité. Rebranchez-le, puis reprenez.</translation>
    </message>
    <message>
        <source>Everything so far is safe. Push in its cable at both ends, and do not move the tripod, then resume.</source>
        <translation>Tout ce qui est fait est en sécurité. Enfoncez le câble aux deux bouts sans déplacer le trépied, puis reprenez.</translation>
    </message>
</context>
<context>
    <name>Method</name>
    <message>
        <source>Each pixel&apos;s brightness</source>
        <translation>Luminosité par pixel</translation>
    </message>
    <message>
        <source>Each pixel on its own</source>
        <translation>Pixel par pixel</translation>
    </message>
    <message>
        <source>Each pixel, sharpened</source>
        <translation>Pixel par pixel, accentué</translation>
    </message>
    <message>
        <source>Clusters</source>
        <translation>Groupes</translation>
    </message>
    <message>
        <source>Windows</source>
        <translation>Fenêtres</translation>
    </message>
    <message>
        <source>All bounces, for films</source>
        <translation>Tous les rebonds, pour la vidéo</translation>
    </message>
    <message>
        <source>Uncorrected</source>
        <translation>Non corrigé</translation>
    </message>
    <message>
        <source>All bounces, solved, for stills</source>
        <translation>Rebonds résolus, images fixes</translation>
    </message>
</context>
<context>
    <name>NumberText</name>
    <message>
        <source>%1 million</source>
        <translation>%1 millions</translation>
    </message>
    <message>
        <source>%1 billion</source>
        <translation>%1 milliards</translation>
    </message>
</context>
<context>
    <name>Overlay</name>
    <message>
        <source>%1 frames a second, %2 ms a frame, %3 of %4 late</source>
        <translation>%1 images/s, %2&#x202f;ms par image, %3 sur %4 en retard</translation>
    </message>
    <message>
        <source>not compensated</source>
        <translation>non corrigé</translation>
    </message>
    <message>
        <source>frozen</source>
        <translation>figé</translation>
    </message>
    <message>
        <source>test chart: %1</source>
        <translation>mire&#x202f;: %1</translation>
    </message>
    <message numerus="yes">
        <source>compensated, %n step(s), %1 % out of reach</source>
        <translation>
            <numerusform>corrigé, %n itération, %1 % hors d’atteinte</numerusform>
            <numerusform>corrigé, %n itérations, %1 % hors d’atteinte</numerusform>
        </translation>
    </message>
    <message>
        <source>still picture</source>
        <translation>image fixe</translation>
    </message>
    <message>
        <source>follows a viewer within %1 ms</source>
        <translation>suit un spectateur en %1 ms</translation>
    </message>
    <message>
        <source>perfected by photographs</source>
        <translation>perfectionnée par des photos</translation>
    </message>
    <message>
        <source>live picture within %1 ms of its arrival</source>
        <translation>image en direct à %1 ms de son arrivée</translation>
    </message>
</context>
<context>
    <name>RecentVenues</name>
    <message>
        <source>Nothing measured yet</source>
        <translation>Rien n’est encore mesuré</translation>
    </message>
    <message>
        <source>Acquire is next</source>
        <translation>Acquisition à faire</translation>
    </message>
    <message>
        <source>Ready to play</source>
        <translation>Prêt à diffuser</translation>
    </message>
    <message>
        <source>Preview out of date</source>
        <translation>Aperçu obsolète</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Mesuré</translation>
    </message>
    <message numerus="yes">
        <source>Interrupted: %n pattern(s) are safe</source>
        <translation>
            <numerusform>Interrompue : %n motif est en sûreté</numerusform>
            <numerusform>Interrompue : %n motifs sont en sûreté</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Measured; %n newer pattern(s) are safe</source>
        <translation>
            <numerusform>Mesuré ; %n motif plus récent en sûreté</numerusform>
            <numerusform>Mesuré ; %n motifs plus récents en sûreté</numerusform>
        </translation>
    </message>
    <message>
        <source>Ended by a change</source>
        <translation>Terminée par un changement</translation>
    </message>
    <message>
        <source>Stopped at blocks of %1 px</source>
        <translation>Arrêtée à des blocs de %1 px</translation>
    </message>
    <message>
        <source>Stopped at %1 px; newer patterns: %2</source>
        <translation>Arrêtée à %1 px ; motifs plus récents : %2</translation>
    </message>
    <message>
        <source>A show plays</source>
        <translation>Une diffusion est en cours</translation>
    </message>
</context>
<context>
    <name>ScreenChoice</name>
    <message>
        <source>This computer</source>
        <translation>Cet ordinateur</translation>
    </message>
    <message>
        <source>%1, %2 × %3, %4 Hz</source>
        <translation>%1, %2 × %3, %4&#x202f;Hz</translation>
    </message>
    <message>
        <source>There is no other screen: the patterns cover this window while they are shown. Plug the projector in, and switch the desktop to extended screens, to keep both apart.</source>
        <translation>Il n’y a pas d’autre écran&#x202f;: les motifs couvrent cette fenêtre pendant leur affichage. Pour séparer les deux, branchez le projecteur et réglez le bureau sur écrans étendus.</translation>
    </message>
    <message>
        <source>This is the screen that you work on. Choose the projector&apos;s.</source>
        <translation>C’est l’écran sur lequel vous travaillez. Choisissez celui du projecteur.</translation>
    </message>
    <message>
        <source>The projector was measured with %1 pixels. Set this screen to that size.</source>
        <translation>Le projecteur a été mesuré avec %1 pixels. Réglez cet écran à cette taille.</translation>
    </message>
    <message>
        <source>This is another projector than the one that was measured. Its light and its place differ: take a verification photograph, and measure again where that does not look as predicted.</source>
        <translation>Ce n’est pas le projecteur qui a été mesuré. Sa lumière et sa place diffèrent&#x202f;: prenez une photo de contrôle, et mesurez à nouveau si elle ne correspond pas à la prévision.</translation>
    </message>
    <message>
        <source>Measured at %1, used at %2. If it is the same projector in the same place, everything that was measured holds; a verification photograph tells.</source>
        <translation>Mesuré sur %1, utilisé sur %2. Si c’est le même projecteur au même endroit, toute la mesure reste valable&#x202f;; une photo de contrôle le montre.</translation>
    </message>
</context>
<context>
    <name>StoppedEarly</name>
    <message>
        <source>Measuring was stopped at blocks of %1 px</source>
        <translation>La mesure a été arrêtée à des blocs de %1 px</translation>
    </message>
    <message>
        <source>All that follows is as coarse. Go on measuring any time.</source>
        <translation>Tout ce qui suit est aussi grossier. Continuez la mesure à tout moment.</translation>
    </message>
    <message>
        <source>Go on at Acquire</source>
        <translation>Continuer à « Acquisition »</translation>
    </message>
    <message>
        <source>What was measured does not fit together</source>
        <translation>Les mesures ne concordent pas</translation>
    </message>
    <message>
        <source>Corrected pictures are expected at %1: that is no better than uncorrected. Measure again.</source>
        <translation>Les images corrigées devraient atteindre %1&#x202f;: pas mieux que sans correction. Mesurez à nouveau.</translation>
    </message>
    <message>
        <source>%1 dB</source>
        <translation>%1 dB</translation>
    </message>
    <message>
        <source>Go to Acquire</source>
        <translation>Aller à « Acquisition »</translation>
    </message>
    <message>
        <source>Measuring ended because something had changed</source>
        <translation>La mesure s’est terminée parce que quelque chose avait changé</translation>
    </message>
    <message>
        <source>What follows is of before. See at Acquire what helps.</source>
        <translation>La suite date d’avant. L’étape «&#x202f;Acquisition&#x202f;» dit quoi faire.</translation>
    </message>
    <message>
        <source>%1 of the view is too bright for the camera</source>
        <translation>%1 de la vue est trop claire pour la caméra</translation>
    </message>
    <message>
        <source>Nothing is corrected there. Close the lens a little, check the camera, then measure again.</source>
        <translation>Rien n’y est corrigé. Fermez un peu l’objectif, vérifiez la caméra, puis mesurez à nouveau.</translation>
    </message>
    <message>
        <source>%1 of the view is left out</source>
        <translation>%1 de la vue est laissée de côté</translation>
    </message>
    <message>
        <source>Test patterns looked different there from what was measured, and nothing is corrected. See that all stands still, then measure again.</source>
        <translation>Les mires de test y différaient de la mesure, et rien n’est corrigé. Veillez à ce que tout reste immobile, puis mesurez à nouveau.</translation>
    </message>
    <message>
        <source>Measuring was stopped before anything was told apart</source>
        <translation>La mesure a été arrêtée avant de rien distinguer</translation>
    </message>
    <message>
        <source>No picture can be corrected by it. Go on measuring, or use the earlier one, at Acquire.</source>
        <translation>Aucune image ne peut être corrigée avec elle. Continuez la mesure, ou utilisez la précédente, à « Acquisition ».</translation>
    </message>
    <message>
        <source>No picture can be corrected by it. Go on measuring any time.</source>
        <translation>Aucune image ne peut être corrigée avec elle. Continuez la mesure quand vous voulez.</translation>
    </message>
    <message>
        <source>Measuring again has not ended</source>
        <translation>La nouvelle mesure n’est pas terminée</translation>
    </message>
    <message>
        <source>What was measured is out of date: it belongs to earlier settings</source>
        <translation>La mesure est périmée : elle correspond à des réglages antérieurs</translation>
    </message>
    <message>
        <source>It still works, and what you see follows from the earlier measurement, until the new one is ready.</source>
        <translation>La mesure antérieure reste utilisable, et ce que vous voyez en découle, jusqu’à ce que la nouvelle soit prête.</translation>
    </message>
</context>
<context>
    <name>VenueKeeping</name>
    <message>
        <source>It is being measured.</source>
        <translation>Il est en cours de mesure.</translation>
    </message>
    <message>
        <source>It is open. Open another venue, then come back.</source>
        <translation>Il est ouvert. Ouvrez un autre lieu, puis revenez.</translation>
    </message>
    <message>
        <source>Give the venue a name.</source>
        <translation>Donnez un nom au lieu.</translation>
    </message>
    <message>
        <source>A name cannot hold a slash.</source>
        <translation>Un nom ne peut pas contenir de barre oblique.</translation>
    </message>
    <message>
        <source>A name cannot begin with a full stop: its folder would be hidden.</source>
        <translation>Un nom ne peut pas commencer par un point&#xa0;: son dossier serait masqué.</translation>
    </message>
    <message>
        <source>There is a folder of that name. Choose another name.</source>
        <translation>Un dossier porte déjà ce nom. Choisissez un autre nom.</translation>
    </message>
    <message>
        <source>Its show starts at log-in. Open it, and remove the installed show at Output first.</source>
        <translation>Sa diffusion démarre à l’ouverture de session. Ouvrez-le et retirez d’abord la diffusion installée à Sortie.</translation>
    </message>
</context>
<context>
    <name>ViewActions</name>
    <message>
        <source>Show everything</source>
        <translation>Tout afficher</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>Enregistrer</translation>
    </message>
    <message>
        <source>Picture as seen</source>
        <translation>Image telle qu’affichée</translation>
    </message>
    <message>
        <source>Save the picture</source>
        <translation>Enregistrer l’image</translation>
    </message>
    <message>
        <source>Pictures (*.png)</source>
        <translation>Images (*.png)</translation>
    </message>
    <message>
        <source>Values</source>
        <translation>Valeurs</translation>
    </message>
    <message>
        <source>Save the values</source>
        <translation>Enregistrer les valeurs</translation>
    </message>
    <message>
        <source>OpenEXR (*.exr)</source>
        <translation>OpenEXR (*.exr)</translation>
    </message>
    <message>
        <source>Whole screen, save</source>
        <translation>Plein écran, enregistrer</translation>
    </message>
    <message>
        <source>Whole screen (F11 in the picture)</source>
        <translation>Plein écran (F11 dans l’image)</translation>
    </message>
</context>
<context>
    <name>WindowProjector</name>
    <message>
        <source>The desktop scales this screen by %1, which blurs every pixel. Set its scale to 100 %.</source>
        <translation>Le bureau affiche cet écran à l’échelle %1, ce qui rend chaque pixel flou. Réglez son échelle à 100&#x202f;%.</translation>
    </message>
    <message>
        <source>A venue is being measured</source>
        <translation>La mesure d’un lieu est en cours</translation>
    </message>
</context>
<context>
    <name>acquisition.alarm-skipped</name>
    <message>
        <source>accepted before pattern {}: {}</source>
        <translation>accepté avant le motif {}&#x202f;: {}</translation>
    </message>
</context>
<context>
    <name>acquisition.ended-by-change</name>
    <message>
        <source>measuring ended with a change: {}; photographs from No. {} on are left out</source>
        <translation>la mesure s’est terminée sur un changement&#xa0;: {}&#x202f;; les photos à partir du n° {} sont laissées de côté</translation>
    </message>
</context>
<context>
    <name>acquisition.light-drifted</name>
    <message>
        <source>The light changed by {} % between the first and the last photograph; this was compensated for, but let the projector warm up before the next time</source>
        <translation>la lumière a changé de {}&#x202f;% entre la première et la dernière photo&#x202f;; il en a été tenu compte, mais laissez le projecteur chauffer avant la prochaine fois</translation>
    </message>
</context>
<context>
    <name>acquisition.overexposed</name>
    <message>
        <source>{} % of the camera pixels are overexposed even at the shortest exposure: close the camera&apos;s aperture a little, then measure again</source>
        <translation>{}&#x202f;% des pixels de la caméra sont surexposés même au temps de pose le plus court&#x202f;: fermez un peu le diaphragme de la caméra, puis mesurez à nouveau</translation>
    </message>
</context>
<context>
    <name>acquisition.pixels-flagged</name>
    <message>
        <source>{} % of the camera pixels do not see what was predicted for the test patterns: check that nothing moved or flickered; these pixels are left out of the compensation</source>
        <translation>{}&#x202f;% des pixels de la caméra voient autre chose que prévu dans les motifs de test&#x202f;: vérifiez que rien n’a bougé ni scintillé&#x202f;; ces pixels sont exclus de la compensation</translation>
    </message>
</context>
<context>
    <name>acquisition.poor-quality</name>
    <message>
        <source>What was measured does not fit together: corrected pictures are expected at {} dB, no better than uncorrected; see that projector, camera and surface stand still and that no other light changes, then measure again</source>
        <translation>Les mesures ne concordent pas&#x202f;: les images corrigées devraient atteindre {} dB, pas mieux que sans correction&#x202f;; veillez à ce que projecteur, caméra et surface restent immobiles et qu&apos;aucune autre lumière ne change, puis mesurez à nouveau</translation>
    </message>
</context>
<context>
    <name>acquisition.stopped-early</name>
    <message>
        <source>Measuring was stopped at blocks of {} px: what is finer is missing, and pictures are compensated less sharply; go on measuring any time as long as nothing has moved</source>
        <translation>La mesure a été arrêtée à des blocs de {} px&#x202f;: ce qui est plus fin manque, et les images sont compensées moins nettement&#x202f;; continuez la mesure à tout moment, tant que rien n’a bougé</translation>
    </message>
</context>
<context>
    <name>acquisition.stopped-with-forecast</name>
    <message numerus="yes">
        <source>Stopped at {} px blocks; {} dB expected, about {} dB with {} more photographs, {}; go on measuring any time as long as nothing has moved</source>
        <comment>Stopped at {} px blocks; {} dB expected, about {} dB with {} more photograph, {}; go on measuring any time as long as nothing has moved</comment>
        <translation>
            <numerusform>Arrêté à des blocs de {} px ; {} dB attendus, environ {} dB avec {} photo de plus, {} ; continuez la mesure à tout moment tant que rien n’a bougé</numerusform>
            <numerusform>Arrêté à des blocs de {} px ; {} dB attendus, environ {} dB avec {} photos de plus, {} ; continuez la mesure à tout moment tant que rien n’a bougé</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>acquisition.taken-again</name>
    <message numerus="yes">
        <source>{}: {} patterns from No. {} on were photographed again</source>
        <comment>{}: {} pattern from No. {} on was photographed again</comment>
        <translation>
            <numerusform>{} : {} motif a été rephotographié à partir du n° {}</numerusform>
            <numerusform>{} : {} motifs ont été rephotographiés à partir du n° {}</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>alarm.by-resuming</name>
    <message>
        <source>{} by resuming the calibration; {}</source>
        <translation>{} en reprenant la calibration&#x202f;; {}</translation>
    </message>
</context>
<context>
    <name>alarm.camera-sees-nothing</name>
    <message>
        <source>the camera sees nothing at all</source>
        <translation>la caméra ne voit rien du tout</translation>
    </message>
</context>
<context>
    <name>alarm.check-screen</name>
    <message>
        <source>check that the right screen is chosen and nothing covers the picture, then try again</source>
        <translation>vérifiez que le bon écran est choisi et que rien ne cache l’image, puis réessayez</translation>
    </message>
</context>
<context>
    <name>alarm.clear-the-view</name>
    <message>
        <source>take away what is in the light or in the view, then try again</source>
        <translation>retirez ce qui se trouve dans la lumière ou dans le champ, puis réessayez</translation>
    </message>
</context>
<context>
    <name>alarm.lamp-changed</name>
    <message>
        <source>the projector&apos;s light changed by {} % within a few photographs</source>
        <translation>la lumière du projecteur a changé de {}&#x202f;% en quelques photos</translation>
    </message>
</context>
<context>
    <name>alarm.leave-it-as-it-is</name>
    <message>
        <source>leave it as it is now, then try again: measuring begins again</source>
        <translation>laissez-le tel qu’il est maintenant, puis réessayez : la mesure recommence</translation>
    </message>
</context>
<context>
    <name>alarm.light-flickers</name>
    <message>
        <source>the light flickers or was switched: photographs of one pattern differ by {} %</source>
        <translation>la lumière scintille ou a été allumée ou éteinte&#xa0;: les photos d’un même motif diffèrent de {}&#x202f;%</translation>
    </message>
</context>
<context>
    <name>alarm.light-room-or-measure-again</name>
    <message>
        <source>switch on again what shone when measuring began, then try again; or stop, and measure again in the light as it is now</source>
        <translation>rallumez ce qui éclairait au début de la mesure, puis réessayez ; ou arrêtez et mesurez à nouveau dans la lumière actuelle</translation>
    </message>
</context>
<context>
    <name>alarm.moved</name>
    <message>
        <source>a camera or projector has moved: the view of camera {} is shifted by {}, {} pixels and turned by {} degrees</source>
        <translation>une caméra ou un projecteur a bougé&#x202f;: le champ de la caméra {} est décalé de {} et {} pixels et tourné de {} degrés</translation>
    </message>
</context>
<context>
    <name>alarm.moved-besides</name>
    <message>
        <source>{}; besides, {}</source>
        <translation>{} ; de plus, {}</translation>
    </message>
</context>
<context>
    <name>alarm.photograph-dark</name>
    <message>
        <source>one of two photographs of a pattern is dark: the lens was covered, or the projector&apos;s picture gone</source>
        <translation>l’une des deux photos d’un motif est sombre&#xa0;: l’objectif était masqué, ou l’image du projecteur absente</translation>
    </message>
</context>
<context>
    <name>alarm.photographs-differ</name>
    <message>
        <source>photographs of one pattern differ by {} %: the light flickers, or something moved between them</source>
        <translation>les photos d’un même motif diffèrent de {}&#x202f;%&#xa0;: la lumière scintille, ou quelque chose a bougé entre elles</translation>
    </message>
</context>
<context>
    <name>alarm.picture-mirrored</name>
    <message>
        <source>the picture of projector {} appears mirrored</source>
        <translation>l’image du projecteur {} apparaît en miroir</translation>
    </message>
</context>
<context>
    <name>alarm.projector-shows-nothing</name>
    <message>
        <source>the projector shows nothing, though the room&apos;s own light is still seen</source>
        <translation>le projecteur n’affiche rien, seule la lumière de la salle est encore visible</translation>
    </message>
</context>
<context>
    <name>alarm.put-back-or-measure-again</name>
    <message>
        <source>put it back, then try again; or stop, and measure again without it</source>
        <translation>remettez-le en place, puis réessayez ; ou arrêtez et mesurez à nouveau sans lui</translation>
    </message>
</context>
<context>
    <name>alarm.put-it-back</name>
    <message>
        <source>put it back to within half a pixel, then try again</source>
        <translation>remettez l’appareil en place à un demi-pixel près, puis réessayez</translation>
    </message>
</context>
<context>
    <name>alarm.put-it-back-and-restore-light</name>
    <message>
        <source>put it back to within half a pixel and restore the light of the room, then try again</source>
        <translation>remettez l’appareil en place à un demi-pixel près et la lumière de la salle comme avant, puis réessayez</translation>
    </message>
</context>
<context>
    <name>alarm.restore-room-light</name>
    <message>
        <source>restore the light of the room, keep doors and curtains closed, then try again</source>
        <translation>remettez-la comme avant, gardez portes et rideaux fermés, puis réessayez</translation>
    </message>
</context>
<context>
    <name>alarm.room-brighter</name>
    <message>
        <source>the light of the room became brighter</source>
        <translation>la lumière de la salle a augmenté</translation>
    </message>
</context>
<context>
    <name>alarm.room-darker</name>
    <message>
        <source>the light of the room became darker</source>
        <translation>la lumière de la salle a diminué</translation>
    </message>
</context>
<context>
    <name>alarm.safe-before-check</name>
    <message>
        <source>every photograph up to the previous check is safe</source>
        <translation>toutes les photos prises jusqu’à la vérification précédente sont en sécurité</translation>
    </message>
</context>
<context>
    <name>alarm.safe-before-light-transport</name>
    <message>
        <source>every photograph before the light transport is safe</source>
        <translation>toutes les photos antérieures au transport lumineux sont en sécurité</translation>
    </message>
</context>
<context>
    <name>alarm.something-gone</name>
    <message>
        <source>{} % of the view of camera {} are brighter than before: what stood there is gone</source>
        <translation>{} % de la vue de la caméra {} sont plus clairs qu’avant : ce qui s’y trouvait n’y est plus</translation>
    </message>
</context>
<context>
    <name>alarm.steady-all</name>
    <message>
        <source>see that camera, projector and surface stand still, switch off dimmed and fluorescent lamps and the projector&apos;s power saving, then try again</source>
        <translation>veillez à ce que la caméra, le projecteur et la surface ne bougent pas, éteignez les lampes à variateur et les tubes fluorescents, désactivez le mode économie d’énergie du projecteur, puis réessayez</translation>
    </message>
</context>
<context>
    <name>alarm.switch-off-dimmed-lamps</name>
    <message>
        <source>switch off dimmed and fluorescent lamps and the projector&apos;s power saving, then try again</source>
        <translation>éteignez les lampes à variateur et les tubes fluorescents, désactivez le mode économie d’énergie du projecteur, puis réessayez</translation>
    </message>
</context>
<context>
    <name>alarm.switch-off-eco-modes</name>
    <message>
        <source>switch off its automatic brightness and eco modes, let it warm up, then try again</source>
        <translation>désactivez sa luminosité automatique et ses modes éco, laissez-le chauffer, puis réessayez</translation>
    </message>
</context>
<context>
    <name>alarm.switch-off-rear-projection</name>
    <message>
        <source>switch off the projector&apos;s rear or ceiling mode, or allow a mirrored picture, then try again</source>
        <translation>désactivez la rétroprojection ou le montage au plafond du projecteur, ou autorisez une image en miroir, puis réessayez</translation>
    </message>
</context>
<context>
    <name>alarm.uncover-lens</name>
    <message>
        <source>uncover the lens, check that the projector is on, then try again</source>
        <translation>découvrez l’objectif, vérifiez que le projecteur est allumé, puis réessayez</translation>
    </message>
</context>
<context>
    <name>alarm.view-changed</name>
    <message>
        <source>{} % of the view of camera {} look different from before</source>
        <translation>{}&#x202f;% du champ de la caméra {} ont changé d’aspect</translation>
    </message>
</context>
<context>
    <name>alarm.wake-projector</name>
    <message>
        <source>wake the projector, switch off its and the screen&apos;s power saving, then try again</source>
        <translation>réveillez le projecteur, désactivez sa mise en veille et celle de l’écran, puis réessayez</translation>
    </message>
</context>
<context>
    <name>alarm.wrong-picture</name>
    <message>
        <source>projector {} does not show the picture that it is given</source>
        <translation>le projecteur {} n’affiche pas l’image qu’il reçoit</translation>
    </message>
</context>
<context>
    <name>calibration.allow-writing-then-resume</name>
    <message>
        <source>check that the folder may be written to, then go on</source>
        <translation>vérifiez que l’écriture dans le dossier est autorisée, puis continuez</translation>
    </message>
</context>
<context>
    <name>calibration.allow-writing-then-retry</name>
    <message>
        <source>check that the folder may be written to, then try again</source>
        <translation>vérifiez que l’écriture dans le dossier est autorisée, puis réessayez</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-list-folder</name>
    <message>
        <source>cannot look into the folder ({})</source>
        <translation>impossible de lire le contenu du dossier ({})</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-move-photograph</name>
    <message>
        <source>a photograph cannot be moved ({})</source>
        <translation>une photo ne peut pas être déplacée ({})</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-open-folder</name>
    <message>
        <source>cannot open the folder ({})</source>
        <translation>impossible d’ouvrir le dossier ({})</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-remove-photograph</name>
    <message>
        <source>a photograph cannot be removed ({})</source>
        <translation>une photo ne peut pas être supprimée ({})</translation>
    </message>
</context>
<context>
    <name>calibration.check-path-and-permission</name>
    <message>
        <source>check the path and that you may read it</source>
        <translation>vérifiez le chemin et que vous avez le droit de le lire</translation>
    </message>
</context>
<context>
    <name>calibration.check-permission-or-name</name>
    <message>
        <source>check that you may read it, or choose another name</source>
        <translation>vérifiez que vous avez le droit de le lire, ou choisissez un autre nom</translation>
    </message>
</context>
<context>
    <name>calibration.choose-another-or-copy-again</name>
    <message>
        <source>choose another calibration, or copy it again from where it was measured</source>
        <translation>choisissez une autre calibration, ou recopiez-la depuis l’endroit où elle a été mesurée</translation>
    </message>
</context>
<context>
    <name>calibration.disk-full</name>
    <message>
        <source>the disk is full</source>
        <translation>le disque est plein</translation>
    </message>
</context>
<context>
    <name>calibration.give-addresses-again</name>
    <message>
        <source>give the projectors&apos; addresses again</source>
        <translation>indiquez à nouveau les adresses des projecteurs</translation>
    </message>
</context>
<context>
    <name>calibration.make-room-then-resume</name>
    <message>
        <source>every photograph so far is safe: free at least {} MB there, then resume</source>
        <translation>toutes les photos prises jusqu’ici sont en sécurité&#x202f;: libérez-y au moins {}&#x202f;Mo, puis reprenez</translation>
    </message>
</context>
<context>
    <name>calibration.manifest-damaged</name>
    <message>
        <source>the file that describes the venue is damaged</source>
        <translation>le fichier qui décrit le lieu est endommagé</translation>
    </message>
</context>
<context>
    <name>calibration.network-unreadable</name>
    <message>
        <source>the addresses of the projectors on the network cannot be read ({})</source>
        <translation>les adresses des projecteurs sur le réseau sont illisibles ({})</translation>
    </message>
</context>
<context>
    <name>calibration.not-a-calibration</name>
    <message>
        <source>this is not a calibration of Relucent</source>
        <translation>ce n’est pas une calibration de Relucent</translation>
    </message>
</context>
<context>
    <name>calibration.result-file-missing</name>
    <message>
        <source>a file of the calibration&apos;s {} is missing</source>
        <translation>un fichier de la calibration ({}) est absent</translation>
    </message>
</context>
<context>
    <name>calibration.result-file-size-wrong</name>
    <message>
        <source>a file of the calibration&apos;s {} has {} bytes instead of {}</source>
        <translation>un fichier de la calibration ({}) a {} octets au lieu de {}</translation>
    </message>
</context>
<context>
    <name>cast.check-screen</name>
    <message>
        <source>see whether the screen is on, or the window open</source>
        <translation>vérifiez que l’écran est allumé, ou la fenêtre ouverte</translation>
    </message>
</context>
<context>
    <name>cast.choice-refused</name>
    <message>
        <source>the desktop no longer gives what was chosen for it</source>
        <translation>le bureau ne donne plus ce qui avait été choisi</translation>
    </message>
</context>
<context>
    <name>cast.choose-again</name>
    <message>
        <source>play it again, and choose there what is shown</source>
        <translation>relancez la lecture et choisissez-y ce qui est montré</translation>
    </message>
</context>
<context>
    <name>cast.choose-in-wizard</name>
    <message>
        <source>play it once in the wizard, on Output, and choose there; a show then takes the same</source>
        <translation>lisez-le une fois dans l’assistant, sous « Sortie », et choisissez-y ; une diffusion prend ensuite le même choix</translation>
    </message>
</context>
<context>
    <name>cast.ended</name>
    <message>
        <source>the desktop has ended it</source>
        <translation>le bureau y a mis fin</translation>
    </message>
</context>
<context>
    <name>cast.install-pipewire</name>
    <message>
        <source>install pipewire and wireplumber, and log in again</source>
        <translation>installez pipewire et wireplumber, puis reconnectez-vous à la session</translation>
    </message>
</context>
<context>
    <name>cast.install-portal</name>
    <message>
        <source>install xdg-desktop-portal and its part for this desktop, and log in again</source>
        <translation>installez xdg-desktop-portal et sa partie pour ce bureau, puis reconnectez-vous à la session</translation>
    </message>
</context>
<context>
    <name>cast.log-in-again</name>
    <message>
        <source>log in again</source>
        <translation>reconnectez-vous à la session</translation>
    </message>
</context>
<context>
    <name>cast.no-pipewire</name>
    <message>
        <source>PipeWire, which brings the picture, does not answer</source>
        <translation>PipeWire, qui apporte l’image, ne répond pas</translation>
    </message>
</context>
<context>
    <name>cast.no-portal</name>
    <message>
        <source>this desktop has no portal that gives the picture of a screen</source>
        <translation>ce bureau n’a pas de portail qui donne l’image d’un écran</translation>
    </message>
</context>
<context>
    <name>cast.no-windows</name>
    <message>
        <source>this desktop gives pictures of screens, not of windows</source>
        <translation>ce bureau donne des images d’écrans, pas de fenêtres</translation>
    </message>
</context>
<context>
    <name>cast.not-chosen</name>
    <message>
        <source>nobody has chosen in the desktop&apos;s dialog what is shown</source>
        <translation>personne n’a choisi dans le dialogue du bureau ce qui est montré</translation>
    </message>
</context>
<context>
    <name>cast.play-screen</name>
    <message>
        <source>play the screen on which the window is</source>
        <translation>lisez l’écran sur lequel se trouve la fenêtre</translation>
    </message>
</context>
<context>
    <name>cast.portal-failed</name>
    <message>
        <source>the desktop&apos;s portal gives no picture ({})</source>
        <translation>le portail du bureau ne donne pas d’image ({})</translation>
    </message>
</context>
<context>
    <name>cast.portal-silent</name>
    <message>
        <source>the desktop&apos;s portal has not answered for {} s</source>
        <translation>le portail du bureau n’a pas répondu pendant {} s</translation>
    </message>
</context>
<context>
    <name>cast.refused</name>
    <message>
        <source>it was refused in the desktop&apos;s dialog</source>
        <translation>cela a été refusé dans le dialogue du bureau</translation>
    </message>
</context>
<context>
    <name>cast.unusable</name>
    <message>
        <source>what the desktop sends is no picture that can be shown</source>
        <translation>ce que le bureau envoie n’est pas une image qui puisse être montrée</translation>
    </message>
</context>
<context>
    <name>cast.update-desktop</name>
    <message>
        <source>update the desktop&apos;s portal and PipeWire</source>
        <translation>mettez à jour le portail du bureau et PipeWire</translation>
    </message>
</context>
<context>
    <name>check.colour-wheel</name>
    <message>
        <source>The colours come one after the other, as through a colour wheel ({} % in {} ms): expose whole frames, multiples of {} ms.</source>
        <translation>Les couleurs se succèdent, comme à travers une roue chromatique ({} % en {} ms) : exposez des trames entières, multiples de {} ms.</translation>
    </message>
</context>
<context>
    <name>check.dithering</name>
    <message>
        <source>The projector mixes greys in time, pixel by pixel ({} %): expose several whole frames, and switch its smoothing and 3D modes off.</source>
        <translation>Le projecteur mélange les gris dans le temps, pixel par pixel ({} %) : exposez plusieurs trames entières et désactivez son lissage et ses modes 3D.</translation>
    </message>
</context>
<context>
    <name>check.lamp-flickers</name>
    <message>
        <source>The lamp flickers within a frame, by {} % in {} ms: expose whole frames, multiples of {} ms.</source>
        <translation>La lampe scintille au sein d’une trame, de {} % en {} ms : exposez des trames entières, multiples de {} ms.</translation>
    </message>
</context>
<context>
    <name>check.light-even</name>
    <message>
        <source>The light is even: no flicker, colour wheel, bands or dithering is seen.</source>
        <translation>La lumière est régulière : ni scintillement, ni roue chromatique, ni bandes, ni tramage.</translation>
    </message>
</context>
<context>
    <name>check.light-unsteady</name>
    <message>
        <source>The light changes by {} % between exposures of whole frames: let the lamp warm up, and switch off dynamic brightness and the lamps in the room.</source>
        <translation>La lumière varie de {} % entre des poses de trames entières : laissez chauffer la lampe, désactivez la luminosité dynamique et éteignez les lampes de la salle.</translation>
    </message>
</context>
<context>
    <name>check.no-brief-exposure</name>
    <message>
        <source>The camera cannot expose for a part of a frame, or sees too little then: flicker within a frame cannot be detected.</source>
        <translation>La caméra ne peut pas exposer moins d’une trame, ou voit alors trop peu : un scintillement au sein d’une trame ne peut être décelé.</translation>
    </message>
</context>
<context>
    <name>check.other-screen-seen</name>
    <message>
        <source>The camera sees {} and not {}.</source>
        <translation>La caméra voit {} et non {}.</translation>
    </message>
</context>
<context>
    <name>check.picture-takes</name>
    <message>
        <source>A picture takes {} ms to appear: each one is waited for that long.</source>
        <translation>Une image met {} ms à apparaître&#xa0;: chacune est attendue aussi longtemps.</translation>
    </message>
</context>
<context>
    <name>check.pictures-late</name>
    <message numerus="yes">
        <source>Pictures arrive {} photographs late: measure the latency, so that it is waited for.</source>
        <comment>Pictures arrive {} photograph late: measure the latency, so that it is waited for.</comment>
        <translation>
            <numerusform>Les images arrivent {} photo trop tard : la latence doit être mesurée et attendue.</numerusform>
            <numerusform>Les images arrivent {} photos trop tard : la latence doit être mesurée et attendue.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>check.rolling-shutter</name>
    <message>
        <source>The camera exposes its rows one after the other (rolling shutter): brief exposures have bands of {} %. Expose whole frames, multiples of {} ms.</source>
        <translation>La caméra expose ses lignes l’une après l’autre (obturateur déroulant) : les poses brèves ont des bandes de {} %. Exposez des trames entières, multiples de {} ms.</translation>
    </message>
</context>
<context>
    <name>check.screen-mirrored</name>
    <message>
        <source>The picture appears mirrored. If it is not meant to (rear projection, a mirror), switch that off in the projector&apos;s menu.</source>
        <translation>L’image apparaît en miroir. Si ce n’est pas voulu (rétroprojection, miroir), désactivez-le dans le menu du projecteur.</translation>
    </message>
</context>
<context>
    <name>check.screen-not-seen</name>
    <message>
        <source>The camera does not see {}.</source>
        <translation>La caméra ne voit pas {}.</translation>
    </message>
</context>
<context>
    <name>check.screen-seen</name>
    <message>
        <source>The camera sees {}: {} % of its view follow the test pattern.</source>
        <translation>La caméra voit {} : {} % de son champ suivent la mire.</translation>
    </message>
</context>
<context>
    <name>check.white-changes</name>
    <message>
        <source>White changes by {} % from photograph to photograph: expose whole frames of the projector, multiples of {} ms, and switch its dynamic brightness off.</source>
        <translation>Le blanc varie de {} % d’une photo à l’autre : exposez des trames entières du projecteur, multiples de {} ms, et désactivez sa luminosité dynamique.</translation>
    </message>
</context>
<context>
    <name>compensation.draw-masks-of-cameras</name>
    <message>
        <source>draw masks in the views of the cameras that measured this calibration</source>
        <translation>dessinez les masques dans les vues des caméras qui ont mesuré cette calibration</translation>
    </message>
</context>
<context>
    <name>compensation.mask-crosses-itself</name>
    <message>
        <source>its outline crosses itself</source>
        <translation>son contour se croise lui-même</translation>
    </message>
</context>
<context>
    <name>compensation.mask-encloses-nothing</name>
    <message>
        <source>its outline encloses nothing</source>
        <translation>son contour n’entoure rien</translation>
    </message>
</context>
<context>
    <name>compensation.mask-feather-out-of-range</name>
    <message>
        <source>its feather must lie between 0 and half of the view&apos;s larger side</source>
        <translation>son bord doux doit être compris entre 0 et la moitié du grand côté de la vue</translation>
    </message>
</context>
<context>
    <name>compensation.mask-not-finite</name>
    <message>
        <source>its points must be finite numbers</source>
        <translation>ses points doivent être des nombres finis</translation>
    </message>
</context>
<context>
    <name>compensation.mask-of-no-camera</name>
    <message>
        <source>a mask was drawn in the view of camera {}, but there are {} cameras</source>
        <translation>un masque a été dessiné dans la vue de la caméra {}, mais il y a {} caméras</translation>
    </message>
</context>
<context>
    <name>compensation.mask-outside-view</name>
    <message>
        <source>its points must lie within the view, from 0 to 1 along both sides</source>
        <translation>ses points doivent être dans la vue, de 0 à 1 sur les deux côtés</translation>
    </message>
</context>
<context>
    <name>compensation.mask-point-twice</name>
    <message>
        <source>two points of its outline are the same</source>
        <translation>deux points de son contour sont les mêmes</translation>
    </message>
</context>
<context>
    <name>compensation.mask-too-few-points</name>
    <message>
        <source>its outline needs three points at least</source>
        <translation>son contour demande au moins trois points</translation>
    </message>
</context>
<context>
    <name>compensation.mask-too-many-points</name>
    <message>
        <source>its outline may have {} points at most</source>
        <translation>son contour peut avoir au plus {} points</translation>
    </message>
</context>
<context>
    <name>compensation.masks-cover-everything</name>
    <message>
        <source>the masks cover the whole picture</source>
        <translation>les masques couvrent toute l’image</translation>
    </message>
</context>
<context>
    <name>compensation.of-mask</name>
    <message>
        <source>mask {}: {}</source>
        <translation>masque {} : {}</translation>
    </message>
</context>
<context>
    <name>compensation.shrink-masks</name>
    <message>
        <source>make a mask smaller, or remove one</source>
        <translation>réduisez un masque ou supprimez-en un</translation>
    </message>
</context>
<context>
    <name>content.choose-picture-folder</name>
    <message>
        <source>choose a folder with PNG, JPEG, TIFF or EXR files</source>
        <translation>choisissez un dossier contenant des fichiers PNG, JPEG, TIFF ou EXR</translation>
    </message>
</context>
<context>
    <name>content.choose-supported-picture</name>
    <message>
        <source>choose a PNG, JPEG, TIFF or EXR picture</source>
        <translation>choisissez une image PNG, JPEG, TIFF ou EXR</translation>
    </message>
</context>
<context>
    <name>content.connect-capture-device</name>
    <message>
        <source>plug it in, close other programs that use it, and try again</source>
        <translation>branchez-le, fermez les autres programmes qui l’utilisent, puis réessayez</translation>
    </message>
</context>
<context>
    <name>content.log-in-to-xorg</name>
    <message>
        <source>log in to a desktop, or play files</source>
        <translation>connectez-vous à un bureau, ou lisez des fichiers</translation>
    </message>
</context>
<context>
    <name>content.no-pictures</name>
    <message>
        <source>no pictures in this folder</source>
        <translation>aucune image dans ce dossier</translation>
    </message>
</context>
<context>
    <name>content.no-x-server</name>
    <message>
        <source>the live picture of a screen needs an X server, and none answers</source>
        <translation>l’image en direct d’un écran demande un serveur X, et aucun ne répond</translation>
    </message>
</context>
<context>
    <name>content.nothing-captured</name>
    <message>
        <source>the capture device gives no picture</source>
        <translation>le périphérique de capture ne fournit aucune image</translation>
    </message>
</context>
<context>
    <name>content.open-first</name>
    <message>
        <source>open it first</source>
        <translation>ouvrez-la d’abord</translation>
    </message>
</context>
<context>
    <name>content.open-first-or-choose</name>
    <message>
        <source>open it first; there are: {}</source>
        <translation>ouvrez-la d’abord ; il y a : {}</translation>
    </message>
</context>
<context>
    <name>content.picture-unreadable</name>
    <message>
        <source>not a picture that can be read</source>
        <translation>ce n’est pas une image lisible</translation>
    </message>
</context>
<context>
    <name>content.sequence-empty</name>
    <message>
        <source>the sequence has no pictures</source>
        <translation>la séquence ne contient aucune image</translation>
    </message>
</context>
<context>
    <name>content.unknown-window</name>
    <message>
        <source>there is no window &apos;{}&apos;</source>
        <translation>il n’y a pas de fenêtre « {} »</translation>
    </message>
</context>
<context>
    <name>device.aim-uncover-and-expose-longer</name>
    <message>
        <source>aim it at the projection, take off its lens cap, and expose longer</source>
        <translation>tournez-la vers la projection, retirez son bouchon d’objectif et allongez la pose</translation>
    </message>
</context>
<context>
    <name>device.allow-command-more-time</name>
    <message>
        <source>check the device, or allow the command more time: {}</source>
        <translation>vérifiez l’appareil, ou accordez plus de temps à la commande&#x202f;: {}</translation>
    </message>
</context>
<context>
    <name>device.another-program-holds-camera</name>
    <message>
        <source>another program holds the camera</source>
        <translation>un autre programme occupe la caméra</translation>
    </message>
</context>
<context>
    <name>device.ask-for-fewer-pixels</name>
    <message>
        <source>ask for that or less</source>
        <translation>n’en demandez pas plus</translation>
    </message>
</context>
<context>
    <name>device.ask-for-given-size</name>
    <message>
        <source>ask for the size that it gives</source>
        <translation>demandez la taille qu’elle fournit</translation>
    </message>
</context>
<context>
    <name>device.ask-for-listed-size</name>
    <message>
        <source>ask for a size that it has: v4l2-ctl --list-formats-ext names them</source>
        <translation>demandez une taille qu’il propose&#x202f;: v4l2-ctl --list-formats-ext les affiche</translation>
    </message>
</context>
<context>
    <name>device.automatic-exposure-stays</name>
    <message>
        <source>the video device&apos;s automatic exposure cannot be switched off</source>
        <translation>l’exposition automatique du périphérique vidéo ne peut pas être désactivée</translation>
    </message>
</context>
<context>
    <name>device.automatic-focus-stays</name>
    <message>
        <source>the video device&apos;s automatic focus cannot be switched off</source>
        <translation>la mise au point automatique du périphérique vidéo ne peut pas être désactivée</translation>
    </message>
</context>
<context>
    <name>device.automatic-function-stays</name>
    <message>
        <source>{} cannot be switched off</source>
        <translation>{} ne peut pas être désactivé</translation>
    </message>
</context>
<context>
    <name>device.automatic-iso</name>
    <message>
        <source>the camera chooses its sensitivity itself (automatic ISO)</source>
        <translation>la caméra choisit elle-même sa sensibilité (ISO automatique)</translation>
    </message>
</context>
<context>
    <name>device.automatic-white-balance-stays</name>
    <message>
        <source>the video device&apos;s automatic white balance cannot be switched off</source>
        <translation>la balance des blancs automatique du périphérique vidéo ne peut pas être désactivée</translation>
    </message>
</context>
<context>
    <name>device.battery-empty</name>
    <message>
        <source>the camera&apos;s battery seems to be empty ({} % when it was last asked)</source>
        <translation>la batterie de la caméra semble vide ({}&#x202f;% à la dernière lecture)</translation>
    </message>
</context>
<context>
    <name>device.battery-low</name>
    <message>
        <source>has {} % left in its battery: a measurement needs a full one or a mains adapter</source>
        <translation>n’a plus que {} % de batterie&#x202f;: une mesure demande une batterie pleine ou une alimentation secteur</translation>
    </message>
</context>
<context>
    <name>device.built-without-genicam</name>
    <message>
        <source>this build of Relucent does not know GenICam cameras</source>
        <translation>cette version compilée de Relucent ne gère pas les caméras GenICam</translation>
    </message>
</context>
<context>
    <name>device.built-without-gphoto</name>
    <message>
        <source>this build of Relucent does not know DSLR and mirrorless cameras</source>
        <translation>cette version compilée de Relucent ne gère pas les reflex ni les hybrides</translation>
    </message>
</context>
<context>
    <name>device.camera-asleep</name>
    <message>
        <source>the camera is there but does not answer, it may be asleep</source>
        <translation>la caméra est là mais ne répond pas, elle est peut-être en veille</translation>
    </message>
</context>
<context>
    <name>device.camera-command-empty</name>
    <message>
        <source>the camera&apos;s command is empty</source>
        <translation>la commande de la caméra est vide</translation>
    </message>
</context>
<context>
    <name>device.camera-command-lacks</name>
    <message>
        <source>the camera&apos;s command does not contain {}</source>
        <translation>la commande de la caméra ne contient pas {}</translation>
    </message>
</context>
<context>
    <name>device.camera-given-up</name>
    <message>
        <source>the camera does not answer</source>
        <translation>la caméra ne répond pas</translation>
    </message>
</context>
<context>
    <name>device.camera-given-up-advice</name>
    <message>
        <source>push in its cable at both ends and switch it on, then go on: every photograph so far is kept</source>
        <translation>enfoncez le câble aux deux bouts et allumez-la, puis continuez&#xa0;: toutes les photos déjà prises sont gardées</translation>
    </message>
</context>
<context>
    <name>device.camera-gone</name>
    <message>
        <source>the camera has been unplugged or switched off, or has fallen asleep</source>
        <translation>la caméra a été débranchée ou éteinte, ou s’est mise en veille</translation>
    </message>
</context>
<context>
    <name>device.camera-no-longer-answers</name>
    <message>
        <source>the camera no longer answers ({}: {})</source>
        <translation>la caméra ne répond plus ({}&#x202f;: {})</translation>
    </message>
</context>
<context>
    <name>device.camera-not-back</name>
    <message>
        <source>the camera has been gone for {} s: {}</source>
        <translation>la caméra a disparu depuis {}&#x202f;s&#x202f;: {}</translation>
    </message>
</context>
<context>
    <name>device.camera-refuses</name>
    <message>
        <source>the camera refuses ({}: {})</source>
        <translation>la caméra refuse ({}&#x202f;: {})</translation>
    </message>
</context>
<context>
    <name>device.camera-sends-no-stream</name>
    <message>
        <source>the camera sends no stream</source>
        <translation>la caméra n’envoie pas de flux</translation>
    </message>
</context>
<context>
    <name>device.camera-size-out-of-range</name>
    <message>
        <source>a camera of {} pixels is impossible: each side is {} to {}</source>
        <translation>une caméra de {} pixels est impossible&#x202f;: chaque côté en a {} à {}</translation>
    </message>
</context>
<context>
    <name>device.camera-stays-busy</name>
    <message>
        <source>the camera stays busy</source>
        <translation>la caméra reste occupée</translation>
    </message>
</context>
<context>
    <name>device.camera-twice</name>
    <message>
        <source>{} is camera {} and camera {}: choose another camera, or one with a serial number of its own</source>
        <translation>{} est la caméra {} et la caméra {}&#x202f;: choisissez une autre caméra, ou une qui a son propre numéro de série</translation>
    </message>
</context>
<context>
    <name>device.cannot-create-temporary-folder</name>
    <message>
        <source>cannot create a temporary folder ({})</source>
        <translation>impossible de créer un dossier temporaire ({})</translation>
    </message>
</context>
<context>
    <name>device.cannot-remove-file</name>
    <message>
        <source>cannot remove the file ({})</source>
        <translation>impossible de supprimer le fichier ({})</translation>
    </message>
</context>
<context>
    <name>device.cannot-reopen-video-device</name>
    <message>
        <source>the video device cannot be opened again</source>
        <translation>le périphérique vidéo ne peut pas être rouvert</translation>
    </message>
</context>
<context>
    <name>device.cannot-start-command</name>
    <message>
        <source>the command cannot be started ({})</source>
        <translation>la commande ne peut pas être lancée ({})</translation>
    </message>
</context>
<context>
    <name>device.cannot-write-recording</name>
    <message>
        <source>the recording cannot be written ({})</source>
        <translation>l’enregistrement ne peut pas être écrit ({})</translation>
    </message>
</context>
<context>
    <name>device.card-full</name>
    <message>
        <source>the camera has no room left for a photograph: its memory card is full</source>
        <translation>la caméra n’a plus de place pour une photo&#x202f;: sa carte mémoire est pleine</translation>
    </message>
</context>
<context>
    <name>device.change-or-empty-card</name>
    <message>
        <source>change or empty the memory card</source>
        <translation>changez ou videz la carte mémoire</translation>
    </message>
</context>
<context>
    <name>device.charge-or-change-battery</name>
    <message>
        <source>charge or change the battery, or better, use a mains adapter, and switch the camera on again</source>
        <translation>rechargez ou changez la batterie, utilisez de préférence un adaptateur secteur, et rallumez la caméra</translation>
    </message>
</context>
<context>
    <name>device.check-cable-and-power</name>
    <message>
        <source>check its cable and its power</source>
        <translation>vérifiez son câble et son alimentation</translation>
    </message>
</context>
<context>
    <name>device.check-cable-and-power-saving</name>
    <message>
        <source>check its cable, and switch off its power saving</source>
        <translation>vérifiez son câble et désactivez sa mise en veille</translation>
    </message>
</context>
<context>
    <name>device.check-cable-network-and-programs</name>
    <message>
        <source>check the camera&apos;s cable and network card, and that no other program uses it</source>
        <translation>vérifiez le câble et la carte réseau de la caméra, et qu’aucun autre programme ne l’utilise</translation>
    </message>
</context>
<context>
    <name>device.check-cable-power-address</name>
    <message>
        <source>check its cable, its power and its address; `relucent-cli devices` lists what is there</source>
        <translation>vérifiez son câble, son alimentation et son adresse&#x202f;; `relucent-cli devices` affiche ce qui est présent</translation>
    </message>
</context>
<context>
    <name>device.check-projector-and-aim</name>
    <message>
        <source>check that the projector is on and shows that output, aim the camera at it, and take its cap off; or choose another screen</source>
        <translation>vérifiez que le projecteur est allumé et affiche cette sortie, tournez la caméra vers lui et retirez le bouchon d’objectif&#x202f;; ou choisissez un autre écran</translation>
    </message>
</context>
<context>
    <name>device.check-projector-or-aim-another</name>
    <message>
        <source>check that this projector is on and shows that output, and aim a camera at it; or remove it from the venue</source>
        <translation>vérifiez que ce projecteur est allumé et montre cette sortie, et pointez une caméra dessus&#x202f;; ou retirez-le du lieu</translation>
    </message>
</context>
<context>
    <name>device.choose-gain-in-range</name>
    <message>
        <source>choose a gain from {} to {}</source>
        <translation>la caméra permet de {} à {}</translation>
    </message>
</context>
<context>
    <name>device.choose-offered-iso</name>
    <message>
        <source>choose one of those that it has: {}</source>
        <translation>elle propose {}</translation>
    </message>
</context>
<context>
    <name>device.choose-or-aim-at-screen</name>
    <message>
        <source>choose {}, or aim the camera at {}</source>
        <translation>choisissez {}, ou tournez la caméra vers {}</translation>
    </message>
</context>
<context>
    <name>device.choose-readable-pixel-format</name>
    <message>
        <source>it has {}; unpacked Mono, Bayer and RGB of 8 to 16 bits are read</source>
        <translation>elle propose {}&#x202f;; les formats lus sont Mono, Bayer et RGB non compactés, de 8 à 16 bits</translation>
    </message>
</context>
<context>
    <name>device.claimed-exposures-invalid</name>
    <message>
        <source>the camera claims exposures of {} to {} s</source>
        <translation>la caméra annonce des temps de pose de {} à {}&#x202f;s</translation>
    </message>
</context>
<context>
    <name>device.close-menus-and-live-view</name>
    <message>
        <source>close its menus and its playback, and leave live view</source>
        <translation>fermez ses menus et sa lecture, et quittez la visée écran (Live View)</translation>
    </message>
</context>
<context>
    <name>device.close-menus-and-restart</name>
    <message>
        <source>close its menus, and switch it off and on</source>
        <translation>fermez ses menus, éteignez-la et rallumez-la</translation>
    </message>
</context>
<context>
    <name>device.close-other-program</name>
    <message>
        <source>close the other program, a camera viewer or a second Relucent perhaps</source>
        <translation>fermez l’autre programme, peut-être une visionneuse de caméra ou un second Relucent</translation>
    </message>
</context>
<context>
    <name>device.close-other-programs</name>
    <message>
        <source>close other programs and try again</source>
        <translation>fermez d’autres programmes et réessayez</translation>
    </message>
</context>
<context>
    <name>device.colour-filter-not-bayer</name>
    <message>
        <source>the camera&apos;s colour filter is not a Bayer filter</source>
        <translation>le filtre coloré de la caméra n’est pas un filtre de Bayer</translation>
    </message>
</context>
<context>
    <name>device.command-failed</name>
    <message>
        <source>the command failed with status {}</source>
        <translation>la commande a échoué avec le statut {}</translation>
    </message>
</context>
<context>
    <name>device.command-failed-saying</name>
    <message>
        <source>the command failed with status {}, saying &quot;{}&quot;</source>
        <translation>la commande a échoué avec le statut {}, en signalant «&#x202f;{}&#x202f;»</translation>
    </message>
</context>
<context>
    <name>device.command-killed</name>
    <message>
        <source>the command was killed by signal {}</source>
        <translation>la commande a été tuée par le signal {}</translation>
    </message>
</context>
<context>
    <name>device.command-killed-saying</name>
    <message>
        <source>the command was killed by signal {}, saying &quot;{}&quot;</source>
        <translation>la commande a été tuée par le signal {}, en signalant «&#x202f;{}&#x202f;»</translation>
    </message>
</context>
<context>
    <name>device.command-too-long</name>
    <message>
        <source>the command took longer than {} s</source>
        <translation>la commande a duré plus de {}&#x202f;s</translation>
    </message>
</context>
<context>
    <name>device.command-too-long-saying</name>
    <message>
        <source>the command took longer than {} s, saying &quot;{}&quot;</source>
        <translation>la commande a duré plus de {}&#x202f;s, en signalant «&#x202f;{}&#x202f;»</translation>
    </message>
</context>
<context>
    <name>device.command-without-consent</name>
    <message>
        <source>the calibration runs a program to which nobody at this computer has agreed: {}</source>
        <translation>le calibrage lance un programme auquel personne n’a consenti sur cet ordinateur : {}</translation>
    </message>
</context>
<context>
    <name>device.command-wrote-nothing</name>
    <message>
        <source>the command ended well but wrote nothing, not {}</source>
        <translation>la commande s’est bien terminée mais n’a rien écrit&#x202f;; {} était attendu</translation>
    </message>
</context>
<context>
    <name>device.command-wrote-something-else</name>
    <message>
        <source>the command ended well but wrote {}, not {}</source>
        <translation>la commande s’est bien terminée mais a écrit {}&#x202f;; {} était attendu</translation>
    </message>
</context>
<context>
    <name>device.copy-or-retake-photograph</name>
    <message>
        <source>copy it again, or take the photograph again; a camera newer than this LibRaw needs DNG files</source>
        <translation>recopiez-le, ou reprenez la photo&#x202f;; une caméra plus récente que ce LibRaw demande des fichiers DNG</translation>
    </message>
</context>
<context>
    <name>device.delivers-8-bits</name>
    <message>
        <source>delivers 8 bits: dark places stay uncertain</source>
        <translation>fournit 8 bits&#x202f;: les zones sombres restent incertaines</translation>
    </message>
</context>
<context>
    <name>device.develop-linearly</name>
    <message>
        <source>develop the files linearly, as 16-bit TIFF, or use another camera</source>
        <translation>développez les fichiers en linéaire, en TIFF 16 bits, ou utilisez une autre caméra</translation>
    </message>
</context>
<context>
    <name>device.exposure-range-invalid</name>
    <message>
        <source>the shortest exposure must be above zero and no longer than the longest</source>
        <translation>le temps de pose le plus court doit être supérieur à zéro et ne pas dépasser le plus long</translation>
    </message>
</context>
<context>
    <name>device.exposure-refused</name>
    <message>
        <source>the camera was asked to expose {} s but exposes {} s</source>
        <translation>une pose de {}&#x202f;s a été demandée à la caméra, qui s’en tient à {}&#x202f;s</translation>
    </message>
</context>
<context>
    <name>device.exposure-time-cannot-be-set</name>
    <message>
        <source>the camera&apos;s exposure time cannot be set</source>
        <translation>le temps de pose de la caméra ne peut pas être réglé</translation>
    </message>
</context>
<context>
    <name>device.exposure-time-fixed</name>
    <message>
        <source>the camera exposes {} s whatever exposure it is asked for</source>
        <translation>la caméra s’en tient à {}&#x202f;s quelle que soit la pose demandée</translation>
    </message>
</context>
<context>
    <name>device.focuses-by-itself</name>
    <message>
        <source>focuses by itself: switch its lens to manual focus</source>
        <translation>fait la mise au point seule&#x202f;: passez l’objectif en mise au point manuelle</translation>
    </message>
</context>
<context>
    <name>device.free-space-or-record-elsewhere</name>
    <message>
        <source>free some space, or record elsewhere</source>
        <translation>libérez de l’espace, ou enregistrez ailleurs</translation>
    </message>
</context>
<context>
    <name>device.free-space-or-set-tmpdir</name>
    <message>
        <source>free some space there, or set TMPDIR to a folder that you may write to</source>
        <translation>libérez de l’espace à cet endroit, ou indiquez dans TMPDIR un dossier où vous avez le droit d’écrire</translation>
    </message>
</context>
<context>
    <name>device.gain-out-of-range</name>
    <message>
        <source>a gain of {} is wanted</source>
        <translation>un gain de {} est demandé</translation>
    </message>
</context>
<context>
    <name>device.gain-refused</name>
    <message>
        <source>was asked for a gain of {} but uses {}</source>
        <translation>a reçu la demande d’un gain de {} et s’en tient à {}</translation>
    </message>
</context>
<context>
    <name>device.genicam-missing</name>
    <message>
        <source>GigE Vision and USB3 Vision cameras: this build lacks Aravis; install libaravis-dev and build again</source>
        <translation>Caméras GigE Vision et USB3 Vision&#x202f;: ce programme a été construit sans Aravis&#x202f;; installez libaravis-dev et reconstruisez-le</translation>
    </message>
</context>
<context>
    <name>device.gphoto-missing</name>
    <message>
        <source>DSLR and mirrorless cameras: this build lacks libgphoto2 or LibRaw; install libgphoto2-dev and libraw-dev and build again</source>
        <translation>Appareils reflex et hybrides&#x202f;: ce programme a été construit sans libgphoto2 ou LibRaw&#x202f;; installez libgphoto2-dev et libraw-dev et reconstruisez-le</translation>
    </message>
</context>
<context>
    <name>device.held-by-desktop</name>
    <message>
        <source>another program is using the camera, usually the desktop, which mounts it like a memory stick</source>
        <translation>un autre programme occupe la caméra, le plus souvent le bureau, qui la monte comme une clé USB</translation>
    </message>
</context>
<context>
    <name>device.install-aravis</name>
    <message>
        <source>install Aravis (libaravis-dev) and build again, or use another kind of camera</source>
        <translation>installez Aravis (libaravis-dev) et recompilez, ou utilisez un autre type de caméra</translation>
    </message>
</context>
<context>
    <name>device.install-libgphoto2</name>
    <message>
        <source>install libgphoto2 and LibRaw (libgphoto2-dev, libraw-dev) and build again, or use a command</source>
        <translation>installez libgphoto2 et LibRaw (libgphoto2-dev, libraw-dev) et recompilez, ou utilisez une commande</translation>
    </message>
</context>
<context>
    <name>device.iso-refused</name>
    <message>
        <source>was asked for ISO {} but uses ISO {}</source>
        <translation>a reçu la demande ISO {} et s’en tient à ISO {}</translation>
    </message>
</context>
<context>
    <name>device.iso-wanted-not-there</name>
    <message>
        <source>ISO {} is wanted and the camera does not have it</source>
        <translation>ISO {} est demandé et la caméra ne l’a pas</translation>
    </message>
</context>
<context>
    <name>device.lift-exposure-limits</name>
    <message>
        <source>switch its automatic exposure and its frame rate limit off</source>
        <translation>désactivez son exposition automatique et la limite de sa fréquence d’images</translation>
    </message>
</context>
<context>
    <name>device.longest-exposure-overstated</name>
    <message>
        <source>claims exposures up to {} s but reaches only {} s</source>
        <translation>annonce des temps de pose jusqu’à {} s mais s’en tient à {} s</translation>
    </message>
</context>
<context>
    <name>device.may-fire-flash</name>
    <message>
        <source>may fire its flash: close it</source>
        <translation>peut déclencher son flash&#x202f;: refermez-le</translation>
    </message>
</context>
<context>
    <name>device.may-take-dark-frame</name>
    <message>
        <source>may take a dark frame after long exposures, which doubles their time</source>
        <translation>peut prendre une image noire après les poses longues, ce qui double leur durée</translation>
    </message>
</context>
<context>
    <name>device.may-take-several-photographs</name>
    <message>
        <source>may take several photographs at once: switch it to single shots</source>
        <translation>peut prendre plusieurs photos à la fois&#x202f;: passez en vue par vue</translation>
    </message>
</context>
<context>
    <name>device.mode-dial-not-manual</name>
    <message>
        <source>the camera&apos;s mode dial is set to {}, where the camera chooses exposures itself</source>
        <translation>la molette de mode de la caméra est sur {}, où la caméra choisit elle-même la pose</translation>
    </message>
</context>
<context>
    <name>device.name-camera-by-port</name>
    <message>
        <source>name one by its port: gphoto2:{} or gphoto2:{}</source>
        <translation>indiquez l’une d’elles par son port&#x202f;: gphoto2:{} ou gphoto2:{}</translation>
    </message>
</context>
<context>
    <name>device.name-connected-camera</name>
    <message>
        <source>name that one: gphoto2:{}</source>
        <translation>indiquez celle-ci&#x202f;: gphoto2:{}</translation>
    </message>
</context>
<context>
    <name>device.no-capture-times</name>
    <message>
        <source>does not say when pictures were captured: some are dropped before each photograph</source>
        <translation>ne dit pas quand les images ont été prises&#x202f;: quelques-unes sont écartées avant chaque photo</translation>
    </message>
</context>
<context>
    <name>device.no-contrast</name>
    <message>
        <source>the camera sees no difference between white and black</source>
        <translation>la caméra ne voit aucune différence entre le blanc et le noir</translation>
    </message>
</context>
<context>
    <name>device.no-focus</name>
    <message>
        <source>the camera could not focus and took no photograph ({})</source>
        <translation>la caméra n’a pas pu faire la mise au point et n’a pas pris de photo ({})</translation>
    </message>
</context>
<context>
    <name>device.no-genicam-camera-answers</name>
    <message>
        <source>no GenICam camera &apos;{}&apos; answers</source>
        <translation>aucune caméra GenICam «&#x202f;{}&#x202f;» ne répond</translation>
    </message>
</context>
<context>
    <name>device.no-photograph-came</name>
    <message>
        <source>a photograph was asked for and none came</source>
        <translation>une photo a été demandée et aucune n’est arrivée</translation>
    </message>
</context>
<context>
    <name>device.no-raw-file-sent</name>
    <message>
        <source>the camera sent {} and no raw file</source>
        <translation>la caméra a envoyé {} et aucun fichier RAW</translation>
    </message>
</context>
<context>
    <name>device.no-raw-files</name>
    <message>
        <source>the camera does not deliver raw files</source>
        <translation>la caméra ne fournit pas de fichiers RAW</translation>
    </message>
</context>
<context>
    <name>device.no-readable-pixel-format</name>
    <message>
        <source>none of the camera&apos;s pixel formats can be read</source>
        <translation>aucun des formats de pixel de la caméra ne peut être lu</translation>
    </message>
</context>
<context>
    <name>device.no-software-trigger</name>
    <message>
        <source>has no software trigger: each photograph may wait for one more exposure</source>
        <translation>n’a pas de déclencheur logiciel&#x202f;: chaque photo peut attendre une pose de plus</translation>
    </message>
</context>
<context>
    <name>device.no-video-pictures</name>
    <message>
        <source>the video device sends no pictures</source>
        <translation>le périphérique vidéo n’envoie pas d’images</translation>
    </message>
</context>
<context>
    <name>device.only-other-camera-connected</name>
    <message>
        <source>no camera of this name is plugged in, but {} is</source>
        <translation>aucune caméra de ce nom n’est branchée, mais {} l’est</translation>
    </message>
</context>
<context>
    <name>device.other-screen-seen</name>
    <message>
        <source>the camera sees {}, not {}</source>
        <translation>la caméra voit {}, et non {}</translation>
    </message>
</context>
<context>
    <name>device.part-of-sensor-lost</name>
    <message>
        <source>the camera does not go back to the part of the sensor that it had</source>
        <translation>la caméra ne revient pas à la partie du capteur qu’elle avait</translation>
    </message>
</context>
<context>
    <name>device.parts-lost-on-the-way</name>
    <message>
        <source>parts of the photograph were lost on the way</source>
        <translation>des parties de la photo ont été perdues en route</translation>
    </message>
</context>
<context>
    <name>device.photograph-attempts-failed</name>
    <message>
        <source>{} attempts at a photograph failed: {}</source>
        <translation>{} tentatives de photo ont échoué&#x202f;: {}</translation>
    </message>
</context>
<context>
    <name>device.photograph-exceeds-sensor</name>
    <message>
        <source>{} pixels are wanted and the camera has {}</source>
        <translation>{} pixels sont demandés et la caméra a {}</translation>
    </message>
</context>
<context>
    <name>device.photograph-format-changed</name>
    <message>
        <source>the photograph has {} pixels as {} where {} as {} were agreed</source>
        <translation>la photo a {} pixels en {} alors que {} en {} étaient convenus</translation>
    </message>
</context>
<context>
    <name>device.photograph-larger-than-announced</name>
    <message>
        <source>the photograph is larger than the camera announced</source>
        <translation>la photo est plus grande que ce que la caméra annonçait</translation>
    </message>
</context>
<context>
    <name>device.photograph-not-finished</name>
    <message>
        <source>the photograph was not finished</source>
        <translation>la photo n’a pas été terminée</translation>
    </message>
</context>
<context>
    <name>device.photograph-size-refused</name>
    <message>
        <source>{} pixels are wanted and the camera gives {}</source>
        <translation>{} pixels sont demandés et la caméra fournit {}</translation>
    </message>
</context>
<context>
    <name>device.photograph-size-unexpected</name>
    <message>
        <source>the photograph has {} pixels where {} were announced</source>
        <translation>la photo a {} pixels alors que {} étaient annoncés</translation>
    </message>
</context>
<context>
    <name>device.photograph-timed-out</name>
    <message>
        <source>no photograph came within {} s</source>
        <translation>aucune photo n’est arrivée en {}&#x202f;s</translation>
    </message>
</context>
<context>
    <name>device.photograph-truncated</name>
    <message>
        <source>a photograph of {} pixels as {} came with {} of {} bytes</source>
        <translation>une photo de {} pixels en {} est arrivée avec {} octets sur {}</translation>
    </message>
</context>
<context>
    <name>device.picture-not-settled</name>
    <message>
        <source>a new picture has not fully appeared after {} frames</source>
        <translation>une nouvelle image n’est pas entièrement affichée après {} trames</translation>
    </message>
</context>
<context>
    <name>device.pixel-format-lost</name>
    <message>
        <source>the camera has forgotten the pixel format that it was set to</source>
        <translation>la caméra a oublié le format de pixel réglé</translation>
    </message>
</context>
<context>
    <name>device.pixel-format-not-offered</name>
    <message>
        <source>the camera has no pixel format {} that can be read</source>
        <translation>la caméra n’a pas de format de pixel {} qui puisse être lu</translation>
    </message>
</context>
<context>
    <name>device.projector-command-empty</name>
    <message>
        <source>the projector&apos;s command is empty</source>
        <translation>la commande du projecteur est vide</translation>
    </message>
</context>
<context>
    <name>device.projector-command-lacks</name>
    <message>
        <source>the projector&apos;s command does not contain {}</source>
        <translation>la commande du projecteur ne contient pas {}</translation>
    </message>
</context>
<context>
    <name>device.projector-size-out-of-range</name>
    <message>
        <source>a projector of {} pixels is impossible: each side is {} to {}</source>
        <translation>un projecteur de {} pixels est impossible&#x202f;: chaque côté en a {} à {}</translation>
    </message>
</context>
<context>
    <name>device.projector-unseen</name>
    <message>
        <source>no camera sees what is shown on {}</source>
        <translation>aucune caméra ne voit ce qui est montré sur {}</translation>
    </message>
</context>
<context>
    <name>device.push-cable-in</name>
    <message>
        <source>push in the camera&apos;s cable at both ends</source>
        <translation>enfoncez le câble de la caméra aux deux bouts</translation>
    </message>
</context>
<context>
    <name>device.raw-file-empty</name>
    <message>
        <source>it is empty</source>
        <translation>il est vide</translation>
    </message>
</context>
<context>
    <name>device.raw-file-incomplete</name>
    <message>
        <source>parts of it are missing</source>
        <translation>il en manque des parties</translation>
    </message>
</context>
<context>
    <name>device.raw-file-unreadable</name>
    <message>
        <source>the raw file cannot be read ({})</source>
        <translation>le fichier RAW ne peut pas être lu ({})</translation>
    </message>
</context>
<context>
    <name>device.raw-file-without-sensor-values</name>
    <message>
        <source>the raw file does not hold the sensor&apos;s own values</source>
        <translation>le fichier RAW ne contient pas les valeurs mêmes du capteur</translation>
    </message>
</context>
<context>
    <name>device.reconnect-same-camera</name>
    <message>
        <source>connect the camera that the measurement was begun with</source>
        <translation>branchez la caméra avec laquelle la mesure a commencé</translation>
    </message>
</context>
<context>
    <name>device.reconnected-camera-size-differs</name>
    <message>
        <source>the camera came back with {} pixels instead of {}</source>
        <translation>la caméra est revenue avec {} pixels au lieu de {}</translation>
    </message>
</context>
<context>
    <name>device.release-from-desktop</name>
    <message>
        <source>make the desktop release it with `gio mount -s gphoto2` (or eject it in the file manager) and close photo programs</source>
        <translation>faites-la libérer par le bureau avec `gio mount -s gphoto2` (ou éjectez-la dans le gestionnaire de fichiers) et fermez les programmes de photo</translation>
    </message>
</context>
<context>
    <name>device.remove-file-by-hand</name>
    <message>
        <source>remove it by hand, then try again</source>
        <translation>supprimez-le à la main, puis réessayez</translation>
    </message>
</context>
<context>
    <name>device.request-refused</name>
    <message>
        <source>the camera refused what it was asked for ({})</source>
        <translation>la caméra a refusé ce qui lui était demandé ({})</translation>
    </message>
</context>
<context>
    <name>device.restart-or-change-pixel-format</name>
    <message>
        <source>switch the camera off and on, or choose another of its pixel formats</source>
        <translation>éteignez et rallumez la caméra, ou choisissez un autre de ses formats de pixel</translation>
    </message>
</context>
<context>
    <name>device.restart-with-default-settings</name>
    <message>
        <source>switch it off and on, load its default settings with its maker&apos;s program, and try again</source>
        <translation>éteignez-la et rallumez-la, chargez ses réglages par défaut avec le programme du fabricant, puis réessayez</translation>
    </message>
</context>
<context>
    <name>device.run-command-in-terminal</name>
    <message>
        <source>run it in a terminal to find out why: {}</source>
        <translation>exécutez-la dans un terminal pour en trouver la raison&#x202f;: {}</translation>
    </message>
</context>
<context>
    <name>device.screen-loses-picture</name>
    <message>
        <source>the projector&apos;s screen keeps losing its picture</source>
        <translation>l’écran du projecteur perd sans cesse son image</translation>
    </message>
</context>
<context>
    <name>device.screen-not-seen</name>
    <message>
        <source>the camera does not see what is shown on {}</source>
        <translation>la caméra ne voit pas ce qui est affiché sur {}</translation>
    </message>
</context>
<context>
    <name>device.screen-twice</name>
    <message>
        <source>screen {} is projector {} and projector {}: choose another screen</source>
        <translation>l’écran {} est le projecteur {} et le projecteur {}&#x202f;: choisissez un autre écran</translation>
    </message>
</context>
<context>
    <name>device.sees-no-colours</name>
    <message>
        <source>sees no colours: brightness can be compensated, colours cannot</source>
        <translation>ne voit pas les couleurs&#x202f;: la luminosité peut être compensée, pas les couleurs</translation>
    </message>
</context>
<context>
    <name>device.set-iso-100</name>
    <message>
        <source>set it to ISO 100 by hand</source>
        <translation>réglez-la à la main sur ISO 100</translation>
    </message>
</context>
<context>
    <name>device.set-manual-exposure-mode</name>
    <message>
        <source>set its exposure mode to timed and manual, or update its firmware</source>
        <translation>réglez son mode d’exposition sur «&#x202f;Timed&#x202f;» et manuel, ou mettez à jour son micrologiciel</translation>
    </message>
</context>
<context>
    <name>device.several-cameras-of-model</name>
    <message>
        <source>{} cameras of this model are plugged in</source>
        <translation>{} caméras de ce modèle sont branchées</translation>
    </message>
</context>
<context>
    <name>device.shortest-exposure-understated</name>
    <message>
        <source>claims exposures from {} s but does not go below {} s</source>
        <translation>annonce des temps de pose à partir de {} s mais s’en tient à {} s</translation>
    </message>
</context>
<context>
    <name>device.simulated-camera-unplugged</name>
    <message>
        <source>the camera&apos;s cable is out</source>
        <translation>le câble de la caméra est débranché</translation>
    </message>
</context>
<context>
    <name>device.steady-view-and-expose-briefly</name>
    <message>
        <source>check that the camera&apos;s view is steady and its exposure short, and switch the projector&apos;s smoothing of motion off</source>
        <translation>vérifiez que le champ de la caméra est stable et sa pose courte, et désactivez le lissage des mouvements du projecteur</translation>
    </message>
</context>
<context>
    <name>device.switch-off-automatic-exposure</name>
    <message>
        <source>switch its automatic exposure off; a camera without manual exposure cannot be used</source>
        <translation>désactivez son exposition automatique&#x202f;; une caméra sans exposition manuelle ne peut pas être utilisée</translation>
    </message>
</context>
<context>
    <name>device.switch-off-with-makers-program</name>
    <message>
        <source>switch it off with the camera maker&apos;s program, or use another camera</source>
        <translation>désactivez ce réglage avec le programme du fabricant de la caméra, ou utilisez une autre caméra</translation>
    </message>
</context>
<context>
    <name>device.switch-off-with-v4l2-ctl</name>
    <message>
        <source>switch it off with v4l2-ctl (--list-ctrls names what it has), or use another camera</source>
        <translation>désactivez ce réglage avec v4l2-ctl (--list-ctrls affiche ceux du périphérique), ou utilisez une autre caméra</translation>
    </message>
</context>
<context>
    <name>device.switch-on-and-keep-awake</name>
    <message>
        <source>check its cable, switch it on and disable its automatic power-off</source>
        <translation>vérifiez son câble, allumez-la et désactivez son extinction automatique</translation>
    </message>
</context>
<context>
    <name>device.switch-quality-to-raw</name>
    <message>
        <source>switch its picture quality to RAW by hand; a camera without RAW cannot be used</source>
        <translation>réglez à la main sa qualité d’image sur RAW&#x202f;; une caméra sans RAW ne peut pas être utilisée</translation>
    </message>
</context>
<context>
    <name>device.switch-to-full-size-raw</name>
    <message>
        <source>switch the camera to full-size RAW (no sRAW, mRAW, no linear DNG)</source>
        <translation>réglez la caméra sur RAW en pleine taille (ni sRAW, ni mRAW, ni DNG linéaire)</translation>
    </message>
</context>
<context>
    <name>device.switch-to-manual-focus</name>
    <message>
        <source>switch its lens to manual focus</source>
        <translation>mettez son objectif en mise au point manuelle</translation>
    </message>
</context>
<context>
    <name>device.switches-itself-off</name>
    <message>
        <source>switches itself off after a while: switch that off</source>
        <translation>s’éteint seule au bout d’un moment&#x202f;: désactivez cela</translation>
    </message>
</context>
<context>
    <name>device.take-photograph-by-hand</name>
    <message>
        <source>switch its lens to manual focus, close its menus, and take a photograph by hand to see what it complains of</source>
        <translation>mettez son objectif en mise au point manuelle, fermez ses menus et prenez une photo à la main pour voir ce qu’elle signale</translation>
    </message>
</context>
<context>
    <name>device.then-go-on</name>
    <message>
        <source>{}, then go on: every photograph so far is kept</source>
        <translation>{}, puis continuez&#x202f;: toutes les photos déjà prises sont conservées</translation>
    </message>
</context>
<context>
    <name>device.trial-photograph-failed</name>
    <message>
        <source>the camera was asked for a photograph and took none</source>
        <translation>une photo a été demandée à la caméra, qui n’en a pas pris</translation>
    </message>
</context>
<context>
    <name>device.turn-dial-or-change-camera</name>
    <message>
        <source>turn its mode dial to M; a camera without manual exposure cannot be used</source>
        <translation>tournez sa molette de mode sur M&#x202f;; une caméra sans M ne peut pas être utilisée</translation>
    </message>
</context>
<context>
    <name>device.turn-dial-to-m</name>
    <message>
        <source>turn it to M</source>
        <translation>tournez-la sur M</translation>
    </message>
</context>
<context>
    <name>device.use-manual-exposure-camera</name>
    <message>
        <source>use a camera with manual exposure</source>
        <translation>utilisez une caméra à exposition manuelle</translation>
    </message>
</context>
<context>
    <name>device.video-device</name>
    <message>
        <source>video device</source>
        <translation>périphérique vidéo</translation>
    </message>
</context>
<context>
    <name>device.video-device-in-use</name>
    <message>
        <source>the video device cannot be opened: another program may be using it</source>
        <translation>le périphérique vidéo ne peut pas être ouvert&#x202f;: un autre programme l’utilise peut-être</translation>
    </message>
</context>
<context>
    <name>device.video-device-missing</name>
    <message>
        <source>no such video device is plugged in</source>
        <translation>aucun périphérique vidéo de ce nom n’est branché</translation>
    </message>
</context>
<context>
    <name>device.video-device-unplugged</name>
    <message>
        <source>the video device has been unplugged</source>
        <translation>le périphérique vidéo a été débranché</translation>
    </message>
</context>
<context>
    <name>device.video-exposure-not-settable</name>
    <message>
        <source>the video device has no exposure that can be set</source>
        <translation>le périphérique vidéo n’a pas d’exposition réglable</translation>
    </message>
</context>
<context>
    <name>device.video-size-refused</name>
    <message>
        <source>{} pixels are wanted and the video device gives {}</source>
        <translation>{} pixels sont demandés et le périphérique vidéo fournit {}</translation>
    </message>
</context>
<context>
    <name>device.wake-camera</name>
    <message>
        <source>press its shutter button half way or switch it off and on, and disable its automatic power-off</source>
        <translation>enfoncez son déclencheur à mi-course ou éteignez-la et rallumez-la, et désactivez son extinction automatique</translation>
    </message>
</context>
<context>
    <name>device.write-announced-size</name>
    <message>
        <source>let the command write that size, or begin again with the size that the camera delivers</source>
        <translation>faites écrire cette taille par la commande, ou recommencez avec la taille que fournit la caméra</translation>
    </message>
</context>
<context>
    <name>device.write-photograph-to-output</name>
    <message>
        <source>let it write the photograph to {output}: {}</source>
        <translation>faites-lui écrire la photo dans {output}&#x202f;: {}</translation>
    </message>
</context>
<context>
    <name>disk.cannot-create-folder</name>
    <message>
        <source>cannot create the folder ({})</source>
        <translation>impossible de créer le dossier ({})</translation>
    </message>
</context>
<context>
    <name>disk.cannot-open</name>
    <message>
        <source>cannot open ({})</source>
        <translation>ouverture impossible ({})</translation>
    </message>
</context>
<context>
    <name>disk.cannot-read</name>
    <message>
        <source>cannot read ({})</source>
        <translation>lecture impossible ({})</translation>
    </message>
</context>
<context>
    <name>disk.cannot-write</name>
    <message>
        <source>cannot write ({})</source>
        <translation>écriture impossible ({})</translation>
    </message>
</context>
<context>
    <name>disk.check-disk-and-cable</name>
    <message>
        <source>check the disk and its cable</source>
        <translation>vérifiez le disque et son câble</translation>
    </message>
</context>
<context>
    <name>disk.check-path</name>
    <message>
        <source>check the path</source>
        <translation>vérifiez le chemin</translation>
    </message>
</context>
<context>
    <name>disk.check-path-and-disk</name>
    <message>
        <source>check the path and the disk</source>
        <translation>vérifiez le chemin et le disque</translation>
    </message>
</context>
<context>
    <name>disk.choose-scratch-folder</name>
    <message>
        <source>let the environment variable TMPDIR name a folder on a disk that you may write to; what has been photographed is safe</source>
        <translation>indiquez dans la variable d’environnement TMPDIR un dossier d’un disque où vous pouvez écrire&#x202f;; ce qui a été photographié est en sécurité</translation>
    </message>
</context>
<context>
    <name>disk.choose-writable-folder</name>
    <message>
        <source>choose a folder that you may write to, or ask for the permission</source>
        <translation>choisissez un dossier où vous avez le droit d’écrire, ou demandez ce droit</translation>
    </message>
</context>
<context>
    <name>disk.free-scratch-room</name>
    <message>
        <source>free some space there; what has been photographed is safe</source>
        <translation>libérez de l’espace à cet endroit&#x202f;; ce qui a été photographié est en sécurité</translation>
    </message>
</context>
<context>
    <name>disk.free-space-or-check-disk</name>
    <message>
        <source>free some space there or check the disk, then try again</source>
        <translation>libérez de l’espace à cet endroit ou vérifiez le disque, puis réessayez</translation>
    </message>
</context>
<context>
    <name>disk.free-space-or-choose-another</name>
    <message>
        <source>free some space there or choose another disk, then try again</source>
        <translation>libérez de l’espace à cet endroit ou choisissez un autre disque, puis réessayez</translation>
    </message>
</context>
<context>
    <name>disk.no-scratch-room</name>
    <message>
        <source>there is no room for intermediate results ({})</source>
        <translation>il n’y a pas de place pour les résultats intermédiaires ({})</translation>
    </message>
</context>
<context>
    <name>duration.hours-minutes</name>
    <message>
        <source>{} h {} min</source>
        <translation>{}&#x202f;h {}&#x202f;min</translation>
    </message>
</context>
<context>
    <name>duration.minutes</name>
    <message>
        <source>{} min</source>
        <translation>{}&#x202f;min</translation>
    </message>
</context>
<context>
    <name>duration.seconds</name>
    <message>
        <source>{} s</source>
        <translation>{}&#x202f;s</translation>
    </message>
</context>
<context>
    <name>duration.under-a-minute</name>
    <message>
        <source>under a minute</source>
        <translation>moins d’une minute</translation>
    </message>
</context>
<context>
    <name>engine.compute-on-processor</name>
    <message>
        <source>compute on the processor instead</source>
        <translation>confiez le calcul au processeur</translation>
    </message>
</context>
<context>
    <name>engine.graphics-buffer-too-large</name>
    <message>
        <source>the graphics card can hold {} MB in one piece, but {} MB are needed</source>
        <translation>la carte graphique atteint {}&#x202f;Mo à la fois alors qu’il en faut {}&#x202f;Mo</translation>
    </message>
</context>
<context>
    <name>engine.graphics-card-lost</name>
    <message>
        <source>the graphics card was lost</source>
        <translation>la carte graphique a été perdue</translation>
    </message>
</context>
<context>
    <name>engine.graphics-card-unusable</name>
    <message>
        <source>the graphics card cannot be used</source>
        <translation>la carte graphique ne peut pas être utilisée</translation>
    </message>
</context>
<context>
    <name>engine.graphics-memory-exhausted</name>
    <message>
        <source>the graphics card has no {} MB of memory left</source>
        <translation>la carte graphique n’a plus {}&#x202f;Mo de mémoire libre</translation>
    </message>
</context>
<context>
    <name>engine.install-driver</name>
    <message>
        <source>install the graphics card&apos;s driver, or compute on the processor</source>
        <translation>installez le pilote de la carte graphique, ou confiez le calcul au processeur</translation>
    </message>
</context>
<context>
    <name>engine.no-graphics-card</name>
    <message>
        <source>there is no graphics card with OpenGL 4.3 and compute shaders</source>
        <translation>aucune carte graphique avec OpenGL 4.3 et shaders de calcul n’est présente</translation>
    </message>
</context>
<context>
    <name>engine.no-libegl-or-libopengl</name>
    <message>
        <source>there is no libEGL or no libOpenGL, which open graphics cards without a display</source>
        <translation>il manque libEGL ou libOpenGL, qui ouvrent les cartes graphiques sans écran</translation>
    </message>
</context>
<context>
    <name>engine.no-opengl</name>
    <message>
        <source>there is no OpenGL 4.3 with compute shaders</source>
        <translation>il manque OpenGL 4.3 avec shaders de calcul</translation>
    </message>
</context>
<context>
    <name>import.camera-taken-as-linear</name>
    <message>
        <source>The camera is taken to be linear, and one photograph counts as one second of exposure</source>
        <translation>la caméra est supposée linéaire, et une photo compte pour une seconde de pose</translation>
    </message>
</context>
<context>
    <name>import.lit-share</name>
    <message>
        <source>The projector lights {} % of the camera&apos;s pixels</source>
        <translation>le projecteur éclaire {}&#x202f;% des pixels de la caméra</translation>
    </message>
</context>
<context>
    <name>import.paired-by-time</name>
    <message>
        <source>The photographs were paired with the patterns in the order in which they were taken, from {} to {}, which is not that of their names</source>
        <translation>les photos ont été associées aux motifs dans l’ordre de prise de vue, de {} à {}, qui n’est pas celui de leurs noms</translation>
    </message>
</context>
<context>
    <name>import.patterns-and-photographs-grey</name>
    <message>
        <source>Patterns and photographs are grey: colours are not told apart, and T&apos;s blocks are neutral</source>
        <translation>motifs et photos sont gris&#x202f;: les couleurs ne sont pas distinguées, et les blocs de T sont neutres</translation>
    </message>
</context>
<context>
    <name>import.patterns-black-and-white</name>
    <message>
        <source>The patterns hold black and white only: the projector&apos;s response is assumed to be a gamma of 2.2</source>
        <translation>les motifs ne contiennent que du noir et du blanc&#x202f;: la réponse du projecteur est supposée être une puissance de 2,2</translation>
    </message>
</context>
<context>
    <name>import.patterns-grey</name>
    <message>
        <source>The patterns are grey: how colours mix was not measured, and T&apos;s blocks are diagonal</source>
        <translation>les motifs sont gris&#x202f;: le mélange des couleurs n’a pas été mesuré, et les blocs de T sont diagonaux</translation>
    </message>
</context>
<context>
    <name>import.photographs-are-jpeg</name>
    <message>
        <source>The photographs are JPEG: they were made linear by the curve of sRGB, which cameras follow only roughly; develop them linearly, as TIFF or EXR, to measure more exactly</source>
        <translation>les photos sont en JPEG&#x202f;: elles ont été linéarisées par la courbe sRGB, que les caméras ne suivent qu’approximativement&#x202f;; développez-les linéairement, en TIFF ou EXR, pour mesurer plus exactement</translation>
    </message>
</context>
<context>
    <name>import.photographs-grey</name>
    <message>
        <source>The photographs are grey: what each of the projector&apos;s colours contributes is known in brightness only</source>
        <translation>les photos sont grises&#x202f;: l’apport de chaque couleur du projecteur n’est connu qu’en luminosité</translation>
    </message>
</context>
<context>
    <name>linearization.choose-overlapping-exposures</name>
    <message>
        <source>set them to ranges of exposure times that overlap</source>
        <translation>réglez-les sur des plages de temps de pose qui se recoupent</translation>
    </message>
</context>
<context>
    <name>linearization.halves-brighter-than-whole</name>
    <message>
        <source>{}: two halves of a picture are {} % brighter than the whole; switch off the dynamic iris, dynamic contrast and any picture mode that adapts to the content</source>
        <translation>{}&#x202f;: deux moitiés d’une image sont plus lumineuses de {}&#x202f;% que l’ensemble&#x202f;; désactivez l’iris dynamique, le contraste dynamique et tout mode d’image qui s’adapte au contenu</translation>
    </message>
</context>
<context>
    <name>linearization.halves-darker-than-whole</name>
    <message>
        <source>{}: two halves of a picture are {} % darker than the whole; switch off the dynamic iris, dynamic contrast and any picture mode that adapts to the content</source>
        <translation>{}&#x202f;: deux moitiés d’une image sont plus sombres de {}&#x202f;% que l’ensemble&#x202f;; désactivez l’iris dynamique, le contraste dynamique et tout mode d’image qui s’adapte au contenu</translation>
    </message>
</context>
<context>
    <name>linearization.highlights-overexposed</name>
    <message>
        <source>{}: some highlights are overexposed even at {} s, the shortest exposure, and will not be compensated; close the aperture or add a grey filter if they matter</source>
        <translation>{}&#x202f;: certains reflets sont surexposés même à {}&#x202f;s, le temps de pose le plus court, et ne seront pas compensés&#x202f;; fermez le diaphragme ou ajoutez un filtre gris s’ils comptent</translation>
    </message>
</context>
<context>
    <name>linearization.light-flickers</name>
    <message>
        <source>{}: the light changes by {} % from one photograph to the next; switch off the projector&apos;s dynamic lamp modes and other lamps nearby, and choose exposure times that are multiples of the mains period</source>
        <translation>{}&#x202f;: la lumière change de {}&#x202f;% d’une photo à la suivante&#x202f;; désactivez les modes de lampe dynamiques du projecteur, éteignez les autres lampes proches et choisissez des temps de pose multiples de la période du secteur</translation>
    </message>
</context>
<context>
    <name>linearization.no-common-exposure</name>
    <message>
        <source>the cameras have no exposure time in common</source>
        <translation>les caméras n’ont aucun temps de pose en commun</translation>
    </message>
</context>
<context>
    <name>linearization.overexposed</name>
    <message>
        <source>{}: the projection is overexposed even at {} s, the shortest exposure; close the aperture, lower the gain or add a grey filter</source>
        <translation>{}&#x202f;: la projection est surexposée même à {}&#x202f;s, le temps de pose le plus court&#x202f;; fermez le diaphragme, réduisez le gain ou ajoutez un filtre gris</translation>
    </message>
</context>
<context>
    <name>linearization.response-uneven</name>
    <message>
        <source>{}: the brightness curves are not the same everywhere in its picture, by up to {} % of white; switch off uniformity correction, local dimming and edge blending in the projector</source>
        <translation>{}&#x202f;: les courbes de luminosité ne sont pas les mêmes partout dans l’image, avec des écarts allant jusqu’à {}&#x202f;% du blanc&#x202f;; désactivez la correction d’uniformité, la gradation locale et la fusion des bords du projecteur</translation>
    </message>
</context>
<context>
    <name>linearization.underexposed</name>
    <message>
        <source>{}: the projection reaches only {} % of the camera&apos;s range at {} s, the longest exposure; open the aperture or raise the gain</source>
        <translation>{}&#x202f;: la projection n’atteint que {}&#x202f;% de la plage de la caméra à {}&#x202f;s, le temps de pose le plus long&#x202f;; ouvrez le diaphragme ou augmentez le gain</translation>
    </message>
</context>
<context>
    <name>linearization.white-brighter-than-colours</name>
    <message>
        <source>{}: white is {} % brighter than red, green and blue together; switch off the white segment (often called brilliant colour or bright mode) and choose a picture mode for video or sRGB</source>
        <translation>{}&#x202f;: le blanc est plus lumineux de {}&#x202f;% que le rouge, le vert et le bleu réunis&#x202f;; désactivez le segment blanc (souvent appelé « Brilliant Color » ou mode lumineux) et choisissez un mode d’image pour la vidéo ou le sRGB</translation>
    </message>
</context>
<context>
    <name>linearization.white-darker-than-colours</name>
    <message>
        <source>{}: white is {} % darker than red, green and blue together; switch off power saving, colour management and dynamic picture modes</source>
        <translation>{}&#x202f;: le blanc est plus sombre de {}&#x202f;% que le rouge, le vert et le bleu réunis&#x202f;; désactivez l’économie d’énergie, la gestion des couleurs et les modes d’image dynamiques</translation>
    </message>
</context>
<context>
    <name>masks.draw-again</name>
    <message>
        <source>draw it again, or correct the file</source>
        <translation>dessinez-le de nouveau ou corrigez le fichier</translation>
    </message>
</context>
<context>
    <name>masks.unknown-key</name>
    <message>
        <source>mask {} has &quot;{}&quot;, which this version does not know</source>
        <translation>le masque {} contient « {} », que cette version ne connaît pas</translation>
    </message>
</context>
<context>
    <name>masks.unreadable</name>
    <message>
        <source>mask {} cannot be read: it needs points as [[x, y], ...], and may have camera, outline and feather</source>
        <translation>le masque {} est illisible : il lui faut points sous la forme [[x, y], ...], et il peut avoir camera, outline et feather</translation>
    </message>
</context>
<context>
    <name>night.hours-began</name>
    <message>
        <source>the show&apos;s hours began before it was done</source>
        <translation>les heures du spectacle ont commencé avant la fin</translation>
    </message>
</context>
<context>
    <name>night.missed</name>
    <message>
        <source>it could not begin within two hours of its time: the show did not run, or the computer slept</source>
        <translation>impossible de commencer dans les deux heures suivant l’heure prévue : le spectacle ne tournait pas, ou l’ordinateur était en veille</translation>
    </message>
</context>
<context>
    <name>night.not-as-predicted</name>
    <message>
        <source>the picture has a colour error of {} where {} was predicted, and no repair helped</source>
        <translation>l’image a une erreur de couleur de {} alors que {} était prédit, et aucune réparation n’a aidé</translation>
    </message>
</context>
<context>
    <name>night.part-not-as-predicted</name>
    <message>
        <source>a part of the surface looks otherwise than predicted, by a colour error of {}, and no repair helped</source>
        <translation>une partie de la surface n’a pas l’aspect prédit, avec une erreur de couleur de {}, et aucune réparation n’a aidé</translation>
    </message>
</context>
<context>
    <name>night.too-long</name>
    <message>
        <source>it was not done within six hours</source>
        <translation>ce n’était pas fini au bout de six heures</translation>
    </message>
</context>
<context>
    <name>perfect.camera-blinded</name>
    <message>
        <source>something blinds the camera: {} of its view is overexposed</source>
        <translation>quelque chose éblouit la caméra : {} de son image sont surexposés</translation>
    </message>
</context>
<context>
    <name>perfect.camera-moved</name>
    <message>
        <source>the view of camera {} has moved by {}, {} pixels since the venue was measured</source>
        <translation>le cadrage de la caméra {} s’est déplacé de {}, {} pixels depuis la mesure</translation>
    </message>
</context>
<context>
    <name>perfect.light-missing</name>
    <message>
        <source>light is missing: is the lens covered, or a projector asleep?</source>
        <translation>il manque de la lumière : l’objectif est-il couvert, ou un projecteur en veille ?</translation>
    </message>
</context>
<context>
    <name>perfect.something-else</name>
    <message>
        <source>the camera sees something else than expected: did somebody stand in the light, or did the room&apos;s light change?</source>
        <translation>la caméra voit autre chose que prévu : quelqu’un était-il dans la lumière, ou l’éclairage de la salle a-t-il changé ?</translation>
    </message>
</context>
<context>
    <name>pjlink.address-twice</name>
    <message>
        <source>projectors {} and {} have the same address, {}</source>
        <translation>les projecteurs {} et {} ont la même adresse, {}</translation>
    </message>
</context>
<context>
    <name>pjlink.cannot-search</name>
    <message>
        <source>projectors cannot be searched ({})</source>
        <translation>la recherche de projecteurs est impossible ({})</translation>
    </message>
</context>
<context>
    <name>pjlink.check-address-and-port</name>
    <message>
        <source>check the address and the port of the projector</source>
        <translation>vérifiez l’adresse et le port du projecteur</translation>
    </message>
</context>
<context>
    <name>pjlink.check-lens</name>
    <message>
        <source>check lens caps, shutter and input of the projector, and where the camera looks</source>
        <translation>vérifiez les capuchons d’objectif, l’obturateur et l’entrée du projecteur, et où regarde la caméra</translation>
    </message>
</context>
<context>
    <name>pjlink.check-network</name>
    <message>
        <source>check its address, its network cable, and that PJLink and the network in standby are switched on in its menu</source>
        <translation>vérifiez son adresse, son câble réseau, et que PJLink et le réseau en veille sont activés dans son menu</translation>
    </message>
</context>
<context>
    <name>pjlink.check-own-network</name>
    <message>
        <source>check this computer&apos;s network, or give the projector&apos;s address</source>
        <translation>vérifiez le réseau de cet ordinateur, ou indiquez l’adresse du projecteur</translation>
    </message>
</context>
<context>
    <name>pjlink.choose-class-one-authentication</name>
    <message>
        <source>choose the authentication of PJLink class 1 in its menu, or none</source>
        <translation>choisissez dans son menu l’authentification PJLink classe 1, ou aucune</translation>
    </message>
</context>
<context>
    <name>pjlink.closed</name>
    <message>
        <source>it closed the connection</source>
        <translation>il a fermé la connexion</translation>
    </message>
</context>
<context>
    <name>pjlink.end-dimming</name>
    <message>
        <source>switch off its dynamic contrast, lamp dimming and eco modes, and daylight in the room; or measure without waiting for its lamp</source>
        <translation>désactivez son contraste dynamique, la gradation de la lampe et les modes éco, et masquez la lumière du jour ; ou mesurez sans attendre sa lampe</translation>
    </message>
</context>
<context>
    <name>pjlink.frozen</name>
    <message>
        <source>projector {} freezes its picture: end that in its menu</source>
        <translation>le projecteur {} fige son image : désactivez cela dans son menu</translation>
    </message>
</context>
<context>
    <name>pjlink.give-password</name>
    <message>
        <source>give the PJLink password that is set in its menu</source>
        <translation>indiquez le mot de passe PJLink défini dans son menu</translation>
    </message>
</context>
<context>
    <name>pjlink.light-drifts</name>
    <message>
        <source>the light of projector {} still drifts by {} % within {} s after {} s</source>
        <translation>la lumière du projecteur {0} varie encore de {1} % en {2} s au bout de {3} s</translation>
    </message>
</context>
<context>
    <name>pjlink.light-unseen</name>
    <message>
        <source>no camera sees light of projector {}</source>
        <translation>aucune caméra ne voit la lumière du projecteur {}</translation>
    </message>
</context>
<context>
    <name>pjlink.look-at-projector</name>
    <message>
        <source>look at its lamps and its menu</source>
        <translation>regardez ses voyants et son menu</translation>
    </message>
</context>
<context>
    <name>pjlink.more-than-projectors</name>
    <message>
        <source>projector {} on the network is none of the {} that there are</source>
        <translation>le projecteur {} sur le réseau n’est aucun des {} présents</translation>
    </message>
</context>
<context>
    <name>pjlink.newer-authentication</name>
    <message>
        <source>the projector at {} asks for its password in a way that this version does not know</source>
        <translation>le projecteur à {} demande son mot de passe d’une manière que cette version ne connaît pas</translation>
    </message>
</context>
<context>
    <name>pjlink.no-answer</name>
    <message>
        <source>the projector at {} does not answer ({})</source>
        <translation>le projecteur à {} ne répond pas ({})</translation>
    </message>
</context>
<context>
    <name>pjlink.no-signal</name>
    <message>
        <source>projector {} has no signal at its input {}: choose the input of this computer</source>
        <translation>le projecteur {} n’a pas de signal à son entrée {} : choisissez l’entrée de cet ordinateur</translation>
    </message>
</context>
<context>
    <name>pjlink.not-native</name>
    <message>
        <source>projector {} receives {} pixels and has {}: it scales the picture, which blurs the compensation; send it its own size</source>
        <translation>le projecteur {} reçoit {} pixels et en a {} : il met l’image à l’échelle, ce qui rend la compensation floue ; envoyez-lui sa propre taille</translation>
    </message>
</context>
<context>
    <name>pjlink.not-on</name>
    <message>
        <source>projector {} was told to switch on and is not on after {} s</source>
        <translation>le projecteur {} a reçu l’ordre de s’allumer et ne l’est pas au bout de {} s</translation>
    </message>
</context>
<context>
    <name>pjlink.not-pjlink</name>
    <message>
        <source>what answers at {} does not speak PJLink</source>
        <translation>ce qui répond à {} ne parle pas PJLink</translation>
    </message>
</context>
<context>
    <name>pjlink.open-shutter-by-hand</name>
    <message>
        <source>open it at the projector, and start again</source>
        <translation>ouvrez-le sur le projecteur, et recommencez</translation>
    </message>
</context>
<context>
    <name>pjlink.other-signal</name>
    <message>
        <source>projector {} receives {} pixels where {} are sent: something between scales the picture, or it shows another input</source>
        <translation>le projecteur {} reçoit {} pixels alors que {} sont envoyés : quelque chose entre les deux met l’image à l’échelle, ou il montre une autre entrée</translation>
    </message>
</context>
<context>
    <name>pjlink.own-failure</name>
    <message>
        <source>the projector at {} reports a failure of its own</source>
        <translation>le projecteur à {} signale une panne</translation>
    </message>
</context>
<context>
    <name>pjlink.part-cover</name>
    <message>
        <source>cover open</source>
        <translation>capot ouvert</translation>
    </message>
</context>
<context>
    <name>pjlink.part-fan</name>
    <message>
        <source>fan</source>
        <translation>ventilateur</translation>
    </message>
</context>
<context>
    <name>pjlink.part-filter</name>
    <message>
        <source>filter</source>
        <translation>filtre</translation>
    </message>
</context>
<context>
    <name>pjlink.part-lamp</name>
    <message>
        <source>lamp</source>
        <translation>lampe</translation>
    </message>
</context>
<context>
    <name>pjlink.part-other</name>
    <message>
        <source>something else</source>
        <translation>autre chose</translation>
    </message>
</context>
<context>
    <name>pjlink.part-temperature</name>
    <message>
        <source>temperature</source>
        <translation>température</translation>
    </message>
</context>
<context>
    <name>pjlink.reports-error</name>
    <message>
        <source>projector {} reports an error: {}</source>
        <translation>le projecteur {} signale une erreur : {}</translation>
    </message>
</context>
<context>
    <name>pjlink.reports-warning</name>
    <message>
        <source>projector {} warns: {}</source>
        <translation>le projecteur {} avertit : {}</translation>
    </message>
</context>
<context>
    <name>pjlink.shutter-stays-closed</name>
    <message>
        <source>the shutter of projector {} does not open</source>
        <translation>l’obturateur du projecteur {} ne s’ouvre pas</translation>
    </message>
</context>
<context>
    <name>pjlink.still-warming</name>
    <message>
        <source>projector {} is still warming up or cooling down after {} s</source>
        <translation>le projecteur {} chauffe ou refroidit encore au bout de {} s</translation>
    </message>
</context>
<context>
    <name>pjlink.switch-on-by-hand</name>
    <message>
        <source>look at its lamps and its menu, switch it on by hand, and start again</source>
        <translation>regardez ses voyants et son menu, allumez-le à la main, et recommencez</translation>
    </message>
</context>
<context>
    <name>pjlink.too-slow</name>
    <message>
        <source>nothing complete came in time</source>
        <translation>rien de complet n’est arrivé à temps</translation>
    </message>
</context>
<context>
    <name>pjlink.wants-password</name>
    <message>
        <source>the projector at {} asks for a password</source>
        <translation>le projecteur à {} demande un mot de passe</translation>
    </message>
</context>
<context>
    <name>pjlink.wrong-password</name>
    <message>
        <source>the projector at {} refuses the password</source>
        <translation>le projecteur à {} refuse le mot de passe</translation>
    </message>
</context>
<context>
    <name>reduction.binned</name>
    <message>
        <source>of the camera&apos;s {} pixels, {} are made: of the part around what is lit, every {} become one</source>
        <translation>des {} pixels de la caméra, on en fait {} : dans la partie autour de ce qui est éclairé, chaque groupe de {} devient un seul pixel</translation>
    </message>
</context>
<context>
    <name>reduction.binned-for-memory</name>
    <message>
        <source>of the camera&apos;s {} pixels, {} are made: every {} become one, as there is memory for no more</source>
        <translation>des {} pixels de la caméra, on en fait {} : chaque groupe de {} devient un seul pixel, car la mémoire ne suffit pas pour davantage</translation>
    </message>
</context>
<context>
    <name>reduction.cropped</name>
    <message>
        <source>of the camera&apos;s {} pixels, the {} around what is lit are used</source>
        <translation>des {} pixels de la caméra, seuls les {} autour de ce qui est éclairé sont utilisés</translation>
    </message>
</context>
<context>
    <name>reduction.fewer-camera-pixels</name>
    <message>
        <source>choose fewer camera pixels: automatic ones are as many as fit</source>
        <translation>choisissez moins de pixels de caméra : en automatique, il y en a autant que la mémoire en contient</translation>
    </message>
</context>
<context>
    <name>reduction.memory-too-little</name>
    <message>
        <source>measuring would take {} GB of memory, and {} GB may be taken</source>
        <translation>la mesure demanderait {} Go de mémoire, et {} Go sont disponibles</translation>
    </message>
</context>
<context>
    <name>reduction.more-memory-or-smaller-projector</name>
    <message>
        <source>use a computer or a limit with more memory, or a projector signal of fewer pixels</source>
        <translation>utilisez un ordinateur ou une limite avec plus de mémoire, ou un signal de projecteur de moins de pixels</translation>
    </message>
</context>
<context>
    <name>reduction.other-size</name>
    <message>
        <source>the camera delivers {} pixels where {} were calibrated</source>
        <translation>la caméra fournit {} pixels alors que {} ont été calibrés</translation>
    </message>
</context>
<context>
    <name>reduction.restore-camera-size</name>
    <message>
        <source>set the camera to the size that it had, or calibrate again</source>
        <translation>réglez la caméra sur la taille qu’elle avait, ou recommencez la calibration</translation>
    </message>
</context>
<context>
    <name>relucent::gui::AcquirePage</name>
    <message>
        <source>Paused, %1</source>
        <translation>En pause, %1</translation>
    </message>
    <message>
        <source>Measuring, %1</source>
        <translation>Mesure, %1</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s), %1</source>
        <translation>
            <numerusform>%n motif, %1</numerusform>
            <numerusform>%n motifs, %1</numerusform>
        </translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Mesuré</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>Obsolète</translation>
    </message>
    <message>
        <source>Stopped by a failure</source>
        <translation>Arrêt sur erreur</translation>
    </message>
    <message>
        <source>Waiting for you. Nothing is being projected.</source>
        <translation>En attente de votre réponse. Rien n’est projeté.</translation>
    </message>
    <message>
        <source>Every photograph is saved. Threshold opens when the last is taken.</source>
        <translation>Chaque photo est enregistrée. «&#x202f;Seuil&#x202f;» s’ouvre après la dernière.</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>Appareils utilisés à l’étape «&#x202f;%1&#x202f;».</translation>
    </message>
    <message>
        <source>Measured in %1</source>
        <translation>Mesuré en %1</translation>
    </message>
    <message>
        <source>Leave the room dark and still, then start.</source>
        <translation>Gardez la salle sombre et sans mouvement, puis démarrez.</translation>
    </message>
    <message>
        <source>Show threshold</source>
        <translation>Voir le seuil</translation>
    </message>
    <message>
        <source>Resume</source>
        <translation>Reprendre</translation>
    </message>
    <message>
        <source>Start measuring</source>
        <translation>Démarrer la mesure</translation>
    </message>
    <message>
        <source>Stop and keep</source>
        <translation>Arrêter et garder</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>This measurement belongs to earlier settings</source>
        <translation>Cette mesure date d’anciens réglages</translation>
    </message>
    <message>
        <source>It still works and stays until the new one is ready.</source>
        <translation>Elle reste utilisable jusqu’à ce que la nouvelle soit prête.</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>Remesurer</translation>
    </message>
    <message>
        <source>The last session ended before it was finished</source>
        <translation>La dernière session s’est arrêtée avant la fin</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>Rien n’a été modifié.</translation>
    </message>
    <message>
        <source>Fineness</source>
        <translation>Finesse</translation>
    </message>
    <message>
        <source>Acquire</source>
        <translation>Acquisition</translation>
    </message>
    <message>
        <source>Measure how every projector pixel lights every camera pixel. Leave the room dark and still.</source>
        <translation>Mesurez comment chaque pixel du projecteur éclaire chaque pixel de la caméra. Gardez la salle sombre et sans mouvement.</translation>
    </message>
    <message>
        <source>Sent to the projector</source>
        <translation>Envoyé au projecteur</translation>
    </message>
    <message>
        <source>Seen by the camera</source>
        <translation>Vu par la caméra</translation>
    </message>
    <message>
        <source>Pattern that the projector shows</source>
        <translation>Motif affiché par le projecteur</translation>
    </message>
    <message>
        <source>Last photograph</source>
        <translation>Dernière photo</translation>
    </message>
    <message>
        <source>Appears when measuring begins. Nothing is projected before you start.</source>
        <translation>Apparaît au début de la mesure. Rien n’est projeté avant que vous démarriez.</translation>
    </message>
    <message>
        <source>How finely</source>
        <translation>Finesse</translation>
    </message>
    <message>
        <source>Fast</source>
        <translation>Rapide</translation>
    </message>
    <message>
        <source>a first look; misses weak bounces</source>
        <translation>premier essai&#x202f;; manque les rebonds faibles</translation>
    </message>
    <message>
        <source>Usual</source>
        <translation>Normal</translation>
    </message>
    <message>
        <source>suits most surfaces</source>
        <translation>pour la plupart des surfaces</translation>
    </message>
    <message>
        <source>Fine</source>
        <translation>Fin</translation>
    </message>
    <message>
        <source>glass, gloss, deep corners</source>
        <translation>verre, brillant, angles profonds</translation>
    </message>
    <message>
        <source>Disk still needed</source>
        <translation>Disque encore requis</translation>
    </message>
    <message>
        <source>Watching</source>
        <translation>Surveillance</translation>
    </message>
    <message>
        <source>Paused</source>
        <translation>En pause</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>Mesure</translation>
    </message>
    <message>
        <source>about %1</source>
        <translation>environ %1</translation>
    </message>
    <message>
        <source>alarm beyond</source>
        <translation>alarme au-delà</translation>
    </message>
    <message>
        <source>taken again</source>
        <translation>repris</translation>
    </message>
    <message>
        <source>During the measurement</source>
        <translation>Pendant la mesure</translation>
    </message>
    <message>
        <source>light that would spoil photographs</source>
        <translation>lumière qui gâcherait les photos</translation>
    </message>
    <message>
        <source>Minutes</source>
        <translation>Minutes</translation>
    </message>
    <message>
        <source>Room light, % of full light</source>
        <translation>Lumière de la salle, % de la pleine lumière</translation>
    </message>
    <message>
        <source>Room light during the measurement</source>
        <translation>Lumière de la salle pendant la mesure</translation>
    </message>
    <message>
        <source>Taken again</source>
        <translation>Repris</translation>
    </message>
    <message numerus="yes">
        <source>About %n pattern(s), %1. Leave the room dark and still.</source>
        <translation>
            <numerusform>Environ %n motif, %1. Laissez la pièce sombre et sans mouvement.</numerusform>
            <numerusform>Environ %n motifs, %1. Laissez la pièce sombre et sans mouvement.</numerusform>
        </translation>
    </message>
    <message>
        <source>What was measured</source>
        <translation>Ce qui a été mesuré</translation>
    </message>
    <message>
        <source>Patterns</source>
        <translation>Motifs</translation>
    </message>
    <message>
        <source>Error of the test patterns</source>
        <translation>Erreur des motifs de test</translation>
    </message>
    <message>
        <source>Continue anyway</source>
        <translation>Continuer ainsi</translation>
    </message>
    <message>
        <source>Found while measuring</source>
        <translation>Constaté pendant la mesure</translation>
    </message>
    <message numerus="yes">
        <source>Begins in %n second(s)</source>
        <translation>
            <numerusform>Commence dans %n seconde</numerusform>
            <numerusform>Commence dans %n secondes</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Measuring begins in %n second(s). Leave the room dark and still.</source>
        <translation>
            <numerusform>La mesure commence dans %n seconde. Laissez la pièce sombre et sans mouvement.</numerusform>
            <numerusform>La mesure commence dans %n secondes. Laissez la pièce sombre et sans mouvement.</numerusform>
        </translation>
    </message>
    <message>
        <source>Start now</source>
        <translation>Commencer maintenant</translation>
    </message>
    <message>
        <source>Not now</source>
        <translation>Pas maintenant</translation>
    </message>
    <message numerus="yes">
        <source>Compared with the start every %n pattern(s). What changed is photographed again; if that does not help, the measurement pauses and asks.</source>
        <translation>
            <numerusform>Comparé au début après chaque motif. Ce qui a changé est photographié à nouveau&#x202f;; si cela ne suffit pas, la mesure se met en pause et vous interroge.</numerusform>
            <numerusform>Comparé au début tous les %n motifs. Ce qui a changé est photographié à nouveau&#x202f;; si cela ne suffit pas, la mesure se met en pause et vous interroge.</numerusform>
        </translation>
    </message>
    <message>
        <source>Start</source>
        <translation>Début</translation>
    </message>
    <message>
        <source>Leave the room first</source>
        <translation>Quitter d’abord la pièce</translation>
    </message>
    <message>
        <source>Time to leave the room before measuring begins</source>
        <translation>Temps pour quitter la pièce avant le début de la mesure</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1&#x202f;s</translation>
    </message>
    <message>
        <source>A sound when it ends or needs me</source>
        <translation>Un son à la fin ou si l’on a besoin de moi</translation>
    </message>
    <message>
        <source>Ready</source>
        <translation>Prêt</translation>
    </message>
    <message>
        <source>Dark enough</source>
        <translation>Assez sombre</translation>
    </message>
    <message>
        <source>Room light is %1 of full light, limit %2.</source>
        <translation>La lumière de la pièce est à %1 de la pleine lumière, limite %2.</translation>
    </message>
    <message>
        <source>It is too bright here</source>
        <translation>Il fait trop clair ici</translation>
    </message>
    <message>
        <source>Room light is %1 of full light. Cover windows and lamps: less light, less noise.</source>
        <translation>La lumière de la pièce est à %1 de la pleine lumière. Occultez fenêtres et lampes&#x202f;: moins de lumière, moins de bruit.</translation>
    </message>
    <message>
        <source>Needs %1 of %2.</source>
        <translation>Nécessite %1 sur %2.</translation>
    </message>
    <message>
        <source>Room on the disk</source>
        <translation>Place sur le disque</translation>
    </message>
    <message>
        <source>The disk is too full</source>
        <translation>Le disque est trop plein</translation>
    </message>
    <message>
        <source>Floodlight image</source>
        <translation>Image en pleine lumière</translation>
    </message>
    <message>
        <source>the projector fully white</source>
        <translation>le projecteur entièrement blanc</translation>
    </message>
    <message>
        <source>The surface in the projector&apos;s full light</source>
        <translation>La surface dans la pleine lumière du projecteur</translation>
    </message>
    <message>
        <source>%1 px</source>
        <translation>%1&#x202f;px</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 sur %2</translation>
    </message>
    <message>
        <source>Level %1 of %2, %3 of %4 patterns.</source>
        <translation>Niveau %1 sur %2, %3 motifs sur %4.</translation>
    </message>
    <message>
        <source>Patterns for each block size</source>
        <translation>Motifs par taille de bloc</translation>
    </message>
    <message>
        <source>blocks are divided only where light needs it</source>
        <translation>les blocs ne sont divisés que là où la lumière l’exige</translation>
    </message>
    <message>
        <source>Stopped at %1 px</source>
        <translation>Arrêté à %1 px</translation>
    </message>
    <message>
        <source>Measuring was stopped at blocks of %1 px</source>
        <translation>La mesure a été arrêtée à des blocs de %1 px</translation>
    </message>
    <message>
        <source>Finer light is missing. Go on any time, if nothing has moved.</source>
        <translation>La lumière plus fine manque. Continuez à tout moment, si rien n’a bougé.</translation>
    </message>
    <message numerus="yes">
        <source>%1 dB expected, about %2 dB with %n more photograph(s), %3. Go on any time, if nothing has moved.</source>
        <translation>
            <numerusform>%1 dB attendus, environ %2 dB avec %n photo de plus, %3. Continuez à tout moment, si rien n’a bougé.</numerusform>
            <numerusform>%1 dB attendus, environ %2 dB avec %n photos de plus, %3. Continuez à tout moment, si rien n’a bougé.</numerusform>
        </translation>
    </message>
    <message>
        <source>Pictures expected at</source>
        <translation>Images attendues à</translation>
    </message>
    <message>
        <source>rough</source>
        <translation>grossier</translation>
    </message>
    <message>
        <source>fair</source>
        <translation>passable</translation>
    </message>
    <message>
        <source>good</source>
        <translation>bon</translation>
    </message>
    <message>
        <source>very good</source>
        <translation>très bon</translation>
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
        <translation>Les dB disent à quel point l’image approche celle voulue, là où elle peut être atteinte : 20 dB paraissent grossiers, 30 dB bons, et 6 dB de plus divisent l’écart par deux.</translation>
    </message>
    <message>
        <source>Compensated so far</source>
        <translation>Compensé jusqu’ici</translation>
    </message>
    <message>
        <source>A picture, compensated with what is measured so far</source>
        <translation>Une image, compensée avec ce qui est mesuré jusqu’ici</translation>
    </message>
    <message>
        <source>Appears after the first patterns, and grows sharper.</source>
        <translation>Apparaît après les premiers motifs et devient plus nette.</translation>
    </message>
    <message>
        <source>Expected now</source>
        <translation>Attendu maintenant</translation>
    </message>
    <message>
        <source>Blocks of %1 px. Expected now: %2. In the end: %3.</source>
        <translation>Blocs de %1 px. Attendu maintenant : %2. À la fin : %3.</translation>
    </message>
    <message>
        <source>In the end</source>
        <translation>À la fin</translation>
    </message>
    <message>
        <source>Waiting for room on the disk. Nothing is being projected.</source>
        <translation>En attente de place sur le disque. Rien n’est projeté.</translation>
    </message>
    <message>
        <source>Go on now</source>
        <translation>Continuer maintenant</translation>
    </message>
    <message>
        <source>Photographs to keep</source>
        <translation>Photos à conserver</translation>
    </message>
    <message>
        <source>Photographs to keep once all is measured</source>
        <translation>Photos à conserver une fois tout mesuré</translation>
    </message>
    <message>
        <source>All</source>
        <translation>Toutes</translation>
    </message>
    <message>
        <source>Of the latest measurement</source>
        <translation>Celles de la dernière mesure</translation>
    </message>
    <message>
        <source>None: results only</source>
        <translation>Aucune&#x202f;: résultats seuls</translation>
    </message>
    <message>
        <source>Those that were set aside by measuring again are removed once all is measured.</source>
        <translation>Celles mises de côté lors d’une nouvelle mesure sont supprimées une fois tout mesuré.</translation>
    </message>
    <message>
        <source>Removed once all is measured. Other settings then have to photograph everything again.</source>
        <translation>Supprimées une fois tout mesuré. Avec d’autres réglages, il faudra alors tout rephotographier.</translation>
    </message>
    <message>
        <source>Measuring with other settings then needs fewer new photographs.</source>
        <translation>Une mesure avec d’autres réglages demande alors moins de nouvelles photos.</translation>
    </message>
    <message>
        <source>Those of the last measurement were removed: all are taken again.</source>
        <translation>Celles de la dernière mesure ont été supprimées&#x202f;: toutes seront reprises.</translation>
    </message>
    <message>
        <source>Waiting for the projector&apos;s screen.</source>
        <translation>En attente de l’écran du projecteur.</translation>
    </message>
    <message>
        <source>Every photograph is saved. The earlier measurement is used until the new one is ready.</source>
        <translation>Chaque photo est enregistrée. L’ancienne mesure sert jusqu’à ce que la nouvelle soit prête.</translation>
    </message>
    <message>
        <source>To go on measuring, confirm that the room is clear.</source>
        <translation>Pour continuer la mesure, confirmez que la salle est évacuée.</translation>
    </message>
    <message>
        <source>Takes every photograph again. What is measured stays until then.</source>
        <translation>Reprend toutes les photos. Ce qui est mesuré reste jusque-là.</translation>
    </message>
    <message>
        <source>Measuring again has not ended</source>
        <translation>La nouvelle mesure n’est pas terminée</translation>
    </message>
    <message>
        <source>Measuring with these settings.</source>
        <translation>Mesure en cours avec ces réglages.</translation>
    </message>
    <message>
        <source>Waiting for the camera.</source>
        <translation>En attente de la caméra.</translation>
    </message>
    <message>
        <source>Keep the earlier one</source>
        <translation>Garder la précédente</translation>
    </message>
    <message>
        <source>The earlier measurement is used again, with all that followed from it.</source>
        <translation>La mesure précédente est de nouveau utilisée, avec tout ce qui en a découlé.</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>Ce qui est mesuré est en sécurité.</translation>
    </message>
    <message>
        <source>Paused, about %1 left</source>
        <translation>En pause, encore %1 environ</translation>
    </message>
    <message>
        <source>%1 of about %2</source>
        <translation>%1 sur environ %2</translation>
    </message>
    <message>
        <source>About %1 left</source>
        <translation>Encore %1 environ</translation>
    </message>
    <message>
        <source>Ends near %1. %2</source>
        <translation>Fin vers %1. %2</translation>
    </message>
    <message>
        <source>Put the camera back</source>
        <translation>Replacer la caméra</translation>
    </message>
    <message>
        <source>Test patterns are predicted from the measurement, then photographed: this is how far the two differ, the photographs&apos; noise included.</source>
        <translation>Les motifs d’essai sont prédits à partir de la mesure, puis photographiés : voici leur écart, bruit des photos compris.</translation>
    </message>
    <message>
        <source>%1; light right within about %2</source>
        <translation>%1 ; lumière juste à %2 près environ</translation>
    </message>
    <message>
        <source>Reading, %1</source>
        <translation>Lecture, %1</translation>
    </message>
    <message>
        <source>Waiting for your answer. Every photograph is saved.</source>
        <translation>Attend votre réponse. Chaque photo est enregistrée.</translation>
    </message>
    <message>
        <source>Go on measuring</source>
        <translation>Continuer la mesure</translation>
    </message>
    <message>
        <source>Answer</source>
        <translation>Répondre</translation>
    </message>
    <message>
        <source>Try again</source>
        <translation>Réessayer</translation>
    </message>
    <message>
        <source>The camera is back at its place</source>
        <translation>La caméra est revenue à sa place</translation>
    </message>
    <message>
        <source>It had moved while it measured, and looks again where it looked.</source>
        <translation>Elle avait bougé pendant la mesure et regarde de nouveau où elle regardait.</translation>
    </message>
    <message numerus="yes">
        <source>“%1” photographs %n pattern(s) again, from No. %2 on, and goes on from there.</source>
        <translation>
            <numerusform>« %1 » rephotographie %n motif à partir du n° %2 et continue de là.</numerusform>
            <numerusform>« %1 » rephotographie %n motifs à partir du n° %2 et continue de là.</numerusform>
        </translation>
    </message>
    <message>
        <source>“%1” looks once more, and goes on.</source>
        <translation>« %1 » regarde encore une fois et continue.</translation>
    </message>
    <message>
        <source>“%1” keeps all as it is: what changed will be wrong, and the report says so.</source>
        <translation>« %1 » laisse tout tel quel : ce qui a changé sera faux, et le rapport le dit.</translation>
    </message>
    <message>
        <source>Measuring waits for your answer.</source>
        <translation>La mesure attend votre réponse.</translation>
    </message>
    <message>
        <source>Kept photographs are read first.</source>
        <translation>Les photos gardées sont d’abord lues.</translation>
    </message>
    <message>
        <source>Nothing is being projected.</source>
        <translation>Rien n’est projeté.</translation>
    </message>
    <message>
        <source>Reading</source>
        <translation>Lecture</translation>
    </message>
    <message>
        <source>Reading, under a minute left</source>
        <translation>Lecture, moins d’une minute</translation>
    </message>
    <message>
        <source>Reading, about %1 left</source>
        <translation>Lecture, encore environ %1</translation>
    </message>
    <message>
        <source>Paused, under a minute left</source>
        <translation>En pause, moins d’une minute</translation>
    </message>
    <message>
        <source>Under a minute left</source>
        <translation>Moins d’une minute</translation>
    </message>
    <message>
        <source>%1 expected</source>
        <translation>%1 attendus</translation>
    </message>
    <message>
        <source>To measure again, confirm that the room is clear.</source>
        <translation>Pour mesurer à nouveau, confirmez que la salle est évacuée.</translation>
    </message>
    <message>
        <source>%1, %2 a minute</source>
        <translation>%1, %2 par minute</translation>
    </message>
    <message>
        <source>all projectors fully white</source>
        <translation>tous les projecteurs entièrement blancs</translation>
    </message>
    <message>
        <source>Reading what was measured</source>
        <translation>Lecture de ce qui a été mesuré</translation>
    </message>
    <message>
        <source>The camera is at its place</source>
        <translation>La caméra est à sa place</translation>
    </message>
    <message>
        <source>It looks where it looked. Perhaps the light flickered.</source>
        <translation>Elle regarde où elle regardait. La lumière a peut-être vacillé.</translation>
    </message>
    <message>
        <source>Ended by a change</source>
        <translation>Terminée par un changement</translation>
    </message>
    <message>
        <source>Put right what changed, then go on measuring.</source>
        <translation>Rétablissez ce qui a changé, puis continuez la mesure.</translation>
    </message>
    <message>
        <source>Measure again as it stands now, or put it back and go on measuring.</source>
        <translation>Remesurez en l’état actuel, ou remettez en place et continuez la mesure.</translation>
    </message>
    <message>
        <source>Measuring was stopped at blocks of %1 px: something had changed</source>
        <translation>La mesure a été arrêtée à des blocs de %1 px&#xa0;: quelque chose avait changé</translation>
    </message>
    <message>
        <source>Measuring ended, and something had changed</source>
        <translation>La mesure est terminée, et quelque chose avait changé</translation>
    </message>
    <message>
        <source>What was photographed since the look before is left out, all before it is kept.</source>
        <translation>Ce qui a été photographié depuis la vérification précédente est laissé de côté, tout ce qui précède est conservé.</translation>
    </message>
    <message>
        <source>Working out, %1</source>
        <translation>Calcul, %1</translation>
    </message>
    <message>
        <source>Working out the result</source>
        <translation>Calcul du résultat</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s)</source>
        <translation>
            <numerusform>%n motif</numerusform>
            <numerusform>%n motifs</numerusform>
        </translation>
    </message>
    <message>
        <source>Waits for an answer</source>
        <translation>Attend une réponse</translation>
    </message>
    <message>
        <source>%1 too bright</source>
        <translation>%1 trop clair</translation>
    </message>
    <message>
        <source>%1 left out</source>
        <translation>%1 laissés de côté</translation>
    </message>
    <message>
        <source>Waiting for your answer.</source>
        <translation>Attend votre réponse.</translation>
    </message>
    <message>
        <source>Stop and keep this one</source>
        <translation>Arrêter et garder celle-ci</translation>
    </message>
    <message>
        <source>Going on has not ended</source>
        <translation>La reprise n’est pas terminée</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s) expected, %1 of them checks; known exactly as each level begins</source>
        <translation>
            <numerusform>%n motif prévu, dont %1 de contrôle ; connu exactement au début de chaque niveau</numerusform>
            <numerusform>%n motifs prévus, dont %1 de contrôle ; connu exactement au début de chaque niveau</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s), %1 of them checks</source>
        <translation>
            <numerusform>%n motif, dont %1 de contrôle</numerusform>
            <numerusform>%n motifs, dont %1 de contrôle</numerusform>
        </translation>
    </message>
    <message>
        <source>Ending</source>
        <translation>Fin en cours</translation>
    </message>
    <message>
        <source>Measure with these settings</source>
        <translation>Mesurer avec ces réglages</translation>
    </message>
    <message>
        <source>Use the earlier one</source>
        <translation>Utiliser la précédente</translation>
    </message>
    <message>
        <source>Waiting</source>
        <translation>En attente</translation>
    </message>
    <message>
        <source>Waiting, under a minute left</source>
        <translation>En attente, moins d’une minute</translation>
    </message>
    <message>
        <source>Waiting, about %1 left</source>
        <translation>En attente, encore %1 environ</translation>
    </message>
    <message>
        <source>Keep the new ones</source>
        <translation>Garder les nouvelles</translation>
    </message>
    <message>
        <source>Keep the earlier measurement?</source>
        <translation>Garder la mesure précédente ?</translation>
    </message>
    <message>
        <source>The new photographs are set aside and not used again: measuring again then takes every photograph again.</source>
        <translation>Les nouvelles photos sont mises de côté et ne servent plus : remesurer reprend alors toutes les photos.</translation>
    </message>
    <message>
        <source>The earlier measurement, and all that followed from it.</source>
        <translation>La mesure précédente et tout ce qui en a découlé.</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s) kept</source>
        <translation>
            <numerusform>%n motif gardé</numerusform>
            <numerusform>%n motifs gardés</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The photographs of %n pattern(s) are read first. Then measuring goes on where it ended.</source>
        <translation>
            <numerusform>Les photos de %n motif sont d’abord lues. La mesure reprend ensuite où elle s’est arrêtée.</numerusform>
            <numerusform>Les photos de %n motifs sont d’abord lues. La mesure reprend ensuite où elle s’est arrêtée.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The photographs of %n pattern(s) are safe. Resuming gives the same result as if nothing had happened.</source>
        <translation>
            <numerusform>Les photos de %n motif sont en sécurité. La reprise donne le même résultat que si rien ne s’était passé.</numerusform>
            <numerusform>Les photos de %n motifs sont en sécurité. La reprise donne le même résultat que si rien ne s’était passé.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The new photographs of %n pattern(s) are safe: resume any time. Until then the earlier measurement is used.</source>
        <translation>
            <numerusform>Les nouvelles photos de %n motif sont en sécurité : reprenez à tout moment. D’ici là, l’ancienne mesure sert.</numerusform>
            <numerusform>Les nouvelles photos de %n motifs sont en sécurité : reprenez à tout moment. D’ici là, l’ancienne mesure sert.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The photographs of %n pattern(s) are on the disk. The pattern under way is not counted.</source>
        <translation>
            <numerusform>Les photos de %n motif sont sur le disque. Le motif en cours n’est pas compté.</numerusform>
            <numerusform>Les photos de %n motifs sont sur le disque. Le motif en cours n’est pas compté.</numerusform>
        </translation>
    </message>
    <message>
        <source>Photographs</source>
        <translation>Photos</translation>
    </message>
    <message numerus="yes">
        <source>Reading the photographs of %n pattern(s): %1.</source>
        <translation>
            <numerusform>Lecture des photos de %n motif : %1.</numerusform>
            <numerusform>Lecture des photos de %n motifs : %1.</numerusform>
        </translation>
    </message>
    <message>
        <source>Keep the new one</source>
        <translation>Garder la nouvelle</translation>
    </message>
    <message>
        <source>Use the earlier measurement?</source>
        <translation>Utiliser la mesure précédente ?</translation>
    </message>
    <message>
        <source>%1; lit, within the dashes: %2 of the view</source>
        <translation>%1&#xa0;; éclairé, dans les tirets&#xa0;: %2 du champ</translation>
    </message>
    <message>
        <source>Stopped after %1</source>
        <translation>Arrêté après %1</translation>
    </message>
    <message>
        <source>Stopped early: light finer than blocks of %1 px is missing.</source>
        <translation>Arrêté avant la fin&#xa0;: la lumière plus fine que des blocs de %1 px manque.</translation>
    </message>
    <message>
        <source>Again, not ended</source>
        <translation>À nouveau, non terminé</translation>
    </message>
    <message>
        <source>What was measured cannot be read</source>
        <translation>Les mesures ne peuvent pas être lues</translation>
    </message>
    <message>
        <source>Use the earlier measurement, or measure again.</source>
        <translation>Utilisez la mesure précédente, ou mesurez à nouveau.</translation>
    </message>
    <message>
        <source>Measure again.</source>
        <translation>Mesurez à nouveau.</translation>
    </message>
    <message>
        <source>%1 dB expected: what was measured does not fit together, and pictures are no better than uncorrected.</source>
        <translation>%1 dB attendus&#x202f;: les mesures ne concordent pas et les images ne sont pas meilleures que sans correction.</translation>
    </message>
    <message>
        <source>%1 dB expected. Go on any time, if nothing has moved.</source>
        <translation>%1 dB attendus. Continuez à tout moment si rien n’a bougé.</translation>
    </message>
    <message>
        <source>What was measured cannot be read.</source>
        <translation>Les mesures ne peuvent pas être lues.</translation>
    </message>
    <message>
        <source>%1: what was photographed since the check before is taken again.</source>
        <translation>%1 : ce qui a été photographié depuis le contrôle précédent est repris.</translation>
    </message>
    <message>
        <source>The light of the room was another one, too: see that it is as it was.</source>
        <translation>La lumière de la salle était différente aussi : veillez à ce qu’elle soit comme avant.</translation>
    </message>
    <message>
        <source>Ending: what is begun is photographed to its end, and test patterns. Then all of it is kept.</source>
        <translation>Fin en cours : ce qui est commencé est photographié jusqu’au bout, ainsi que des motifs de test. Ensuite, tout est conservé.</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the patterns flash.</source>
        <translation>Confirmez que la salle est évacuée : les motifs clignotent.</translation>
    </message>
    <message>
        <source>%1: all patterns are taken again, from the first.</source>
        <translation>%1 : tous les motifs sont repris, depuis le premier.</translation>
    </message>
    <message>
        <source>Measured in %1, and repaired since</source>
        <translation>Mesuré en %1, et réparé depuis</translation>
    </message>
    <message>
        <source>Photographs of the repair since</source>
        <translation>Photos de la réparation depuis</translation>
    </message>
    <message>
        <source>Stopped too early</source>
        <translation>Arrêtée trop tôt</translation>
    </message>
</context>
<context>
    <name>relucent::gui::AcquisitionTrace</name>
    <message>
        <source>the light flickered</source>
        <translation>la lumière a vacillé</translation>
    </message>
    <message>
        <source>the room light changed</source>
        <translation>la lumière de la salle a changé</translation>
    </message>
    <message>
        <source>the projector&apos;s light changed</source>
        <translation>la lumière du projecteur a changé</translation>
    </message>
    <message>
        <source>the camera or the projector moved</source>
        <translation>la caméra ou le projecteur a bougé</translation>
    </message>
    <message>
        <source>the picture was not the one sent</source>
        <translation>ce n’était pas l’image envoyée</translation>
    </message>
    <message>
        <source>the camera saw nothing</source>
        <translation>la caméra n’a rien vu</translation>
    </message>
    <message>
        <source>the projector showed nothing</source>
        <translation>le projecteur n’affichait rien</translation>
    </message>
    <message>
        <source>too bright, shorter exposure</source>
        <translation>trop clair, pose plus courte</translation>
    </message>
    <message>
        <source>does not fit what was seen before</source>
        <translation>ne concorde pas avec ce qui précède</translation>
    </message>
    <message>
        <source>No. %1</source>
        <translation>N° %1</translation>
    </message>
    <message>
        <source>No. %1 to %2</source>
        <translation>N° %1 à %2</translation>
    </message>
    <message>
        <source>Room light</source>
        <translation>Lumière de la salle</translation>
    </message>
    <message>
        <source>Camera and view</source>
        <translation>Caméra et champ</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>Projecteur</translation>
    </message>
    <message>
        <source>Flicker</source>
        <translation>Scintillement</translation>
    </message>
    <message>
        <source>Room light steady</source>
        <translation>Lumière de la salle stable</translation>
    </message>
    <message>
        <source>Room light changed</source>
        <translation>La lumière de la salle a changé</translation>
    </message>
    <message>
        <source>%1 of full light, changed by %2 since the start.</source>
        <translation>%1 de la pleine lumière, variation de %2 depuis le début.</translation>
    </message>
    <message>
        <source>Camera still</source>
        <translation>Caméra immobile</translation>
    </message>
    <message>
        <source>The view changed</source>
        <translation>Le champ a changé</translation>
    </message>
    <message>
        <source>The view differs by %1 from the first.</source>
        <translation>Le champ diffère du premier de %1.</translation>
    </message>
    <message>
        <source>Projector steady</source>
        <translation>Projecteur stable</translation>
    </message>
    <message>
        <source>The projector&apos;s light changed</source>
        <translation>La lumière du projecteur a changé</translation>
    </message>
    <message>
        <source>Its light drifted by %1 and is corrected.</source>
        <translation>Sa lumière a dérivé de %1 ; c’est corrigé.</translation>
    </message>
    <message>
        <source>No flicker</source>
        <translation>Aucun scintillement</translation>
    </message>
    <message>
        <source>Photographs of one pattern agree within %1.</source>
        <translation>Les photos d’un même motif concordent à %1 près.</translation>
    </message>
    <message>
        <source>No difference between photographs of one pattern was found.</source>
        <translation>Aucune différence entre les photos d’un même motif.</translation>
    </message>
    <message>
        <source>The camera or the projector moved</source>
        <translation>La caméra ou le projecteur a bougé</translation>
    </message>
    <message>
        <source>The picture is not the one sent</source>
        <translation>L’image n’est pas celle envoyée</translation>
    </message>
    <message>
        <source>The camera sees nothing</source>
        <translation>La caméra ne voit rien</translation>
    </message>
    <message>
        <source>The projector shows nothing</source>
        <translation>Le projecteur ne montre rien</translation>
    </message>
    <message>
        <source>Put right</source>
        <translation>Corrigé</translation>
    </message>
    <message>
        <source>Looked at again at the next check.</source>
        <translation>Revu à la prochaine vérification.</translation>
    </message>
    <message>
        <source>the light flickered, or something moved</source>
        <translation>la lumière a vacillé, ou quelque chose a bougé</translation>
    </message>
    <message>
        <source>The light flickers, or something moves</source>
        <translation>La lumière vacille, ou quelque chose bouge</translation>
    </message>
    <message>
        <source>Not known while the view has changed.</source>
        <translation>Inconnu tant que la vue est une autre.</translation>
    </message>
    <message>
        <source>The light flickers, or was switched</source>
        <translation>La lumière scintille ou a été allumée ou éteinte</translation>
    </message>
    <message>
        <source>Photographed again</source>
        <translation>Rephotographié</translation>
    </message>
    <message>
        <source>dark: lens covered for a moment?</source>
        <translation>sombre : objectif masqué un instant ?</translation>
    </message>
    <message>
        <source>Found since the last check.</source>
        <translation>Constaté depuis le dernier contrôle.</translation>
    </message>
    <message>
        <source>something in the view changed</source>
        <translation>quelque chose a changé dans la vue</translation>
    </message>
    <message>
        <source>Something in the view changed</source>
        <translation>Quelque chose a changé dans la vue</translation>
    </message>
    <message>
        <source>Not known while the camera sees nothing.</source>
        <translation>Inconnue tant que la caméra ne voit rien.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ActionBar</name>
    <message>
        <source>Progress of the measurement</source>
        <translation>Progression de la mesure</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Retour</translation>
    </message>
    <message>
        <source>Show where</source>
        <translation>Où ?</translation>
    </message>
</context>
<context>
    <name>relucent::gui::CameraPage</name>
    <message>
        <source>Choose</source>
        <translation>Choisir</translation>
    </message>
    <message>
        <source>Choose %1</source>
        <translation>Choisir %1</translation>
    </message>
    <message>
        <source>Choose the one that looks at the surface.</source>
        <translation>Choisissez celle qui vise la surface.</translation>
    </message>
    <message>
        <source>Looking for cameras</source>
        <translation>Recherche de caméras</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>Rien n’a été modifié.</translation>
    </message>
    <message>
        <source>Checking</source>
        <translation>Vérification</translation>
    </message>
    <message>
        <source>Checked %1</source>
        <translation>Vérifiée à %1</translation>
    </message>
    <message>
        <source>Choose the camera that looks at the surface.</source>
        <translation>Choisissez la caméra qui vise la surface.</translation>
    </message>
    <message>
        <source>Opening the devices</source>
        <translation>Ouverture des appareils</translation>
    </message>
    <message>
        <source>%1 is too bright in every exposure.</source>
        <translation>%1 de la vue est trop claire à toutes les poses.</translation>
    </message>
    <message>
        <source>Look through the camera first.</source>
        <translation>Affichez d’abord la vue caméra.</translation>
    </message>
    <message>
        <source>Next: test patterns for the projector&apos;s response</source>
        <translation>Ensuite&#x202f;: motifs d’essai pour la réponse du projecteur</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>Check again</source>
        <translation>Revérifier</translation>
    </message>
    <message>
        <source>Choose another camera</source>
        <translation>Choisir une autre caméra</translation>
    </message>
    <message>
        <source>Focus area</source>
        <translation>Zone de netteté</translation>
    </message>
    <message>
        <source>Nothing is measured at this step, so nothing is lost.</source>
        <translation>Rien n’est mesuré à cette étape, donc rien n’est perdu.</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Caméra</translation>
    </message>
    <message>
        <source>Frame the surface, focus, and let the exposures cover its brightest and darkest parts.</source>
        <translation>Cadrez la surface, faites la mise au point et vérifiez que les poses couvrent ses parties les plus claires et les plus sombres.</translation>
    </message>
    <message>
        <source>Focus, %1 of best</source>
        <translation>Netteté, %1 du maximum</translation>
    </message>
    <message>
        <source>Camera view</source>
        <translation>Vue caméra</translation>
    </message>
    <message>
        <source>What the camera sees now</source>
        <translation>Ce que voit la caméra</translation>
    </message>
    <message>
        <source>The camera is not being looked through.</source>
        <translation>La vue caméra est arrêtée.</translation>
    </message>
    <message>
        <source>Light in this exposure: red, green, blue</source>
        <translation>Lumière à cette pose&#x202f;: rouge, vert, bleu</translation>
    </message>
    <message>
        <source>Signal</source>
        <translation>Signal</translation>
    </message>
    <message>
        <source>Focus</source>
        <translation>Netteté</translation>
    </message>
    <message>
        <source>Turn the lens until the bar stays at the mark: the best so far.</source>
        <translation>Tournez la bague jusqu’à ce que la barre reste au repère&#x202f;: le maximum atteint.</translation>
    </message>
    <message>
        <source>Exposures</source>
        <translation>Temps de pose</translation>
    </message>
    <message>
        <source>Checks</source>
        <translation>Vérifications</translation>
    </message>
    <message>
        <source>Signal, share of full</source>
        <translation>Signal, part du maximum</translation>
    </message>
    <message>
        <source>Pixels</source>
        <translation>Pixels</translation>
    </message>
    <message>
        <source>The camera sees the projector</source>
        <translation>La caméra voit le projecteur</translation>
    </message>
    <message>
        <source>White and black differ as they should.</source>
        <translation>Blanc et noir diffèrent comme il se doit.</translation>
    </message>
    <message>
        <source>Bright parts are covered</source>
        <translation>Parties claires couvertes</translation>
    </message>
    <message>
        <source>%1 is too bright in every exposure</source>
        <translation>%1 de la vue est trop claire à toutes les poses</translation>
    </message>
    <message>
        <source>Close the lens a little, or shade lamps in the view.</source>
        <translation>Fermez un peu le diaphragme ou masquez les lampes dans la vue.</translation>
    </message>
    <message>
        <source>Dark parts are covered</source>
        <translation>Parties sombres couvertes</translation>
    </message>
    <message>
        <source>%1 is too dark in every exposure</source>
        <translation>%1 de la vue est trop sombre à toutes les poses</translation>
    </message>
    <message>
        <source>The projector may not reach there. Where it should, open the lens.</source>
        <translation>Le projecteur n’y arrive peut-être pas. Là où il le devrait, ouvrez le diaphragme.</translation>
    </message>
    <message>
        <source>Keep exposures</source>
        <translation>Garder les temps de pose</translation>
    </message>
    <message>
        <source>too bright to tell</source>
        <translation>trop clair pour juger</translation>
    </message>
    <message>
        <source>Too bright %1</source>
        <translation>Trop clair %1</translation>
    </message>
    <message>
        <source>Too dark %1</source>
        <translation>Trop sombre %1</translation>
    </message>
    <message>
        <source>No camera is chosen yet</source>
        <translation>Aucune caméra choisie</translation>
    </message>
    <message>
        <source>Camera pixels</source>
        <translation>Pixels de la caméra</translation>
    </message>
    <message>
        <source>As many as needed: %1</source>
        <translation>Autant que nécessaire : %1</translation>
    </message>
    <message>
        <source>All: %1</source>
        <translation>Tous : %1</translation>
    </message>
    <message>
        <source>%1 become one: %2</source>
        <translation>%1 en un seul : %2</translation>
    </message>
    <message>
        <source>Camera pixels that are used</source>
        <translation>Pixels de la caméra utilisés</translation>
    </message>
    <message>
        <source>Memory</source>
        <translation>Mémoire</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>Disque</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>Temps</translation>
    </message>
    <message>
        <source>More camera pixels than projector pixels show nothing more. The photographs that prove the result stay as large as they are.</source>
        <translation>Plus de pixels de caméra que de projecteur ne montrent rien de plus. Les photos qui prouvent le résultat gardent leur taille.</translation>
    </message>
    <message>
        <source>Mark what is sharp</source>
        <translation>Marquer ce qui est net</translation>
    </message>
    <message>
        <source>Checked before. Check again if camera or projector were moved.</source>
        <translation>Déjà contrôlé. Contrôlez à nouveau si la caméra ou le projecteur a bougé.</translation>
    </message>
    <message>
        <source>Continue</source>
        <translation>Continuer</translation>
    </message>
    <message>
        <source>Exposure times</source>
        <translation>Temps de pose</translation>
    </message>
    <message>
        <source>The projector&apos;s picture: the camera sees %1 of it</source>
        <translation>L’image du projecteur : la caméra en voit %1</translation>
    </message>
    <message>
        <source>at the left</source>
        <translation>à gauche</translation>
    </message>
    <message>
        <source>at the right</source>
        <translation>à droite</translation>
    </message>
    <message>
        <source>at the top</source>
        <translation>en haut</translation>
    </message>
    <message>
        <source>at the bottom</source>
        <translation>en bas</translation>
    </message>
    <message>
        <source>Missing are places within it: in shadow, or too dark for the camera.</source>
        <translation>Il manque des endroits à l’intérieur : dans l’ombre, ou trop sombres pour la caméra.</translation>
    </message>
    <message>
        <source>Missing: %1. Aim the camera there, or move it back.</source>
        <translation>Il manque : %1. Orientez la caméra par là, ou reculez-la.</translation>
    </message>
    <message>
        <source>%1 of the projector&apos;s picture is seen</source>
        <translation>%1 de l’image du projecteur est vu</translation>
    </message>
    <message>
        <source>%1 of projector %2&apos;s picture is seen</source>
        <translation>%1 de l’image du projecteur %2 est vu</translation>
    </message>
    <message>
        <source>Every exposure is a multiple of %1</source>
        <translation>Chaque pose est un multiple de %1</translation>
    </message>
    <message>
        <source>The projector&apos;s light changes as quickly as that: each photograph has all of it.</source>
        <translation>La lumière du projecteur change à ce rythme : chaque photo la contient en entier.</translation>
    </message>
    <message>
        <source>Allow any exposure</source>
        <translation>Permettre toute pose</translation>
    </message>
    <message>
        <source>Exposures shorter than %1 flicker</source>
        <translation>Les poses plus courtes que %1 scintillent</translation>
    </message>
    <message>
        <source>The projector&apos;s light changes within that time.</source>
        <translation>La lumière du projecteur change pendant ce temps.</translation>
    </message>
    <message>
        <source>Use multiples of %1</source>
        <translation>Utiliser des multiples de %1</translation>
    </message>
    <message>
        <source>Checked before</source>
        <translation>Déjà contrôlé</translation>
    </message>
    <message>
        <source>These exposures are kept. “Check again” looks through the camera.</source>
        <translation>Ces temps de pose sont conservés. « Revérifier » regarde par la caméra.</translation>
    </message>
    <message>
        <source>Not checked yet</source>
        <translation>Pas encore contrôlé</translation>
    </message>
    <message>
        <source>Missing: %1. A simulated camera stays where it stands: go on, what it does not see is left as it is.</source>
        <translation>Manque : %1. Une caméra simulée reste où elle est : continuez, ce qu’elle ne voit pas reste tel quel.</translation>
    </message>
    <message>
        <source>Exposures as measured</source>
        <translation>Poses de la mesure</translation>
    </message>
    <message>
        <source>Camera %1: %2 is too bright in every exposure.</source>
        <translation>Caméra %1&#x202f;: %2 est trop clair à chaque temps de pose.</translation>
    </message>
    <message>
        <source>What %1 sees now</source>
        <translation>Ce que voit %1 maintenant</translation>
    </message>
    <message>
        <source>Focus %1</source>
        <translation>Netteté %1</translation>
    </message>
    <message numerus="yes">
        <source>%n projector(s): %1</source>
        <translation>
            <numerusform>%n projecteur&#x202f;: %1</numerusform>
            <numerusform>%n projecteurs&#x202f;: %1</numerusform>
        </translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Lumière</translation>
    </message>
    <message>
        <source>Overlap</source>
        <translation>Recouvrement</translation>
    </message>
    <message>
        <source>how many projectors light each place</source>
        <translation>combien de projecteurs éclairent chaque endroit</translation>
    </message>
    <message>
        <source>Checks done</source>
        <translation>Vérifications faites</translation>
    </message>
    <message>
        <source>%1 of every picture is seen</source>
        <translation>%1 de chaque image est visible</translation>
    </message>
    <message>
        <source>Exposures, kept</source>
        <translation>Temps de pose, gardés</translation>
    </message>
    <message>
        <source>Check again to look with another one.</source>
        <translation>Vérifiez à nouveau pour regarder avec un autre.</translation>
    </message>
    <message>
        <source>Exposures, paused</source>
        <translation>Temps de pose, en pause</translation>
    </message>
    <message>
        <source>places within it</source>
        <translation>des endroits à l’intérieur</translation>
    </message>
    <message>
        <source>All of the view, by one exposure or another.</source>
        <translation>Tout le champ, par un temps de pose ou un autre.</translation>
    </message>
    <message>
        <source>All but %1 of the view, by one exposure or another.</source>
        <translation>Toute la vue, sauf %1, par un temps de pose ou un autre.</translation>
    </message>
    <message>
        <source>%1 too bright</source>
        <translation>%1 trop clair</translation>
    </message>
    <message>
        <source>Keep the former camera</source>
        <translation>Garder la caméra précédente</translation>
    </message>
    <message>
        <source>exposure %1, click to judge focus</source>
        <translation>pose %1, cliquez où juger la netteté</translation>
    </message>
    <message>
        <source>Checks under way</source>
        <translation>Contrôles en cours</translation>
    </message>
    <message>
        <source>Stop the checks</source>
        <translation>Arrêter les contrôles</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the checks begin with that.</source>
        <translation>Confirmez que la salle est évacuée&#xa0;: les contrôles commencent alors.</translation>
    </message>
    <message>
        <source>as it was seen last, exposure %1</source>
        <translation>vu en dernier lieu, pose %1</translation>
    </message>
    <message>
        <source>%1 of full light was too bright in every exposure. “Check again” looks through the camera.</source>
        <translation>%1 de la pleine lumière était trop clair à chaque temps de pose. « Revérifier » regarde par la caméra.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::CameraRows</name>
    <message>
        <source>Cameras</source>
        <translation>Caméras</translation>
    </message>
    <message>
        <source>Look again</source>
        <translation>Rechercher</translation>
    </message>
    <message>
        <source>Looking for cameras</source>
        <translation>Recherche de caméras</translation>
    </message>
    <message>
        <source>Cannot be used: %1</source>
        <translation>Inutilisable&#x202f;: %1</translation>
    </message>
    <message numerus="yes">
        <source>%1 pixels, %n bit(s), exposures %2 to %3</source>
        <translation>
            <numerusform>%1 pixels, %n bit, poses de %2 à %3</numerusform>
            <numerusform>%1 pixels, %n bits, poses de %2 à %3</numerusform>
        </translation>
    </message>
    <message>
        <source>Recommended: it tells faint light apart best</source>
        <translation>Conseillée&#x202f;: distingue le mieux la lumière faible</translation>
    </message>
    <message>
        <source>Fewer bits: faint light is told apart less well</source>
        <translation>Moins de bits&#x202f;: la lumière faible est moins bien distinguée</translation>
    </message>
    <message>
        <source>Recommended: its exposures cover most, from bright to dark</source>
        <translation>Conseillée&#x202f;: ses temps de pose couvrent le plus, du clair au sombre</translation>
    </message>
    <message>
        <source>Fewer exposures: bright and dark are harder to cover</source>
        <translation>Moins de temps de pose&#x202f;: clair et sombre sont plus durs à couvrir</translation>
    </message>
    <message>
        <source>Recommended: it has most pixels</source>
        <translation>Conseillée&#x202f;: elle a le plus de pixels</translation>
    </message>
    <message>
        <source>Fewer pixels than the first</source>
        <translation>Moins de pixels que la première</translation>
    </message>
    <message>
        <source>As suitable as the first</source>
        <translation>Aussi adaptée que la première</translation>
    </message>
    <message>
        <source>No camera answers. Check its cable and its power, and close other programs that use it.</source>
        <translation>Aucune caméra ne répond. Vérifiez son câble et son alimentation, et fermez les autres programmes qui l’utilisent.</translation>
    </message>
    <message>
        <source>These are found here: webcams and other video devices, industrial cameras by GigE Vision or USB3 Vision, and still cameras on USB.</source>
        <translation>On trouve ici : webcams et autres périphériques vidéo, caméras industrielles en GigE Vision ou USB3 Vision, et appareils photo en USB.</translation>
    </message>
    <message>
        <source>Any other is driven by a program of yours: go Back and choose “New venue by script”. The guide (F1) tells how cameras are set up.</source>
        <translation>Toute autre est pilotée par un programme à vous : « Retour », puis « Nouveau lieu par script ». Le guide (F1) explique comment préparer les caméras.</translation>
    </message>
    <message>
        <source>Any other is driven by a program of yours. The guide (F1) tells how cameras are set up.</source>
        <translation>Toute autre est pilotée par un programme à vous. Le guide (F1) explique comment préparer les caméras.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ClusterPage</name>
    <message>
        <source>What is measured is safe.</source>
        <translation>Ce qui est mesuré est en sécurité.</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>Obsolète</translation>
    </message>
    <message>
        <source>Grouping again</source>
        <translation>Nouveau regroupement</translation>
    </message>
    <message>
        <source>Grouping</source>
        <translation>Regroupement</translation>
    </message>
    <message>
        <source>Reading the light transport</source>
        <translation>Lecture du transport lumineux</translation>
    </message>
    <message>
        <source>Preview content</source>
        <translation>Aperçu du contenu</translation>
    </message>
    <message>
        <source>The clusters that are kept belong to an earlier threshold</source>
        <translation>Les groupes gardés datent d’un ancien seuil</translation>
    </message>
    <message>
        <source>What you see here has been grouped again. Going on keeps it.</source>
        <translation>Ce que vous voyez ici est un nouveau regroupement. Continuer le garde.</translation>
    </message>
    <message>
        <source>Cluster</source>
        <translation>Groupes</translation>
    </message>
    <message>
        <source>Cluster map</source>
        <translation>Carte des groupes</translation>
    </message>
    <message>
        <source>click a pixel</source>
        <translation>cliquez un pixel</translation>
    </message>
    <message>
        <source>Error map</source>
        <translation>Erreur</translation>
    </message>
    <message>
        <source>Flat</source>
        <translation>Plat</translation>
    </message>
    <message>
        <source>Relief</source>
        <translation>Relief</translation>
    </message>
    <message>
        <source>Cluster sizes</source>
        <translation>Taille des groupes</translation>
    </message>
    <message>
        <source>Projector pixels in the cluster</source>
        <translation>Pixels du projecteur dans le groupe</translation>
    </message>
    <message>
        <source>Clusters</source>
        <translation>Groupes</translation>
    </message>
    <message>
        <source>%1, %2: in no cluster</source>
        <translation>%1, %2&#x202f;: dans aucun groupe</translation>
    </message>
    <message>
        <source>Error map, median %1</source>
        <translation>Carte d’erreur, médiane %1</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>Distance</translation>
    </message>
    <message>
        <source>small, sharp</source>
        <translation>petits, nets</translation>
    </message>
    <message>
        <source>large, fast</source>
        <translation>grands, rapides</translation>
    </message>
    <message>
        <source>Share of the brightest</source>
        <translation>Part du plus lumineux</translation>
    </message>
    <message>
        <source>more detail</source>
        <translation>plus de détails</translation>
    </message>
    <message>
        <source>more speed</source>
        <translation>plus rapide</translation>
    </message>
    <message>
        <source>Largest cluster</source>
        <translation>Plus grand groupe</translation>
    </message>
    <message>
        <source>fast</source>
        <translation>rapide</translation>
    </message>
    <message>
        <source>exact</source>
        <translation>exact</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>Résultat</translation>
    </message>
    <message>
        <source>Light kept in clusters</source>
        <translation>Lumière dans les groupes</translation>
    </message>
    <message>
        <source>Median error</source>
        <translation>Erreur médiane</translation>
    </message>
    <message>
        <source>%1 px</source>
        <translation>%1&#x202f;px</translation>
    </message>
    <message>
        <source>%1 of light</source>
        <translation>%1 de la lumière</translation>
    </message>
    <message numerus="yes">
        <source>%n cluster(s)</source>
        <translation>
            <numerusform>%n groupe</numerusform>
            <numerusform>%n groupes</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n cluster(s), median %1 px</source>
        <translation>
            <numerusform>%n groupe, médiane %1 px</numerusform>
            <numerusform>%n groupes, médiane %1 px</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1, %2: %n projector pixel(s), error %3</source>
        <translation>
            <numerusform>%1, %2 : %n pixel du projecteur, erreur %3</numerusform>
            <numerusform>%1, %2 : %n pixels du projecteur, erreur %3</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Cluster map, %n cluster(s), largest %1</source>
        <translation>
            <numerusform>Carte des groupes, %n groupe, le plus grand : %1</numerusform>
            <numerusform>Carte des groupes, %n groupes, le plus grand : %1</numerusform>
        </translation>
    </message>
    <message>
        <source>95 % of pixels below</source>
        <translation>95 % des pixels sous</translation>
    </message>
    <message numerus="yes">
        <source>%1, %2: %n projector pixel(s)</source>
        <translation>
            <numerusform>%1, %2 : %n pixel du projecteur</numerusform>
            <numerusform>%1, %2 : %n pixels du projecteur</numerusform>
        </translation>
    </message>
    <message>
        <source>error</source>
        <translation>erreur</translation>
    </message>
    <message>
        <source>limit %1</source>
        <translation>limite %1</translation>
    </message>
    <message>
        <source>over %1</source>
        <translation>plus de %1</translation>
    </message>
    <message>
        <source>about %1</source>
        <translation>environ %1</translation>
    </message>
    <message>
        <source>Cut off by the size limit</source>
        <translation>Coupée par la limite</translation>
    </message>
    <message>
        <source>Films, frames a second</source>
        <translation>Vidéo, images par seconde</translation>
    </message>
    <message>
        <source>What this computer manages in Full HD with the light that Threshold keeps. The groups make no difference to it: films are solved in overlapping windows.</source>
        <translation>Ce que cet ordinateur atteint en Full HD avec la lumière que garde Seuil. Les groupes n’y changent rien : la vidéo est résolue dans des fenêtres qui se recouvrent.</translation>
    </message>
    <message>
        <source>Without a size limit, one cluster would cover %1 of the picture.</source>
        <translation>Sans limite de taille, un groupe couvrirait %1 de l’image.</translation>
    </message>
    <message>
        <source>The surface is blurred across neighbouring pixels, so groups join up. The limit keeps them apart.</source>
        <translation>La surface est floue d’un pixel à l’autre, si bien que les groupes se rejoignent. La limite les sépare.</translation>
    </message>
    <message>
        <source>The clusters that are kept belong to an earlier measurement</source>
        <translation>Les groupes gardés datent d’une ancienne mesure</translation>
    </message>
    <message>
        <source>Films are shown by “All bounces, for films”, whatever the clusters are. Clusters tell which places light each other, and can be compared at Preview.</source>
        <translation>Les vidéos utilisent «&#x202f;Tous les rebonds, pour la vidéo&#x202f;», quels que soient les groupes. Les groupes disent quels endroits s’éclairent entre eux et se comparent dans l’aperçu.</translation>
    </message>
    <message>
        <source>See which parts of the surface light each other, and split them into groups that can be solved on their own.</source>
        <translation>Voir quelles parties de la surface s’éclairent entre elles et les diviser en groupes qui se résolvent seuls.</translation>
    </message>
    <message>
        <source>Grouped anew</source>
        <translation>Regroupé à nouveau</translation>
    </message>
    <message>
        <source>Changed: it is applied as soon as you go on.</source>
        <translation>Modifié&#xa0;: appliqué dès que vous continuez.</translation>
    </message>
    <message>
        <source>What was measured is too coarse to group. Go on measuring.</source>
        <translation>La mesure est trop grossière pour former des groupes. Continuez la mesure.</translation>
    </message>
    <message>
        <source>No light is strong enough to group.</source>
        <translation>Aucune lumière n’est assez forte pour former des groupes.</translation>
    </message>
    <message>
        <source>Reliefs need OpenGL, which is not there.</source>
        <translation>Les reliefs demandent OpenGL, qui est absent.</translation>
    </message>
    <message>
        <source>An error of %1 is normal here.</source>
        <translation>Une erreur de %1 est normale ici.</translation>
    </message>
    <message>
        <source>Grouping drops the blur of the lens on purpose: little where it is sharp, 70 to 80 % where it is blurred. Look for patches that stand out from their surroundings.</source>
        <translation>Le regroupement écarte exprès le flou de l’objectif : peu là où l’image est nette, 70 à 80 % là où elle est floue. Cherchez les zones qui se détachent de leur entourage.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::CornerView</name>
    <message>
        <source>Top left corner, %1, %2.</source>
        <translation>Coin supérieur gauche, %1, %2.</translation>
    </message>
    <message>
        <source>Top right corner, %1, %2.</source>
        <translation>Coin supérieur droit, %1, %2.</translation>
    </message>
    <message>
        <source>Bottom right corner, %1, %2.</source>
        <translation>Coin inférieur droit, %1, %2.</translation>
    </message>
    <message>
        <source>Bottom left corner, %1, %2.</source>
        <translation>Coin inférieur gauche, %1, %2.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::DevicePage</name>
    <message>
        <source>A show is playing</source>
        <translation>Une diffusion est en cours</translation>
    </message>
    <message>
        <source>What is begun here shines in its place. The show is seen again once it has ended.</source>
        <translation>Ce qui est lancé ici est projeté à sa place. La diffusion réapparaît une fois que c’est terminé.</translation>
    </message>
    <message>
        <source>Another program plays a show of this venue</source>
        <translation>Un autre programme diffuse ce lieu</translation>
    </message>
    <message>
        <source>The show plays on.</source>
        <translation>La diffusion continue.</translation>
    </message>
    <message>
        <source>End that show</source>
        <translation>Arrêter cette diffusion</translation>
    </message>
    <message>
        <source>End the show</source>
        <translation>Arrêter la diffusion</translation>
    </message>
    <message>
        <source>Let it play</source>
        <translation>La laisser continuer</translation>
    </message>
    <message>
        <source>The show that another program plays of this venue: the projector&apos;s screen goes dark.</source>
        <translation>La diffusion de ce lieu par un autre programme&#xa0;: l’écran du projecteur devient noir.</translation>
    </message>
    <message>
        <source>Venue and playlist stay. An installed show starts again at the next log-in.</source>
        <translation>Le lieu et la liste restent. Une diffusion installée redémarre à la prochaine ouverture de session.</translation>
    </message>
    <message>
        <source>Its pictures shine on the projector whatever is shown from here, and may come between patterns that are measured.</source>
        <translation>Ses images sont projetées quoi qu’on montre d’ici, et peuvent se glisser entre les motifs mesurés.</translation>
    </message>
    <message>
        <source>It is ending</source>
        <translation>Elle se termine</translation>
    </message>
    <message>
        <source>The show that another program plays of another venue: the projector&apos;s screen goes dark.</source>
        <translation>La diffusion d’un autre lieu par un autre programme&#xa0;: l’écran du projecteur s’éteint.</translation>
    </message>
    <message>
        <source>Another program plays a show of another venue on this projector</source>
        <translation>Un autre programme diffuse un autre lieu sur ce projecteur</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged. Plug it in again: the show comes back by itself.</source>
        <translation>L’écran du projecteur est débranché. Rebranchez-le : la diffusion revient d’elle-même.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::DeviceSelector</name>
    <message>
        <source>Projector that is shown</source>
        <translation>Projecteur affiché</translation>
    </message>
    <message>
        <source>Camera that is shown</source>
        <translation>Caméra affichée</translation>
    </message>
</context>
<context>
    <name>relucent::gui::EndingDialog</name>
    <message>
        <source>Ending</source>
        <translation>Fermeture</translation>
    </message>
    <message>
        <source>Ending…</source>
        <translation>Fermeture…</translation>
    </message>
    <message>
        <source>Everything that was measured is safe. The devices finish what they are doing, which can take half a minute; then this window closes by itself.</source>
        <translation>Tout ce qui a été mesuré est en sécurité. Les appareils terminent ce qu’ils font, ce qui peut prendre une demi-minute ; puis cette fenêtre se ferme d’elle-même.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::FailureDialog</name>
    <message>
        <source>The disk did not do what was asked</source>
        <translation>Le disque n’a pas fait ce qui était demandé</translation>
    </message>
    <message>
        <source>The memory is full</source>
        <translation>La mémoire est pleine</translation>
    </message>
    <message>
        <source>A file cannot be read</source>
        <translation>Un fichier est illisible</translation>
    </message>
    <message>
        <source>This cannot be done as it is</source>
        <translation>C’est impossible en l’état</translation>
    </message>
    <message>
        <source>The computation failed</source>
        <translation>Le calcul a échoué</translation>
    </message>
    <message>
        <source>What happened</source>
        <translation>Ce qui s’est passé</translation>
    </message>
    <message>
        <source>What is safe</source>
        <translation>Ce qui est en sécurité</translation>
    </message>
    <message>
        <source>What to do</source>
        <translation>Que faire</translation>
    </message>
    <message>
        <source>Copy details</source>
        <translation>Copier les détails</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Fermer</translation>
    </message>
    <message>
        <source>What it ends</source>
        <translation>Ce que cela arrête</translation>
    </message>
    <message>
        <source>What happens</source>
        <translation>Ce qui se passe</translation>
    </message>
    <message>
        <source>A device did not do what was asked</source>
        <translation>Un appareil n’a pas fait ce qui était demandé</translation>
    </message>
</context>
<context>
    <name>relucent::gui::FlashConsent</name>
    <message>
        <source>The projector shows patterns that change as quickly as the devices can, perhaps more than 3 times a second.</source>
        <translation>Le projecteur affiche des motifs qui changent aussi vite que les appareils le peuvent, peut-être plus de 3 fois par seconde.</translation>
    </message>
    <message>
        <source>The room is clear</source>
        <translation>La salle est évacuée</translation>
    </message>
    <message>
        <source>Flashing light</source>
        <translation>Lumière clignotante</translation>
    </message>
    <message>
        <source>The room is clear and everyone here knows</source>
        <translation>La salle est évacuée et chacun ici est prévenu</translation>
    </message>
    <message>
        <source>Flashing light can cause seizures. Clear the room and cover the entrance.</source>
        <translation>La lumière clignotante peut provoquer des crises d’épilepsie. Évacuez la salle et masquez l’entrée.</translation>
    </message>
    <message numerus="yes">
        <source>The projector shows patterns that change about %n time(s) a second, and at times more often.</source>
        <translation>
            <numerusform>Le projecteur affiche des motifs qui changent environ %n fois par seconde, par moments plus souvent.</numerusform>
            <numerusform>Le projecteur affiche des motifs qui changent environ %n fois par seconde, par moments plus souvent.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::gui::HelpWindow</name>
    <message>
        <source>Help</source>
        <translation>Aide</translation>
    </message>
    <message>
        <source>Search the guide</source>
        <translation>Chercher dans le guide</translation>
    </message>
    <message>
        <source>Pages of the guide</source>
        <translation>Pages du guide</translation>
    </message>
    <message>
        <source>The page</source>
        <translation>La page</translation>
    </message>
    <message>
        <source>No page holds these words.</source>
        <translation>Aucune page ne contient ces mots.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::IdentifyOverlay</name>
    <message>
        <source>%1, %2 × %3, %4 Hz</source>
        <translation>%1, %2 × %3, %4&#x202f;Hz</translation>
    </message>
    <message>
        <source>Lines sharp? Then this is the projector&apos;s own resolution.</source>
        <translation>Lignes nettes&#x202f;? Alors c’est la définition native du projecteur.</translation>
    </message>
    <message>
        <source>Screen %1</source>
        <translation>Écran %1</translation>
    </message>
</context>
<context>
    <name>relucent::gui::LinearizePage</name>
    <message>
        <source>The photographs of this step are still in the folder.</source>
        <translation>Les photos de cette étape sont encore dans le dossier.</translation>
    </message>
    <message>
        <source>Measuring, %1</source>
        <translation>Mesure, %1</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Mesuré</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>Obsolète</translation>
    </message>
    <message>
        <source>Stopped by a failure</source>
        <translation>Arrêt sur erreur</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>Appareils utilisés à l’étape «&#x202f;%1&#x202f;».</translation>
    </message>
    <message>
        <source>The colours do not add up. Continuing is recorded in the report.</source>
        <translation>Les couleurs ne s’additionnent pas. Si vous continuez, le rapport le mentionne.</translation>
    </message>
    <message>
        <source>Measured in %1</source>
        <translation>Mesuré en %1</translation>
    </message>
    <message>
        <source>Plan acquisition</source>
        <translation>Régler l’acquisition</translation>
    </message>
    <message>
        <source>Continue anyway</source>
        <translation>Continuer ainsi</translation>
    </message>
    <message>
        <source>Measure response</source>
        <translation>Mesurer la réponse</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Arrêter</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>Remesurer</translation>
    </message>
    <message>
        <source>These curves belong to earlier settings</source>
        <translation>Ces courbes datent d’anciens réglages</translation>
    </message>
    <message>
        <source>They still work and stay until the new ones are measured.</source>
        <translation>Elles restent utilisables jusqu’à la mesure des nouvelles.</translation>
    </message>
    <message>
        <source>Levels</source>
        <translation>Niveaux</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>Rien n’a été modifié.</translation>
    </message>
    <message>
        <source>Try again</source>
        <translation>Réessayer</translation>
    </message>
    <message>
        <source>Every photograph that was taken is on the disk. Trying again goes on from there.</source>
        <translation>Toutes les photos prises sont sur le disque. Réessayer reprend à partir de là.</translation>
    </message>
    <message>
        <source>Linearize</source>
        <translation>Linéarisation</translation>
    </message>
    <message>
        <source>Measure how much light each step of the projector&apos;s three colours really gives.</source>
        <translation>Mesurez la lumière que donne réellement chaque niveau des trois couleurs du projecteur.</translation>
    </message>
    <message>
        <source>Red</source>
        <translation>Rouge</translation>
    </message>
    <message>
        <source>Green</source>
        <translation>Vert</translation>
    </message>
    <message>
        <source>Blue</source>
        <translation>Bleu</translation>
    </message>
    <message>
        <source>Sent to the projector</source>
        <translation>Envoyé au projecteur</translation>
    </message>
    <message>
        <source>Seen by the camera</source>
        <translation>Vu par la caméra</translation>
    </message>
    <message>
        <source>Pattern that the projector shows</source>
        <translation>Motif affiché par le projecteur</translation>
    </message>
    <message>
        <source>Last photograph</source>
        <translation>Dernière photo</translation>
    </message>
    <message>
        <source>Appears when measuring begins.</source>
        <translation>Apparaît au début de la mesure.</translation>
    </message>
    <message>
        <source>%1, photograph %2</source>
        <translation>%1, photo %2</translation>
    </message>
    <message>
        <source>Response of the projector</source>
        <translation>Réponse du projecteur</translation>
    </message>
    <message>
        <source>Level sent to the projector</source>
        <translation>Niveau envoyé au projecteur</translation>
    </message>
    <message>
        <source>Light, % of full</source>
        <translation>Lumière, % du maximum</translation>
    </message>
    <message>
        <source>Light of every level, three colours</source>
        <translation>Lumière de chaque niveau, trois couleurs</translation>
    </message>
    <message>
        <source>as it is measured</source>
        <translation>pendant la mesure</translation>
    </message>
    <message numerus="yes">
        <source>%n level(s) a colour, drift removed</source>
        <translation>
            <numerusform>%n niveau par couleur, dérive retirée</numerusform>
            <numerusform>%n niveaux par couleur, dérive retirée</numerusform>
        </translation>
    </message>
    <message>
        <source>not measured yet</source>
        <translation>pas encore mesuré</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>Résultat</translation>
    </message>
    <message>
        <source>Exposures</source>
        <translation>Temps de pose</translation>
    </message>
    <message>
        <source>Chosen for this venue</source>
        <translation>Choisis pour ce lieu</translation>
    </message>
    <message>
        <source>Measure with</source>
        <translation>Mesurer avec</translation>
    </message>
    <message>
        <source>Levels a colour</source>
        <translation>Niveaux par couleur</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>Mesure</translation>
    </message>
    <message>
        <source>Not measured yet</source>
        <translation>Pas encore mesuré</translation>
    </message>
    <message>
        <source>Whether the colours add up, the camera is linear and every level is brighter than the one below is told when all levels are measured.</source>
        <translation>Quand tous les niveaux sont mesurés, vous saurez si les couleurs s’additionnent, si la caméra est linéaire et si chaque niveau est plus clair que le précédent.</translation>
    </message>
    <message>
        <source>The colours add up</source>
        <translation>Les couleurs s’additionnent</translation>
    </message>
    <message>
        <source>Red, green and blue together give white within %1.</source>
        <translation>Rouge, vert et bleu ensemble donnent le blanc à %1 près.</translation>
    </message>
    <message>
        <source>The colours do not add up</source>
        <translation>Les couleurs ne s’additionnent pas</translation>
    </message>
    <message>
        <source>White differs by %1 from its colours. Turn off “brilliant” or “dynamic” in the projector&apos;s menu, then measure again.</source>
        <translation>Le blanc s’écarte de %1 de ses couleurs. Désactivez «&#x202f;brillant&#x202f;» ou «&#x202f;dynamique&#x202f;» dans le menu du projecteur, puis remesurez.</translation>
    </message>
    <message>
        <source>The camera is linear</source>
        <translation>La caméra est linéaire</translation>
    </message>
    <message>
        <source>The camera&apos;s curve is known</source>
        <translation>La courbe de la caméra est connue</translation>
    </message>
    <message>
        <source>Doubling the exposure doubles the signal.</source>
        <translation>Doubler la pose double le signal.</translation>
    </message>
    <message>
        <source>Its photographs are brought back to linear light.</source>
        <translation>Ses photos sont ramenées à une lumière linéaire.</translation>
    </message>
    <message>
        <source>Curves rise everywhere</source>
        <translation>Courbes partout croissantes</translation>
    </message>
    <message>
        <source>No level is darker than the one below it.</source>
        <translation>Aucun niveau n’est plus sombre que le précédent.</translation>
    </message>
    <message>
        <source>Found while measuring</source>
        <translation>Constaté pendant la mesure</translation>
    </message>
    <message numerus="yes">
        <source>About %n test pattern(s)</source>
        <translation>
            <numerusform>Environ %n motif d’essai</numerusform>
            <numerusform>Environ %n motifs d’essai</numerusform>
        </translation>
    </message>
    <message>
        <source>Go on now</source>
        <translation>Continuer maintenant</translation>
    </message>
    <message>
        <source>Measuring with these settings. Stop to change them.</source>
        <translation>Mesure en cours avec ces réglages. Arrêtez-la pour les changer.</translation>
    </message>
    <message>
        <source>Keep the earlier one</source>
        <translation>Garder la précédente</translation>
    </message>
    <message>
        <source>The earlier curves are used again, with all that followed from them.</source>
        <translation>Les courbes précédentes sont de nouveau utilisées, avec tout ce qui en a découlé.</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>Ce qui est mesuré est en sécurité.</translation>
    </message>
    <message>
        <source>Black level</source>
        <translation>Niveau de noir</translation>
    </message>
    <message>
        <source>Contrast</source>
        <translation>Contraste</translation>
    </message>
    <message>
        <source>%1 of full light</source>
        <translation>%1 de la pleine lumière</translation>
    </message>
    <message>
        <source>Colours within %1</source>
        <translation>Couleurs à %1 près</translation>
    </message>
    <message>
        <source>How far each level&apos;s light is from the fitted curve</source>
        <translation>Écart entre la lumière de chaque niveau et la courbe</translation>
    </message>
    <message>
        <source>within ±%1</source>
        <translation>à ±%1 près</translation>
    </message>
    <message>
        <source>One test pattern shows many levels side by side, so few patterns are enough.</source>
        <translation>Un motif de test montre de nombreux niveaux côte à côte : peu de motifs suffisent.</translation>
    </message>
    <message>
        <source>Off the curve</source>
        <translation>Écart à la courbe</translation>
    </message>
    <message>
        <source>Residuals: what was photographed, less the curve that was fitted to it.</source>
        <translation>Résidus&#xa0;: ce qui a été photographié, moins la courbe ajustée.</translation>
    </message>
    <message>
        <source>Off the curve, % of full</source>
        <translation>Écart à la courbe, % du maximum</translation>
    </message>
    <message>
        <source>Stopping after the photograph under way.</source>
        <translation>Arrêt après la photo en cours.</translation>
    </message>
    <message>
        <source>To measure again, confirm that the room is clear.</source>
        <translation>Pour mesurer à nouveau, confirmez que la salle est évacuée.</translation>
    </message>
    <message>
        <source>Colours off by %1</source>
        <translation>Couleurs décalées de %1</translation>
    </message>
    <message>
        <source>The photographs contradict each other. See that nothing covers the lens, then measure again.</source>
        <translation>Les photos se contredisent. Vérifiez que rien ne masque l’objectif, puis mesurez de nouveau.</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the patterns flash.</source>
        <translation>Confirmez que la salle est évacuée : les motifs clignotent.</translation>
    </message>
    <message>
        <source>The photographs contradict each other</source>
        <translation>Les photos se contredisent</translation>
    </message>
    <message>
        <source>White differs by %1 from its colours, and levels by up to %2 from their curve: no picture mode does that. Something covered the lens or the picture, or the light changed. Nothing else is told from these photographs; measure again.</source>
        <translation>Le blanc diffère de %1 de ses couleurs, et des niveaux jusqu’à %2 de leur courbe : aucun mode d’image ne fait cela. Quelque chose masquait l’objectif ou l’image, ou la lumière a changé. On ne peut rien déduire d’autre de ces photos ; mesurez de nouveau.</translation>
    </message>
    <message>
        <source>The camera sees hardly any light of the projector</source>
        <translation>La caméra ne voit presque aucune lumière du projecteur</translation>
    </message>
    <message>
        <source>See that nothing covers the lens or the picture. What is photographed meanwhile is lost: stop, and measure again.</source>
        <translation>Vérifiez que rien ne masque l’objectif ni l’image. Ce qui est photographié entre-temps est perdu : arrêtez, puis mesurez de nouveau.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MainWindow</name>
    <message>
        <source>Dim pictures</source>
        <translation>Assombrir les images</translation>
    </message>
    <message>
        <source>Pictures dimmed</source>
        <translation>Images assombries</translation>
    </message>
    <message>
        <source>Settings</source>
        <translation>Réglages</translation>
    </message>
    <message>
        <source>Help</source>
        <translation>Aide</translation>
    </message>
    <message>
        <source>F1</source>
        <translation>F1</translation>
    </message>
    <message>
        <source>Less light from this screen falls into the room (F9)</source>
        <translation>Moins de lumière de cet écran tombe dans la salle (F9)</translation>
    </message>
    <message>
        <source>Undone: %1</source>
        <translation>Annulé&#xa0;: %1</translation>
    </message>
    <message>
        <source>Nothing to undo here</source>
        <translation>Rien à annuler ici</translation>
    </message>
    <message>
        <source>Done again: %1</source>
        <translation>Rétabli&#xa0;: %1</translation>
    </message>
    <message>
        <source>Nothing to do again</source>
        <translation>Rien à rétablir</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MaskEditing</name>
    <message>
        <source>This is no mask: %1.</source>
        <translation>Ce n’est pas un masque : %1.</translation>
    </message>
    <message>
        <source>New mask</source>
        <translation>Nouveau masque</translation>
    </message>
    <message>
        <source>Outline of a mask</source>
        <translation>Contour d’un masque</translation>
    </message>
    <message>
        <source>Feather of a mask</source>
        <translation>Bord doux d’un masque</translation>
    </message>
    <message>
        <source>Removed mask</source>
        <translation>Masque supprimé</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MaskView</name>
    <message numerus="yes">
        <source>Drawing a mask: %n point(s). Space sets one at %1, %2. Return closes it, Escape leaves it.</source>
        <translation>
            <numerusform>Dessin d’un masque : %n point. Espace en pose un à %1, %2. Entrée le ferme, Échap l’abandonne.</numerusform>
            <numerusform>Dessin d’un masque : %n points. Espace en pose un à %1, %2. Entrée le ferme, Échap l’abandonne.</numerusform>
        </translation>
    </message>
    <message>
        <source>Point %1 of %2, %3, %4.</source>
        <translation>Point %1 sur %2, %3, %4.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MatrixView</name>
    <message>
        <source>camera %1
projector %2</source>
        <translation>caméra %1
projecteur %2</translation>
    </message>
    <message>
        <source>%1
%2</source>
        <translation>%1
%2</translation>
    </message>
    <message>
        <source>transport</source>
        <translation>transport</translation>
    </message>
    <message>
        <source>projector x, y</source>
        <translation>projecteur x, y</translation>
    </message>
    <message>
        <source>projector line</source>
        <translation>ligne projecteur</translation>
    </message>
    <message>
        <source>camera x, y</source>
        <translation>caméra x, y</translation>
    </message>
    <message>
        <source>camera line</source>
        <translation>ligne caméra</translation>
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
        <translation>Nom</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Annuler</translation>
    </message>
    <message>
        <source>Type a name.</source>
        <translation>Saisissez un nom.</translation>
    </message>
    <message>
        <source>It has this name.</source>
        <translation>Il porte déjà ce nom.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Nights</name>
    <message>
        <source>The venue was as it was measured.</source>
        <translation>Le lieu était tel qu’il a été mesuré.</translation>
    </message>
    <message>
        <source>Repaired.</source>
        <translation>Réparée.</translation>
    </message>
    <message>
        <source>Something has changed, and no better picture came of a repair.</source>
        <translation>Quelque chose a changé, et aucune réparation n’a donné une meilleure image.</translation>
    </message>
    <message>
        <source>%1 dB</source>
        <translation>%1 dB</translation>
    </message>
    <message>
        <source>Photographed</source>
        <translation>Photographié</translation>
    </message>
    <message>
        <source>Predicted</source>
        <translation>Prévu</translation>
    </message>
    <message>
        <source>Repaired</source>
        <translation>Réparée</translation>
    </message>
    <message>
        <source>Alarm</source>
        <translation>Alarme</translation>
    </message>
    <message>
        <source>Days before the last night</source>
        <translation>Jours avant la dernière nuit</translation>
    </message>
    <message>
        <source>Colour error ΔE</source>
        <translation>Erreur de couleur ΔE</translation>
    </message>
    <message numerus="yes">
        <source>%n night(s).</source>
        <translation>
            <numerusform>%n nuit.</numerusform>
            <numerusform>%n nuits.</numerusform>
        </translation>
    </message>
    <message>
        <source>Photographed: %1 to %2, last %3.</source>
        <translation>Photographié : de %1 à %2, en dernier %3.</translation>
    </message>
    <message>
        <source>Repairs: %1. Alarms: %2.</source>
        <translation>Réparations : %1. Alarmes : %2.</translation>
    </message>
    <message>
        <source>Left out: %1</source>
        <translation>Omise : %1</translation>
    </message>
    <message>
        <source>Alarm: %1</source>
        <translation>Alarme : %1</translation>
    </message>
    <message numerus="yes">
        <source>%n picture(s) perfected.</source>
        <translation>
            <numerusform>%n image perfectionnée.</numerusform>
            <numerusform>%n images perfectionnées.</numerusform>
        </translation>
    </message>
    <message>
        <source>Photographed: %1, predicted: %2.</source>
        <translation>Photographié : %1, prévu : %2.</translation>
    </message>
    <message>
        <source>Nobody was told: %1</source>
        <translation>Personne n’a été prévenu : %1</translation>
    </message>
    <message>
        <source>Quality, dB</source>
        <translation>Qualité, dB</translation>
    </message>
</context>
<context>
    <name>relucent::gui::NightsDialog</name>
    <message>
        <source>Quality over weeks</source>
        <translation>Qualité au fil des semaines</translation>
    </message>
    <message>
        <source>Colour error</source>
        <translation>Erreur de couleur</translation>
    </message>
    <message>
        <source>What the photograph of each night&apos;s proof came to, beside what was predicted.</source>
        <translation>Ce que la photo de contrôle de chaque nuit a donné, à côté de ce qui était prévu.</translation>
    </message>
    <message>
        <source>Quality of the picture, night by night</source>
        <translation>Qualité de l’image, nuit après nuit</translation>
    </message>
    <message>
        <source>What came of each night, the last one first</source>
        <translation>Le résultat de chaque nuit, la dernière en premier</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Fermer</translation>
    </message>
    <message>
        <source>Quality</source>
        <translation>Qualité</translation>
    </message>
    <message>
        <source>Colour error: CIEDE2000, less is better. Quality: peak signal-to-noise ratio, PSNR, in dB; more is better.</source>
        <translation>Erreur de couleur&#xa0;: CIEDE2000, moins vaut mieux. Qualité&#xa0;: rapport signal sur bruit de crête, PSNR, en dB&#xa0;; plus vaut mieux.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::NightsPart</name>
    <message>
        <source>Every night</source>
        <translation>Chaque nuit</translation>
    </message>
    <message>
        <source>Quality over weeks</source>
        <translation>Qualité au fil des semaines</translation>
    </message>
    <message>
        <source>A chart of all nights, and what came of each.</source>
        <translation>Un graphique de toutes les nuits et le résultat de chacune.</translation>
    </message>
    <message>
        <source>There was no night yet</source>
        <translation>Il n’y a pas encore eu de nuit</translation>
    </message>
    <message>
        <source>Somebody has to look, %1</source>
        <translation>Quelqu’un doit aller voir, %1</translation>
    </message>
    <message>
        <source>Left out, %1</source>
        <translation>Omise, %1</translation>
    </message>
    <message>
        <source>All is well, %1</source>
        <translation>Tout va bien, %1</translation>
    </message>
    <message>
        <source>Look after the picture</source>
        <translation>Prendre soin de l’image</translation>
    </message>
    <message>
        <source>never</source>
        <translation>jamais</translation>
    </message>
    <message>
        <source>at %1</source>
        <translation>à %1</translation>
    </message>
    <message>
        <source>A show can look after the picture by itself at night: it checks, repairs, perfects and proves, and tells here what came of it. Its camera has to stay where it is.</source>
        <translation>Une diffusion peut prendre soin de l’image toute seule la nuit&#xa0;: elle contrôle, répare, perfectionne et prouve, et dit ici ce qu’il en est. Sa caméra doit rester où elle est.</translation>
    </message>
    <message>
        <source>No show of a rehearsal is looked after.</source>
        <translation>La diffusion d’une répétition n’est pas suivie.</translation>
    </message>
    <message>
        <source>The installed show has its first one at %1, if it plays by then. Its camera has to stay where it is.</source>
        <translation>La diffusion installée a sa première à %1, si elle tourne à ce moment-là. Sa caméra doit rester où elle est.</translation>
    </message>
    <message>
        <source>A night is under way</source>
        <translation>Une nuit est en cours</translation>
    </message>
    <message>
        <source>The show makes way while its picture is looked after. What comes of it is told here.</source>
        <translation>La diffusion cède la place pendant que l’on s’occupe de son image. Le résultat sera indiqué ici.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::NudgeDialog</name>
    <message>
        <source>fits</source>
        <translation>juste</translation>
    </message>
    <message>
        <source>Turn the camera to the right and down.</source>
        <translation>Tournez la caméra vers la droite et le bas.</translation>
    </message>
    <message>
        <source>Turn the camera to the right and up.</source>
        <translation>Tournez la caméra vers la droite et le haut.</translation>
    </message>
    <message>
        <source>Turn the camera to the left and down.</source>
        <translation>Tournez la caméra vers la gauche et le bas.</translation>
    </message>
    <message>
        <source>Turn the camera to the left and up.</source>
        <translation>Tournez la caméra vers la gauche et le haut.</translation>
    </message>
    <message>
        <source>Turn the camera to the right.</source>
        <translation>Tournez la caméra vers la droite.</translation>
    </message>
    <message>
        <source>Turn the camera to the left.</source>
        <translation>Tournez la caméra vers la gauche.</translation>
    </message>
    <message>
        <source>Turn the camera down.</source>
        <translation>Tournez la caméra vers le bas.</translation>
    </message>
    <message>
        <source>Turn the camera up.</source>
        <translation>Tournez la caméra vers le haut.</translation>
    </message>
    <message>
        <source>Tilt the camera clockwise.</source>
        <translation>Inclinez la caméra dans le sens des aiguilles d’une montre.</translation>
    </message>
    <message>
        <source>Tilt the camera anticlockwise.</source>
        <translation>Inclinez la caméra dans le sens inverse des aiguilles d’une montre.</translation>
    </message>
    <message>
        <source>What the camera saw, and what it sees now</source>
        <translation>Ce que la caméra voyait et ce qu’elle voit maintenant</translation>
    </message>
    <message>
        <source>The projector shows full light. Left of the line stands what the camera saw when the venue was measured, right of it what it sees now.</source>
        <translation>Le projecteur éclaire à pleine lumière. À gauche de la ligne, ce que la caméra voyait lors de la mesure&#x202f;; à droite, ce qu’elle voit maintenant.</translation>
    </message>
    <message>
        <source>Sideways</source>
        <translation>Sur le côté</translation>
    </message>
    <message>
        <source>Up and down</source>
        <translation>Haut et bas</translation>
    </message>
    <message>
        <source>Tilt</source>
        <translation>Inclinaison</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Fermer</translation>
    </message>
    <message>
        <source>Opening the devices</source>
        <translation>Ouverture des appareils</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Mesuré</translation>
    </message>
    <message>
        <source>Now</source>
        <translation>Maintenant</translation>
    </message>
    <message>
        <source>%1 px to the right</source>
        <translation>%1 px vers la droite</translation>
    </message>
    <message>
        <source>%1 px to the left</source>
        <translation>%1 px vers la gauche</translation>
    </message>
    <message>
        <source>%1 px down</source>
        <translation>%1 px vers le bas</translation>
    </message>
    <message>
        <source>%1 px up</source>
        <translation>%1 px vers le haut</translation>
    </message>
    <message>
        <source>%1°</source>
        <translation>%1°</translation>
    </message>
    <message>
        <source>Looking through the camera</source>
        <translation>Vue caméra en direct</translation>
    </message>
    <message>
        <source>The camera looks where it looked.</source>
        <translation>La caméra regarde où elle regardait.</translation>
    </message>
    <message>
        <source>Fasten it, look once more, and close this window.</source>
        <translation>Fixez-la, regardez encore une fois et fermez cette fenêtre.</translation>
    </message>
    <message>
        <source>The arrow shows where. If the projector was bumped instead, move its picture the other way.</source>
        <translation>La flèche indique où. Si c’est le projecteur qui a bougé, déplacez son image dans l’autre sens.</translation>
    </message>
    <message>
        <source>What is seen is not the view that was measured.</source>
        <translation>Ce que l’on voit n’est pas la vue mesurée.</translation>
    </message>
    <message>
        <source>Turn the camera until both halves look alike. If they do, the light or the surface has changed.</source>
        <translation>Tournez la caméra jusqu’à ce que les deux moitiés se ressemblent. Si c’est déjà le cas, la lumière ou la surface a changé.</translation>
    </message>
    <message>
        <source>Put the camera back</source>
        <translation>Replacer la caméra</translation>
    </message>
    <message>
        <source>In a rehearsal it comes back by itself while you look.</source>
        <translation>En répétition, elle revient d’elle-même pendant que vous regardez.</translation>
    </message>
    <message>
        <source>%1° clockwise</source>
        <translation>%1° dans le sens des aiguilles d’une montre</translation>
    </message>
    <message>
        <source>%1° anticlockwise</source>
        <translation>%1° dans le sens inverse des aiguilles d’une montre</translation>
    </message>
    <message>
        <source>If the projector was bumped instead, move its picture the other way.</source>
        <translation>Si c’est le projecteur qui a été heurté, déplacez son image dans l’autre sens.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputPage</name>
    <message>
        <source>Projector&apos;s screen</source>
        <translation>Écran du projecteur</translation>
    </message>
    <message>
        <source>This screen</source>
        <translation>Cet écran</translation>
    </message>
    <message>
        <source>%1: measured ΔE %2, predicted %3</source>
        <translation>%1&#x202f;: ΔE mesuré %2, prévu %3</translation>
    </message>
    <message>
        <source>Not photographed yet</source>
        <translation>Pas encore photographié</translation>
    </message>
    <message>
        <source>One photograph shows whether the surface looks as predicted.</source>
        <translation>Une photo montre si la surface a l’aspect prévu.</translation>
    </message>
    <message>
        <source>Corrected</source>
        <translation>Corrigé</translation>
    </message>
    <message>
        <source>Original</source>
        <translation>Original</translation>
    </message>
    <message>
        <source>%1 of the picture can be reached.</source>
        <translation>%1 de l’image est atteignable.</translation>
    </message>
    <message>
        <source>The surface looks as predicted</source>
        <translation>La surface a l’aspect prévu</translation>
    </message>
    <message>
        <source>The camera or projector may have moved.</source>
        <translation>La caméra ou le projecteur a peut-être bougé.</translation>
    </message>
    <message>
        <source>Error of the test patterns: %1, when measured %2. %3 of the view changed.</source>
        <translation>Erreur des motifs d’essai&#x202f;: %1 (à la mesure&#x202f;: %2). %3 de la vue a changé.</translation>
    </message>
    <message>
        <source>The measurement still holds</source>
        <translation>La mesure reste valable</translation>
    </message>
    <message>
        <source>Verification</source>
        <translation>Contrôle</translation>
    </message>
    <message>
        <source>Take verification photograph</source>
        <translation>Prendre une photo de contrôle</translation>
    </message>
    <message>
        <source>Ctrl+Shift+V</source>
        <translation>Ctrl+Maj+V</translation>
    </message>
    <message>
        <source>Check for drift</source>
        <translation>Chercher une dérive</translation>
    </message>
    <message>
        <source>Photographs the test patterns of the measurement again, ten or so.</source>
        <translation>Photographie à nouveau une dizaine de motifs d’essai de la mesure.</translation>
    </message>
    <message>
        <source>Hand over</source>
        <translation>Remise</translation>
    </message>
    <message>
        <source>Save report</source>
        <translation>Enregistrer le rapport</translation>
    </message>
    <message>
        <source>Installed. The show starts at the next log-in, without camera or wizard.</source>
        <translation>Installée. La diffusion démarre à la prochaine ouverture de session, sans caméra ni assistant.</translation>
    </message>
    <message>
        <source>Playlist</source>
        <translation>Liste de lecture</translation>
    </message>
    <message>
        <source>The picture stands in its middle, pixel for pixel.</source>
        <translation>L’image est placée en son milieu, pixel pour pixel.</translation>
    </message>
    <message>
        <source>Still pictures: %1</source>
        <translation>Images fixes&#x202f;: %1</translation>
    </message>
    <message>
        <source>Films and cross-fades use windows and steps, which are quick enough.</source>
        <translation>Vidéos et fondus enchaînés utilisent «&#x202f;Fenêtres et itérations&#x202f;», assez rapide.</translation>
    </message>
    <message>
        <source>Make the list again.</source>
        <translation>Refaites la liste.</translation>
    </message>
    <message>
        <source>Black</source>
        <translation>Noir</translation>
    </message>
    <message>
        <source>Frozen</source>
        <translation>Figé</translation>
    </message>
    <message>
        <source>Playing</source>
        <translation>Lecture</translation>
    </message>
    <message>
        <source>Add a picture or a film to the playlist.</source>
        <translation>Ajoutez une image ou une vidéo à la liste de lecture.</translation>
    </message>
    <message>
        <source>Choose the projector&apos;s screen.</source>
        <translation>Choisissez l’écran du projecteur.</translation>
    </message>
    <message>
        <source>Playing. Hold A to compare.</source>
        <translation>Lecture en cours. Maintenez A pour comparer.</translation>
    </message>
    <message>
        <source>Take a verification photograph, or install without proof.</source>
        <translation>Prenez une photo de contrôle, ou installez sans contrôle.</translation>
    </message>
    <message>
        <source>Nothing is projected before you open the output.</source>
        <translation>Rien n’est projeté avant que vous ouvriez la sortie.</translation>
    </message>
    <message>
        <source>Install show</source>
        <translation>Installer la diffusion</translation>
    </message>
    <message>
        <source>Install without proof</source>
        <translation>Installer sans contrôle</translation>
    </message>
    <message>
        <source>Open output</source>
        <translation>Ouvrir la sortie</translation>
    </message>
    <message>
        <source>Play</source>
        <translation>Lire</translation>
    </message>
    <message>
        <source>Freeze</source>
        <translation>Figer</translation>
    </message>
    <message>
        <source>Show again</source>
        <translation>Réafficher</translation>
    </message>
    <message>
        <source>Close output</source>
        <translation>Fermer la sortie</translation>
    </message>
    <message>
        <source>Add to the playlist</source>
        <translation>Ajouter à la liste de lecture</translation>
    </message>
    <message>
        <source>Remove from the playlist</source>
        <translation>Retirer de la liste de lecture</translation>
    </message>
    <message>
        <source>Order of the playlist</source>
        <translation>Ordre de la liste de lecture</translation>
    </message>
    <message>
        <source>Repeat</source>
        <translation>Boucle</translation>
    </message>
    <message>
        <source>Cross-fade</source>
        <translation>Fondu enchaîné</translation>
    </message>
    <message>
        <source>The calibration is as it was.</source>
        <translation>La calibration est inchangée.</translation>
    </message>
    <message>
        <source>Output</source>
        <translation>Sortie</translation>
    </message>
    <message>
        <source>Play corrected content, prove that it works with one photograph, and hand the venue over.</source>
        <translation>Diffusez le contenu corrigé, prouvez le résultat par une photo et remettez le lieu.</translation>
    </message>
    <message>
        <source>Playback</source>
        <translation>Lecture</translation>
    </message>
    <message>
        <source>frames a second</source>
        <translation>images/seconde</translation>
    </message>
    <message>
        <source>frame time</source>
        <translation>temps par image</translation>
    </message>
    <message>
        <source>frames late</source>
        <translation>en retard</translation>
    </message>
    <message>
        <source>Seconds</source>
        <translation>Secondes</translation>
    </message>
    <message>
        <source>Frame time, ms</source>
        <translation>Temps par image, ms</translation>
    </message>
    <message>
        <source>Frame times of the last minute</source>
        <translation>Temps par image de la dernière minute</translation>
    </message>
    <message>
        <source>%1 ms</source>
        <translation>%1&#x202f;ms</translation>
    </message>
    <message>
        <source>closed</source>
        <translation>fermée</translation>
    </message>
    <message>
        <source>on %1</source>
        <translation>sur %1</translation>
    </message>
    <message>
        <source>still picture, on %1</source>
        <translation>image fixe, sur %1</translation>
    </message>
    <message>
        <source>On the projector now</source>
        <translation>Projeté maintenant</translation>
    </message>
    <message>
        <source>What the projector shows</source>
        <translation>Ce que le projecteur affiche</translation>
    </message>
    <message>
        <source>Photograph of the surface</source>
        <translation>Photo de la surface</translation>
    </message>
    <message>
        <source>What was wanted at the left of the divider, the photograph at the right</source>
        <translation>L’image voulue à gauche du séparateur, la photo à droite</translation>
    </message>
    <message>
        <source>No verification photograph has been taken.</source>
        <translation>Aucune photo de contrôle n’a été prise.</translation>
    </message>
    <message>
        <source>Photograph against wanted</source>
        <translation>Photo comparée au voulu</translation>
    </message>
    <message>
        <source>colour difference</source>
        <translation>écart de couleur</translation>
    </message>
    <message>
        <source>Colour difference between the photograph and what was wanted</source>
        <translation>Écart de couleur entre la photo et l’image voulue</translation>
    </message>
    <message>
        <source>A verification photograph shows here what is left to see.</source>
        <translation>Une photo de contrôle montre ici les écarts qui restent visibles.</translation>
    </message>
    <message>
        <source>taken %1</source>
        <translation>prise à %1</translation>
    </message>
    <message>
        <source>Wanted</source>
        <translation>Voulu</translation>
    </message>
    <message>
        <source>Photograph</source>
        <translation>Photo</translation>
    </message>
    <message>
        <source>Delete removes an item, Ctrl+Up and Ctrl+Down move it. Files can be dropped here.</source>
        <translation>Suppr retire un élément, Ctrl+Haut et Ctrl+Bas le déplacent. Vous pouvez déposer des fichiers ici.</translation>
    </message>
    <message>
        <source>%1, playing</source>
        <translation>%1, en lecture</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Ajouter</translation>
    </message>
    <message>
        <source>Add files to the playlist</source>
        <translation>Ajouter des fichiers à la liste de lecture</translation>
    </message>
    <message>
        <source>Move up</source>
        <translation>Monter</translation>
    </message>
    <message>
        <source>Move down</source>
        <translation>Descendre</translation>
    </message>
    <message>
        <source>Cross-fade, tenths of a second</source>
        <translation>Fondu enchaîné, dixièmes de seconde</translation>
    </message>
    <message>
        <source>Add pictures or films</source>
        <translation>Ajouter des images ou des vidéos</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1&#x202f;s</translation>
    </message>
    <message>
        <source>Skipped: %1</source>
        <translation>Ignoré&#x202f;: %1</translation>
    </message>
    <message>
        <source>This screen&apos;s resolution is not that of the projector that was measured.</source>
        <translation>La définition de cet écran n’est pas celle du projecteur mesuré.</translation>
    </message>
    <message>
        <source>Written to %1, and for paper to report.pdf beside it.</source>
        <translation>Écrit dans %1, et pour le papier dans report.pdf à côté.</translation>
    </message>
    <message>
        <source>The projector is another screen now</source>
        <translation>Le projecteur est maintenant un autre écran</translation>
    </message>
    <message>
        <source>Show installed</source>
        <translation>Diffusion installée</translation>
    </message>
    <message>
        <source>Installed at %1: the show starts at the next log-in. Hold A to compare.</source>
        <translation>Installé à %1&#x202f;: la diffusion démarre à la prochaine connexion. Maintenez A pour comparer.</translation>
    </message>
    <message>
        <source>The output will cover this window. Esc closes the output.</source>
        <translation>La sortie recouvrira cette fenêtre. Échap ferme la sortie.</translation>
    </message>
    <message>
        <source>Install again</source>
        <translation>Réinstaller</translation>
    </message>
    <message>
        <source>The projector&apos;s screen %1 is not there. Plug it in, or choose another.</source>
        <translation>L’écran %1 du projecteur est absent. Branchez-le, ou choisissez-en un autre.</translation>
    </message>
    <message>
        <source>Choose a screen for projector %1.</source>
        <translation>Choisissez un écran pour le projecteur %1.</translation>
    </message>
    <message numerus="yes">
        <source>Each of the %n projector(s) needs a screen of its own. Plug in another one.</source>
        <translation>
            <numerusform>Le projecteur demande un écran à lui. Branchez-en un.</numerusform>
            <numerusform>Chacun des %n projecteurs demande un écran à lui. Branchez-en un autre.</numerusform>
        </translation>
    </message>
    <message>
        <source>There is one screen only. Plug the projector in and extend the desktop to it, or choose this screen.</source>
        <translation>Il n’y a qu’un écran. Branchez le projecteur et étendez-y le bureau, ou choisissez cet écran.</translation>
    </message>
    <message>
        <source>still picture, %1 of the pixels at their limit</source>
        <translation>image fixe, %1 des pixels à leur limite</translation>
    </message>
    <message>
        <source>%1 fps, %2 ms, %3 of the pixels at their limit</source>
        <translation>%1 fps, %2 ms, %3 des pixels à leur limite</translation>
    </message>
    <message>
        <source>Screen unplugged</source>
        <translation>Écran débranché</translation>
    </message>
    <message>
        <source>The surface does not look as predicted. Find out whether something moved.</source>
        <translation>La surface n’a pas l’aspect prévu. Vérifiez si quelque chose a bougé.</translation>
    </message>
    <message>
        <source>Something has changed since it was measured. Measure again, then install.</source>
        <translation>Quelque chose a changé depuis la mesure. Remesurez, puis installez.</translation>
    </message>
    <message>
        <source>Install anyway</source>
        <translation>Installer quand même</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>Remesurer</translation>
    </message>
    <message>
        <source>Aim again</source>
        <translation>Réaligner</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged</source>
        <translation>L’écran du projecteur est débranché</translation>
    </message>
    <message>
        <source>Nothing is lost. Plug it in again: the show comes back by itself.</source>
        <translation>Rien n’est perdu. Rebranchez-le : la diffusion revient d’elle-même.</translation>
    </message>
    <message>
        <source>The camera&apos;s view has moved by %1 px sideways and %2 px up or down.</source>
        <translation>La vue de la caméra s’est décalée de %1 px sur le côté et de %2 px en hauteur.</translation>
    </message>
    <message>
        <source>Shows full light, and where the camera has to be turned to look where it looked.</source>
        <translation>Affiche la pleine lumière et où tourner la caméra pour qu’elle regarde où elle regardait.</translation>
    </message>
    <message>
        <source>Limit for %1 frames a second: %2 ms</source>
        <translation>Limite pour %1 images par seconde&#x202f;: %2 ms</translation>
    </message>
    <message>
        <source>the processor</source>
        <translation>le processeur</translation>
    </message>
    <message>
        <source>Next test chart (T)</source>
        <translation>Mire suivante (T)</translation>
    </message>
    <message>
        <source>Figures over the picture (O)</source>
        <translation>Chiffres sur l’image (O)</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>Appareils utilisés à l’étape «&#x202f;%1&#x202f;».</translation>
    </message>
    <message>
        <source>Put the camera back</source>
        <translation>Replacer la caméra</translation>
    </message>
    <message>
        <source>On this page only</source>
        <translation>Sur cette page seulement</translation>
    </message>
    <message>
        <source>The photograph is out of date</source>
        <translation>La photo n’est plus à jour</translation>
    </message>
    <message>
        <source>Another venue&apos;s show starts at log-in. Installing this one replaces it.</source>
        <translation>La diffusion d’un autre lieu démarre à l’ouverture de session. Installer celle-ci la remplace.</translation>
    </message>
    <message>
        <source>Another venue&apos;s show starts at log-in. This is a rehearsal, which is not installed.</source>
        <translation>La diffusion d’un autre lieu démarre à l’ouverture de session. Ceci est une répétition, qui ne s’installe pas.</translation>
    </message>
    <message>
        <source>Once installed, the show starts at every log-in, without camera or wizard.</source>
        <translation>Une fois installée, la diffusion démarre à chaque ouverture de session, sans caméra ni assistant.</translation>
    </message>
    <message>
        <source>This is a rehearsal with simulated devices: its show is not installed. That of a real venue starts at every log-in.</source>
        <translation>Ceci est une répétition avec des appareils simulés : sa diffusion ne s’installe pas. Celle d’un lieu réel démarre à chaque ouverture de session.</translation>
    </message>
    <message>
        <source>Remove installed show</source>
        <translation>Retirer la diffusion installée</translation>
    </message>
    <message>
        <source>It does not start at log-in any more. Venue and playlist stay.</source>
        <translation>Elle ne démarre plus à l’ouverture de session. Le lieu et la liste restent.</translation>
    </message>
    <message>
        <source>Proof out of date</source>
        <translation>Contrôle obsolète</translation>
    </message>
    <message>
        <source>Take a verification photograph: it proves that the venue is measured well.</source>
        <translation>Prenez une photo de contrôle : elle prouve que le lieu est bien mesuré.</translation>
    </message>
    <message>
        <source>This rehearsal plays on this page only: nothing is projected.</source>
        <translation>Cette répétition se joue sur cette page seulement : rien n’est projeté.</translation>
    </message>
    <message>
        <source>Black: the show goes on unseen until you show it again.</source>
        <translation>Noir : la diffusion continue sans être vue jusqu’à ce que vous la montriez.</translation>
    </message>
    <message>
        <source>Frozen: this picture stands until you press Play.</source>
        <translation>Figé : cette image reste jusqu’à ce que vous appuyiez sur Lire.</translation>
    </message>
    <message>
        <source>Rehearsed to the end. A simulated venue is not installed. Hold A to compare.</source>
        <translation>Répété jusqu’au bout. Un lieu simulé ne s’installe pas. Maintenez A pour comparer.</translation>
    </message>
    <message>
        <source>The verification photograph is out of date</source>
        <translation>La photo de contrôle n’est plus à jour</translation>
    </message>
    <message>
        <source>taken %1, out of date</source>
        <translation>prise à %1, obsolète</translation>
    </message>
    <message>
        <source>No screen chosen</source>
        <translation>Aucun écran choisi</translation>
    </message>
    <message>
        <source>%1, unplugged</source>
        <translation>%1, débranché</translation>
    </message>
    <message>
        <source>Not to be proved yet</source>
        <translation>Pas encore à contrôler</translation>
    </message>
    <message>
        <source>What it was taken of has been measured or chosen anew since, or is another set. Take it again to prove what is shown now.</source>
        <translation>Ce qu’elle montre a été mesuré ou choisi à nouveau depuis, ou est une autre variante. Reprenez-la pour contrôler ce qui est montré maintenant.</translation>
    </message>
    <message>
        <source>As predicted, but errors are plain to see</source>
        <translation>Comme prévu, mais les écarts se voient nettement</translation>
    </message>
    <message>
        <source>Nothing has moved: the prediction itself is coarse. Measuring finer or darker content helps.</source>
        <translation>Rien n’a bougé&#x202f;: la prévision elle-même est grossière. Mesurer plus finement ou un contenu plus sombre aide.</translation>
    </message>
    <message>
        <source>Waiting for the projector&apos;s screen to come back.</source>
        <translation>En attente du retour de l’écran du projecteur.</translation>
    </message>
    <message>
        <source>What plays is not what was measured or chosen last. Show that first.</source>
        <translation>Ce qui passe n’est pas ce qui a été mesuré ou choisi en dernier. Montrez-le d’abord.</translation>
    </message>
    <message>
        <source>Look at it first</source>
        <translation>La voir d’abord</translation>
    </message>
    <message>
        <source>What was measured or chosen since is not on the projector yet.</source>
        <translation>Ce qui a été mesuré ou choisi depuis n’est pas encore sur le projecteur.</translation>
    </message>
    <message>
        <source>What was measured or chosen since is not on the projector yet. Steps that are out of date count with what was chosen there before.</source>
        <translation>Ce qui a été mesuré ou choisi depuis n’est pas encore sur le projecteur. Les étapes plus à jour valent telles que choisies avant.</translation>
    </message>
    <message>
        <source>The screen %1 is unplugged. Nothing is projected.</source>
        <translation>L’écran %1 est débranché. Rien n’est projeté.</translation>
    </message>
    <message>
        <source>Camera %1: %2, as predicted</source>
        <translation>Caméra %1&#x202f;: %2, comme prévu</translation>
    </message>
    <message>
        <source>Camera %1: %2, not as predicted</source>
        <translation>Caméra %1&#x202f;: %2, pas comme prévu</translation>
    </message>
    <message>
        <source>The view of camera %3 has moved by %1 px sideways and %2 px up or down.</source>
        <translation>La vue de la caméra %3 s’est déplacée de %1 px de côté et de %2 px en hauteur.</translation>
    </message>
    <message>
        <source>Camera %1 or a projector may have moved.</source>
        <translation>La caméra %1 ou un projecteur a pu bouger.</translation>
    </message>
    <message>
        <source>Something has changed. Repair the calibration.</source>
        <translation>Quelque chose a changé. Réparez la calibration.</translation>
    </message>
    <message>
        <source>Something has changed since it was measured. Repair the calibration: only that is measured again.</source>
        <translation>Quelque chose a changé depuis la mesure. Réparez la calibration&#x202f;: seul cela est mesuré à nouveau.</translation>
    </message>
    <message>
        <source>Repair the calibration</source>
        <translation>Réparer la calibration</translation>
    </message>
    <message>
        <source>Nothing to repair</source>
        <translation>Rien à réparer</translation>
    </message>
    <message>
        <source>The venue is as it was measured.</source>
        <translation>Le lieu est tel qu’il a été mesuré.</translation>
    </message>
    <message>
        <source>Not repaired</source>
        <translation>Non réparée</translation>
    </message>
    <message>
        <source>No better picture came of it: the measurement is used as before.</source>
        <translation>L’image n’en est pas devenue meilleure&#x202f;: la mesure est utilisée comme avant.</translation>
    </message>
    <message>
        <source>Repaired, %1</source>
        <translation>Réparée, %1</translation>
    </message>
    <message>
        <source>Colour error of a photographed picture: %1 before, %2 now.</source>
        <translation>Erreur de couleur d’une image photographiée : %1 avant, %2 maintenant.</translation>
    </message>
    <message>
        <source>Finds what has changed, measures only that again, and keeps it if a photograph of the picture is better by it.</source>
        <translation>Trouve ce qui a changé, ne mesure que cela à nouveau et le garde si une photo de l’image en est meilleure.</translation>
    </message>
    <message>
        <source>Use the measurement before</source>
        <translation>Utiliser la mesure d’avant</translation>
    </message>
    <message>
        <source>Takes the repair back.</source>
        <translation>Annule la réparation.</translation>
    </message>
    <message>
        <source>arrival to light</source>
        <translation>de l’arrivée à la lumière</translation>
    </message>
    <message>
        <source>From a live picture&apos;s arrival at this computer until the projectors have it: the longest of the last five seconds. The way there is not in it.</source>
        <translation>De l’arrivée d’une image en direct sur cet ordinateur jusqu’à ce que les projecteurs l’aient : le maximum des cinq dernières secondes. Le trajet jusqu’ici n’est pas compris.</translation>
    </message>
    <message>
        <source>Connecting to %1</source>
        <translation>Connexion à %1</translation>
    </message>
    <message>
        <source>Lost: %1. %2</source>
        <translation>Perdu : %1. %2</translation>
    </message>
    <message>
        <source>Add a stream</source>
        <translation>Ajouter un flux</translation>
    </message>
    <message>
        <source>A live picture from the network, as cameras and encoders send it.</source>
        <translation>Une image en direct du réseau, comme l’envoient caméras et encodeurs.</translation>
    </message>
    <message>
        <source>Nothing has moved: of the light only %1 is kept at Threshold, so that bounces are missing, in the prediction too. Keep more of it.</source>
        <translation>Rien n’a bougé : au seuil, seuls %1 de la lumière sont gardés, si bien qu’il manque des réflexions, dans la prévision aussi. Gardez-en davantage.</translation>
    </message>
    <message>
        <source>The show of another venue will no longer start at log-in.</source>
        <translation>La diffusion d’un autre lieu ne démarrera plus à l’ouverture de session.</translation>
    </message>
    <message>
        <source>The show of this venue will no longer start at log-in.</source>
        <translation>La diffusion de ce lieu ne démarrera plus à l’ouverture de session.</translation>
    </message>
    <message>
        <source>Venue and playlist stay. It can be installed again from its venue&apos;s Output.</source>
        <translation>Le lieu et la liste restent. Elle peut être réinstallée depuis la Sortie de son lieu.</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Supprimer</translation>
    </message>
    <message>
        <source>Keep</source>
        <translation>Garder</translation>
    </message>
    <message>
        <source>To end it, hold Esc for two seconds at the projector&apos;s screen.</source>
        <translation>Pour y mettre fin, maintenez Échap deux secondes sur l’écran du projecteur.</translation>
    </message>
    <message>
        <source>Test chart</source>
        <translation>Mire</translation>
    </message>
    <message>
        <source>A test chart is on the surface. T shows the next one, then the playlist.</source>
        <translation>Une mire est sur la surface. T affiche la suivante, puis la liste de lecture.</translation>
    </message>
    <message>
        <source>Show the playlist</source>
        <translation>Afficher la liste</translation>
    </message>
    <message>
        <source>A test chart is on the surface</source>
        <translation>Une mire est sur la surface</translation>
    </message>
    <message>
        <source>The playlist runs on unseen until you show it again.</source>
        <translation>La liste de lecture continue sans être vue jusqu’à ce que vous la réaffichiez.</translation>
    </message>
    <message>
        <source>Times of sets</source>
        <translation>Heures des variantes</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>Variante</translation>
    </message>
    <message>
        <source>Times of the day…</source>
        <translation>Heures du jour…</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1&#xa0;: %2</translation>
    </message>
    <message>
        <source>The installed show plays this one all day.</source>
        <translation>La diffusion installée la montre toute la journée.</translation>
    </message>
    <message>
        <source>The picture is being perfected.</source>
        <translation>L’image est en perfectionnement.</translation>
    </message>
    <message>
        <source>The output is being opened.</source>
        <translation>La sortie s’ouvre.</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged.</source>
        <translation>Écran du projecteur débranché.</translation>
    </message>
    <message>
        <source>There is nothing else on the list.</source>
        <translation>Il n’y a rien d’autre dans la liste.</translation>
    </message>
    <message>
        <source>The playlist is empty.</source>
        <translation>La liste de lecture est vide.</translation>
    </message>
    <message>
        <source>There is no other set.</source>
        <translation>Il n’y a pas d’autre variante.</translation>
    </message>
    <message>
        <source>The show changes by itself, here too: %1</source>
        <translation>La diffusion change d’elle-même, ici aussi&#xa0;: %1</translation>
    </message>
    <message>
        <source>Choose in the desktop&apos;s dialog what to show as %1</source>
        <translation>Choisissez dans le dialogue du bureau ce que %1 montre</translation>
    </message>
    <message>
        <source>Add a screen or window</source>
        <translation>Ajouter un écran ou une fenêtre</translation>
    </message>
    <message>
        <source>The live picture of a screen of this computer, or of a window on it.</source>
        <translation>L’image en direct d’un écran de cet ordinateur, ou d’une fenêtre qui s’y trouve.</translation>
    </message>
    <message>
        <source>A screen, chosen in the desktop&apos;s dialog</source>
        <translation>Un écran, choisi dans le dialogue du bureau</translation>
    </message>
    <message>
        <source>A window, chosen in the desktop&apos;s dialog</source>
        <translation>Une fenêtre, choisie dans le dialogue du bureau</translation>
    </message>
    <message>
        <source>Screen %1</source>
        <translation>Écran %1</translation>
    </message>
    <message>
        <source>Window %1</source>
        <translation>Fenêtre %1</translation>
    </message>
    <message>
        <source>There is no desktop whose screens could be shown.</source>
        <translation>Il n’y a pas de bureau dont les écrans pourraient être montrés.</translation>
    </message>
    <message>
        <source>The camera is back at its place</source>
        <translation>La caméra est revenue à sa place</translation>
    </message>
    <message>
        <source>Put the camera back, or repair the calibration.</source>
        <translation>Replacez la caméra ou réparez la calibration.</translation>
    </message>
    <message>
        <source>Perfecting</source>
        <translation>Perfectionnement</translation>
    </message>
    <message>
        <source>Photographing</source>
        <translation>Prise de vue</translation>
    </message>
    <message>
        <source>Checking for drift</source>
        <translation>Contrôle de la dérive</translation>
    </message>
    <message>
        <source>Repairing</source>
        <translation>Réparation</translation>
    </message>
    <message>
        <source>The output is closed. Patterns to be photographed are projected.</source>
        <translation>La sortie est fermée. Des motifs à photographier sont projetés.</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Arrêter</translation>
    </message>
    <message>
        <source>Not as predicted</source>
        <translation>Non conforme à la prévision</translation>
    </message>
    <message>
        <source>The output is closed. The devices are in use at %1.</source>
        <translation>La sortie est fermée. Appareils utilisés à l’étape «&#x202f;%1&#x202f;».</translation>
    </message>
    <message>
        <source>Show the current correction</source>
        <translation>Montrer la correction actuelle</translation>
    </message>
    <message>
        <source>The projector still shows another correction. Show the current one, then take the photograph.</source>
        <translation>Le projecteur montre encore une autre correction. Montrez l’actuelle, puis prenez la photo.</translation>
    </message>
    <message>
        <source>Another correction</source>
        <translation>Autre correction</translation>
    </message>
    <message>
        <source>The camera&apos;s view has moved. Put it back, then photograph again.</source>
        <translation>La vue de la caméra a bougé. Replacez-la, puis photographiez à nouveau.</translation>
    </message>
    <message>
        <source>The show still plays another correction</source>
        <translation>La diffusion utilise encore une autre correction</translation>
    </message>
    <message>
        <source>Another correction plays. Show the current one first.</source>
        <translation>Une autre correction est diffusée. Montrez d’abord l’actuelle.</translation>
    </message>
    <message>
        <source>Another correction still plays.</source>
        <translation>Une autre correction est encore diffusée.</translation>
    </message>
    <message>
        <source>Covered by %1</source>
        <translation>Masqué par %1</translation>
    </message>
    <message>
        <source>The projector shows the light of another step: %1</source>
        <translation>Le projecteur montre la lumière d’une autre étape : %1</translation>
    </message>
    <message>
        <source>The show goes on behind it, and is seen again when that has ended.</source>
        <translation>La diffusion continue derrière et se revoit quand c’est terminé.</translation>
    </message>
    <message>
        <source>The light of another step is before the show.</source>
        <translation>La lumière d’une autre étape est devant la diffusion.</translation>
    </message>
    <message>
        <source>Time of a picture</source>
        <translation>Durée d’une image</translation>
    </message>
    <message>
        <source>%1, skipped</source>
        <translation>%1, ignoré</translation>
    </message>
    <message>
        <source>Seconds that the chosen picture stands</source>
        <translation>Secondes d’affichage de l’image choisie</translation>
    </message>
    <message>
        <source> s</source>
        <translation>&#x202f;s</translation>
    </message>
    <message>
        <source>Picture stands for</source>
        <translation>Image affichée pendant</translation>
    </message>
    <message>
        <source>Photographed %1.</source>
        <translation>Photographiée : %1.</translation>
    </message>
    <message>
        <source>Photographed %1, before the last check for drift.</source>
        <translation>Photographiée : %1, avant la dernière recherche de dérive.</translation>
    </message>
    <message>
        <source>The surface looked as predicted then</source>
        <translation>La surface avait alors l’aspect prévu</translation>
    </message>
    <message>
        <source>Checked %1.</source>
        <translation>Vérifié : %1.</translation>
    </message>
    <message>
        <source>Hold A for the original, Ctrl+P freezes, B makes it black, T shows test charts, O figures.</source>
        <translation>Maintenez A pour l’original, Ctrl+P fige, B met en noir, T affiche des mires, O des chiffres.</translation>
    </message>
    <message>
        <source>No program here opens it: open it by hand, or take it to another computer.</source>
        <translation>Aucun programme d’ici ne l’ouvre : ouvrez-le à la main, ou emportez-le sur un autre ordinateur.</translation>
    </message>
    <message>
        <source>Picture: %1</source>
        <translation>Image&#xa0;: %1</translation>
    </message>
    <message>
        <source>The check was ended: the room is not said to be clear</source>
        <translation>Le contrôle a été arrêté&#xa0;: la salle n’est plus confirmée évacuée</translation>
    </message>
    <message>
        <source>It came to no result. Check again when the room is clear.</source>
        <translation>Il n’a donné aucun résultat. Recommencez quand la salle sera évacuée.</translation>
    </message>
    <message>
        <source>The repair was ended: the room is not said to be clear</source>
        <translation>La réparation a été arrêtée&#xa0;: la salle n’est plus confirmée évacuée</translation>
    </message>
    <message>
        <source>The measurement is used as before. Repair again when the room is clear.</source>
        <translation>La mesure est utilisée comme avant. Recommencez la réparation quand la salle sera évacuée.</translation>
    </message>
    <message>
        <source>The output is closed. A picture to be photographed is projected.</source>
        <translation>La sortie est fermée. Une image à photographier est projetée.</translation>
    </message>
    <message>
        <source>The room is brighter by %1 of full light.</source>
        <translation>La salle est plus claire de %1 de la pleine lumière.</translation>
    </message>
    <message>
        <source>The room is darker by %1 of full light.</source>
        <translation>La salle est plus sombre de %1 de la pleine lumière.</translation>
    </message>
    <message>
        <source>The projector gives %1 of the light that it gave.</source>
        <translation>Le projecteur donne %1 de la lumière qu’il donnait.</translation>
    </message>
    <message>
        <source>The output is closed. Nothing is projected from here.</source>
        <translation>La sortie est fermée. Rien n’est projeté d’ici.</translation>
    </message>
    <message>
        <source>A photograph is being taken.</source>
        <translation>Une photo est en cours.</translation>
    </message>
    <message>
        <source>Slowly, as the room is not said to be clear: nothing flashes.</source>
        <translation>Lentement, car la salle n’est pas confirmée évacuée&#xa0;: rien ne clignote.</translation>
    </message>
    <message>
        <source>It plays this playlist with the measurement that is in use by then.</source>
        <translation>Il lit cette liste avec la mesure utilisée à ce moment-là.</translation>
    </message>
    <message>
        <source>The output is closed here. Another program plays a show of this venue.</source>
        <translation>La sortie est fermée ici. Un autre programme diffuse ce lieu.</translation>
    </message>
    <message>
        <source>Hardly anything fits. Put the camera back or repair the calibration; if neither helps, aim and measure again.</source>
        <translation>Presque rien ne correspond. Remettez la caméra en place ou réparez le calibrage&#xa0;; si rien n’aide, visez et mesurez à nouveau.</translation>
    </message>
    <message>
        <source>Almost nothing of the projector&apos;s light is seen. Look at the lens and at the projector, then check again.</source>
        <translation>On ne voit presque rien de la lumière du projecteur. Regardez l’objectif et le projecteur, puis vérifiez à nouveau.</translation>
    </message>
    <message>
        <source>Installed. The show starts at the next log-in, without wizard. The camera stays: at night it looks after the picture.</source>
        <translation>Installée. La diffusion démarre à la prochaine ouverture de session, sans assistant. La caméra reste&#xa0;: la nuit, elle veille sur l’image.</translation>
    </message>
    <message>
        <source>Another program plays</source>
        <translation>Un autre programme diffuse</translation>
    </message>
    <message>
        <source>Hardly anything fits. Put the camera back, repair the calibration, or aim and measure again.</source>
        <translation>Presque rien ne correspond. Remettez la caméra en place, réparez le calibrage, ou visez et mesurez à nouveau.</translation>
    </message>
    <message>
        <source>Another program plays a show of this venue.</source>
        <translation>Un autre programme diffuse ce lieu.</translation>
    </message>
    <message>
        <source>The room&apos;s light has changed. Restore it and check again, or repair the calibration.</source>
        <translation>La lumière de la salle a changé. Rétablissez-la et vérifiez à nouveau, ou réparez le calibrage.</translation>
    </message>
    <message>
        <source>The camera looks elsewhere</source>
        <translation>La caméra regarde ailleurs</translation>
    </message>
    <message>
        <source>It was left %1 px from where it looked when it was measured. Put it back, or repair the calibration.</source>
        <translation>Elle est restée à %1 px de sa visée lors de la mesure. Remettez-la en place ou réparez le calibrage.</translation>
    </message>
    <message>
        <source>Put the camera back, or measure again.</source>
        <translation>Replacez la caméra ou mesurez à nouveau.</translation>
    </message>
    <message>
        <source>Something has changed. Measure again.</source>
        <translation>Quelque chose a changé. Mesurez à nouveau.</translation>
    </message>
    <message>
        <source>Hardly anything fits. Put the camera back, or aim and measure again.</source>
        <translation>Presque rien ne correspond. Remettez la caméra en place, ou visez et mesurez à nouveau.</translation>
    </message>
    <message>
        <source>Keep the repaired one</source>
        <translation>Garder la réparée</translation>
    </message>
    <message>
        <source>Use the measurement before?</source>
        <translation>Utiliser la mesure d’avant ?</translation>
    </message>
    <message>
        <source>What was repaired is measured again if you repair once more.</source>
        <translation>Ce qui a été réparé sera mesuré à nouveau si vous réparez encore une fois.</translation>
    </message>
    <message>
        <source>The measurement from before the repair is used as it was, with all that followed from it.</source>
        <translation>La mesure d’avant la réparation est utilisée telle qu’elle était, avec tout ce qui en découlait.</translation>
    </message>
    <message>
        <source>Screen %1, which this plays on</source>
        <translation>Écran %1, sur lequel ceci est diffusé</translation>
    </message>
    <message>
        <source>They are larger than predicted. A check for drift tells whether something has moved.</source>
        <translation>Elles sont plus grandes que prévu. Chercher une dérive montre si quelque chose a bougé.</translation>
    </message>
    <message>
        <source>Once installed, the show starts at every log-in, without wizard. The camera stays: at night it looks after the picture.</source>
        <translation>Une fois installée, la diffusion démarre à chaque ouverture de session, sans assistant. La caméra reste : la nuit, elle s’occupe de l’image.</translation>
    </message>
    <message>
        <source>Take a verification photograph. What was found before is not settled.</source>
        <translation>Prenez une photo de contrôle. Ce qui a été constaté avant n’est pas réglé.</translation>
    </message>
    <message>
        <source>The surface did not look as predicted. Open the output: it leads to what helps.</source>
        <translation>La surface n’avait pas l’aspect prévu. Ouvrez la sortie : elle mène à ce qui aide.</translation>
    </message>
    <message>
        <source>Black: the frozen picture stands unseen until you show it again.</source>
        <translation>Noir : l’image figée reste invisible jusqu’à ce que vous la montriez de nouveau.</translation>
    </message>
    <message>
        <source>still picture, perfected by photographs</source>
        <translation>image fixe, perfectionnée par des photos</translation>
    </message>
    <message>
        <source>Nothing has moved: part of the picture is out of the projector&apos;s reach, in a shadow, darker than its black or brighter than its white there. Another picture, or another place for it, helps.</source>
        <translation>Rien n’a bougé&#x202f;: une partie de l’image est hors de portée du projecteur, dans une ombre, plus sombre que son noir ou plus claire que son blanc à cet endroit. Une autre image, ou une autre place, aide.</translation>
    </message>
    <message>
        <source>Errors are plain to see</source>
        <translation>Les écarts se voient nettement</translation>
    </message>
    <message>
        <source>The frozen picture stands unseen until you show it again.</source>
        <translation>L’image figée reste, invisible, jusqu’à ce que vous l’affichiez à nouveau.</translation>
    </message>
    <message>
        <source>The output is closed here. Another program plays a show of another venue on this projector.</source>
        <translation>La sortie est fermée ici. Un autre programme diffuse un autre lieu sur ce projecteur.</translation>
    </message>
    <message>
        <source>Another program plays a show of another venue on this projector.</source>
        <translation>Un autre programme diffuse un autre lieu sur ce projecteur.</translation>
    </message>
    <message>
        <source>Two shows at once</source>
        <translation>Deux diffusions à la fois</translation>
    </message>
    <message>
        <source>The output is open here and in another program: whose picture is seen is not known. End one.</source>
        <translation>La sortie est ouverte ici et dans un autre programme&#xa0;: on ne sait pas quelle image se voit. Terminez-en une.</translation>
    </message>
    <message>
        <source>Perhaps under another program&apos;s picture</source>
        <translation>Peut-être sous l’image d’un autre programme</translation>
    </message>
    <message>
        <source>Black: the test chart stands unseen. T shows the next one, then the playlist.</source>
        <translation>Noir&#xa0;: la mire reste, invisible. T affiche la suivante, puis la liste.</translation>
    </message>
    <message>
        <source>Hide the figures</source>
        <translation>Masquer les chiffres</translation>
    </message>
    <message>
        <source>Figures are on the surface</source>
        <translation>Des chiffres sont sur la surface</translation>
    </message>
    <message>
        <source>Whoever is in the room reads them over the picture.</source>
        <translation>Ceux qui sont dans la salle les lisent sur l’image.</translation>
    </message>
    <message>
        <source>Installed as it is. %1</source>
        <translation>Installé en l’état. %1</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the patterns flash.</source>
        <translation>Confirmez que la salle est évacuée : les motifs clignotent.</translation>
    </message>
    <message>
        <source>No picture has come yet: black</source>
        <translation>Aucune image n’est encore arrivée : noir</translation>
    </message>
    <message>
        <source>The live picture is lost: black</source>
        <translation>L’image en direct est perdue : noir</translation>
    </message>
    <message>
        <source>The live picture is lost: its last one stands</source>
        <translation>L’image en direct est perdue : la dernière reste</translation>
    </message>
    <message>
        <source>A film plays to its end.</source>
        <translation>Un film est lu jusqu’à sa fin.</translation>
    </message>
    <message>
        <source>A part of the surface looks otherwise than predicted, by ΔE %1.</source>
        <translation>Une partie de la surface n’a pas l’aspect prédit : ΔE %1.</translation>
    </message>
    <message>
        <source>Installed, but the show cannot start with what was measured last.</source>
        <translation>Installée, mais la diffusion ne peut pas démarrer avec la dernière mesure.</translation>
    </message>
    <message>
        <source>Go on measuring, or use the earlier one, at Acquire.</source>
        <translation>Continuez la mesure, ou utilisez la précédente, à « Acquisition ».</translation>
    </message>
    <message>
        <source>Go on measuring at Acquire.</source>
        <translation>Continuez à « Acquisition ».</translation>
    </message>
    <message>
        <source>What was measured is too coarse to place content. Go on measuring.</source>
        <translation>La mesure est trop grossière pour placer un contenu. Continuez la mesure.</translation>
    </message>
    <message>
        <source>Not all was decided on what is measured now</source>
        <translation>Tout n’a pas été décidé d’après la mesure actuelle</translation>
    </message>
    <message>
        <source>Steps that are out of date count with what was chosen there before.</source>
        <translation>Les étapes périmées comptent avec ce qui y avait été choisi.</translation>
    </message>
    <message>
        <source>The test patterns fit, the photograph does not</source>
        <translation>Les motifs d’essai concordent, la photo non</translation>
    </message>
    <message>
        <source>Few patterns can miss a small part. Where another photograph differs, too, a repair looks closer.</source>
        <translation>Peu de motifs peuvent manquer une petite partie. Si une autre photo diffère aussi, une réparation y regarde de plus près.</translation>
    </message>
    <message>
        <source>This picture was perfected after the photograph.</source>
        <translation>Cette image a été perfectionnée après la photo.</translation>
    </message>
    <message>
        <source>In the camera&apos;s picture it is %1 from the left and %2 from the top.</source>
        <translation>Dans l’image de la caméra, elle est à %1 de la gauche et %2 du haut.</translation>
    </message>
    <message>
        <source>What was found before may have come of that: a photograph shows what is left of it.</source>
        <translation>Ce qui avait été constaté avant a pu en venir : une photo de contrôle montre ce qu’il en reste.</translation>
    </message>
    <message>
        <source>Black. %1</source>
        <translation>Noir. %1</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputPlaylist</name>
    <message>
        <source>Demonstration picture</source>
        <translation>Image de démonstration</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputProjection</name>
    <message>
        <source>Open the output again.</source>
        <translation>Rouvrez la sortie.</translation>
    </message>
    <message>
        <source>Relucent is projecting</source>
        <translation>Relucent projette</translation>
    </message>
    <message>
        <source>%1, shown without OpenGL</source>
        <translation>%1, affiché sans OpenGL</translation>
    </message>
    <message>
        <source>The output goes on as before.</source>
        <translation>La sortie continue comme avant.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputProof</name>
    <message>
        <source>No venue is open.</source>
        <translation>Aucun lieu n’est ouvert.</translation>
    </message>
    <message>
        <source>A photograph is being taken.</source>
        <translation>Une photo est en cours.</translation>
    </message>
    <message>
        <source>Drift is being checked.</source>
        <translation>La dérive est vérifiée.</translation>
    </message>
    <message>
        <source>It is being repaired.</source>
        <translation>Réparation en cours.</translation>
    </message>
    <message>
        <source>The report is being written.</source>
        <translation>Le rapport est en cours d’écriture.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Perfecting</name>
    <message>
        <source>%1 The picture is shown as before. Try again.</source>
        <translation>%1 L’image est affichée comme avant. Réessayez.</translation>
    </message>
    <message>
        <source>The photographs found nothing better. The picture is shown as before.</source>
        <translation>Les photos n’ont rien trouvé de mieux. L’image est affichée comme avant.</translation>
    </message>
    <message>
        <source>The picture is being perfected</source>
        <translation>L’image est en cours de perfectionnement</translation>
    </message>
    <message numerus="yes">
        <source>%n photograph(s) by now. Keep the room as it is.</source>
        <translation>
            <numerusform>%n photo pour l’instant. Laissez la salle telle quelle.</numerusform>
            <numerusform>%n photos pour l’instant. Laissez la salle telle quelle.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1: %2 before, %3 now, by %n photograph(s).</source>
        <translation>
            <numerusform>%1 : %2 avant, %3 maintenant, par %n photo.</numerusform>
            <numerusform>%1 : %2 avant, %3 maintenant, par %n photos.</numerusform>
        </translation>
    </message>
    <message>
        <source>This picture is perfected</source>
        <translation>Cette image est perfectionnée</translation>
    </message>
    <message>
        <source>The picture is as it was</source>
        <translation>L’image est comme avant</translation>
    </message>
    <message>
        <source>Not perfected</source>
        <translation>Pas perfectionnée</translation>
    </message>
    <message>
        <source>A picture that stands can be corrected by photographs of itself, some eight of them. It is kept for this venue, placed as it is now.</source>
        <translation>Une image fixe peut être corrigée par des photos d’elle-même, huit environ. Elle est conservée pour ce lieu, placée comme maintenant.</translation>
    </message>
    <message>
        <source>Perfect a picture</source>
        <translation>Perfectionner une image</translation>
    </message>
    <message>
        <source>Perfect this picture</source>
        <translation>Perfectionner cette image</translation>
    </message>
    <message>
        <source>Stop and keep the best</source>
        <translation>Arrêter et garder le meilleur</translation>
    </message>
    <message>
        <source>Show it as before</source>
        <translation>Afficher comme avant</translation>
    </message>
    <message>
        <source>What the photographs corrected is dropped.</source>
        <translation>Ce que les photos ont corrigé est abandonné.</translation>
    </message>
    <message>
        <source>Perfect it again</source>
        <translation>Perfectionner à nouveau</translation>
    </message>
    <message>
        <source>No venue is open.</source>
        <translation>Aucun lieu n’est ouvert.</translation>
    </message>
    <message>
        <source>The picture is being perfected.</source>
        <translation>L’image est en perfectionnement.</translation>
    </message>
    <message>
        <source>perfected, %1 before, %2 now.</source>
        <translation>perfectionnée, %1 avant, %2 maintenant.</translation>
    </message>
    <message>
        <source>Tried last, %1: %2</source>
        <translation>Dernier essai, %1&#xa0;: %2</translation>
    </message>
    <message>
        <source>Slowly, as the room is not said to be clear: nothing flashes.</source>
        <translation>Lentement, car la salle n’est pas confirmée évacuée&#xa0;: rien ne clignote.</translation>
    </message>
    <message>
        <source>Picture: %1</source>
        <translation>Image&#xa0;: %1</translation>
    </message>
    <message>
        <source>Not perfected since it changed</source>
        <translation>Pas perfectionnée depuis le changement</translation>
    </message>
    <message>
        <source>It was perfected for an earlier measurement, for another set, with other light or masks, or placed otherwise. That is kept, and is of no use now: perfect it once more.</source>
        <translation>Elle a été perfectionnée pour une mesure antérieure, pour une autre variante, avec une autre lumière ou d’autres masques, ou placée autrement. Cela est conservé, mais ne sert plus&#xa0;: perfectionnez-la encore une fois.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::PlaneView</name>
    <message>
        <source>%1 px</source>
        <translation>%1&#x202f;px</translation>
    </message>
    <message>
        <source>Esc goes back</source>
        <translation>Échap&#x202f;: retour</translation>
    </message>
</context>
<context>
    <name>relucent::gui::PreviewPage</name>
    <message>
        <source>Demonstration picture</source>
        <translation>Image de démonstration</translation>
    </message>
    <message>
        <source>Content</source>
        <translation>Contenu</translation>
    </message>
    <message>
        <source>Change</source>
        <translation>Changer</translation>
    </message>
    <message>
        <source>Whole</source>
        <translation>Entière</translation>
    </message>
    <message>
        <source>Fill</source>
        <translation>Remplir</translation>
    </message>
    <message>
        <source>Stretch</source>
        <translation>Étirer</translation>
    </message>
    <message>
        <source>Place automatically</source>
        <translation>Placer automatiquement</translation>
    </message>
    <message>
        <source>In the largest upright rectangle that can be reached</source>
        <translation>Dans le plus grand rectangle d’aplomb atteignable</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Lumière</translation>
    </message>
    <message>
        <source>May stay too dark</source>
        <translation>Peut rester trop sombre</translation>
    </message>
    <message>
        <source>Share of the content that may stay too dark, percent</source>
        <translation>Part du contenu qui peut rester trop sombre, pour cent</translation>
    </message>
    <message>
        <source>Lift of the blacks</source>
        <translation>Décollement des noirs</translation>
    </message>
    <message>
        <source>Lift of the blacks, percent</source>
        <translation>Décollement des noirs, pour cent</translation>
    </message>
    <message>
        <source>Reach</source>
        <translation>Lumière atteignable</translation>
    </message>
    <message>
        <source>Can be reached</source>
        <translation>Atteignable</translation>
    </message>
    <message>
        <source>Too dark to reach</source>
        <translation>Trop sombre</translation>
    </message>
    <message>
        <source>Never black enough</source>
        <translation>Jamais assez noir</translation>
    </message>
    <message>
        <source>Colour error</source>
        <translation>Écart de couleur</translation>
    </message>
    <message>
        <source>Part of the picture gets no light from this projector.</source>
        <translation>Une partie de l’image ne reçoit aucune lumière de ce projecteur.</translation>
    </message>
    <message>
        <source>A second could fill it.</source>
        <translation>Un second projecteur pourrait la remplir.</translation>
    </message>
    <message>
        <source>Choose a picture</source>
        <translation>Choisir une image</translation>
    </message>
    <message>
        <source>Fit</source>
        <translation>Cadrage</translation>
    </message>
    <message>
        <source>Brightness</source>
        <translation>Luminosité</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>Ce qui est mesuré est en sécurité.</translation>
    </message>
    <message>
        <source>Picture</source>
        <translation>Image</translation>
    </message>
    <message>
        <source>The picture of before stays.</source>
        <translation>L’image précédente reste en place.</translation>
    </message>
    <message>
        <source>Preparing the preview</source>
        <translation>Préparation de l’aperçu</translation>
    </message>
    <message>
        <source>The corners cross over. Drag them apart.</source>
        <translation>Les coins se croisent. Écartez-les.</translation>
    </message>
    <message>
        <source>Corners</source>
        <translation>Coins</translation>
    </message>
    <message>
        <source>Automatic place</source>
        <translation>Placement automatique</translation>
    </message>
    <message>
        <source>Preparing</source>
        <translation>Préparation</translation>
    </message>
    <message>
        <source>%1 in reach</source>
        <translation>%1 atteignable</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>Obsolète</translation>
    </message>
    <message>
        <source>The preview is not prepared.</source>
        <translation>L’aperçu n’est pas préparé.</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>Appareils utilisés à l’étape «&#x202f;%1&#x202f;».</translation>
    </message>
    <message>
        <source>Predicting</source>
        <translation>Prévision</translation>
    </message>
    <message>
        <source>Predicted from the measurement. Nothing is projected now.</source>
        <translation>Prévu d’après la mesure. Rien n’est projeté en ce moment.</translation>
    </message>
    <message>
        <source>Preview</source>
        <translation>Aperçu</translation>
    </message>
    <message>
        <source>Place the content in the camera&apos;s view and see what the audience will see before you project it.</source>
        <translation>Placez le contenu dans la vue caméra et voyez ce que verra le public avant de projeter.</translation>
    </message>
    <message>
        <source>Audience view</source>
        <translation>Vue du public</translation>
    </message>
    <message>
        <source>Reachable light</source>
        <translation>Lumière atteignable</translation>
    </message>
    <message>
        <source>Difference</source>
        <translation>Écart</translation>
    </message>
    <message>
        <source>What the audience will see, uncorrected at the left of the divider and corrected at the right</source>
        <translation>Ce que verra le public, non corrigé à gauche du séparateur et corrigé à droite</translation>
    </message>
    <message>
        <source>Colour difference between what is wanted and what is predicted</source>
        <translation>Écart de couleur entre l’image voulue et l’image prévue</translation>
    </message>
    <message>
        <source>Methods</source>
        <translation>Méthodes</translation>
    </message>
    <message>
        <source>predicted for this content; click one to use it</source>
        <translation>prévu pour ce contenu&#x202f;; cliquez pour choisir</translation>
    </message>
    <message>
        <source>Comparison of methods</source>
        <translation>Comparaison des méthodes</translation>
    </message>
    <message>
        <source>Method</source>
        <translation>Méthode</translation>
    </message>
    <message>
        <source>Notes</source>
        <translation>Remarques</translation>
    </message>
    <message>
        <source>blind to bounces</source>
        <translation>ignore les rebonds</translation>
    </message>
    <message>
        <source>limit of this venue</source>
        <translation>limite de ce lieu</translation>
    </message>
    <message>
        <source>%1 dB</source>
        <translation>%1&#x202f;dB</translation>
    </message>
    <message>
        <source>%1 ms</source>
        <translation>%1&#x202f;ms</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1&#x202f;s</translation>
    </message>
    <message>
        <source>Uncorrected</source>
        <translation>Non corrigé</translation>
    </message>
    <message>
        <source>Corrected, predicted</source>
        <translation>Corrigé, prévu</translation>
    </message>
    <message>
        <source>of white</source>
        <translation>du blanc</translation>
    </message>
    <message>
        <source>The larger this share, the brighter the picture, and the more of it stays too dark.</source>
        <translation>Plus cette part est grande, plus l’image est claire, et plus il en reste de parties trop sombres.</translation>
    </message>
    <message>
        <source>Part of the picture gets no light from any projector.</source>
        <translation>Une partie de l’image ne reçoit de lumière d’aucun projecteur.</translation>
    </message>
    <message>
        <source>Another one could fill it.</source>
        <translation>Un autre pourrait la combler.</translation>
    </message>
    <message>
        <source>Go to output</source>
        <translation>Aller à la sortie</translation>
    </message>
    <message>
        <source>under 1 ms</source>
        <translation>moins de 1 ms</translation>
    </message>
    <message>
        <source>Uncorrected, too</source>
        <translation>Non corrigé aussi</translation>
    </message>
    <message>
        <source>What was measured is too coarse to place content. Go on measuring.</source>
        <translation>La mesure est trop grossière pour placer un contenu. Continuez la mesure.</translation>
    </message>
    <message>
        <source>All of it can be reached</source>
        <translation>Tout est accessible</translation>
    </message>
    <message>
        <source>no note</source>
        <translation>sans remarque</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged.</source>
        <translation>L’écran du projecteur est débranché.</translation>
    </message>
    <message>
        <source>On the surface now: the corrected picture.</source>
        <translation>Sur la surface : l’image corrigée.</translation>
    </message>
    <message>
        <source>On the surface now: the uncorrected picture.</source>
        <translation>Sur la surface : l’image sans correction.</translation>
    </message>
    <message>
        <source>Stop shining</source>
        <translation>Arrêter</translation>
    </message>
    <message>
        <source>Shine on surface</source>
        <translation>Projeter sur la surface</translation>
    </message>
    <message>
        <source>Shows this picture on the surface until you stop it or leave.</source>
        <translation>Montre cette image sur la surface jusqu’à ce que vous l’arrêtiez ou partiez.</translation>
    </message>
    <message>
        <source>Show uncorrected</source>
        <translation>Montrer sans correction</translation>
    </message>
    <message>
        <source>Show corrected</source>
        <translation>Montrer avec correction</translation>
    </message>
    <message>
        <source>There is no preview yet.</source>
        <translation>Il n’y a pas encore d’aperçu.</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is not there. Plug it in and extend the desktop to it.</source>
        <translation>L’écran du projecteur est absent. Branchez-le et étendez-y le bureau.</translation>
    </message>
    <message>
        <source>The brightest light that can be reached; hatched where the content is out of reach</source>
        <translation>La lumière la plus forte possible ; hachuré là où le contenu est hors d’atteinte</translation>
    </message>
    <message>
        <source>Hatched: %1 cannot be reached</source>
        <translation>Hachuré : %1 hors d’atteinte</translation>
    </message>
    <message>
        <source>It has been measured again since the content was placed</source>
        <translation>Une nouvelle mesure a été faite depuis le placement du contenu</translation>
    </message>
    <message>
        <source>The threshold has been changed since the content was placed</source>
        <translation>Le seuil a changé depuis le placement du contenu</translation>
    </message>
    <message>
        <source>What you see here is predicted anew. Going to the output keeps it.</source>
        <translation>Ce que vous voyez ici est prévu à nouveau. Passer à la sortie le garde.</translation>
    </message>
    <message>
        <source>Still picture</source>
        <translation>Image fixe</translation>
    </message>
    <message>
        <source>How long a still picture takes to be solved, once. Films always play by “All bounces, for films” in the quicker show engine: how fast is said at Cluster.</source>
        <translation>Le temps de calcul d’une image fixe, une seule fois. Les vidéos utilisent toujours «&#x202f;Tous les rebonds, pour la vidéo&#x202f;» dans le moteur plus rapide de la diffusion&#x202f;: la vitesse se lit à Groupes.</translation>
    </message>
    <message>
        <source>Of this content, where it can be reached. What Acquire expects is a mean of other pictures: the two may differ by some dB.</source>
        <translation>Pour ce contenu, là où il est atteignable. Ce que la mesure prévoit est une moyenne d’autres images&#x202f;: les deux peuvent différer de quelques dB.</translation>
    </message>
    <message>
        <source>blind to light between clusters</source>
        <translation>aveugle entre groupes</translation>
    </message>
    <message>
        <source>recommended</source>
        <translation>recommandée</translation>
    </message>
    <message>
        <source>Compare</source>
        <translation>Comparer</translation>
    </message>
    <message>
        <source>Hide</source>
        <translation>Masquer</translation>
    </message>
    <message>
        <source>This content comes to %1. Acquire expected %2 on average of three other pictures, by the recommended method.</source>
        <translation>Ce contenu atteint %1. « Acquisition » prévoyait %2 en moyenne sur trois autres images, avec la méthode recommandée.</translation>
    </message>
    <message>
        <source>Place of a camera</source>
        <translation>Place d’une caméra</translation>
    </message>
    <message>
        <source>no content</source>
        <translation>pas de contenu</translation>
    </message>
    <message>
        <source>%1 dB, ΔE %2</source>
        <translation>%1 dB, ΔE %2</translation>
    </message>
    <message>
        <source>%1, counts %2</source>
        <translation>%1, compte %2</translation>
    </message>
    <message>
        <source>Views</source>
        <translation>Vues</translation>
    </message>
    <message>
        <source>On the surface</source>
        <translation>Sur la surface</translation>
    </message>
    <message>
        <source>Upright from here</source>
        <translation>Droit d’ici</translation>
    </message>
    <message>
        <source>Weight of this view</source>
        <translation>Poids de cette vue</translation>
    </message>
    <message>
        <source>Weight of the shown view, percent</source>
        <translation>Poids de la vue montrée, pour cent</translation>
    </message>
    <message>
        <source>For one viewer who moves</source>
        <translation>Pour un spectateur qui bouge</translation>
    </message>
    <message>
        <source>Where the viewer stands, from the first camera to the last</source>
        <translation>Où se tient le spectateur, de la première caméra à la dernière</translation>
    </message>
    <message>
        <source>Place in this view</source>
        <translation>Place dans cette vue</translation>
    </message>
    <message>
        <source>Weight of a view</source>
        <translation>Poids d’une vue</translation>
    </message>
    <message>
        <source>Drag the cameras to where they stand, then move the viewer.</source>
        <translation>Faites glisser les caméras là où elles se trouvent, puis déplacez le spectateur.</translation>
    </message>
    <message>
        <source>As little as hides where projectors end</source>
        <translation>Juste assez pour cacher les bords des projecteurs</translation>
    </message>
    <message>
        <source>Place of the viewer</source>
        <translation>Place du spectateur</translation>
    </message>
    <message>
        <source>Contradiction</source>
        <translation>Contradiction</translation>
    </message>
    <message>
        <source>How much worse a view is because of what the other views ask for</source>
        <translation>De combien une vue est moins bonne à cause de ce que demandent les autres</translation>
    </message>
    <message>
        <source>Comparing the views</source>
        <translation>Comparaison des vues</translation>
    </message>
    <message>
        <source>Visibly worse because of other views: %1</source>
        <translation>Visiblement moins bon à cause des autres vues&#x202f;: %1</translation>
    </message>
    <message>
        <source>Visibly worse because of other views</source>
        <translation>Visiblement moins bon à cause des autres vues</translation>
    </message>
    <message>
        <source>Even</source>
        <translation>Uniforme</translation>
    </message>
    <message>
        <source>One white for all pictures, as bright as most of the surface can show it.</source>
        <translation>Un seul blanc pour toutes les images, aussi clair que la plus grande partie de la surface peut le montrer.</translation>
    </message>
    <message>
        <source>By picture</source>
        <translation>Par image</translation>
    </message>
    <message>
        <source>Each picture has the white at which the least of it is lost: dark ones become brighter, bright ones dimmer.</source>
        <translation>Chaque image a le blanc avec lequel elle perd le moins&#x202f;: les sombres deviennent plus claires, les claires moins.</translation>
    </message>
    <message>
        <source>By region</source>
        <translation>Par zone</translation>
    </message>
    <message>
        <source>The same for each part of the picture, smoothly from one to the next: the least is lost of all.</source>
        <translation>De même pour chaque partie de l’image, avec des transitions douces&#x202f;: c’est ainsi que l’on perd le moins.</translation>
    </message>
    <message>
        <source>How bright white is</source>
        <translation>Luminosité du blanc</translation>
    </message>
    <message>
        <source>The picture is shown as before.</source>
        <translation>L’image est affichée comme avant.</translation>
    </message>
    <message>
        <source>Bright</source>
        <translation>Lumineux</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show are as bright as can be: white on a yellow wall turns yellow.</source>
        <translation>Les couleurs que la surface ne peut pas montrer sont aussi lumineuses que possible : du blanc sur un mur jaune devient jaune.</translation>
    </message>
    <message>
        <source>Between</source>
        <translation>Intermédiaire</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show become somewhat dimmer and shift less.</source>
        <translation>Les couleurs que la surface ne peut pas montrer deviennent un peu plus sombres et changent moins.</translation>
    </message>
    <message>
        <source>True</source>
        <translation>Fidèle</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show are dimmed until their hue is right: for faces and logos.</source>
        <translation>Les couleurs que la surface ne peut pas montrer sont assombries jusqu’à ce que leur teinte soit juste : pour les visages et les logos.</translation>
    </message>
    <message>
        <source>Colours out of reach</source>
        <translation>Couleurs hors d’atteinte</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show</source>
        <translation>Couleurs que la surface ne peut pas montrer</translation>
    </message>
    <message>
        <source>Uncertainty</source>
        <translation>Incertitude</translation>
    </message>
    <message>
        <source>95 of 100 pixels come within this of what is predicted, in percent of white. More photographs or longer exposures make it smaller.</source>
        <translation>95 pixels sur 100 s’écartent au plus d’autant de ce qui est prévu, en pour cent du blanc. Plus de photos ou des poses plus longues la réduisent.</translation>
    </message>
    <message>
        <source>How far the light may be from what is predicted, by the measurement&apos;s noise</source>
        <translation>De combien la lumière peut s’écarter de ce qui est prévu, par le bruit de la mesure</translation>
    </message>
    <message>
        <source>95 of 100 pixels come within the value shown, on average %1 of white</source>
        <translation>95 pixels sur 100 restent dans la valeur affichée, en moyenne %1 du blanc</translation>
    </message>
    <message>
        <source>Quality</source>
        <translation>Qualité</translation>
    </message>
    <message>
        <source>Detail kept</source>
        <translation>Détail conservé</translation>
    </message>
    <message>
        <source>Peak signal-to-noise ratio, PSNR: 20 dB looks rough, 30 dB good.</source>
        <translation>Rapport signal sur bruit de crête, PSNR&#xa0;: 20 dB paraissent grossiers, 30 dB bons.</translation>
    </message>
    <message>
        <source>Structural similarity, SSIM: 1 is all of it.</source>
        <translation>Similarité structurelle, SSIM&#xa0;: 1 signifie tout.</translation>
    </message>
    <message>
        <source>What of it is shown</source>
        <translation>Ce qui en est montré</translation>
    </message>
    <message>
        <source>Mask %1</source>
        <translation>Masque %1</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1, %2</translation>
    </message>
    <message>
        <source>Masks</source>
        <translation>Masques</translation>
    </message>
    <message>
        <source>No light falls on these parts: doors, windows, where visitors sit.</source>
        <translation>Aucune lumière ne tombe sur ces parties : portes, fenêtres, places des visiteurs.</translation>
    </message>
    <message>
        <source>Draw a mask</source>
        <translation>Dessiner un masque</translation>
    </message>
    <message>
        <source>Click points in the picture, and the first one again to close. With the keyboard: arrow keys, Space, Return; Escape leaves it.</source>
        <translation>Cliquez des points dans l’image, puis de nouveau le premier pour fermer. Au clavier : flèches, Espace, Entrée ; Échap abandonne.</translation>
    </message>
    <message>
        <source>Straight</source>
        <translation>Droit</translation>
    </message>
    <message>
        <source>Curved</source>
        <translation>Courbe</translation>
    </message>
    <message>
        <source>How the points of the mask are joined</source>
        <translation>Comment les points du masque sont reliés</translation>
    </message>
    <message>
        <source>Feather</source>
        <translation>Bord doux</translation>
    </message>
    <message>
        <source>How far beyond the mask the light comes back, thousandths of the view</source>
        <translation>Jusqu’où la lumière revient au-delà du masque, en millièmes de la vue</translation>
    </message>
    <message>
        <source>Remove the mask</source>
        <translation>Supprimer le masque</translation>
    </message>
    <message>
        <source>Stop drawing</source>
        <translation>Arrêter de dessiner</translation>
    </message>
    <message>
        <source>errors weighed as an eye does</source>
        <translation>erreurs pesées comme par l’œil</translation>
    </message>
    <message>
        <source>No venue is open.</source>
        <translation>Aucun lieu n’est ouvert.</translation>
    </message>
    <message>
        <source>The sets are as they were.</source>
        <translation>Les variantes sont restées telles quelles.</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>Variante</translation>
    </message>
    <message>
        <source>Without a name</source>
        <translation>Sans nom</translation>
    </message>
    <message>
        <source>More</source>
        <translation>Plus</translation>
    </message>
    <message>
        <source>More for the set</source>
        <translation>Plus pour la variante</translation>
    </message>
    <message>
        <source>Save as…</source>
        <translation>Enregistrer sous…</translation>
    </message>
    <message>
        <source>Rename…</source>
        <translation>Renommer…</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Supprimer</translation>
    </message>
    <message>
        <source>It is placed automatically.</source>
        <translation>Elle est placée automatiquement.</translation>
    </message>
    <message>
        <source>A picture is on the surface.</source>
        <translation>Une image est sur la surface.</translation>
    </message>
    <message>
        <source>The output is open. Close it first.</source>
        <translation>La sortie est ouverte. Fermez-la d’abord.</translation>
    </message>
    <message>
        <source>Shine on %1</source>
        <translation>Projeter sur %1</translation>
    </message>
    <message>
        <source>A rehearsal has no surface: this lights the screen %1 until you stop it or leave.</source>
        <translation>Une répétition n’a pas de surface : ceci éclaire l’écran %1 jusqu’à ce que vous l’arrêtiez ou partiez.</translation>
    </message>
    <message>
        <source>Part of the picture lies where the view is left out.</source>
        <translation>Une partie de l’image se trouve là où la vue est laissée de côté.</translation>
    </message>
    <message>
        <source>It stays uncorrected. Acquire says why.</source>
        <translation>Elle reste non corrigée. Acquisition dit pourquoi.</translation>
    </message>
    <message>
        <source>Predicted from the measurement. The output stays as it is.</source>
        <translation>Prévu d’après la mesure. La sortie reste telle quelle.</translation>
    </message>
    <message>
        <source>The content was placed on another measurement or threshold</source>
        <translation>Le contenu a été placé sur une autre mesure ou un autre seuil</translation>
    </message>
    <message>
        <source>To shine on the surface, close the output first.</source>
        <translation>Pour projeter sur la surface, fermez d’abord la sortie.</translation>
    </message>
    <message>
        <source>Uncorrected, in blocks of %1 px</source>
        <translation>Non corrigée, par blocs de %1 px</translation>
    </message>
    <message>
        <source>Predicted from the measurement. Another program&apos;s show is projected.</source>
        <translation>Prévu d’après la mesure. La diffusion d’un autre programme est projetée.</translation>
    </message>
    <message>
        <source>The preview is being prepared.</source>
        <translation>L’aperçu est en préparation.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::RenameDialog</name>
    <message>
        <source>Rename a venue</source>
        <translation>Renommer un lieu</translation>
    </message>
    <message>
        <source>Its folder has the same name and is renamed with it. A show that starts at log-in follows.</source>
        <translation>Son dossier porte le même nom et est renommé avec lui. Une diffusion qui démarre à l’ouverture de session suit.</translation>
    </message>
    <message>
        <source>Rename</source>
        <translation>Renommer</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Session</name>
    <message>
        <source>%1 is at work. What is chosen here can be kept when that has ended.</source>
        <translation>%1 est en cours. Ce qui est choisi ici pourra être gardé ensuite.</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>Appareils utilisés à «&#x202f;%1&#x202f;».</translation>
    </message>
    <message>
        <source>Confirm that the room is clear.</source>
        <translation>Confirmez que la salle est évacuée.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::SetNameDialog</name>
    <message>
        <source>Save as a set</source>
        <translation>Enregistrer comme variante</translation>
    </message>
    <message>
        <source>Rename a set</source>
        <translation>Renommer une variante</translation>
    </message>
    <message>
        <source>Day, night, school class</source>
        <translation>Jour, nuit, classe</translation>
    </message>
    <message>
        <source>What you see becomes this set, and is changed in it from now on.</source>
        <translation>Ce que vous voyez devient cette variante, et y est modifié désormais.</translation>
    </message>
    <message>
        <source>Playlists and controllers that call it by its present name have to be changed, too.</source>
        <translation>Les listes de lecture et les contrôleurs qui l’appellent par son nom actuel doivent aussi être modifiés.</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>Enregistrer</translation>
    </message>
    <message>
        <source>Rename</source>
        <translation>Renommer</translation>
    </message>
    <message>
        <source>There is a set of this name already.</source>
        <translation>Il existe déjà une variante de ce nom.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::SetTimesDialog</name>
    <message>
        <source>Sets by the time of the day</source>
        <translation>Variantes selon l’heure du jour</translation>
    </message>
    <message>
        <source>From each time on the installed show plays that set, every day, until the next time.</source>
        <translation>À partir de chaque heure, la diffusion installée montre cette variante, tous les jours, jusqu’à l’heure suivante.</translation>
    </message>
    <message>
        <source>From this time on</source>
        <translation>À partir de cette heure</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>Variante</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Ajouter</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Supprimer</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Annuler</translation>
    </message>
    <message>
        <source>Apply</source>
        <translation>Appliquer</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1&#xa0;: %2</translation>
    </message>
    <message>
        <source>There are no times yet.</source>
        <translation>Il n’y a pas encore d’heures.</translation>
    </message>
    <message>
        <source>Type a time of the day, such as %1.</source>
        <translation>Saisissez une heure de la journée, par exemple %1.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::SettingsDialog</name>
    <message>
        <source>Settings</source>
        <translation>Réglages</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Fermer</translation>
    </message>
    <message>
        <source>Look</source>
        <translation>Apparence</translation>
    </message>
    <message>
        <source>Dark</source>
        <translation>Sombre</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Clair</translation>
    </message>
    <message>
        <source>Theme. The dark one is for the dark room.</source>
        <translation>Thème. Le thème sombre convient à la salle obscure.</translation>
    </message>
    <message>
        <source>Dim pictures: the laptop is room light</source>
        <translation>Assombrir les images&#x202f;: le portable éclaire la salle</translation>
    </message>
    <message>
        <source>As the computer</source>
        <translation>Comme l’ordinateur</translation>
    </message>
    <message>
        <source>Language</source>
        <translation>Langue</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>Mesure</translation>
    </message>
    <message>
        <source>As quickly as the devices can, after a consent</source>
        <translation>Aussi vite que les appareils le peuvent, après accord</translation>
    </message>
    <message numerus="yes">
        <source>At most %n change(s) a second</source>
        <translation>
            <numerusform>Au plus %n changement par seconde</numerusform>
            <numerusform>Au plus %n changements par seconde</numerusform>
        </translation>
    </message>
    <message>
        <source>Flashing light of the projector</source>
        <translation>Lumière clignotante du projecteur</translation>
    </message>
    <message>
        <source>More than three changes a second can cause seizures. Slower measuring needs no consent.</source>
        <translation>Plus de trois changements par seconde peuvent provoquer des crises d’épilepsie. Une mesure plus lente ne demande pas d’accord.</translation>
    </message>
    <message>
        <source>A sound when a measurement ends</source>
        <translation>Un son à la fin d’une mesure</translation>
    </message>
    <message>
        <source>New venues</source>
        <translation>Nouveaux lieux</translation>
    </message>
    <message>
        <source>Folder for new venues</source>
        <translation>Dossier des nouveaux lieux</translation>
    </message>
    <message>
        <source>Choose a folder</source>
        <translation>Choisir un dossier</translation>
    </message>
    <message>
        <source>Folder</source>
        <translation>Dossier</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Show</name>
    <message>
        <source>A show is playing.</source>
        <translation>Une diffusion est en cours.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StatusPage</name>
    <message>
        <source>State</source>
        <translation>État</translation>
    </message>
    <message>
        <source>Updated</source>
        <translation>Mis à jour</translation>
    </message>
    <message>
        <source>Computed on</source>
        <translation>Calculé sur</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>Images</translation>
    </message>
    <message>
        <source>Late frames</source>
        <translation>Images en retard</translation>
    </message>
    <message>
        <source>Frames per second</source>
        <translation>Images par seconde</translation>
    </message>
    <message>
        <source>Time per frame (ms)</source>
        <translation>Temps par image (ms)</translation>
    </message>
    <message>
        <source>Delay behind the viewer (ms)</source>
        <translation>Retard sur le spectateur (ms)</translation>
    </message>
    <message>
        <source>Clipped share</source>
        <translation>Part écrêtée</translation>
    </message>
    <message>
        <source>Steps</source>
        <translation>Étapes</translation>
    </message>
    <message>
        <source>Perfected</source>
        <translation>Perfectionnée</translation>
    </message>
    <message>
        <source>Item</source>
        <translation>Élément</translation>
    </message>
    <message>
        <source>Items skipped</source>
        <translation>Éléments sautés</translation>
    </message>
    <message>
        <source>Failures</source>
        <translation>Pannes</translation>
    </message>
    <message>
        <source>Most memory used (bytes)</source>
        <translation>Mémoire maximale utilisée (octets)</translation>
    </message>
    <message>
        <source>Displays</source>
        <translation>Affichages</translation>
    </message>
    <message>
        <source>Connector</source>
        <translation>Connecteur</translation>
    </message>
    <message>
        <source>Shining</source>
        <translation>Allumé</translation>
    </message>
    <message>
        <source>Drawn by</source>
        <translation>Dessiné par</translation>
    </message>
    <message>
        <source>Projectors</source>
        <translation>Projecteurs</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>Projecteur</translation>
    </message>
    <message>
        <source>Address</source>
        <translation>Adresse</translation>
    </message>
    <message>
        <source>Answers</source>
        <translation>Répond</translation>
    </message>
    <message>
        <source>Problem</source>
        <translation>Problème</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Nom</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>Modèle</translation>
    </message>
    <message>
        <source>Power</source>
        <translation>Alimentation</translation>
    </message>
    <message>
        <source>Shutter</source>
        <translation>Obturateur</translation>
    </message>
    <message>
        <source>Lamp hours</source>
        <translation>Heures de lampe</translation>
    </message>
    <message>
        <source>Filter hours</source>
        <translation>Heures de filtre</translation>
    </message>
    <message>
        <source>Input</source>
        <translation>Entrée</translation>
    </message>
    <message>
        <source>Signal</source>
        <translation>Signal</translation>
    </message>
    <message>
        <source>Own pixels</source>
        <translation>Pixels propres</translation>
    </message>
    <message>
        <source>Remarks</source>
        <translation>Remarques</translation>
    </message>
    <message>
        <source>yes</source>
        <translation>oui</translation>
    </message>
    <message>
        <source>no</source>
        <translation>non</translation>
    </message>
    <message>
        <source>Relucent: %1</source>
        <translation>Relucent : %1</translation>
    </message>
    <message>
        <source>Alarm</source>
        <translation>Alarme</translation>
    </message>
    <message>
        <source>Last night</source>
        <translation>Dernière nuit</translation>
    </message>
    <message>
        <source>When</source>
        <translation>Quand</translation>
    </message>
    <message>
        <source>Outcome</source>
        <translation>Résultat</translation>
    </message>
    <message>
        <source>Pictures perfected</source>
        <translation>Images perfectionnées</translation>
    </message>
    <message>
        <source>Colour error (ΔE)</source>
        <translation>Erreur de couleur (ΔE)</translation>
    </message>
    <message>
        <source>Predicted colour error (ΔE)</source>
        <translation>Erreur de couleur prévue (ΔE)</translation>
    </message>
    <message>
        <source>Nobody was told</source>
        <translation>Personne n’a été prévenu</translation>
    </message>
    <message>
        <source>Next night</source>
        <translation>Prochaine nuit</translation>
    </message>
    <message>
        <source>Somebody has to look</source>
        <translation>Quelqu’un doit aller voir</translation>
    </message>
    <message>
        <source>Watched by camera</source>
        <translation>Surveillé par caméra</translation>
    </message>
    <message>
        <source>Photographs</source>
        <translation>Photographies</translation>
    </message>
    <message>
        <source>Photographs used</source>
        <translation>Photographies utilisées</translation>
    </message>
    <message>
        <source>Share that can be told</source>
        <translation>Part évaluable</translation>
    </message>
    <message>
        <source>Time per photograph (ms)</source>
        <translation>Temps par photographie (ms)</translation>
    </message>
    <message>
        <source>What has changed</source>
        <translation>Ce qui a changé</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>Type</translation>
    </message>
    <message>
        <source>How much</source>
        <translation>Combien</translation>
    </message>
    <message>
        <source>What happened</source>
        <translation>Ce qui s’est passé</translation>
    </message>
    <message>
        <source>What to do</source>
        <translation>Ce qu’il faut faire</translation>
    </message>
    <message>
        <source>Delay of the live picture (ms)</source>
        <translation>Retard de l’image en direct (ms)</translation>
    </message>
    <message>
        <source>Streams</source>
        <translation>Flux</translation>
    </message>
    <message>
        <source>Losses</source>
        <translation>Pertes</translation>
    </message>
    <message>
        <source>Pixels</source>
        <translation>Pixels</translation>
    </message>
    <message>
        <source>Time from the sender, by its clock (ms)</source>
        <translation>Temps depuis l’émetteur, selon son horloge (ms)</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>Variante</translation>
    </message>
    <message>
        <source>Black</source>
        <translation>Noir</translation>
    </message>
    <message>
        <source>Frozen</source>
        <translation>Figé</translation>
    </message>
    <message>
        <source>Corrected</source>
        <translation>Corrigé</translation>
    </message>
    <message>
        <source>Brightness</source>
        <translation>Luminosité</translation>
    </message>
    <message>
        <source>Test chart</source>
        <translation>Mire</translation>
    </message>
    <message>
        <source>starting</source>
        <translation>démarre</translation>
    </message>
    <message>
        <source>playing</source>
        <translation>en lecture</translation>
    </message>
    <message>
        <source>resting until its hours</source>
        <translation>au repos jusqu’à ses heures</translation>
    </message>
    <message>
        <source>photographing</source>
        <translation>photographie</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>en échec</translation>
    </message>
    <message>
        <source>stopped</source>
        <translation>arrêté</translation>
    </message>
    <message>
        <source>connecting</source>
        <translation>connexion</translation>
    </message>
    <message>
        <source>asking whether it may</source>
        <translation>demande l’autorisation</translation>
    </message>
    <message>
        <source>lost</source>
        <translation>perdu</translation>
    </message>
    <message>
        <source>opening</source>
        <translation>ouverture</translation>
    </message>
    <message>
        <source>watching</source>
        <translation>observe</translation>
    </message>
    <message>
        <source>paused</source>
        <translation>en pause</translation>
    </message>
    <message>
        <source>no camera</source>
        <translation>pas de caméra</translation>
    </message>
    <message>
        <source>no calibration</source>
        <translation>pas de calibration</translation>
    </message>
    <message>
        <source>black, until somebody ends it</source>
        <translation>noir, jusqu’à ce que quelqu’un y mette fin</translation>
    </message>
    <message>
        <source>test chart</source>
        <translation>mire</translation>
    </message>
    <message>
        <source>frozen, until somebody ends it</source>
        <translation>figé, jusqu’à ce que quelqu’un y mette fin</translation>
    </message>
    <message>
        <source>playing, but no display shows it</source>
        <translation>en lecture, mais aucun écran ne l’affiche</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StatusStrip</name>
    <message>
        <source>Projector</source>
        <translation>Projecteur</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Caméra</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>Disque</translation>
    </message>
    <message>
        <source>none chosen</source>
        <translation>à choisir</translation>
    </message>
    <message>
        <source>%1 free</source>
        <translation>%1 libres</translation>
    </message>
    <message>
        <source>simulated</source>
        <translation>simulation</translation>
    </message>
    <message>
        <source>by script</source>
        <translation>par script</translation>
    </message>
    <message>
        <source>%1, in use</source>
        <translation>%1, utilisée</translation>
    </message>
    <message>
        <source>Saved %1</source>
        <translation>Enregistré à %1</translation>
    </message>
    <message>
        <source>Room light</source>
        <translation>Lumière ambiante</translation>
    </message>
    <message>
        <source>%1, unplugged</source>
        <translation>%1, débranché</translation>
    </message>
    <message>
        <source>%1 of full light, steady</source>
        <translation>%1 de la pleine lumière, stable</translation>
    </message>
    <message>
        <source>%1 of full light, changed</source>
        <translation>%1 de la pleine lumière, a changé</translation>
    </message>
    <message>
        <source>%1, silent</source>
        <translation>%1, muette</translation>
    </message>
    <message numerus="yes">
        <source>%n screen(s)</source>
        <translation>
            <numerusform>%n écran</numerusform>
            <numerusform>%n écrans</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n with %1, %2</source>
        <comment>projectors and their pixels</comment>
        <translation>
            <numerusform>%n de %1, %2</numerusform>
            <numerusform>%n de %1, %2</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n, simulated</source>
        <comment>cameras</comment>
        <translation>
            <numerusform>%n, simulée</numerusform>
            <numerusform>%n, simulées</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n camera(s)</source>
        <translation>
            <numerusform>%n caméra</numerusform>
            <numerusform>%n caméras</numerusform>
        </translation>
    </message>
    <message>
        <source>none in use</source>
        <translation>non utilisé</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StepRail</name>
    <message>
        <source>locked</source>
        <translation>verrouillée</translation>
    </message>
    <message>
        <source>done</source>
        <translation>terminée</translation>
    </message>
    <message>
        <source>out of date</source>
        <translation>obsolète</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>en échec</translation>
    </message>
    <message>
        <source>current</source>
        <translation>actuelle</translation>
    </message>
    <message>
        <source>open</source>
        <translation>à faire</translation>
    </message>
    <message>
        <source>Step %1, %2, %3</source>
        <translation>Étape %1, %2, %3</translation>
    </message>
    <message>
        <source>No venue open</source>
        <translation>Aucun lieu ouvert</translation>
    </message>
    <message>
        <source>stopped early</source>
        <translation>arrêté avant la fin</translation>
    </message>
    <message>
        <source>under way</source>
        <translation>en cours</translation>
    </message>
    <message>
        <source>doubtful</source>
        <translation>douteux</translation>
    </message>
    <message>
        <source>Opens once %1 is done.</source>
        <translation>S’ouvre quand «&#x202f;%1&#x202f;» est terminé.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StreamDialog</name>
    <message>
        <source>Add a stream</source>
        <translation>Ajouter un flux</translation>
    </message>
    <message>
        <source>A live picture from the network, without its sound: RTSP, SRT, RTP, UDP, HTTP or RTMP. While it plays, this computer is connected to that address.</source>
        <translation>Une image en direct du réseau, sans le son : RTSP, SRT, RTP, UDP, HTTP ou RTMP. Pendant la lecture, cet ordinateur est connecté à cette adresse.</translation>
    </message>
    <message>
        <source>Address</source>
        <translation>Adresse</translation>
    </message>
    <message>
        <source>User name and password stand before the host, as in rtsp://user:password@host. They are kept in the playlist, and shown nowhere.</source>
        <translation>Le nom d’utilisateur et le mot de passe précèdent l’hôte, comme dans rtsp://user:password@host. Ils sont conservés dans la liste de lecture et ne s’affichent nulle part.</translation>
    </message>
    <message>
        <source>While it is lost</source>
        <translation>Pendant qu’il est perdu</translation>
    </message>
    <message>
        <source>Its last picture</source>
        <translation>Sa dernière image</translation>
    </message>
    <message>
        <source>Black</source>
        <translation>Noir</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Annuler</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Ajouter</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ThresholdPage</name>
    <message>
        <source>%1 of light kept</source>
        <translation>%1 de lumière gardée</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>Obsolète</translation>
    </message>
    <message>
        <source>Reading the light transport</source>
        <translation>Lecture du transport lumineux</translation>
    </message>
    <message>
        <source>Below 95 % of the light, bounces are lost.</source>
        <translation>Sous 95&#x202f;% de la lumière, des rebonds sont perdus.</translation>
    </message>
    <message>
        <source>Next: groups of pixels that can be solved on their own</source>
        <translation>Ensuite&#x202f;: groupes de pixels à résoudre séparément</translation>
    </message>
    <message>
        <source>Group into clusters</source>
        <translation>Former les groupes</translation>
    </message>
    <message>
        <source>The threshold was chosen for an earlier measurement</source>
        <translation>Le seuil a été choisi pour une mesure antérieure</translation>
    </message>
    <message>
        <source>Look at it again, then go on.</source>
        <translation>Revoyez-le, puis continuez.</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>Ce qui est mesuré est en sécurité.</translation>
    </message>
    <message>
        <source>Threshold</source>
        <translation>Seuil</translation>
    </message>
    <message>
        <source>Choose the faintest light worth keeping. Less is faster and smaller; too little loses the bounces.</source>
        <translation>Choisissez la plus faible lumière à garder. En garder moins est plus rapide et plus léger&#x202f;; trop peu fait perdre les rebonds.</translation>
    </message>
    <message>
        <source>Camera view</source>
        <translation>Vue caméra</translation>
    </message>
    <message>
        <source>The surface in full light</source>
        <translation>La surface en pleine lumière</translation>
    </message>
    <message>
        <source>Pixel %1, %2</source>
        <translation>Pixel %1, %2</translation>
    </message>
    <message>
        <source>Projector pixels that light the picked camera pixel</source>
        <translation>Pixels du projecteur qui éclairent le pixel caméra choisi</translation>
    </message>
    <message>
        <source>Pick a pixel in the camera view.</source>
        <translation>Choisissez un pixel dans la vue caméra.</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Caméra</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>Projecteur</translation>
    </message>
    <message>
        <source>transport</source>
        <translation>transport</translation>
    </message>
    <message>
        <source>Transport matrix</source>
        <translation>Matrice de transport</translation>
    </message>
    <message>
        <source>click an entry</source>
        <translation>cliquez un élément</translation>
    </message>
    <message>
        <source>Light transport matrix, camera pixels down, projector pixels across</source>
        <translation>Matrice de transport lumineux, pixels caméra en vertical, pixels projecteur en horizontal</translation>
    </message>
    <message>
        <source>Transport value, camera signal a second</source>
        <translation>Valeur de transport, signal caméra par seconde</translation>
    </message>
    <message>
        <source>How much light flows through each connection</source>
        <translation>Lumière passant par chaque liaison</translation>
    </message>
    <message>
        <source>drag the cut, or use the arrow keys</source>
        <translation>faites glisser le seuil, ou flèches du clavier</translation>
    </message>
    <message>
        <source>Connections</source>
        <translation>Liaisons</translation>
    </message>
    <message>
        <source>Cut</source>
        <translation>Seuil</translation>
    </message>
    <message>
        <source>Cut at %1, keeps %2</source>
        <translation>Seuil à %1, garde %2</translation>
    </message>
    <message>
        <source>Everything is kept</source>
        <translation>Tout est gardé</translation>
    </message>
    <message>
        <source>Leave out light below</source>
        <translation>Écarter la lumière sous</translation>
    </message>
    <message>
        <source>One value</source>
        <translation>Une valeur</translation>
    </message>
    <message>
        <source>What stays</source>
        <translation>Ce qui reste</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Lumière</translation>
    </message>
    <message>
        <source>Memory</source>
        <translation>Mémoire</translation>
    </message>
    <message>
        <source>What is left out is put back in proportion, so that the surface keeps its brightness.</source>
        <translation>Ce qui est écarté est rendu en proportion, pour que la surface garde sa luminosité.</translation>
    </message>
    <message>
        <source>Picked pixel</source>
        <translation>Pixel choisi</translation>
    </message>
    <message>
        <source>Lit by</source>
        <translation>Éclairé par</translation>
    </message>
    <message>
        <source>Strongest</source>
        <translation>Le plus fort</translation>
    </message>
    <message>
        <source>From around it</source>
        <translation>De ses alentours</translation>
    </message>
    <message>
        <source>Light from elsewhere</source>
        <translation>Lumière d’ailleurs</translation>
    </message>
    <message>
        <source>Use suggested, %1</source>
        <translation>Valeur proposée, %1</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 sur %2</translation>
    </message>
    <message>
        <source>Picked pixel %1, %2</source>
        <translation>Pixel choisi %1, %2</translation>
    </message>
    <message numerus="yes">
        <source>%n pixel(s)</source>
        <translation>
            <numerusform>%n pixel</numerusform>
            <numerusform>%n pixels</numerusform>
        </translation>
    </message>
    <message>
        <source>Cut, camera signal a second</source>
        <translation>Seuil, signal caméra par seconde</translation>
    </message>
    <message>
        <source>Use picked pixel</source>
        <translation>Prendre le pixel choisi</translation>
    </message>
    <message>
        <source>For each camera pixel</source>
        <translation>Par pixel de caméra</translation>
    </message>
    <message>
        <source>Suggested: three times the noise of the measurement.</source>
        <translation>Conseil&#x202f;: trois fois le bruit de la mesure.</translation>
    </message>
    <message>
        <source>Suggested: keeps nearly all of the light.</source>
        <translation>Conseil&#x202f;: garde presque toute la lumière.</translation>
    </message>
    <message>
        <source>%1 on average</source>
        <translation>%1 en moyenne</translation>
    </message>
    <message>
        <source>Kind of cut</source>
        <translation>Type de coupe</translation>
    </message>
    <message>
        <source>Share of each pixel</source>
        <translation>Part de chaque pixel</translation>
    </message>
    <message>
        <source>Share of the strongest light of each camera pixel, in tenths of a percent</source>
        <translation>Part de la lumière la plus forte de chaque pixel de la caméra, en dixièmes de pour cent</translation>
    </message>
    <message>
        <source>Below %1 of the strongest light that each camera pixel gets</source>
        <translation>Sous %1 de la lumière la plus forte que reçoit chaque pixel de la caméra</translation>
    </message>
    <message>
        <source>Of each camera pixel the strongest connection always stays, however high the cut.</source>
        <translation>De chaque pixel de la caméra, la liaison la plus forte reste toujours, si haut que soit le seuil.</translation>
    </message>
    <message>
        <source>“%1” is not a cut: type a number, 0 or more. The cut is still %2.</source>
        <translation>« %1 » n’est pas un seuil : tapez un nombre, 0 ou plus. Le seuil reste %2.</translation>
    </message>
    <message>
        <source>At three times the noise, %1, only %2 of the light would stay: much faint light adds up. Suggested: keep everything.</source>
        <translation>Au triple du bruit, %1, il ne resterait que %2 de la lumière&#x202f;: beaucoup de lumière faible s’additionne. Conseil&#x202f;: tout garder.</translation>
    </message>
    <message>
        <source>Keep everything</source>
        <translation>Tout garder</translation>
    </message>
    <message>
        <source>Changed: it is applied as soon as you go on.</source>
        <translation>Modifié&#xa0;: appliqué dès que vous continuez.</translation>
    </message>
    <message>
        <source>What was measured is being read.</source>
        <translation>La mesure est en cours de lecture.</translation>
    </message>
    <message>
        <source>Pick a pixel in a picture.</source>
        <translation>Choisissez un pixel dans une image.</translation>
    </message>
    <message>
        <source>It is in use.</source>
        <translation>Il est utilisé.</translation>
    </message>
    <message>
        <source>No light of the picked pixel was kept.</source>
        <translation>Aucune lumière du pixel choisi n’a été gardée.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::TidyDialog</name>
    <message>
        <source>All</source>
        <translation>Toutes</translation>
    </message>
    <message>
        <source>Of the latest measurement</source>
        <translation>Celles de la dernière mesure</translation>
    </message>
    <message>
        <source>None: results only</source>
        <translation>Aucune : résultats seuls</translation>
    </message>
    <message>
        <source>Only what nothing reads goes, and old files are compressed without loss.</source>
        <translation>Seul part ce que rien ne lit ; les anciens fichiers sont compressés sans perte.</translation>
    </message>
    <message>
        <source>Those that were set aside by measuring again go too. Nothing reads them.</source>
        <translation>Celles mises de côté lors d’une nouvelle mesure partent aussi. Rien ne les lit.</translation>
    </message>
    <message>
        <source>All that was measured and computed stays. The photographs go.</source>
        <translation>Tout ce qui a été mesuré et calculé reste. Les photos partent.</translation>
    </message>
    <message>
        <source>Showing, checking and reports need results only. Other settings, and better methods of later versions, then have to photograph everything again.</source>
        <translation>Projection, contrôle et rapports n’ont besoin que des résultats. D’autres réglages, et de meilleures méthodes de versions futures, devront alors tout rephotographier.</translation>
    </message>
    <message numerus="yes">
        <source>%n photograph(s)</source>
        <translation>
            <numerusform>%n photo</numerusform>
            <numerusform>%n photos</numerusform>
        </translation>
    </message>
    <message>
        <source>What was freed until then is free. Nothing that is needed is lost.</source>
        <translation>Ce qui a été libéré jusque-là l’est. Rien de nécessaire n’est perdu.</translation>
    </message>
    <message>
        <source>Photographs to keep</source>
        <translation>Photos à conserver</translation>
    </message>
    <message>
        <source>This venue is not measured to the end.</source>
        <translation>Ce lieu n’est pas mesuré jusqu’au bout.</translation>
    </message>
    <message>
        <source>All its photographs stay: going on needs them.</source>
        <translation>Toutes ses photos restent : il les faut pour continuer.</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Retour</translation>
    </message>
    <message>
        <source>Freeing the disk</source>
        <translation>Libération du disque</translation>
    </message>
    <message>
        <source>%1 will be removed for good.</source>
        <translation>%1 seront supprimées pour de bon.</translation>
    </message>
    <message>
        <source>%1 will be freed.</source>
        <translation>%1 seront libérés.</translation>
    </message>
    <message>
        <source>%1 freed, %2 removed</source>
        <translation>%1 libérés, %2 supprimées</translation>
    </message>
    <message>
        <source>%1 Nothing that is needed is lost.</source>
        <translation>%1 Rien de nécessaire n’est perdu.</translation>
    </message>
    <message>
        <source>frees %1</source>
        <translation>libère %1</translation>
    </message>
    <message>
        <source>nothing to free</source>
        <translation>rien à libérer</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Annuler</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Arrêter</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Fermer</translation>
    </message>
    <message>
        <source>Free %1…</source>
        <translation>Libérer %1…</translation>
    </message>
    <message>
        <source>Free %1</source>
        <translation>Libérer %1</translation>
    </message>
    <message>
        <source>No photograph goes: everything stays possible.</source>
        <translation>Aucune photo ne part : tout reste possible.</translation>
    </message>
    <message>
        <source>The latest measurement keeps its photographs: everything stays possible.</source>
        <translation>La dernière mesure garde ses photos : tout reste possible.</translation>
    </message>
    <message>
        <source>Looking up what could be freed. Nothing is removed yet.</source>
        <translation>Recherche de ce qui peut être libéré. Rien n’est encore supprimé.</translation>
    </message>
    <message>
        <source>Free disk space</source>
        <translation>Libérer de l’espace disque</translation>
    </message>
    <message>
        <source>Disk space of %1</source>
        <translation>Espace disque de %1</translation>
    </message>
    <message>
        <source>Freeing space was stopped.</source>
        <translation>La libération d’espace a été arrêtée.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VenueNetwork</name>
    <message>
        <source>“%1” is no network address of a projector. Write its number or name, as 192.168.1.50.</source>
        <translation>« %1 » n’est pas l’adresse réseau d’un projecteur. Écrivez son numéro ou son nom, comme 192.168.1.50.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VenuePage</name>
    <message>
        <source>Unplugged. Plug it in or choose another.</source>
        <translation>Débranché. Branchez-le ou choisissez-en un autre.</translation>
    </message>
    <message>
        <source>%1, %2 by %3, chosen</source>
        <translation>%1, %2 par %3, choisi</translation>
    </message>
    <message>
        <source>%1, %2 by %3</source>
        <translation>%1, %2 par %3</translation>
    </message>
    <message>
        <source>Screens</source>
        <translation>Écrans</translation>
    </message>
    <message>
        <source>Choose the one that shines on the surface. Its pixels are the projector&apos;s.</source>
        <translation>Choisissez celui qui éclaire la surface. Ses pixels sont ceux du projecteur.</translation>
    </message>
    <message>
        <source>Identify screens</source>
        <translation>Identifier les écrans</translation>
    </message>
    <message>
        <source>I</source>
        <translation>I</translation>
    </message>
    <message>
        <source>The projector shares your screen</source>
        <translation>Le projecteur partage votre écran</translation>
    </message>
    <message>
        <source>Real devices</source>
        <translation>Appareils réels</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>Projecteur</translation>
    </message>
    <message>
        <source>Glossy corner</source>
        <translation>Coin brillant</translation>
    </message>
    <message>
        <source>Light bounces between two cards</source>
        <translation>La lumière rebondit entre deux cartons</translation>
    </message>
    <message>
        <source>Bust before a brick wall</source>
        <translation>Buste et mur de briques</translation>
    </message>
    <message>
        <source>Texture, shadow and light between surfaces</source>
        <translation>Texture, ombre et lumière entre les surfaces</translation>
    </message>
    <message>
        <source>Many depths</source>
        <translation>Plusieurs profondeurs</translation>
    </message>
    <message>
        <source>Some surfaces are out of focus</source>
        <translation>Certaines surfaces sont floues</translation>
    </message>
    <message>
        <source>Dome</source>
        <translation>Dôme</translation>
    </message>
    <message>
        <source>Every part lights every other part</source>
        <translation>Chaque partie éclaire toutes les autres</translation>
    </message>
    <message>
        <source>Wine glass</source>
        <translation>Verre à vin</translation>
    </message>
    <message>
        <source>Light is refracted both ways</source>
        <translation>La lumière est réfractée à l’aller et au retour</translation>
    </message>
    <message>
        <source>Painted wall</source>
        <translation>Mur peint</translation>
    </message>
    <message>
        <source>Flat, with diamonds; the easiest</source>
        <translation>Plan, à losanges&#x202f;; le plus facile</translation>
    </message>
    <message>
        <source>%1, a first look</source>
        <translation>%1, premier essai</translation>
    </message>
    <message>
        <source>%1, quick</source>
        <translation>%1, rapide</translation>
    </message>
    <message>
        <source>%1, usual</source>
        <translation>%1, normal</translation>
    </message>
    <message>
        <source>%1, fine</source>
        <translation>%1, fin</translation>
    </message>
    <message>
        <source>Venue</source>
        <translation>Lieu</translation>
    </message>
    <message>
        <source>Rehearse in a simulated venue</source>
        <translation>Répéter dans un lieu simulé</translation>
    </message>
    <message>
        <source>New venue by script</source>
        <translation>Nouveau lieu par script</translation>
    </message>
    <message>
        <source>New venue</source>
        <translation>Nouveau lieu</translation>
    </message>
    <message>
        <source>Say which screen shines, which programs show and photograph, and where the work is kept.</source>
        <translation>Indiquez l’écran qui éclaire, les programmes qui affichent et photographient, et où garder le travail.</translation>
    </message>
    <message>
        <source>Setting up</source>
        <translation>Préparation</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1, %2</translation>
    </message>
    <message>
        <source>simulated, %1</source>
        <translation>simulation, %1</translation>
    </message>
    <message>
        <source>by script, %1</source>
        <translation>par script, %1</translation>
    </message>
    <message>
        <source>%1 is open</source>
        <translation>%1 est ouvert</translation>
    </message>
    <message>
        <source>Enter opens the highlighted choice</source>
        <translation>Entrée ouvre le choix en surbrillance</translation>
    </message>
    <message>
        <source>Check camera</source>
        <translation>Vérifier la caméra</translation>
    </message>
    <message>
        <source>Start rehearsal</source>
        <translation>Lancer la répétition</translation>
    </message>
    <message>
        <source>Nothing was changed in that folder.</source>
        <translation>Rien n’a été modifié dans ce dossier.</translation>
    </message>
    <message>
        <source>Give the venue a name.</source>
        <translation>Donnez un nom au lieu.</translation>
    </message>
    <message>
        <source>A name cannot hold a slash.</source>
        <translation>Un nom ne peut pas contenir de barre oblique.</translation>
    </message>
    <message>
        <source>There is a folder of that name. Choose another name.</source>
        <translation>Un dossier porte déjà ce nom. Choisissez un autre nom.</translation>
    </message>
    <message>
        <source>Choose the screen that shines on the surface.</source>
        <translation>Choisissez l’écran qui éclaire la surface.</translation>
    </message>
    <message>
        <source>Free %1 or choose another folder.</source>
        <translation>Libérez %1 ou choisissez un autre dossier.</translation>
    </message>
    <message>
        <source>Confirm that the room is clear.</source>
        <translation>Confirmez que la salle est évacuée.</translation>
    </message>
    <message>
        <source>Nothing was measured yet.</source>
        <translation>Rien n’est encore mesuré.</translation>
    </message>
    <message>
        <source>Programs</source>
        <translation>Programmes</translation>
    </message>
    <message>
        <source>Any projector and any camera that a command can drive</source>
        <translation>Tout projecteur et toute caméra qu’une commande peut piloter</translation>
    </message>
    <message>
        <source>Photographs {exposure} seconds into the file {output}: float EXR, 16-bit PNG or TIFF</source>
        <translation>Prend une photo de {exposure} secondes dans le fichier {output}&#x202f;: EXR flottant, PNG ou TIFF 16 bits</translation>
    </message>
    <message>
        <source>Projector&apos;s pixels</source>
        <translation>Pixels du projecteur</translation>
    </message>
    <message>
        <source>Width</source>
        <translation>Largeur</translation>
    </message>
    <message>
        <source>Height</source>
        <translation>Hauteur</translation>
    </message>
    <message>
        <source>Rehearsal. Opened %1</source>
        <translation>Répétition. Ouvert le %1</translation>
    </message>
    <message>
        <source>Opened %1</source>
        <translation>Ouvert le %1</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Ouvrir</translation>
    </message>
    <message>
        <source>Open %1</source>
        <translation>Ouvrir %1</translation>
    </message>
    <message>
        <source>Open a venue</source>
        <translation>Ouvrir un lieu</translation>
    </message>
    <message>
        <source>Rehearse</source>
        <translation>Répéter</translation>
    </message>
    <message>
        <source>Learn every step in a simulated venue. No devices needed.</source>
        <translation>Apprenez chaque étape dans un lieu simulé. Aucun appareil requis.</translation>
    </message>
    <message>
        <source>Continue where you stopped, or change the content.</source>
        <translation>Reprenez où vous en étiez, ou changez le contenu.</translation>
    </message>
    <message>
        <source>Measure a surface with a projector and a camera at this computer.</source>
        <translation>Mesurez une surface avec un projecteur et une caméra branchés à cet ordinateur.</translation>
    </message>
    <message>
        <source>Projector and camera are driven by programs of yours.</source>
        <translation>Projecteur et caméra sont pilotés par vos propres programmes.</translation>
    </message>
    <message>
        <source>Recent</source>
        <translation>Récents</translation>
    </message>
    <message>
        <source>No venues yet</source>
        <translation>Aucun lieu pour l’instant</translation>
    </message>
    <message>
        <source>The venues that you measure are listed here, newest first.</source>
        <translation>Les lieux que vous mesurez apparaissent ici, les plus récents d’abord.</translation>
    </message>
    <message>
        <source>A first rehearsal takes a few minutes.</source>
        <translation>Une première répétition prend quelques minutes.</translation>
    </message>
    <message>
        <source>This venue</source>
        <translation>Ce lieu</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Nom</translation>
    </message>
    <message>
        <source>Name of the venue</source>
        <translation>Nom du lieu</translation>
    </message>
    <message>
        <source>Folder</source>
        <translation>Dossier</translation>
    </message>
    <message>
        <source>Folder that holds the venue</source>
        <translation>Dossier qui contient le lieu</translation>
    </message>
    <message>
        <source>Choose a folder</source>
        <translation>Choisir un dossier</translation>
    </message>
    <message>
        <source>Expected</source>
        <translation>À prévoir</translation>
    </message>
    <message>
        <source>Patterns</source>
        <translation>Motifs</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>Disque</translation>
    </message>
    <message>
        <source>about %1</source>
        <translation>environ %1</translation>
    </message>
    <message>
        <source>Simulated devices</source>
        <translation>Appareils simulés</translation>
    </message>
    <message>
        <source>Pixels of the simulated projector</source>
        <translation>Pixels du projecteur simulé</translation>
    </message>
    <message>
        <source>More pixels show finer detail and take longer. The first time, the light of the venue is traced; later it is remembered.</source>
        <translation>Plus de pixels montrent des détails plus fins et prennent plus de temps. La première fois, la lumière du lieu est tracée&#x202f;; ensuite, elle est réutilisée.</translation>
    </message>
    <message numerus="yes">
        <source>About %n pattern(s), %1</source>
        <translation>
            <numerusform>Environ %n motif, %1</numerusform>
            <numerusform>Environ %n motifs, %1</numerusform>
        </translation>
    </message>
    <message>
        <source>Shows the file {image} and ends as soon as the projector shines it</source>
        <translation>Affiche le fichier {image} et se termine dès que le projecteur l’émet</translation>
    </message>
    <message>
        <source>Relief, two projectors</source>
        <translation>Relief, deux projecteurs</translation>
    </message>
    <message>
        <source>Each shines into the other&apos;s shadows</source>
        <translation>Chacun éclaire les ombres de l’autre</translation>
    </message>
    <message>
        <source>The projector&apos;s screen</source>
        <translation>L’écran du projecteur</translation>
    </message>
    <message>
        <source>Say which screen the projector is now. What was measured stays.</source>
        <translation>Indiquez quel écran est maintenant le projecteur. Les mesures restent.</translation>
    </message>
    <message>
        <source>Nothing is measured again.</source>
        <translation>Rien n’est remesuré.</translation>
    </message>
    <message>
        <source>Use this screen</source>
        <translation>Utiliser cet écran</translation>
    </message>
    <message>
        <source>Change the screen</source>
        <translation>Changer d’écran</translation>
    </message>
    <message>
        <source>The projector&apos;s screen %1 is not there</source>
        <translation>L’écran %1 du projecteur est absent</translation>
    </message>
    <message>
        <source>Plug it in, or say which screen the projector is now.</source>
        <translation>Branchez-le, ou indiquez quel écran est maintenant le projecteur.</translation>
    </message>
    <message>
        <source>%1 is not the folder of a venue: it has no %2 in it.</source>
        <translation>%1 n’est pas le dossier d’un lieu&#x202f;: il ne contient pas %2.</translation>
    </message>
    <message numerus="yes">
        <source>There are %n venue(s) within it: open one of them.</source>
        <translation>
            <numerusform>Il contient %n lieu&#x202f;: ouvrez-le.</numerusform>
            <numerusform>Il contient %n lieux&#x202f;: ouvrez l’un d’eux.</numerusform>
        </translation>
    </message>
    <message>
        <source>Choose a venue&apos;s own folder. It has the venue&apos;s name.</source>
        <translation>Choisissez le dossier d’un lieu. Il porte le nom du lieu.</translation>
    </message>
    <message>
        <source>This folder is not a venue</source>
        <translation>Ce dossier n’est pas un lieu</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>Rien n’a été modifié.</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>Les appareils sont utilisés par %1.</translation>
    </message>
    <message>
        <source>Choose another screen.</source>
        <translation>Choisissez un autre écran.</translation>
    </message>
    <message>
        <source>Only your own screen is there. Plug the projector in, and extend the desktop to it.</source>
        <translation>Seul votre propre écran est présent. Branchez le projecteur et étendez-y le bureau.</translation>
    </message>
    <message>
        <source>Nothing is measured again</source>
        <translation>Rien n’est remesuré</translation>
    </message>
    <message>
        <source>Measured at</source>
        <translation>Mesuré sur</translation>
    </message>
    <message>
        <source>Used at</source>
        <translation>Utilisé sur</translation>
    </message>
    <message>
        <source>Pixels</source>
        <translation>Pixels</translation>
    </message>
    <message>
        <source>A screen is known again by its maker&apos;s names and serial number. Where it tells none, it is known by its connector: then a cable that is plugged in elsewhere has to be said here.</source>
        <translation>Un écran est reconnu à sa marque et à son numéro de série. S’il n’en donne pas, il l’est à son connecteur&#x202f;: un câble branché ailleurs doit alors être indiqué ici.</translation>
    </message>
    <message>
        <source>Is open</source>
        <translation>Est ouvert</translation>
    </message>
    <message>
        <source>Time, by camera</source>
        <translation>Durée, selon la caméra</translation>
    </message>
    <message>
        <source>Industrial cameras and video devices are fast, still cameras slow.</source>
        <translation>Les caméras industrielles et les périphériques vidéo sont rapides, les appareils photo lents.</translation>
    </message>
    <message>
        <source>%1 to %2</source>
        <translation>%1 à %2</translation>
    </message>
    <message>
        <source>%1 free</source>
        <translation>%1 libres</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 sur %2</translation>
    </message>
    <message>
        <source>Free the disk of what %1 does not need</source>
        <translation>Libérer le disque de ce dont %1 n’a pas besoin</translation>
    </message>
    <message>
        <source>Resume</source>
        <translation>Reprendre</translation>
    </message>
    <message>
        <source>Resume %1</source>
        <translation>Reprendre %1</translation>
    </message>
    <message>
        <source>Free space…</source>
        <translation>Libérer de l’espace…</translation>
    </message>
    <message>
        <source>Somebody bumps the camera</source>
        <translation>Quelqu’un heurte la caméra</translation>
    </message>
    <message>
        <source>A light is switched on</source>
        <translation>Une lumière est allumée</translation>
    </message>
    <message>
        <source>The camera&apos;s cable comes out</source>
        <translation>Le câble de la caméra se débranche</translation>
    </message>
    <message>
        <source>Surprises</source>
        <translation>Surprises</translation>
    </message>
    <message>
        <source>Each comes once while Acquire measures, at a moment that nobody knows. Practise what the wizard says, before it happens in front of a client.</source>
        <translation>Chacune survient une fois pendant la mesure d’Acquisition, à un moment que personne ne connaît. Exercez-vous à ce que dit l’assistant avant que cela n’arrive devant un client.</translation>
    </message>
    <message>
        <source>Measures how a surface changes what is projected on it, and corrects pictures and films until they look right there.</source>
        <translation>Mesure comment une surface change ce qu’on y projette et corrige images et films jusqu’à ce qu’ils y paraissent justes.</translation>
    </message>
    <message>
        <source>Easy. Measuring takes %1</source>
        <translation>Facile. Durée de la mesure : %1</translation>
    </message>
    <message>
        <source>Medium. Measuring takes %1</source>
        <translation>Moyen. Durée de la mesure : %1</translation>
    </message>
    <message>
        <source>Hard. Measuring takes %1</source>
        <translation>Difficile. Durée de la mesure : %1</translation>
    </message>
    <message>
        <source>Name of %1</source>
        <translation>Nom de %1</translation>
    </message>
    <message>
        <source>Projectors</source>
        <translation>Projecteurs</translation>
    </message>
    <message>
        <source>None chosen yet.</source>
        <translation>Aucun choisi pour l’instant.</translation>
    </message>
    <message>
        <source>Add a projector</source>
        <translation>Ajouter un projecteur</translation>
    </message>
    <message>
        <source>Projector %1</source>
        <translation>Projecteur %1</translation>
    </message>
    <message>
        <source>Remove projector %1</source>
        <translation>Retirer le projecteur %1</translation>
    </message>
    <message>
        <source>%1: choose its screen</source>
        <translation>%1&#x202f;: choisissez son écran</translation>
    </message>
    <message>
        <source>Cameras</source>
        <translation>Caméras</translation>
    </message>
    <message>
        <source>Camera %1</source>
        <translation>Caméra %1</translation>
    </message>
    <message>
        <source>Remove camera %1</source>
        <translation>Retirer la caméra %1</translation>
    </message>
    <message>
        <source>Add one from the list, or choose it at the next step.</source>
        <translation>Ajoutez-en une de la liste, ou choisissez-la à l’étape suivante.</translation>
    </message>
    <message>
        <source>Content is placed in the view of the first one.</source>
        <translation>Le contenu est placé dans la vue de la première.</translation>
    </message>
    <message>
        <source>Add those that look at the surface.</source>
        <translation>Ajoutez celles qui regardent la surface.</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Retirer</translation>
    </message>
    <message>
        <source>Remove %1</source>
        <translation>Retirer %1</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Ajouter</translation>
    </message>
    <message>
        <source>Add %1</source>
        <translation>Ajouter %1</translation>
    </message>
    <message>
        <source>Say which screens shine on the surface, which cameras watch, and where the work is kept.</source>
        <translation>Dites quels écrans éclairent la surface, quelles caméras regardent et où garder le travail.</translation>
    </message>
    <message numerus="yes">
        <source>%n projector(s)</source>
        <translation>
            <numerusform>%n projecteur</numerusform>
            <numerusform>%n projecteurs</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n camera(s)</source>
        <translation>
            <numerusform>%n caméra</numerusform>
            <numerusform>%n caméras</numerusform>
        </translation>
    </message>
    <message>
        <source>This screen is projector %1 already.</source>
        <translation>Cet écran est déjà le projecteur %1.</translation>
    </message>
    <message>
        <source>That screen is projector %1. Choose another screen.</source>
        <translation>Cet écran est le projecteur %1. Choisissez-en un autre.</translation>
    </message>
    <message>
        <source>Dome, four projectors</source>
        <translation>Dôme, quatre projecteurs</translation>
    </message>
    <message>
        <source>They overlap; two cameras watch</source>
        <translation>Ils se recouvrent&#x202f;; deux caméras regardent</translation>
    </message>
    <message>
        <source>Bust from three sides</source>
        <translation>Buste vu de trois côtés</translation>
    </message>
    <message>
        <source>Two projectors, three cameras: for an audience that walks</source>
        <translation>Deux projecteurs, trois caméras&#x202f;: pour un public qui marche</translation>
    </message>
    <message>
        <source>Projector whose screen is changed</source>
        <translation>Projecteur dont l’écran est changé</translation>
    </message>
    <message>
        <source>Network address (PJLink)</source>
        <translation>Adresse réseau (PJLink)</translation>
    </message>
    <message>
        <source>Password, if it has one</source>
        <translation>Mot de passe, s’il en a un</translation>
    </message>
    <message>
        <source>On the network</source>
        <translation>Sur le réseau</translation>
    </message>
    <message>
        <source>Optional: a projector with a network address is switched on, and its lamp waited for until it is steady, before anything is measured.</source>
        <translation>Facultatif : un projecteur qui a une adresse réseau est allumé, et l’on attend que sa lampe soit stable, avant toute mesure.</translation>
    </message>
    <message>
        <source>Find projectors</source>
        <translation>Rechercher des projecteurs</translation>
    </message>
    <message>
        <source>Looking for projectors…</source>
        <translation>Recherche de projecteurs…</translation>
    </message>
    <message>
        <source>None answers. Only PJLink class 2 can be searched: type the address.</source>
        <translation>Aucun ne répond. Seul PJLink classe 2 peut être recherché : tapez l’adresse.</translation>
    </message>
    <message numerus="yes">
        <source>%n answer. Choose from the list of each.</source>
        <translation>
            <numerusform>%n répond. Choisissez-le dans la liste.</numerusform>
            <numerusform>%n répondent. Choisissez dans la liste de chacun.</numerusform>
        </translation>
    </message>
    <message>
        <source>Move to the trash</source>
        <translation>Mettre à la corbeille</translation>
    </message>
    <message>
        <source>Keep it</source>
        <translation>Le garder</translation>
    </message>
    <message>
        <source>Try again then.</source>
        <translation>Réessayez ensuite.</translation>
    </message>
    <message>
        <source>Nothing of the venue is lost.</source>
        <translation>Rien du lieu n’est perdu.</translation>
    </message>
    <message>
        <source>Remove a venue</source>
        <translation>Supprimer un lieu</translation>
    </message>
    <message>
        <source>“%1” goes to the trash, with its photographs, results and playlist.</source>
        <translation>«&#xa0;%1&#xa0;» va à la corbeille, avec ses photos, ses résultats et sa liste de lecture.</translation>
    </message>
    <message>
        <source>Until the trash is emptied it can be taken back from there.</source>
        <translation>Jusqu’à ce que la corbeille soit vidée, il peut en être repris.</translation>
    </message>
    <message>
        <source>More</source>
        <translation>Plus</translation>
    </message>
    <message>
        <source>More for %1</source>
        <translation>Plus pour %1</translation>
    </message>
    <message>
        <source>Rename…</source>
        <translation>Renommer…</translation>
    </message>
    <message>
        <source>Remove…</source>
        <translation>Supprimer…</translation>
    </message>
    <message>
        <source>Setting up another</source>
        <translation>Un autre est en préparation</translation>
    </message>
    <message>
        <source>Allow them</source>
        <translation>Les autoriser</translation>
    </message>
    <message>
        <source>Open without them</source>
        <translation>Ouvrir sans eux</translation>
    </message>
    <message>
        <source>Programs of a venue</source>
        <translation>Programmes d’un lieu</translation>
    </message>
    <message>
        <source>“%1” names programs of its own as projector or camera. They would run on this computer as you, and nobody here has agreed to that yet:</source>
        <translation>« %1 » désigne des programmes à lui comme projecteur ou caméra. Ils s’exécuteraient sur cet ordinateur en votre nom, et personne ici n’y a encore consenti :</translation>
    </message>
    <message>
        <source>None of them was run. Without them everything that was measured can be looked at and shown.</source>
        <translation>Aucun n’a été lancé. Sans eux, tout ce qui a été mesuré peut être regardé et montré.</translation>
    </message>
    <message>
        <source>Allow them if you know what they do, or know who made this venue.</source>
        <translation>Autorisez-les si vous savez ce qu’ils font ou qui a fait ce lieu.</translation>
    </message>
    <message>
        <source>No other screen is plugged in.</source>
        <translation>Aucun autre écran n’est branché.</translation>
    </message>
    <message>
        <source>The same steps, with a simulated projector and camera. Nothing is projected unless you choose a screen.</source>
        <translation>Les mêmes étapes, avec un projecteur et une caméra simulés. Rien n’est projeté, sauf si vous choisissez un écran.</translation>
    </message>
    <message>
        <source>Programs of this venue</source>
        <translation>Programmes de ce lieu</translation>
    </message>
    <message>
        <source>Say which commands drive these devices from now on. What was measured stays.</source>
        <translation>Indiquez quelles commandes pilotent désormais ces appareils. Les mesures restent.</translation>
    </message>
    <message>
        <source>Use these commands</source>
        <translation>Utiliser ces commandes</translation>
    </message>
    <message>
        <source>Change the programs</source>
        <translation>Changer les programmes</translation>
    </message>
    <message>
        <source>Type another command.</source>
        <translation>Saisissez une autre commande.</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Caméra</translation>
    </message>
    <message>
        <source>A program that fails ends with another status than 0. What it says last is told with it. Try it in a terminal, with a file in place of {image} or {output} and seconds in place of {exposure}.</source>
        <translation>Un programme qui échoue se termine avec un état autre que 0, et son dernier message est indiqué. Essayez-le dans un terminal, avec un fichier à la place de {image} ou {output} et des secondes à la place de {exposure}.</translation>
    </message>
    <message>
        <source>Relucent shows the pictures on it, unless a program of yours does.</source>
        <translation>Relucent y affiche les images, sauf si un de vos programmes le fait.</translation>
    </message>
    <message>
        <source>Not needed with a screen. %1</source>
        <translation>Inutile avec un écran. %1</translation>
    </message>
    <message>
        <source>Choose the projector&apos;s screen, or type the command that shows.</source>
        <translation>Choisissez l’écran du projecteur, ou saisissez la commande qui affiche.</translation>
    </message>
    <message>
        <source>%1, %2, unplugged</source>
        <translation>%1, %2, débranché</translation>
    </message>
    <message>
        <source>As many as the chosen screen has.</source>
        <translation>Autant que l’écran choisi en a.</translation>
    </message>
    <message>
        <source>Continue</source>
        <translation>Continuer</translation>
    </message>
    <message>
        <source>A show plays on %1</source>
        <translation>Une diffusion est en cours sur %1</translation>
    </message>
    <message>
        <source>Another program shows it. End it before anything is measured there: Camera has the button.</source>
        <translation>Un autre programme l’affiche. Arrêtez-la avant d’y mesurer&#xa0;: le bouton est sous Caméra.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VenueTidy</name>
    <message>
        <source>Try again then.</source>
        <translation>Réessayez ensuite.</translation>
    </message>
    <message>
        <source>%1 is at work. Space can be freed when it has ended.</source>
        <translation>%1 est en cours. L’espace pourra être libéré ensuite.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ViewerPlan</name>
    <message>
        <source>Plan of the cameras and of the viewer, seen from above</source>
        <translation>Plan des caméras et du spectateur, vu d’en haut</translation>
    </message>
    <message>
        <source>Camera %1</source>
        <translation>Caméra %1</translation>
    </message>
    <message>
        <source>Viewer</source>
        <translation>Spectateur</translation>
    </message>
    <message>
        <source>%1: %2 m to the left, %3 m from the surface</source>
        <translation>%1&#x202f;: %2 m à gauche, à %3 m de la surface</translation>
    </message>
    <message>
        <source>%1: %2 m to the right, %3 m from the surface</source>
        <translation>%1&#x202f;: %2 m à droite, à %3 m de la surface</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VtkView</name>
    <message>
        <source>This view needs OpenGL 3.2, and this computer draws without it. Everything else works: pictures and maps are shown without depth.</source>
        <translation>Cette vue demande OpenGL 3.2, et cet ordinateur affiche sans lui. Tout le reste fonctionne&#x202f;: images et cartes sont affichées sans relief.</translation>
    </message>
    <message>
        <source>For this view, install the graphics card&apos;s driver and start Relucent again.</source>
        <translation>Pour cette vue, installez le pilote de la carte graphique et redémarrez Relucent.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Wizard</name>
    <message>
        <source>Not applied yet</source>
        <translation>Pas encore appliqué</translation>
    </message>
</context>
<context>
    <name>repair.camera-moved</name>
    <message>
        <source>the view of camera {} has moved by {} and {} pixels and turned by {} degrees</source>
        <translation>la vue de la caméra {} s’est déplacée de {} et {} pixels et a tourné de {} degrés</translation>
    </message>
</context>
<context>
    <name>repair.light-changed</name>
    <message>
        <source>projector {} gives {} % of the red, {} % of the green and {} % of the blue light that it gave</source>
        <translation>le projecteur {} donne {} % de la lumière rouge, {} % de la verte et {} % de la bleue qu’il donnait</translation>
    </message>
</context>
<context>
    <name>repair.light-elsewhere</name>
    <message>
        <source>in {} % of the cameras&apos; pixels light arrives otherwise than it did</source>
        <translation>dans {} % des pixels des caméras, la lumière arrive autrement qu’avant</translation>
    </message>
</context>
<context>
    <name>repair.picture-moved</name>
    <message>
        <source>the projected picture has moved by {} and {} pixels as camera {} sees it</source>
        <translation>l’image projetée s’est déplacée de {} et {} pixels, vue par la caméra {}</translation>
    </message>
</context>
<context>
    <name>repair.room-brighter</name>
    <message>
        <source>the room is brighter by {} % of the projectors&apos; full light</source>
        <translation>la salle est plus claire de {} % de la pleine lumière des projecteurs</translation>
    </message>
</context>
<context>
    <name>repair.room-darker</name>
    <message>
        <source>the room is darker by {} % of the projectors&apos; full light</source>
        <translation>la salle est plus sombre de {} % de la pleine lumière des projecteurs</translation>
    </message>
</context>
<context>
    <name>repair.surface-changed</name>
    <message>
        <source>{} % of what the cameras see is brighter, darker or of another colour than it was</source>
        <translation>{} % de ce que voient les caméras est plus clair, plus sombre ou d’une autre couleur qu’avant</translation>
    </message>
</context>
<context>
    <name>report.cannot-write</name>
    <message>
        <source>the report cannot be written</source>
        <translation>le rapport ne peut pas être écrit</translation>
    </message>
</context>
<context>
    <name>report.free-some-space</name>
    <message>
        <source>free some space</source>
        <translation>libérez de l’espace</translation>
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
        <translation>{}&#x202f;: {}</translation>
    </message>
</context>
<context>
    <name>sentence.with-advice</name>
    <message>
        <source>{}; {}</source>
        <translation>{}&#x202f;; {}</translation>
    </message>
</context>
<context>
    <name>session.cannot-end-show</name>
    <message>
        <source>the other program may not be ended from here</source>
        <translation>l’autre programme ne peut pas être arrêté d’ici</translation>
    </message>
</context>
<context>
    <name>session.close-other-window</name>
    <message>
        <source>go on there, or close it there first</source>
        <translation>continuez là-bas, ou fermez-le d’abord là-bas</translation>
    </message>
</context>
<context>
    <name>session.end-show-itself</name>
    <message>
        <source>hold Esc on the projector&apos;s picture for two seconds</source>
        <translation>maintenez Échap deux secondes sur l’image du projecteur</translation>
    </message>
</context>
<context>
    <name>session.open-in-another-window</name>
    <message>
        <source>this venue is open in another window of Relucent</source>
        <translation>ce lieu est ouvert dans une autre fenêtre de Relucent</translation>
    </message>
</context>
<context>
    <name>sets.choose-name</name>
    <message>
        <source>choose another name, as day or school class</source>
        <translation>choisissez un autre nom, comme jour ou classe</translation>
    </message>
</context>
<context>
    <name>sets.choose-one</name>
    <message>
        <source>choose one of {}</source>
        <translation>choisissez parmi {}</translation>
    </message>
</context>
<context>
    <name>sets.damaged</name>
    <message>
        <source>the sets of this calibration cannot be read</source>
        <translation>les variantes de ce calibrage sont illisibles</translation>
    </message>
</context>
<context>
    <name>sets.in-use</name>
    <message>
        <source>the set &apos;{}&apos; is in use</source>
        <translation>la variante «&#xa0;{}&#xa0;» est utilisée</translation>
    </message>
</context>
<context>
    <name>sets.name-empty</name>
    <message>
        <source>a set needs a name</source>
        <translation>une variante doit avoir un nom</translation>
    </message>
</context>
<context>
    <name>sets.name-odd</name>
    <message>
        <source>the name of a set is plain text that neither begins nor ends with a space</source>
        <translation>le nom d’une variante est un texte simple qui ne commence ni ne finit par une espace</translation>
    </message>
</context>
<context>
    <name>sets.name-taken</name>
    <message>
        <source>there is a set &apos;{}&apos; already</source>
        <translation>il existe déjà une variante «&#xa0;{}&#xa0;»</translation>
    </message>
</context>
<context>
    <name>sets.name-too-long</name>
    <message>
        <source>the name of a set has at most {} bytes</source>
        <translation>le nom d’une variante a au plus {} octets</translation>
    </message>
</context>
<context>
    <name>sets.of-newer-version</name>
    <message>
        <source>a newer Relucent wrote the sets of this calibration</source>
        <translation>un Relucent plus récent a écrit les variantes de ce calibrage</translation>
    </message>
</context>
<context>
    <name>sets.remove-section</name>
    <message>
        <source>take &quot;sets&quot; out of the settings in {}, or copy the calibration again from where it was made</source>
        <translation>retirez «&#xa0;sets&#xa0;» des réglages dans {}, ou copiez de nouveau le calibrage depuis l’endroit où il a été fait</translation>
    </message>
</context>
<context>
    <name>sets.save-first</name>
    <message>
        <source>this calibration has no sets yet: save one first</source>
        <translation>ce calibrage n’a pas encore de variantes&#xa0;: enregistrez-en d’abord une</translation>
    </message>
</context>
<context>
    <name>sets.unknown</name>
    <message>
        <source>there is no set &apos;{}&apos;</source>
        <translation>il n’y a pas de variante «&#xa0;{}&#xa0;»</translation>
    </message>
</context>
<context>
    <name>sets.use-another-first</name>
    <message>
        <source>use another one first</source>
        <translation>utilisez-en d’abord une autre</translation>
    </message>
</context>
<context>
    <name>show.allow-commands</name>
    <message>
        <source>look at what it does, then open the venue in the wizard and allow its programs</source>
        <translation>regardez ce qu’il fait, puis ouvrez le lieu dans l’assistant et autorisez ses programmes</translation>
    </message>
</context>
<context>
    <name>show.cannot-enable-service</name>
    <message>
        <source>the service cannot be switched on ({})</source>
        <translation>le service ne peut pas être activé ({})</translation>
    </message>
</context>
<context>
    <name>show.cannot-remove-entry</name>
    <message>
        <source>it cannot be removed ({})</source>
        <translation>le fichier ne peut pas être retiré ({})</translation>
    </message>
</context>
<context>
    <name>show.cannot-write-log</name>
    <message>
        <source>the log cannot be written ({})</source>
        <translation>le journal ne peut pas être écrit ({})</translation>
    </message>
</context>
<context>
    <name>show.check-folder-permissions</name>
    <message>
        <source>check the folder&apos;s permissions</source>
        <translation>vérifiez les droits d’accès du dossier</translation>
    </message>
</context>
<context>
    <name>show.choose-another-log-folder</name>
    <message>
        <source>choose another folder with --log</source>
        <translation>choisissez un autre dossier avec --log</translation>
    </message>
</context>
<context>
    <name>show.engine-lost-device</name>
    <message>
        <source>the engine lost its graphics card</source>
        <translation>le moteur de rendu a perdu son périphérique</translation>
    </message>
</context>
<context>
    <name>show.no-camera</name>
    <message>
        <source>this show has no camera: its calibration names none</source>
        <translation>ce spectacle n’a pas de caméra : sa calibration n’en nomme aucune</translation>
    </message>
</context>
<context>
    <name>show.no-xwayland</name>
    <message>
        <source>in a Wayland session, take QT_QPA_PLATFORM=xcb out of the environment; else take away the desktop&apos;s rules for windows of Relucent, then try again</source>
        <translation>dans une session Wayland, retirez QT_QPA_PLATFORM=xcb de l’environnement ; sinon, supprimez les règles du bureau pour les fenêtres de Relucent, puis réessayez</translation>
    </message>
</context>
<context>
    <name>show.projector-by-command</name>
    <message>
        <source>this calibration shows pictures by a command of its own, which does not know of the show: stop the show and use relucent-cli verify and perfect</source>
        <translation>cette calibration affiche les images par une commande à elle, qui ne sait rien du spectacle : arrêtez le spectacle et utilisez relucent-cli verify et perfect</translation>
    </message>
</context>
<context>
    <name>show.restore-resolution</name>
    <message>
        <source>set its resolution back in the desktop&apos;s settings, then try again</source>
        <translation>rétablissez sa définition dans les réglages du bureau, puis réessayez</translation>
    </message>
</context>
<context>
    <name>show.screen-asleep</name>
    <message>
        <source>the projector&apos;s screen is asleep and does not wake</source>
        <translation>l’écran du projecteur est en veille et ne se réveille pas</translation>
    </message>
</context>
<context>
    <name>show.screen-size-changed</name>
    <message>
        <source>the projector&apos;s screen has {} pixels now and {} were calibrated</source>
        <translation>l’écran du projecteur a maintenant {} pixels alors que {} ont été calibrés</translation>
    </message>
</context>
<context>
    <name>show.start-show-again</name>
    <message>
        <source>start the show again</source>
        <translation>relancez la diffusion</translation>
    </message>
</context>
<context>
    <name>show.switch-off-power-saving</name>
    <message>
        <source>switch off its power saving and the screen saver in the desktop&apos;s settings, then try again</source>
        <translation>désactivez sa mise en veille et l’économiseur d’écran dans les réglages du bureau, puis réessayez</translation>
    </message>
</context>
<context>
    <name>show.window-elsewhere</name>
    <message>
        <source>the desktop puts the projector&apos;s picture on the screen {} instead</source>
        <translation>le bureau place l’image du projecteur sur l’écran {} à la place</translation>
    </message>
</context>
<context>
    <name>stage.adapting-light-transport</name>
    <message>
        <source>fitting the light transport to what is seen</source>
        <translation>adaptation du transport de lumière à ce qui est vu</translation>
    </message>
</context>
<context>
    <name>stage.algorithm-1</name>
    <message>
        <source>Algorithm 1</source>
        <translation>Algorithme 1</translation>
    </message>
</context>
<context>
    <name>stage.assembling-light-transport</name>
    <message>
        <source>Assembling the light transport</source>
        <translation>Assemblage du transport lumineux</translation>
    </message>
</context>
<context>
    <name>stage.awaiting-steady-light</name>
    <message>
        <source>Waiting until the lamps are steady</source>
        <translation>Attente de la stabilité des lampes</translation>
    </message>
</context>
<context>
    <name>stage.black-and-full-light</name>
    <message>
        <source>black and full light</source>
        <translation>noir et pleine lumière</translation>
    </message>
</context>
<context>
    <name>stage.calibrating</name>
    <message>
        <source>Calibrating</source>
        <translation>Calibration</translation>
    </message>
</context>
<context>
    <name>stage.capped-clusters</name>
    <message>
        <source>Clusters held to a size</source>
        <translation>Groupes de taille limitée</translation>
    </message>
</context>
<context>
    <name>stage.capping-clusters</name>
    <message>
        <source>Holding clusters to a size</source>
        <translation>Limitation de la taille des groupes</translation>
    </message>
</context>
<context>
    <name>stage.checking-additivity</name>
    <message>
        <source>Checking that the colours of {} add up</source>
        <translation>Vérification de l’additivité des couleurs&#x202f;: {}</translation>
    </message>
</context>
<context>
    <name>stage.checking-drift</name>
    <message>
        <source>Checking for drift</source>
        <translation>Recherche d’une dérive</translation>
    </message>
</context>
<context>
    <name>stage.checking-projector-and-camera</name>
    <message>
        <source>Checking projector and camera</source>
        <translation>Vérification du projecteur et de la caméra</translation>
    </message>
</context>
<context>
    <name>stage.choosing-camera-pixels</name>
    <message>
        <source>Finding the camera pixels that are needed</source>
        <translation>Recherche des pixels de caméra nécessaires</translation>
    </message>
</context>
<context>
    <name>stage.clustering-light-transport</name>
    <message>
        <source>Clustering the light transport</source>
        <translation>Regroupement du transport lumineux</translation>
    </message>
</context>
<context>
    <name>stage.comparing-cluster-inverses-in-venue</name>
    <message>
        <source>Comparing the inverses of clusters in {}</source>
        <translation>Comparaison des inverses des groupes&#x202f;: {}</translation>
    </message>
</context>
<context>
    <name>stage.comparing-methods</name>
    <message>
        <source>Comparing the methods</source>
        <translation>Comparaison des méthodes</translation>
    </message>
</context>
<context>
    <name>stage.comparing-methods-in-venue</name>
    <message>
        <source>Comparing the methods in {}</source>
        <translation>Comparaison des méthodes&#x202f;: {}</translation>
    </message>
</context>
<context>
    <name>stage.comparing-views</name>
    <message>
        <source>Comparing what the views want</source>
        <translation>Comparaison de ce que demande chaque vue</translation>
    </message>
</context>
<context>
    <name>stage.compensating</name>
    <message>
        <source>Compensating</source>
        <translation>Correction</translation>
    </message>
</context>
<context>
    <name>stage.concluding-measurement</name>
    <message>
        <source>what may be expected of the result</source>
        <translation>ce qu’on peut attendre du résultat</translation>
    </message>
</context>
<context>
    <name>stage.decoding</name>
    <message>
        <source>Decoding</source>
        <translation>Décodage</translation>
    </message>
</context>
<context>
    <name>stage.dense-patterns</name>
    <message>
        <source>patterns in blocks of {} px</source>
        <translation>motifs en blocs de {} px</translation>
    </message>
</context>
<context>
    <name>stage.estimating-light-transport</name>
    <message>
        <source>Estimating the light transport</source>
        <translation>Estimation du transport lumineux</translation>
    </message>
</context>
<context>
    <name>stage.estimating-response-and-colours</name>
    <message>
        <source>Estimating response and colours</source>
        <translation>Estimation de la réponse et des couleurs</translation>
    </message>
</context>
<context>
    <name>stage.evaluating</name>
    <message>
        <source>Evaluating</source>
        <translation>Évaluation</translation>
    </message>
</context>
<context>
    <name>stage.finding-defocus</name>
    <message>
        <source>Finding the defocus</source>
        <translation>Recherche du flou</translation>
    </message>
</context>
<context>
    <name>stage.finding-exposure</name>
    <message>
        <source>Finding the exposure</source>
        <translation>Recherche du temps de pose</translation>
    </message>
</context>
<context>
    <name>stage.finding-exposures</name>
    <message>
        <source>Finding the exposures</source>
        <translation>Recherche des temps de pose</translation>
    </message>
</context>
<context>
    <name>stage.finding-projector-picture</name>
    <message>
        <source>Looking for the projector&apos;s picture</source>
        <translation>Recherche de l’image du projecteur</translation>
    </message>
</context>
<context>
    <name>stage.finding-shadows</name>
    <message>
        <source>Looking for shadows</source>
        <translation>Recherche d’ombres</translation>
    </message>
</context>
<context>
    <name>stage.finding-uncorrectable-pixels</name>
    <message>
        <source>Looking for what cannot be corrected</source>
        <translation>Recherche de ce qui ne peut être corrigé</translation>
    </message>
</context>
<context>
    <name>stage.finding-what-is-seen</name>
    <message>
        <source>Finding which part of the picture is seen</source>
        <translation>Recherche de la part visible de l’image</translation>
    </message>
</context>
<context>
    <name>stage.fitting-light-spread</name>
    <message>
        <source>Fitting the spread of light</source>
        <translation>Ajustement de l’étalement de la lumière</translation>
    </message>
</context>
<context>
    <name>stage.forming-patches</name>
    <message>
        <source>Forming patches</source>
        <translation>Formation des zones</translation>
    </message>
</context>
<context>
    <name>stage.inverting-clusters</name>
    <message>
        <source>Inverting the clusters</source>
        <translation>Inversion des groupes</translation>
    </message>
</context>
<context>
    <name>stage.inverting-light-transport</name>
    <message>
        <source>Inverting the light transport</source>
        <translation>Inversion du transport lumineux</translation>
    </message>
</context>
<context>
    <name>stage.inverting-venue</name>
    <message>
        <source>Inverting {}</source>
        <translation>Inversion&#x202f;: {}</translation>
    </message>
</context>
<context>
    <name>stage.joining-clusters</name>
    <message>
        <source>Joining clusters</source>
        <translation>Réunion des groupes</translation>
    </message>
</context>
<context>
    <name>stage.judging-light</name>
    <message>
        <source>Judging the light</source>
        <translation>Évaluation de la lumière</translation>
    </message>
</context>
<context>
    <name>stage.level-of-tree</name>
    <message numerus="yes">
        <source>level {} of {}: {} patterns</source>
        <comment>level {} of {}: {} pattern</comment>
        <translation>
            <numerusform>niveau {} sur {} : {} motif</numerusform>
            <numerusform>niveau {} sur {} : {} motifs</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>stage.light-transport</name>
    <message>
        <source>light transport</source>
        <translation>transport lumineux</translation>
    </message>
</context>
<context>
    <name>stage.linearizing</name>
    <message>
        <source>Linearizing</source>
        <translation>Linéarisation</translation>
    </message>
</context>
<context>
    <name>stage.looking-for-changes</name>
    <message>
        <source>Looking for what has changed</source>
        <translation>Recherche de ce qui a changé</translation>
    </message>
</context>
<context>
    <name>stage.looking-for-hot-pixels</name>
    <message>
        <source>Looking for hot pixels of the camera</source>
        <translation>Recherche des pixels chauds de la caméra</translation>
    </message>
</context>
<context>
    <name>stage.looking-through-camera</name>
    <message>
        <source>Looking through the camera</source>
        <translation>Vue caméra en direct</translation>
    </message>
</context>
<context>
    <name>stage.measuring-brightness-curves</name>
    <message>
        <source>Measuring the brightness curves of {}</source>
        <translation>Mesure des courbes de luminosité&#x202f;: {}</translation>
    </message>
</context>
<context>
    <name>stage.measuring-camera</name>
    <message>
        <source>Measuring the camera</source>
        <translation>Mesure de la caméra</translation>
    </message>
</context>
<context>
    <name>stage.measuring-latency</name>
    <message>
        <source>Measuring the latency</source>
        <translation>Mesure de la latence</translation>
    </message>
</context>
<context>
    <name>stage.measuring-light-transport</name>
    <message>
        <source>Measuring the light transport</source>
        <translation>Mesure du transport lumineux</translation>
    </message>
</context>
<context>
    <name>stage.measuring-response</name>
    <message>
        <source>Measuring the response</source>
        <translation>Mesure de la réponse</translation>
    </message>
</context>
<context>
    <name>stage.measuring-venue</name>
    <message>
        <source>Measuring {}</source>
        <translation>Mesure&#x202f;: {}</translation>
    </message>
</context>
<context>
    <name>stage.measuring-what-changed</name>
    <message>
        <source>measuring what is no longer as it was</source>
        <translation>mesure de ce qui n’est plus comme avant</translation>
    </message>
</context>
<context>
    <name>stage.opening-devices</name>
    <message>
        <source>Opening the devices</source>
        <translation>Ouverture des appareils</translation>
    </message>
</context>
<context>
    <name>stage.perfecting</name>
    <message>
        <source>Correcting the picture by photographs of itself</source>
        <translation>Correction de l’image par des photos d’elle-même</translation>
    </message>
</context>
<context>
    <name>stage.photographing-projections</name>
    <message>
        <source>Photographing the projections</source>
        <translation>Photographie des projections</translation>
    </message>
</context>
<context>
    <name>stage.photographing-test-patterns</name>
    <message>
        <source>Photographing test patterns</source>
        <translation>Photographie des motifs d’essai</translation>
    </message>
</context>
<context>
    <name>stage.predicting-held-out-patterns</name>
    <message>
        <source>Predicting held-out patterns</source>
        <translation>Prévision des motifs réservés</translation>
    </message>
</context>
<context>
    <name>stage.preparing-benchmarks</name>
    <message>
        <source>Preparing the benchmarks</source>
        <translation>Préparation des tests de vitesse</translation>
    </message>
</context>
<context>
    <name>stage.preparing-devices</name>
    <message>
        <source>Preparing the devices</source>
        <translation>Préparation des appareils</translation>
    </message>
</context>
<context>
    <name>stage.preparing-engine</name>
    <message>
        <source>Preparing the engine</source>
        <translation>Préparation du moteur</translation>
    </message>
</context>
<context>
    <name>stage.preparing-preview</name>
    <message>
        <source>Preparing the preview</source>
        <translation>Préparation de l’aperçu</translation>
    </message>
</context>
<context>
    <name>stage.preparing-venue</name>
    <message>
        <source>Preparing the venue</source>
        <translation>Préparation du lieu</translation>
    </message>
</context>
<context>
    <name>stage.reading-calibration</name>
    <message>
        <source>Reading the calibration</source>
        <translation>Lecture de la calibration</translation>
    </message>
</context>
<context>
    <name>stage.reading-light-transport</name>
    <message>
        <source>Reading the light transport</source>
        <translation>Lecture du transport lumineux</translation>
    </message>
</context>
<context>
    <name>stage.reading-patterns</name>
    <message>
        <source>Reading the patterns</source>
        <translation>Lecture des motifs</translation>
    </message>
</context>
<context>
    <name>stage.reading-photographs</name>
    <message>
        <source>Reading the photographs</source>
        <translation>Lecture des photos</translation>
    </message>
</context>
<context>
    <name>stage.reading-pictures</name>
    <message>
        <source>Reading the pictures</source>
        <translation>Lecture des images</translation>
    </message>
</context>
<context>
    <name>stage.reading-response</name>
    <message>
        <source>Reading the response</source>
        <translation>Lecture de la réponse</translation>
    </message>
</context>
<context>
    <name>stage.reading-venue</name>
    <message>
        <source>Reading {}</source>
        <translation>Lecture&#x202f;: {}</translation>
    </message>
</context>
<context>
    <name>stage.remeasuring-flagged-pixels</name>
    <message numerus="yes">
        <source>measuring {} flagged pixels again</source>
        <comment>measuring {} flagged pixel again</comment>
        <translation>
            <numerusform>nouvelle mesure de {} pixel signalé</numerusform>
            <numerusform>nouvelle mesure de {} pixels signalés</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>stage.scaling-to-flood-image</name>
    <message>
        <source>Scaling to the flood image</source>
        <translation>Mise à l’échelle sur la pleine lumière</translation>
    </message>
</context>
<context>
    <name>stage.separating-direct-and-indirect-light</name>
    <message>
        <source>Separating direct and indirect light</source>
        <translation>Séparation des lumières directe et indirecte</translation>
    </message>
</context>
<context>
    <name>stage.sharing-leaves</name>
    <message>
        <source>light that neighbouring pixels share</source>
        <translation>lumière que partagent les pixels voisins</translation>
    </message>
</context>
<context>
    <name>stage.sharpening</name>
    <message>
        <source>Sharpening</source>
        <translation>Accentuation</translation>
    </message>
</context>
<context>
    <name>stage.solving</name>
    <message>
        <source>Solving</source>
        <translation>Résolution</translation>
    </message>
</context>
<context>
    <name>stage.storing-light-transport</name>
    <message>
        <source>storing the light transport</source>
        <translation>enregistrement du transport lumineux</translation>
    </message>
</context>
<context>
    <name>stage.switching-projectors-on</name>
    <message>
        <source>Switching the projectors on</source>
        <translation>Allumage des projecteurs</translation>
    </message>
</context>
<context>
    <name>stage.taking-verification-photograph</name>
    <message>
        <source>Taking the verification photograph</source>
        <translation>Prise de la photo de contrôle</translation>
    </message>
</context>
<context>
    <name>stage.test-patterns</name>
    <message>
        <source>test patterns</source>
        <translation>motifs d’essai</translation>
    </message>
</context>
<context>
    <name>stage.timing-engine</name>
    <message>
        <source>Timing the engine</source>
        <translation>Chronométrage du moteur</translation>
    </message>
</context>
<context>
    <name>stage.tracing-simulated-venue</name>
    <message>
        <source>tracing the simulated venue</source>
        <translation>tracé de la lumière du lieu simulé</translation>
    </message>
</context>
<context>
    <name>stage.windows</name>
    <message>
        <source>Computing the windows of the inverse</source>
        <translation>Fenêtres</translation>
    </message>
</context>
<context>
    <name>stage.working-out-finest-blocks</name>
    <message>
        <source>working out the finest blocks</source>
        <translation>calcul des blocs les plus fins</translation>
    </message>
</context>
<context>
    <name>stage.writing</name>
    <message>
        <source>Writing</source>
        <translation>Écriture</translation>
    </message>
</context>
<context>
    <name>stage.writing-out-light-transport</name>
    <message>
        <source>Writing out the light transport</source>
        <translation>Écriture du transport lumineux</translation>
    </message>
</context>
<context>
    <name>stage.writing-report</name>
    <message>
        <source>Writing the report</source>
        <translation>Écriture du rapport</translation>
    </message>
</context>
<context>
    <name>stage.writing-results</name>
    <message>
        <source>Writing the results</source>
        <translation>Écriture des résultats</translation>
    </message>
</context>
<context>
    <name>stream.address-incomplete</name>
    <message>
        <source>in a stream&apos;s address the host or its port is missing or wrong</source>
        <translation>dans l’adresse du flux, l’hôte ou son port manque ou est faux</translation>
    </message>
</context>
<context>
    <name>stream.check-host</name>
    <message>
        <source>check the name in the address, or write the number</source>
        <translation>vérifiez le nom dans l’adresse, ou écrivez le numéro</translation>
    </message>
</context>
<context>
    <name>stream.check-network</name>
    <message>
        <source>check the network and the address</source>
        <translation>vérifiez le réseau et l’adresse</translation>
    </message>
</context>
<context>
    <name>stream.check-path</name>
    <message>
        <source>check what stands behind the host in the address</source>
        <translation>vérifiez ce qui suit l’hôte dans l’adresse</translation>
    </message>
</context>
<context>
    <name>stream.check-sender</name>
    <message>
        <source>check the sender, the network, and the address</source>
        <translation>vérifiez l’émetteur, le réseau et l’adresse</translation>
    </message>
</context>
<context>
    <name>stream.end-other</name>
    <message>
        <source>end that program, or send to another port</source>
        <translation>fermez ce programme, ou envoyez vers un autre port</translation>
    </message>
</context>
<context>
    <name>stream.ended</name>
    <message>
        <source>it has ended</source>
        <translation>il est terminé</translation>
    </message>
</context>
<context>
    <name>stream.host-unknown</name>
    <message>
        <source>its host is not found</source>
        <translation>son hôte est introuvable</translation>
    </message>
</context>
<context>
    <name>stream.list-once</name>
    <message>
        <source>put it into the playlist once</source>
        <translation>ne le mettez qu’une fois dans la liste de lecture</translation>
    </message>
</context>
<context>
    <name>stream.no-memory</name>
    <message>
        <source>there is not enough memory for its pictures</source>
        <translation>la mémoire ne suffit pas pour ses images</translation>
    </message>
</context>
<context>
    <name>stream.no-such-path</name>
    <message>
        <source>there is nothing at its path</source>
        <translation>il n’y a rien à son chemin</translation>
    </message>
</context>
<context>
    <name>stream.not-ready</name>
    <message>
        <source>{}: {}</source>
        <translation>{} : {}</translation>
    </message>
</context>
<context>
    <name>stream.not-yet</name>
    <message>
        <source>it has given no picture yet</source>
        <translation>il n’a encore donné aucune image</translation>
    </message>
</context>
<context>
    <name>stream.open-already</name>
    <message>
        <source>this program plays it already</source>
        <translation>ce programme le diffuse déjà</translation>
    </message>
</context>
<context>
    <name>stream.port-in-use</name>
    <message>
        <source>another program receives at its port</source>
        <translation>un autre programme reçoit sur son port</translation>
    </message>
</context>
<context>
    <name>stream.refused</name>
    <message>
        <source>the connection was refused</source>
        <translation>la connexion a été refusée</translation>
    </message>
</context>
<context>
    <name>stream.send-h264</name>
    <message>
        <source>let it be sent as H.264 or Motion JPEG</source>
        <translation>faites-le envoyer en H.264 ou Motion JPEG</translation>
    </message>
</context>
<context>
    <name>stream.silent</name>
    <message>
        <source>no picture came within {} s</source>
        <translation>aucune image n’est arrivée en {} s</translation>
    </message>
</context>
<context>
    <name>stream.stalled</name>
    <message>
        <source>no picture has come for {} s</source>
        <translation>aucune image n’est arrivée depuis {} s</translation>
    </message>
</context>
<context>
    <name>stream.start-sender</name>
    <message>
        <source>start the sender, and check the port</source>
        <translation>démarrez l’émetteur et vérifiez le port</translation>
    </message>
</context>
<context>
    <name>stream.start-sender-again</name>
    <message>
        <source>start the sender again</source>
        <translation>redémarrez l’émetteur</translation>
    </message>
</context>
<context>
    <name>stream.unknown-hold</name>
    <message>
        <source>the stream&apos;s address ends in an unknown choice</source>
        <translation>l’adresse du flux se termine par un choix inconnu</translation>
    </message>
</context>
<context>
    <name>stream.unknown-scheme</name>
    <message>
        <source>this is no address of a stream</source>
        <translation>ce n’est pas l’adresse d’un flux</translation>
    </message>
</context>
<context>
    <name>stream.unreachable</name>
    <message>
        <source>its host cannot be reached</source>
        <translation>son hôte est injoignable</translation>
    </message>
</context>
<context>
    <name>stream.unreadable</name>
    <message>
        <source>it cannot be read ({})</source>
        <translation>il ne peut pas être lu ({})</translation>
    </message>
</context>
<context>
    <name>stream.unusable</name>
    <message>
        <source>what comes is no video that can be shown</source>
        <translation>ce qui arrive n’est pas une vidéo qui puisse être montrée</translation>
    </message>
</context>
<context>
    <name>stream.wants-password</name>
    <message>
        <source>it wants another user name and password</source>
        <translation>il demande un autre nom d’utilisateur et un autre mot de passe</translation>
    </message>
</context>
<context>
    <name>stream.write-address</name>
    <message>
        <source>write it like {}, and in user names and passwords % and two digits for signs like @, : and /</source>
        <translation>écrivez-la comme {}, et dans les noms d’utilisateur et mots de passe % et deux chiffres pour des signes comme @, : et /</translation>
    </message>
</context>
<context>
    <name>stream.write-hold</name>
    <message>
        <source>write #hold=last or #hold=black</source>
        <translation>écrivez #hold=last ou #hold=black</translation>
    </message>
</context>
<context>
    <name>stream.write-password</name>
    <message>
        <source>write them into the address before the host: {}</source>
        <translation>écrivez-les dans l’adresse avant l’hôte : {}</translation>
    </message>
</context>
<context>
    <name>stream.write-scheme</name>
    <message>
        <source>let it begin with one of {}</source>
        <translation>faites-la commencer par l’un de : {}</translation>
    </message>
</context>
<context>
    <name>venue.cannot-open-folder</name>
    <message>
        <source>the folder cannot be opened ({})</source>
        <translation>le dossier ne peut pas être ouvert ({})</translation>
    </message>
</context>
<context>
    <name>venue.cannot-rename</name>
    <message>
        <source>the folder cannot be renamed ({})</source>
        <translation>le dossier ne peut pas être renommé ({})</translation>
    </message>
</context>
<context>
    <name>venue.no-trash</name>
    <message>
        <source>it cannot be moved to the trash</source>
        <translation>il ne peut pas être mis à la corbeille</translation>
    </message>
</context>
<context>
    <name>venue.remove-folder-yourself</name>
    <message>
        <source>this disk may have none: remove the folder with the file manager</source>
        <translation>ce disque n’en a peut-être pas&#xa0;: supprimez le dossier avec le gestionnaire de fichiers</translation>
    </message>
</context>
<context>
    <name>venue.used-by-another</name>
    <message>
        <source>another program is working on this venue</source>
        <translation>un autre programme travaille sur ce lieu</translation>
    </message>
</context>
<context>
    <name>venue.wait-for-another</name>
    <message>
        <source>wait until it has finished, or close it, then try again</source>
        <translation>attendez qu’il ait fini ou fermez-le, puis réessayez</translation>
    </message>
</context>
<context>
    <name>view.cannot-write-picture</name>
    <message>
        <source>the picture could not be written</source>
        <translation>l’image n’a pas pu être écrite</translation>
    </message>
</context>
<context>
    <name>view.choose-writable-folder</name>
    <message>
        <source>choose a folder that you may write to, with free space</source>
        <translation>choisissez un dossier où vous avez le droit d’écrire et où il reste de l’espace</translation>
    </message>
</context>
<context>
    <name>wizard.allow-commands</name>
    <message>
        <source>open the venue anew and allow its programs</source>
        <translation>rouvrez le lieu et autorisez ses programmes</translation>
    </message>
</context>
</TS>
