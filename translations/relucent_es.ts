<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="es">
<context>
    <name>About</name>
    <message>
        <source>About Relucent</source>
        <translation>Acerca de Relucent</translation>
    </message>
    <message>
        <source>Version %1, with these libraries: %2.</source>
        <translation>Versión %1, con estas bibliotecas: %2.</translation>
    </message>
</context>
<context>
    <name>ContentFiles</name>
    <message>
        <source>Pictures and films</source>
        <translation>Imágenes y vídeos</translation>
    </message>
    <message>
        <source>Pictures</source>
        <translation>Imágenes</translation>
    </message>
    <message>
        <source>All files</source>
        <translation>Todos los archivos</translation>
    </message>
</context>
<context>
    <name>DeviceLabel</name>
    <message>
        <source>Projector %1</source>
        <translation>Proyector %1</translation>
    </message>
    <message>
        <source>Camera %1</source>
        <translation>Cámara %1</translation>
    </message>
</context>
<context>
    <name>EndQuestion</name>
    <message>
        <source>A measurement is under way</source>
        <translation>Hay una medición en curso</translation>
    </message>
    <message>
        <source>%1 in the venue “%2”.</source>
        <translation>%1 en el lugar «%2».</translation>
    </message>
    <message>
        <source>Every photograph is on the disk. Opened again, the venue goes on from there.</source>
        <translation>Todas las fotografías están en el disco. Al abrir de nuevo el lugar, se sigue desde ahí.</translation>
    </message>
    <message>
        <source>End it for now</source>
        <translation>Terminarla por ahora</translation>
    </message>
    <message>
        <source>Go on measuring</source>
        <translation>Seguir midiendo</translation>
    </message>
    <message>
        <source>The show of the venue “%1”: the projector&apos;s screen goes dark.</source>
        <translation>El show del lugar «%1»: la pantalla del proyector se apaga.</translation>
    </message>
    <message>
        <source>Playlist and results are on the disk. Open the output again to play the show again.</source>
        <translation>La lista y los resultados están en el disco. Abra de nuevo la salida para reproducir otra vez el show.</translation>
    </message>
    <message>
        <source>A measurement and a show are under way</source>
        <translation>Hay una medición y un show en curso</translation>
    </message>
    <message>
        <source>End both</source>
        <translation>Terminar ambos</translation>
    </message>
    <message>
        <source>Let both go on</source>
        <translation>Dejar que ambos sigan</translation>
    </message>
    <message>
        <source>A show is playing</source>
        <translation>Hay un show en curso</translation>
    </message>
    <message>
        <source>End the show</source>
        <translation>Terminar el show</translation>
    </message>
    <message>
        <source>Go on playing</source>
        <translation>Seguir reproduciendo</translation>
    </message>
    <message>
        <source>The show of the venue “%1”.</source>
        <translation>La función del lugar «%1».</translation>
    </message>
</context>
<context>
    <name>Failure</name>
    <message>
        <source>The computer has no memory left.</source>
        <translation>Al equipo no le queda memoria.</translation>
    </message>
    <message>
        <source>Close other programs, or choose fewer pixels.</source>
        <translation>Cierre otros programas o elija menos píxeles.</translation>
    </message>
    <message>
        <source>Relucent made a mistake.</source>
        <translation>Relucent ha cometido un error.</translation>
    </message>
    <message>
        <source>What is saved is safe. Copy the details for whoever looks after the program, then try again.</source>
        <translation>Lo guardado está a salvo. Copie los detalles para quien se encarga del programa e inténtelo de nuevo.</translation>
    </message>
    <message>
        <source>What is saved is safe. Try again.</source>
        <translation>Lo guardado está a salvo. Inténtelo de nuevo.</translation>
    </message>
    <message>
        <source>The camera does not see this projector</source>
        <translation>La cámara no ve este proyector</translation>
    </message>
    <message>
        <source>A program of this venue failed</source>
        <translation>Falló un programa de este lugar</translation>
    </message>
    <message>
        <source>Another command is typed at the step Venue, by “Change the programs”.</source>
        <translation>Otra orden se escribe en el paso «Lugar», con «Cambiar los programas».</translation>
    </message>
</context>
<context>
    <name>FullDisk</name>
    <message>
        <source>The disk is full. Measuring has paused.</source>
        <translation>El disco está lleno. La medición está en pausa.</translation>
    </message>
    <message>
        <source>Every photograph is safe. %1 are free, %2 are needed: then measuring goes on by itself.</source>
        <translation>Todas las fotografías están a salvo. Hay %1 libres y se necesitan %2: entonces la medición sigue por sí sola.</translation>
    </message>
</context>
<context>
    <name>LostDevice</name>
    <message>
        <source>The projector&apos;s screen is unplugged</source>
        <translation>La pantalla del proyector está desconectada</translation>
    </message>
    <message>
        <source>Everything so far is safe. Plug it in again: it goes on by itself.</source>
        <translation>Todo lo hecho está a salvo. Vuelva a conectarla: sigue por sí solo.</translation>
    </message>
    <message>
        <source>Everything so far is safe. Push in its cable at both ends, and do not move the tripod: it goes on by itself.</source>
        <translation>Todo lo hecho está a salvo. Apriete el cable en ambos extremos y no mueva el trípode: sigue por sí solo.</translation>
    </message>
    <message>
        <source>The camera does not answer</source>
        <translation>La cámara no responde</translation>
    </message>
    <message>
        <source>Screen unplugged</source>
        <translation>Pantalla desconectada</translation>
    </message>
    <message>
        <source>Camera silent</source>
        <translation>Cámara sin respuesta</translation>
    </message>
    <message>
        <source>%1: its screen is unplugged</source>
        <extracomment>%1 is a projector: its name, or &quot;Projector 2&quot;</extracomment>
        <translation>%1: su pantalla está desconectada</translation>
    </message>
    <message>
        <source>%1 does not answer</source>
        <extracomment>%1 is a camera: its name, or &quot;Camera 2&quot;</extracomment>
        <translation>%1 no responde</translation>
    </message>
    <message>
        <source>Everything so far is safe. Plug it in again, then resume.</source>
        <translation>Todo lo hecho está a salvo. Vuelva a conectarla y después reanude.</translation>
    </message>
    <message>
        <source>Everything so far is safe. Push in its cable at both ends, and do not move the tripod, then resume.</source>
        <translation>Todo lo hecho está a salvo. Apriete el cable en ambos extremos, no mueva el trípode y después reanude.</translation>
    </message>
</context>
<context>
    <name>Method</name>
    <message>
        <source>Each pixel&apos;s brightness</source>
        <translation>El brillo de cada píxel</translation>
    </message>
    <message>
        <source>Each pixel on its own</source>
        <translation>Cada píxel por separado</translation>
    </message>
    <message>
        <source>Each pixel, sharpened</source>
        <translation>Cada píxel, con nitidez</translation>
    </message>
    <message>
        <source>Clusters</source>
        <translation>Clústeres</translation>
    </message>
    <message>
        <source>Windows</source>
        <translation>Ventanas</translation>
    </message>
    <message>
        <source>All bounces, for films</source>
        <translation>Todos los rebotes, para vídeo</translation>
    </message>
    <message>
        <source>Uncorrected</source>
        <translation>Sin corregir</translation>
    </message>
    <message>
        <source>All bounces, solved, for stills</source>
        <translation>Rebotes resueltos, imágenes fijas</translation>
    </message>
</context>
<context>
    <name>NumberText</name>
    <message>
        <source>%1 million</source>
        <translation>%1 millones</translation>
    </message>
    <message>
        <source>%1 billion</source>
        <translation>%1 mil millones</translation>
    </message>
</context>
<context>
    <name>Overlay</name>
    <message>
        <source>%1 frames a second, %2 ms a frame, %3 of %4 late</source>
        <translation>%1 fotogramas/s, %2 ms por fotograma, %3 de %4 con retraso</translation>
    </message>
    <message>
        <source>not compensated</source>
        <translation>sin compensar</translation>
    </message>
    <message>
        <source>frozen</source>
        <translation>congelado</translation>
    </message>
    <message>
        <source>test chart: %1</source>
        <translation>carta de prueba: %1</translation>
    </message>
    <message numerus="yes">
        <source>compensated, %n step(s), %1 % out of reach</source>
        <translation>
            <numerusform>compensado, %n paso, %1 % fuera de alcance</numerusform>
            <numerusform>compensado, %n pasos, %1 % fuera de alcance</numerusform>
        </translation>
    </message>
    <message>
        <source>still picture</source>
        <translation>imagen fija</translation>
    </message>
    <message>
        <source>follows a viewer within %1 ms</source>
        <translation>sigue a un espectador en %1 ms</translation>
    </message>
    <message>
        <source>perfected by photographs</source>
        <translation>perfeccionada con fotografías</translation>
    </message>
    <message>
        <source>live picture within %1 ms of its arrival</source>
        <translation>imagen en vivo a %1 ms de su llegada</translation>
    </message>
</context>
<context>
    <name>RecentVenues</name>
    <message>
        <source>Nothing measured yet</source>
        <translation>Sin medir</translation>
    </message>
    <message>
        <source>Acquire is next</source>
        <translation>Sigue: Adquisición</translation>
    </message>
    <message>
        <source>Ready to play</source>
        <translation>Listo para reproducir</translation>
    </message>
    <message>
        <source>Preview out of date</source>
        <translation>Vista previa desactualizada</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Medido</translation>
    </message>
    <message numerus="yes">
        <source>Interrupted: %n pattern(s) are safe</source>
        <translation>
            <numerusform>Interrumpida: %n patrón está a salvo</numerusform>
            <numerusform>Interrumpida: %n patrones están a salvo</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Measured; %n newer pattern(s) are safe</source>
        <translation>
            <numerusform>Medido; %n patrón más nuevo a salvo</numerusform>
            <numerusform>Medido; %n patrones más nuevos a salvo</numerusform>
        </translation>
    </message>
    <message>
        <source>Ended by a change</source>
        <translation>Terminada por un cambio</translation>
    </message>
    <message>
        <source>Stopped at blocks of %1 px</source>
        <translation>Detenida en bloques de %1 px</translation>
    </message>
    <message>
        <source>Stopped at %1 px; newer patterns: %2</source>
        <translation>Detenida en %1 px; patrones más nuevos: %2</translation>
    </message>
    <message>
        <source>A show plays</source>
        <translation>Se reproduce un show</translation>
    </message>
</context>
<context>
    <name>ScreenChoice</name>
    <message>
        <source>This computer</source>
        <translation>Este equipo</translation>
    </message>
    <message>
        <source>%1, %2 × %3, %4 Hz</source>
        <translation>%1, %2 × %3, %4 Hz</translation>
    </message>
    <message>
        <source>There is no other screen: the patterns cover this window while they are shown. Plug the projector in, and switch the desktop to extended screens, to keep both apart.</source>
        <translation>No hay otra pantalla: los patrones cubren esta ventana mientras se muestran. Conecte el proyector y extienda el escritorio a las dos pantallas para separarlos.</translation>
    </message>
    <message>
        <source>This is the screen that you work on. Choose the projector&apos;s.</source>
        <translation>Esta es la pantalla en la que trabaja. Elija la del proyector.</translation>
    </message>
    <message>
        <source>The projector was measured with %1 pixels. Set this screen to that size.</source>
        <translation>El proyector se midió con %1 píxeles. Ponga esta pantalla a ese tamaño.</translation>
    </message>
    <message>
        <source>This is another projector than the one that was measured. Its light and its place differ: take a verification photograph, and measure again where that does not look as predicted.</source>
        <translation>Este no es el proyector que se midió. Su luz y su lugar son otros: tome una fotografía de verificación y mida de nuevo si no se ve como se predijo.</translation>
    </message>
    <message>
        <source>Measured at %1, used at %2. If it is the same projector in the same place, everything that was measured holds; a verification photograph tells.</source>
        <translation>Medido en %1, usado en %2. Si es el mismo proyector en el mismo sitio, todo lo medido sigue valiendo; una fotografía de verificación lo muestra.</translation>
    </message>
</context>
<context>
    <name>StoppedEarly</name>
    <message>
        <source>Measuring was stopped at blocks of %1 px</source>
        <translation>La medición se detuvo en bloques de %1 px</translation>
    </message>
    <message>
        <source>All that follows is as coarse. Go on measuring any time.</source>
        <translation>Todo lo que sigue es igual de basto. Siga midiendo en cualquier momento.</translation>
    </message>
    <message>
        <source>Go on at Acquire</source>
        <translation>Continuar en «Adquisición»</translation>
    </message>
    <message>
        <source>What was measured does not fit together</source>
        <translation>Lo medido no concuerda</translation>
    </message>
    <message>
        <source>Corrected pictures are expected at %1: that is no better than uncorrected. Measure again.</source>
        <translation>De las imágenes corregidas se esperan %1: no es mejor que sin corregir. Mida de nuevo.</translation>
    </message>
    <message>
        <source>%1 dB</source>
        <translation>%1 dB</translation>
    </message>
    <message>
        <source>Go to Acquire</source>
        <translation>Ir a «Adquisición»</translation>
    </message>
    <message>
        <source>Measuring ended because something had changed</source>
        <translation>La medición terminó porque algo había cambiado</translation>
    </message>
    <message>
        <source>What follows is of before. See at Acquire what helps.</source>
        <translation>Lo que sigue es de antes. En «Adquisición» se indica qué ayuda.</translation>
    </message>
    <message>
        <source>%1 of the view is too bright for the camera</source>
        <translation>El %1 de la vista es demasiado brillante para la cámara</translation>
    </message>
    <message>
        <source>Nothing is corrected there. Close the lens a little, check the camera, then measure again.</source>
        <translation>Allí no se corrige nada. Cierre un poco el objetivo, compruebe la cámara y mida de nuevo.</translation>
    </message>
    <message>
        <source>%1 of the view is left out</source>
        <translation>Se deja fuera el %1 de la vista</translation>
    </message>
    <message>
        <source>Test patterns looked different there from what was measured, and nothing is corrected. See that all stands still, then measure again.</source>
        <translation>Allí los patrones de prueba se vieron distintos de lo medido, y no se corrige nada. Procure que todo esté quieto y mida de nuevo.</translation>
    </message>
    <message>
        <source>Measuring was stopped before anything was told apart</source>
        <translation>La medición se detuvo antes de distinguir nada</translation>
    </message>
    <message>
        <source>No picture can be corrected by it. Go on measuring, or use the earlier one, at Acquire.</source>
        <translation>Con ella no se puede corregir ninguna imagen. Siga midiendo o use la anterior, en «Adquisición».</translation>
    </message>
    <message>
        <source>No picture can be corrected by it. Go on measuring any time.</source>
        <translation>Con ella no se puede corregir ninguna imagen. Siga midiendo cuando quiera.</translation>
    </message>
    <message>
        <source>Measuring again has not ended</source>
        <translation>La nueva medición no ha terminado</translation>
    </message>
    <message>
        <source>What was measured is out of date: it belongs to earlier settings</source>
        <translation>Lo medido está desactualizado: corresponde a ajustes anteriores</translation>
    </message>
    <message>
        <source>It still works, and what you see follows from the earlier measurement, until the new one is ready.</source>
        <translation>La medición anterior sigue sirviendo, y lo que ve se deriva de ella, hasta que la nueva esté lista.</translation>
    </message>
</context>
<context>
    <name>VenueKeeping</name>
    <message>
        <source>It is being measured.</source>
        <translation>Se está midiendo.</translation>
    </message>
    <message>
        <source>It is open. Open another venue, then come back.</source>
        <translation>Está abierto. Abra otro lugar y vuelva después.</translation>
    </message>
    <message>
        <source>Give the venue a name.</source>
        <translation>Dé un nombre al lugar.</translation>
    </message>
    <message>
        <source>A name cannot hold a slash.</source>
        <translation>Un nombre no puede contener una barra (/).</translation>
    </message>
    <message>
        <source>A name cannot begin with a full stop: its folder would be hidden.</source>
        <translation>Un nombre no puede empezar con un punto: su carpeta quedaría oculta.</translation>
    </message>
    <message>
        <source>There is a folder of that name. Choose another name.</source>
        <translation>Ya hay una carpeta con ese nombre. Elija otro.</translation>
    </message>
    <message>
        <source>Its show starts at log-in. Open it, and remove the installed show at Output first.</source>
        <translation>Su show empieza al iniciar sesión. Ábralo y quite primero el show instalado en Salida.</translation>
    </message>
</context>
<context>
    <name>ViewActions</name>
    <message>
        <source>Show everything</source>
        <translation>Mostrar todo</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>Guardar</translation>
    </message>
    <message>
        <source>Picture as seen</source>
        <translation>Imagen tal como se ve</translation>
    </message>
    <message>
        <source>Save the picture</source>
        <translation>Guardar la imagen</translation>
    </message>
    <message>
        <source>Pictures (*.png)</source>
        <translation>Imágenes (*.png)</translation>
    </message>
    <message>
        <source>Values</source>
        <translation>Valores</translation>
    </message>
    <message>
        <source>Save the values</source>
        <translation>Guardar los valores</translation>
    </message>
    <message>
        <source>OpenEXR (*.exr)</source>
        <translation>OpenEXR (*.exr)</translation>
    </message>
    <message>
        <source>Whole screen, save</source>
        <translation>Pantalla completa, guardar</translation>
    </message>
    <message>
        <source>Whole screen (F11 in the picture)</source>
        <translation>Pantalla completa (F11 en la imagen)</translation>
    </message>
</context>
<context>
    <name>WindowProjector</name>
    <message>
        <source>The desktop scales this screen by %1, which blurs every pixel. Set its scale to 100 %.</source>
        <translation>El escritorio escala esta pantalla con un factor de %1, lo que emborrona cada píxel. Ponga su escala al 100&#xa0;%.</translation>
    </message>
    <message>
        <source>A venue is being measured</source>
        <translation>Se está midiendo un lugar</translation>
    </message>
</context>
<context>
    <name>acquisition.alarm-skipped</name>
    <message>
        <source>accepted before pattern {}: {}</source>
        <translation>aceptado antes del patrón {}: {}</translation>
    </message>
</context>
<context>
    <name>acquisition.ended-by-change</name>
    <message>
        <source>measuring ended with a change: {}; photographs from No. {} on are left out</source>
        <translation>la medición terminó con un cambio: {}; se omiten las fotografías a partir de la n.º {}</translation>
    </message>
</context>
<context>
    <name>acquisition.light-drifted</name>
    <message>
        <source>The light changed by {} % between the first and the last photograph; this was compensated for, but let the projector warm up before the next time</source>
        <translation>la luz cambió un {} % entre la primera y la última fotografía; se ha tenido en cuenta, pero deje que el proyector se caliente antes de la próxima vez</translation>
    </message>
</context>
<context>
    <name>acquisition.overexposed</name>
    <message>
        <source>{} % of the camera pixels are overexposed even at the shortest exposure: close the camera&apos;s aperture a little, then measure again</source>
        <translation>el {} % de los píxeles de la cámara está sobreexpuesto incluso con la exposición más corta: cierre un poco el diafragma de la cámara y mida de nuevo</translation>
    </message>
</context>
<context>
    <name>acquisition.pixels-flagged</name>
    <message>
        <source>{} % of the camera pixels do not see what was predicted for the test patterns: check that nothing moved or flickered; these pixels are left out of the compensation</source>
        <translation>el {} % de los píxeles de la cámara ve algo distinto de lo previsto en los patrones de prueba: compruebe que nada se movió ni parpadeó; estos píxeles quedan fuera de la compensación</translation>
    </message>
</context>
<context>
    <name>acquisition.poor-quality</name>
    <message>
        <source>What was measured does not fit together: corrected pictures are expected at {} dB, no better than uncorrected; see that projector, camera and surface stand still and that no other light changes, then measure again</source>
        <translation>Lo medido no concuerda: de las imágenes corregidas se esperan {} dB, no mejor que sin corregir; compruebe que el proyector, la cámara y la superficie no se muevan y que no cambie ninguna otra luz, y mida de nuevo</translation>
    </message>
</context>
<context>
    <name>acquisition.stopped-early</name>
    <message>
        <source>Measuring was stopped at blocks of {} px: what is finer is missing, and pictures are compensated less sharply; go on measuring any time as long as nothing has moved</source>
        <translation>La medición se detuvo en bloques de {} px: falta lo más fino y las imágenes se compensan con menos nitidez; siga midiendo en cualquier momento, mientras nada se haya movido</translation>
    </message>
</context>
<context>
    <name>acquisition.stopped-with-forecast</name>
    <message numerus="yes">
        <source>Stopped at {} px blocks; {} dB expected, about {} dB with {} more photographs, {}; go on measuring any time as long as nothing has moved</source>
        <comment>Stopped at {} px blocks; {} dB expected, about {} dB with {} more photograph, {}; go on measuring any time as long as nothing has moved</comment>
        <translation>
            <numerusform>Detenido en bloques de {} px; se esperan {} dB, unos {} dB con {} foto más, {}; siga midiendo en cualquier momento mientras nada se haya movido</numerusform>
            <numerusform>Detenido en bloques de {} px; se esperan {} dB, unos {} dB con {} fotos más, {}; siga midiendo en cualquier momento mientras nada se haya movido</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>acquisition.taken-again</name>
    <message numerus="yes">
        <source>{}: {} patterns from No. {} on were photographed again</source>
        <comment>{}: {} pattern from No. {} on was photographed again</comment>
        <translation>
            <numerusform>{}: se volvió a fotografiar {} patrón desde el n.º {}</numerusform>
            <numerusform>{}: se volvieron a fotografiar {} patrones desde el n.º {}</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>alarm.by-resuming</name>
    <message>
        <source>{} by resuming the calibration; {}</source>
        <translation>{} reanudando la calibración; {}</translation>
    </message>
</context>
<context>
    <name>alarm.camera-sees-nothing</name>
    <message>
        <source>the camera sees nothing at all</source>
        <translation>la cámara no ve nada en absoluto</translation>
    </message>
</context>
<context>
    <name>alarm.check-screen</name>
    <message>
        <source>check that the right screen is chosen and nothing covers the picture, then try again</source>
        <translation>compruebe que se ha elegido la pantalla correcta y que nada tapa la imagen, e inténtelo de nuevo</translation>
    </message>
</context>
<context>
    <name>alarm.clear-the-view</name>
    <message>
        <source>take away what is in the light or in the view, then try again</source>
        <translation>retire lo que esté en la luz o en la imagen e inténtelo de nuevo</translation>
    </message>
</context>
<context>
    <name>alarm.lamp-changed</name>
    <message>
        <source>the projector&apos;s light changed by {} % within a few photographs</source>
        <translation>la luz del proyector ha cambiado un {} % en pocas fotografías</translation>
    </message>
</context>
<context>
    <name>alarm.leave-it-as-it-is</name>
    <message>
        <source>leave it as it is now, then try again: measuring begins again</source>
        <translation>déjelo como está ahora y pruebe otra vez: la medición empieza de nuevo</translation>
    </message>
</context>
<context>
    <name>alarm.light-flickers</name>
    <message>
        <source>the light flickers or was switched: photographs of one pattern differ by {} %</source>
        <translation>la luz parpadea o se ha encendido o apagado: las fotografías de un mismo patrón difieren un {} %</translation>
    </message>
</context>
<context>
    <name>alarm.light-room-or-measure-again</name>
    <message>
        <source>switch on again what shone when measuring began, then try again; or stop, and measure again in the light as it is now</source>
        <translation>vuelva a encender lo que iluminaba al empezar a medir y pruebe otra vez; o detenga y mida de nuevo con la luz de ahora</translation>
    </message>
</context>
<context>
    <name>alarm.moved</name>
    <message>
        <source>a camera or projector has moved: the view of camera {} is shifted by {}, {} pixels and turned by {} degrees</source>
        <translation>una cámara o un proyector se ha movido: la vista de la cámara {} está desplazada {}, {} píxeles y girada {} grados</translation>
    </message>
</context>
<context>
    <name>alarm.moved-besides</name>
    <message>
        <source>{}; besides, {}</source>
        <translation>{}; además, {}</translation>
    </message>
</context>
<context>
    <name>alarm.photograph-dark</name>
    <message>
        <source>one of two photographs of a pattern is dark: the lens was covered, or the projector&apos;s picture gone</source>
        <translation>una de las dos fotografías de un patrón está oscura: el objetivo estaba tapado o la imagen del proyector faltaba</translation>
    </message>
</context>
<context>
    <name>alarm.photographs-differ</name>
    <message>
        <source>photographs of one pattern differ by {} %: the light flickers, or something moved between them</source>
        <translation>las fotografías de un mismo patrón difieren en un {} %: la luz parpadea o algo se movió entre ellas</translation>
    </message>
</context>
<context>
    <name>alarm.picture-mirrored</name>
    <message>
        <source>the picture of projector {} appears mirrored</source>
        <translation>la imagen del proyector {} aparece reflejada</translation>
    </message>
</context>
<context>
    <name>alarm.projector-shows-nothing</name>
    <message>
        <source>the projector shows nothing, though the room&apos;s own light is still seen</source>
        <translation>el proyector no muestra nada, pero se sigue viendo la luz de la propia sala</translation>
    </message>
</context>
<context>
    <name>alarm.put-back-or-measure-again</name>
    <message>
        <source>put it back, then try again; or stop, and measure again without it</source>
        <translation>vuelva a ponerlo y pruebe otra vez; o detenga y mida de nuevo sin ello</translation>
    </message>
</context>
<context>
    <name>alarm.put-it-back</name>
    <message>
        <source>put it back to within half a pixel, then try again</source>
        <translation>vuelva a colocarlo en su sitio con una precisión de medio píxel e inténtelo de nuevo</translation>
    </message>
</context>
<context>
    <name>alarm.put-it-back-and-restore-light</name>
    <message>
        <source>put it back to within half a pixel and restore the light of the room, then try again</source>
        <translation>vuelva a colocarlo en su sitio con una precisión de medio píxel, deje la luz de la sala como estaba e inténtelo de nuevo</translation>
    </message>
</context>
<context>
    <name>alarm.restore-room-light</name>
    <message>
        <source>restore the light of the room, keep doors and curtains closed, then try again</source>
        <translation>déjela como estaba, mantenga cerradas puertas y cortinas, e inténtelo de nuevo</translation>
    </message>
</context>
<context>
    <name>alarm.room-brighter</name>
    <message>
        <source>the light of the room became brighter</source>
        <translation>la luz de la sala ha aumentado</translation>
    </message>
</context>
<context>
    <name>alarm.room-darker</name>
    <message>
        <source>the light of the room became darker</source>
        <translation>la luz de la sala ha disminuido</translation>
    </message>
</context>
<context>
    <name>alarm.safe-before-check</name>
    <message>
        <source>every photograph up to the previous check is safe</source>
        <translation>todas las fotografías hasta la comprobación anterior están a salvo</translation>
    </message>
</context>
<context>
    <name>alarm.safe-before-light-transport</name>
    <message>
        <source>every photograph before the light transport is safe</source>
        <translation>todas las fotografías anteriores al transporte de luz están a salvo</translation>
    </message>
</context>
<context>
    <name>alarm.something-gone</name>
    <message>
        <source>{} % of the view of camera {} are brighter than before: what stood there is gone</source>
        <translation>el {} % de la vista de la cámara {} está más claro que antes: lo que había allí ya no está</translation>
    </message>
</context>
<context>
    <name>alarm.steady-all</name>
    <message>
        <source>see that camera, projector and surface stand still, switch off dimmed and fluorescent lamps and the projector&apos;s power saving, then try again</source>
        <translation>compruebe que la cámara, el proyector y la superficie no se muevan, apague las lámparas atenuadas y fluorescentes, desactive el ahorro de energía del proyector e inténtelo de nuevo</translation>
    </message>
</context>
<context>
    <name>alarm.switch-off-dimmed-lamps</name>
    <message>
        <source>switch off dimmed and fluorescent lamps and the projector&apos;s power saving, then try again</source>
        <translation>apague las lámparas atenuadas y fluorescentes, desactive el ahorro de energía del proyector e inténtelo de nuevo</translation>
    </message>
</context>
<context>
    <name>alarm.switch-off-eco-modes</name>
    <message>
        <source>switch off its automatic brightness and eco modes, let it warm up, then try again</source>
        <translation>desactive su brillo automático y sus modos eco, deje que se caliente e inténtelo de nuevo</translation>
    </message>
</context>
<context>
    <name>alarm.switch-off-rear-projection</name>
    <message>
        <source>switch off the projector&apos;s rear or ceiling mode, or allow a mirrored picture, then try again</source>
        <translation>desactive en el proyector el modo de retroproyección o de techo, o permita una imagen reflejada, e inténtelo de nuevo</translation>
    </message>
</context>
<context>
    <name>alarm.uncover-lens</name>
    <message>
        <source>uncover the lens, check that the projector is on, then try again</source>
        <translation>destape el objetivo, compruebe que el proyector está encendido e inténtelo de nuevo</translation>
    </message>
</context>
<context>
    <name>alarm.view-changed</name>
    <message>
        <source>{} % of the view of camera {} look different from before</source>
        <translation>el {} % de la vista de la cámara {} se ve distinto que antes</translation>
    </message>
</context>
<context>
    <name>alarm.wake-projector</name>
    <message>
        <source>wake the projector, switch off its and the screen&apos;s power saving, then try again</source>
        <translation>active el proyector, desactive su ahorro de energía y el de la pantalla, e inténtelo de nuevo</translation>
    </message>
</context>
<context>
    <name>alarm.wrong-picture</name>
    <message>
        <source>projector {} does not show the picture that it is given</source>
        <translation>el proyector {} no muestra la imagen que se le envía</translation>
    </message>
</context>
<context>
    <name>calibration.allow-writing-then-resume</name>
    <message>
        <source>check that the folder may be written to, then go on</source>
        <translation>compruebe que se puede escribir en la carpeta y continúe</translation>
    </message>
</context>
<context>
    <name>calibration.allow-writing-then-retry</name>
    <message>
        <source>check that the folder may be written to, then try again</source>
        <translation>compruebe que se puede escribir en la carpeta e inténtelo de nuevo</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-list-folder</name>
    <message>
        <source>cannot look into the folder ({})</source>
        <translation>no se puede ver el contenido de la carpeta ({})</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-move-photograph</name>
    <message>
        <source>a photograph cannot be moved ({})</source>
        <translation>no se puede mover una fotografía ({})</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-open-folder</name>
    <message>
        <source>cannot open the folder ({})</source>
        <translation>no se puede abrir la carpeta ({})</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-remove-photograph</name>
    <message>
        <source>a photograph cannot be removed ({})</source>
        <translation>no se puede eliminar una fotografía ({})</translation>
    </message>
</context>
<context>
    <name>calibration.check-path-and-permission</name>
    <message>
        <source>check the path and that you may read it</source>
        <translation>revise la ruta y compruebe que tiene permiso de lectura</translation>
    </message>
</context>
<context>
    <name>calibration.check-permission-or-name</name>
    <message>
        <source>check that you may read it, or choose another name</source>
        <translation>compruebe que tiene permiso de lectura o elija otro nombre</translation>
    </message>
</context>
<context>
    <name>calibration.choose-another-or-copy-again</name>
    <message>
        <source>choose another calibration, or copy it again from where it was measured</source>
        <translation>elija otra calibración o vuelva a copiarla desde donde se midió</translation>
    </message>
</context>
<context>
    <name>calibration.disk-full</name>
    <message>
        <source>the disk is full</source>
        <translation>el disco está lleno</translation>
    </message>
</context>
<context>
    <name>calibration.give-addresses-again</name>
    <message>
        <source>give the projectors&apos; addresses again</source>
        <translation>indique de nuevo las direcciones de los proyectores</translation>
    </message>
</context>
<context>
    <name>calibration.make-room-then-resume</name>
    <message>
        <source>every photograph so far is safe: free at least {} MB there, then resume</source>
        <translation>todas las fotografías tomadas están a salvo: libere allí al menos {} MB y reanude</translation>
    </message>
</context>
<context>
    <name>calibration.manifest-damaged</name>
    <message>
        <source>the file that describes the venue is damaged</source>
        <translation>el archivo que describe el lugar está dañado</translation>
    </message>
</context>
<context>
    <name>calibration.network-unreadable</name>
    <message>
        <source>the addresses of the projectors on the network cannot be read ({})</source>
        <translation>no se pueden leer las direcciones de los proyectores en la red ({})</translation>
    </message>
</context>
<context>
    <name>calibration.not-a-calibration</name>
    <message>
        <source>this is not a calibration of Relucent</source>
        <translation>esto no es una calibración de Relucent</translation>
    </message>
</context>
<context>
    <name>calibration.result-file-missing</name>
    <message>
        <source>a file of the calibration&apos;s {} is missing</source>
        <translation>falta un archivo de la calibración ({})</translation>
    </message>
</context>
<context>
    <name>calibration.result-file-size-wrong</name>
    <message>
        <source>a file of the calibration&apos;s {} has {} bytes instead of {}</source>
        <translation>un archivo de la calibración ({}) tiene {} bytes en lugar de {}</translation>
    </message>
</context>
<context>
    <name>cast.check-screen</name>
    <message>
        <source>see whether the screen is on, or the window open</source>
        <translation>compruebe que la pantalla esté encendida, o la ventana abierta</translation>
    </message>
</context>
<context>
    <name>cast.choice-refused</name>
    <message>
        <source>the desktop no longer gives what was chosen for it</source>
        <translation>el escritorio ya no da lo que se había elegido</translation>
    </message>
</context>
<context>
    <name>cast.choose-again</name>
    <message>
        <source>play it again, and choose there what is shown</source>
        <translation>reprodúzcalo de nuevo y elija ahí qué se muestra</translation>
    </message>
</context>
<context>
    <name>cast.choose-in-wizard</name>
    <message>
        <source>play it once in the wizard, on Output, and choose there; a show then takes the same</source>
        <translation>reprodúzcalo una vez en el asistente, en «Salida», y elija ahí; un show toma después lo mismo</translation>
    </message>
</context>
<context>
    <name>cast.ended</name>
    <message>
        <source>the desktop has ended it</source>
        <translation>el escritorio lo ha terminado</translation>
    </message>
</context>
<context>
    <name>cast.install-pipewire</name>
    <message>
        <source>install pipewire and wireplumber, and log in again</source>
        <translation>instale pipewire y wireplumber y vuelva a iniciar sesión</translation>
    </message>
</context>
<context>
    <name>cast.install-portal</name>
    <message>
        <source>install xdg-desktop-portal and its part for this desktop, and log in again</source>
        <translation>instale xdg-desktop-portal y su parte para este escritorio y vuelva a iniciar sesión</translation>
    </message>
</context>
<context>
    <name>cast.log-in-again</name>
    <message>
        <source>log in again</source>
        <translation>vuelva a iniciar sesión</translation>
    </message>
</context>
<context>
    <name>cast.no-pipewire</name>
    <message>
        <source>PipeWire, which brings the picture, does not answer</source>
        <translation>PipeWire, que trae la imagen, no responde</translation>
    </message>
</context>
<context>
    <name>cast.no-portal</name>
    <message>
        <source>this desktop has no portal that gives the picture of a screen</source>
        <translation>este escritorio no tiene un portal que dé la imagen de una pantalla</translation>
    </message>
</context>
<context>
    <name>cast.no-windows</name>
    <message>
        <source>this desktop gives pictures of screens, not of windows</source>
        <translation>este escritorio da imágenes de pantallas, no de ventanas</translation>
    </message>
</context>
<context>
    <name>cast.not-chosen</name>
    <message>
        <source>nobody has chosen in the desktop&apos;s dialog what is shown</source>
        <translation>nadie ha elegido en el diálogo del escritorio qué se muestra</translation>
    </message>
</context>
<context>
    <name>cast.play-screen</name>
    <message>
        <source>play the screen on which the window is</source>
        <translation>reproduzca la pantalla en la que está la ventana</translation>
    </message>
</context>
<context>
    <name>cast.portal-failed</name>
    <message>
        <source>the desktop&apos;s portal gives no picture ({})</source>
        <translation>el portal del escritorio no da ninguna imagen ({})</translation>
    </message>
</context>
<context>
    <name>cast.portal-silent</name>
    <message>
        <source>the desktop&apos;s portal has not answered for {} s</source>
        <translation>el portal del escritorio no ha respondido en {} s</translation>
    </message>
</context>
<context>
    <name>cast.refused</name>
    <message>
        <source>it was refused in the desktop&apos;s dialog</source>
        <translation>se rechazó en el diálogo del escritorio</translation>
    </message>
</context>
<context>
    <name>cast.unusable</name>
    <message>
        <source>what the desktop sends is no picture that can be shown</source>
        <translation>lo que envía el escritorio no es una imagen que se pueda mostrar</translation>
    </message>
</context>
<context>
    <name>cast.update-desktop</name>
    <message>
        <source>update the desktop&apos;s portal and PipeWire</source>
        <translation>actualice el portal del escritorio y PipeWire</translation>
    </message>
</context>
<context>
    <name>check.colour-wheel</name>
    <message>
        <source>The colours come one after the other, as through a colour wheel ({} % in {} ms): expose whole frames, multiples of {} ms.</source>
        <translation>Los colores llegan uno tras otro, como por una rueda de color ({} % en {} ms): exponga fotogramas enteros, múltiplos de {} ms.</translation>
    </message>
</context>
<context>
    <name>check.dithering</name>
    <message>
        <source>The projector mixes greys in time, pixel by pixel ({} %): expose several whole frames, and switch its smoothing and 3D modes off.</source>
        <translation>El proyector mezcla los grises en el tiempo, píxel a píxel ({} %): exponga varios fotogramas enteros y desactive el suavizado y los modos 3D.</translation>
    </message>
</context>
<context>
    <name>check.lamp-flickers</name>
    <message>
        <source>The lamp flickers within a frame, by {} % in {} ms: expose whole frames, multiples of {} ms.</source>
        <translation>La lámpara parpadea dentro de un fotograma, un {} % en {} ms: exponga fotogramas enteros, múltiplos de {} ms.</translation>
    </message>
</context>
<context>
    <name>check.light-even</name>
    <message>
        <source>The light is even: no flicker, colour wheel, bands or dithering is seen.</source>
        <translation>La luz es uniforme: no se ven parpadeo, rueda de color, bandas ni tramado.</translation>
    </message>
</context>
<context>
    <name>check.light-unsteady</name>
    <message>
        <source>The light changes by {} % between exposures of whole frames: let the lamp warm up, and switch off dynamic brightness and the lamps in the room.</source>
        <translation>La luz cambia un {} % entre exposiciones de fotogramas enteros: deje que la lámpara se caliente y apague el brillo dinámico y las lámparas de la sala.</translation>
    </message>
</context>
<context>
    <name>check.no-brief-exposure</name>
    <message>
        <source>The camera cannot expose for a part of a frame, or sees too little then: flicker within a frame cannot be detected.</source>
        <translation>La cámara no puede exponer menos de un fotograma, o entonces ve demasiado poco: no se puede detectar el parpadeo dentro de un fotograma.</translation>
    </message>
</context>
<context>
    <name>check.other-screen-seen</name>
    <message>
        <source>The camera sees {} and not {}.</source>
        <translation>La cámara ve {} y no {}.</translation>
    </message>
</context>
<context>
    <name>check.picture-takes</name>
    <message>
        <source>A picture takes {} ms to appear: each one is waited for that long.</source>
        <translation>Una imagen tarda {} ms en aparecer: se espera ese tiempo a cada una.</translation>
    </message>
</context>
<context>
    <name>check.pictures-late</name>
    <message numerus="yes">
        <source>Pictures arrive {} photographs late: measure the latency, so that it is waited for.</source>
        <comment>Pictures arrive {} photograph late: measure the latency, so that it is waited for.</comment>
        <translation>
            <numerusform>Las imágenes llegan {} fotografía tarde: hay que medir la latencia y esperarla.</numerusform>
            <numerusform>Las imágenes llegan {} fotografías tarde: hay que medir la latencia y esperarla.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>check.rolling-shutter</name>
    <message>
        <source>The camera exposes its rows one after the other (rolling shutter): brief exposures have bands of {} %. Expose whole frames, multiples of {} ms.</source>
        <translation>La cámara expone sus filas una tras otra (obturador rodante): las exposiciones breves tienen bandas del {} %. Exponga fotogramas enteros, múltiplos de {} ms.</translation>
    </message>
</context>
<context>
    <name>check.screen-mirrored</name>
    <message>
        <source>The picture appears mirrored. If it is not meant to (rear projection, a mirror), switch that off in the projector&apos;s menu.</source>
        <translation>La imagen aparece reflejada. Si no es intencionado (retroproyección, un espejo), desactívelo en el menú del proyector.</translation>
    </message>
</context>
<context>
    <name>check.screen-not-seen</name>
    <message>
        <source>The camera does not see {}.</source>
        <translation>La cámara no ve {}.</translation>
    </message>
</context>
<context>
    <name>check.screen-seen</name>
    <message>
        <source>The camera sees {}: {} % of its view follow the test pattern.</source>
        <translation>La cámara ve {}: el {} % de su imagen sigue el patrón de prueba.</translation>
    </message>
</context>
<context>
    <name>check.white-changes</name>
    <message>
        <source>White changes by {} % from photograph to photograph: expose whole frames of the projector, multiples of {} ms, and switch its dynamic brightness off.</source>
        <translation>El blanco cambia un {} % de una fotografía a otra: exponga fotogramas enteros del proyector, múltiplos de {} ms, y desactive su brillo dinámico.</translation>
    </message>
</context>
<context>
    <name>compensation.draw-masks-of-cameras</name>
    <message>
        <source>draw masks in the views of the cameras that measured this calibration</source>
        <translation>dibuje máscaras en las vistas de las cámaras que midieron esta calibración</translation>
    </message>
</context>
<context>
    <name>compensation.mask-crosses-itself</name>
    <message>
        <source>its outline crosses itself</source>
        <translation>su contorno se cruza consigo mismo</translation>
    </message>
</context>
<context>
    <name>compensation.mask-encloses-nothing</name>
    <message>
        <source>its outline encloses nothing</source>
        <translation>su contorno no encierra nada</translation>
    </message>
</context>
<context>
    <name>compensation.mask-feather-out-of-range</name>
    <message>
        <source>its feather must lie between 0 and half of the view&apos;s larger side</source>
        <translation>su borde suave debe estar entre 0 y la mitad del lado mayor de la vista</translation>
    </message>
</context>
<context>
    <name>compensation.mask-not-finite</name>
    <message>
        <source>its points must be finite numbers</source>
        <translation>sus puntos deben ser números finitos</translation>
    </message>
</context>
<context>
    <name>compensation.mask-of-no-camera</name>
    <message>
        <source>a mask was drawn in the view of camera {}, but there are {} cameras</source>
        <translation>se dibujó una máscara en la vista de la cámara {}, pero hay {} cámaras</translation>
    </message>
</context>
<context>
    <name>compensation.mask-outside-view</name>
    <message>
        <source>its points must lie within the view, from 0 to 1 along both sides</source>
        <translation>sus puntos deben estar dentro de la vista, de 0 a 1 en ambos lados</translation>
    </message>
</context>
<context>
    <name>compensation.mask-point-twice</name>
    <message>
        <source>two points of its outline are the same</source>
        <translation>dos puntos de su contorno son iguales</translation>
    </message>
</context>
<context>
    <name>compensation.mask-too-few-points</name>
    <message>
        <source>its outline needs three points at least</source>
        <translation>su contorno necesita al menos tres puntos</translation>
    </message>
</context>
<context>
    <name>compensation.mask-too-many-points</name>
    <message>
        <source>its outline may have {} points at most</source>
        <translation>su contorno puede tener como máximo {} puntos</translation>
    </message>
</context>
<context>
    <name>compensation.masks-cover-everything</name>
    <message>
        <source>the masks cover the whole picture</source>
        <translation>las máscaras cubren toda la imagen</translation>
    </message>
</context>
<context>
    <name>compensation.of-mask</name>
    <message>
        <source>mask {}: {}</source>
        <translation>máscara {}: {}</translation>
    </message>
</context>
<context>
    <name>compensation.shrink-masks</name>
    <message>
        <source>make a mask smaller, or remove one</source>
        <translation>reduzca una máscara o quite una</translation>
    </message>
</context>
<context>
    <name>content.choose-picture-folder</name>
    <message>
        <source>choose a folder with PNG, JPEG, TIFF or EXR files</source>
        <translation>elija una carpeta con archivos PNG, JPEG, TIFF o EXR</translation>
    </message>
</context>
<context>
    <name>content.choose-supported-picture</name>
    <message>
        <source>choose a PNG, JPEG, TIFF or EXR picture</source>
        <translation>elija una imagen PNG, JPEG, TIFF o EXR</translation>
    </message>
</context>
<context>
    <name>content.connect-capture-device</name>
    <message>
        <source>plug it in, close other programs that use it, and try again</source>
        <translation>conéctelo, cierre otros programas que lo usen e inténtelo de nuevo</translation>
    </message>
</context>
<context>
    <name>content.log-in-to-xorg</name>
    <message>
        <source>log in to a desktop, or play files</source>
        <translation>inicie sesión en un escritorio, o reproduzca archivos</translation>
    </message>
</context>
<context>
    <name>content.no-pictures</name>
    <message>
        <source>no pictures in this folder</source>
        <translation>no hay imágenes en esta carpeta</translation>
    </message>
</context>
<context>
    <name>content.no-x-server</name>
    <message>
        <source>the live picture of a screen needs an X server, and none answers</source>
        <translation>la imagen en directo de una pantalla necesita un servidor X y ninguno responde</translation>
    </message>
</context>
<context>
    <name>content.nothing-captured</name>
    <message>
        <source>the capture device gives no picture</source>
        <translation>el dispositivo de captura no da ninguna imagen</translation>
    </message>
</context>
<context>
    <name>content.open-first</name>
    <message>
        <source>open it first</source>
        <translation>ábrala primero</translation>
    </message>
</context>
<context>
    <name>content.open-first-or-choose</name>
    <message>
        <source>open it first; there are: {}</source>
        <translation>ábrala primero; hay: {}</translation>
    </message>
</context>
<context>
    <name>content.picture-unreadable</name>
    <message>
        <source>not a picture that can be read</source>
        <translation>no es una imagen que se pueda leer</translation>
    </message>
</context>
<context>
    <name>content.sequence-empty</name>
    <message>
        <source>the sequence has no pictures</source>
        <translation>la secuencia no tiene imágenes</translation>
    </message>
</context>
<context>
    <name>content.unknown-window</name>
    <message>
        <source>there is no window &apos;{}&apos;</source>
        <translation>no hay ninguna ventana «{}»</translation>
    </message>
</context>
<context>
    <name>device.aim-uncover-and-expose-longer</name>
    <message>
        <source>aim it at the projection, take off its lens cap, and expose longer</source>
        <translation>apúntela a la proyección, quite la tapa del objetivo y use una exposición más larga</translation>
    </message>
</context>
<context>
    <name>device.allow-command-more-time</name>
    <message>
        <source>check the device, or allow the command more time: {}</source>
        <translation>revise el dispositivo o conceda más tiempo al comando: {}</translation>
    </message>
</context>
<context>
    <name>device.another-program-holds-camera</name>
    <message>
        <source>another program holds the camera</source>
        <translation>otro programa está usando la cámara</translation>
    </message>
</context>
<context>
    <name>device.ask-for-fewer-pixels</name>
    <message>
        <source>ask for that or less</source>
        <translation>pida ese tamaño o uno menor</translation>
    </message>
</context>
<context>
    <name>device.ask-for-given-size</name>
    <message>
        <source>ask for the size that it gives</source>
        <translation>pida el tamaño que entrega</translation>
    </message>
</context>
<context>
    <name>device.ask-for-listed-size</name>
    <message>
        <source>ask for a size that it has: v4l2-ctl --list-formats-ext names them</source>
        <translation>pida un tamaño que admita: v4l2-ctl --list-formats-ext los enumera</translation>
    </message>
</context>
<context>
    <name>device.automatic-exposure-stays</name>
    <message>
        <source>the video device&apos;s automatic exposure cannot be switched off</source>
        <translation>no se puede desactivar la exposición automática del dispositivo de vídeo</translation>
    </message>
</context>
<context>
    <name>device.automatic-focus-stays</name>
    <message>
        <source>the video device&apos;s automatic focus cannot be switched off</source>
        <translation>no se puede desactivar el enfoque automático del dispositivo de vídeo</translation>
    </message>
</context>
<context>
    <name>device.automatic-function-stays</name>
    <message>
        <source>{} cannot be switched off</source>
        <translation>no se puede desactivar {}</translation>
    </message>
</context>
<context>
    <name>device.automatic-iso</name>
    <message>
        <source>the camera chooses its sensitivity itself (automatic ISO)</source>
        <translation>la cámara elige ella misma su sensibilidad (ISO automático)</translation>
    </message>
</context>
<context>
    <name>device.automatic-white-balance-stays</name>
    <message>
        <source>the video device&apos;s automatic white balance cannot be switched off</source>
        <translation>no se puede desactivar el balance de blancos automático del dispositivo de vídeo</translation>
    </message>
</context>
<context>
    <name>device.battery-empty</name>
    <message>
        <source>the camera&apos;s battery seems to be empty ({} % when it was last asked)</source>
        <translation>la batería de la cámara parece agotada ({} % en la última consulta)</translation>
    </message>
</context>
<context>
    <name>device.battery-low</name>
    <message>
        <source>has {} % left in its battery: a measurement needs a full one or a mains adapter</source>
        <translation>tiene un {} % de batería: una medición necesita la batería llena o un adaptador de red</translation>
    </message>
</context>
<context>
    <name>device.built-without-genicam</name>
    <message>
        <source>this build of Relucent does not know GenICam cameras</source>
        <translation>esta compilación de Relucent no admite cámaras GenICam</translation>
    </message>
</context>
<context>
    <name>device.built-without-gphoto</name>
    <message>
        <source>this build of Relucent does not know DSLR and mirrorless cameras</source>
        <translation>esta compilación de Relucent no admite cámaras réflex (DSLR) ni sin espejo</translation>
    </message>
</context>
<context>
    <name>device.camera-asleep</name>
    <message>
        <source>the camera is there but does not answer, it may be asleep</source>
        <translation>la cámara está presente pero no responde, puede que esté en reposo</translation>
    </message>
</context>
<context>
    <name>device.camera-command-empty</name>
    <message>
        <source>the camera&apos;s command is empty</source>
        <translation>la orden de la cámara está vacía</translation>
    </message>
</context>
<context>
    <name>device.camera-command-lacks</name>
    <message>
        <source>the camera&apos;s command does not contain {}</source>
        <translation>en la orden de la cámara falta {}</translation>
    </message>
</context>
<context>
    <name>device.camera-given-up</name>
    <message>
        <source>the camera does not answer</source>
        <translation>la cámara no responde</translation>
    </message>
</context>
<context>
    <name>device.camera-given-up-advice</name>
    <message>
        <source>push in its cable at both ends and switch it on, then go on: every photograph so far is kept</source>
        <translation>encaje el cable en ambos extremos y enciéndala, luego continúe: todas las fotografías hechas se conservan</translation>
    </message>
</context>
<context>
    <name>device.camera-gone</name>
    <message>
        <source>the camera has been unplugged or switched off, or has fallen asleep</source>
        <translation>la cámara se ha desconectado, se ha apagado o ha entrado en reposo</translation>
    </message>
</context>
<context>
    <name>device.camera-no-longer-answers</name>
    <message>
        <source>the camera no longer answers ({}: {})</source>
        <translation>la cámara ha dejado de responder ({}: {})</translation>
    </message>
</context>
<context>
    <name>device.camera-not-back</name>
    <message>
        <source>the camera has been gone for {} s: {}</source>
        <translation>la cámara lleva {} s sin responder: {}</translation>
    </message>
</context>
<context>
    <name>device.camera-refuses</name>
    <message>
        <source>the camera refuses ({}: {})</source>
        <translation>la cámara se niega ({}: {})</translation>
    </message>
</context>
<context>
    <name>device.camera-sends-no-stream</name>
    <message>
        <source>the camera sends no stream</source>
        <translation>la cámara no envía ninguna transmisión</translation>
    </message>
</context>
<context>
    <name>device.camera-size-out-of-range</name>
    <message>
        <source>a camera of {} pixels is impossible: each side is {} to {}</source>
        <translation>una cámara de {} píxeles es imposible: cada lado tiene de {} a {}</translation>
    </message>
</context>
<context>
    <name>device.camera-stays-busy</name>
    <message>
        <source>the camera stays busy</source>
        <translation>la cámara sigue ocupada</translation>
    </message>
</context>
<context>
    <name>device.camera-twice</name>
    <message>
        <source>{} is camera {} and camera {}: choose another camera, or one with a serial number of its own</source>
        <translation>{} es la cámara {} y la cámara {}: elija otra cámara, o una con número de serie propio</translation>
    </message>
</context>
<context>
    <name>device.cannot-create-temporary-folder</name>
    <message>
        <source>cannot create a temporary folder ({})</source>
        <translation>no se puede crear una carpeta temporal ({})</translation>
    </message>
</context>
<context>
    <name>device.cannot-remove-file</name>
    <message>
        <source>cannot remove the file ({})</source>
        <translation>no se puede eliminar el archivo ({})</translation>
    </message>
</context>
<context>
    <name>device.cannot-reopen-video-device</name>
    <message>
        <source>the video device cannot be opened again</source>
        <translation>no se puede volver a abrir el dispositivo de vídeo</translation>
    </message>
</context>
<context>
    <name>device.cannot-start-command</name>
    <message>
        <source>the command cannot be started ({})</source>
        <translation>no se puede iniciar el comando ({})</translation>
    </message>
</context>
<context>
    <name>device.cannot-write-recording</name>
    <message>
        <source>the recording cannot be written ({})</source>
        <translation>no se puede escribir la grabación ({})</translation>
    </message>
</context>
<context>
    <name>device.card-full</name>
    <message>
        <source>the camera has no room left for a photograph: its memory card is full</source>
        <translation>a la cámara no le queda sitio para una fotografía: su tarjeta de memoria está llena</translation>
    </message>
</context>
<context>
    <name>device.change-or-empty-card</name>
    <message>
        <source>change or empty the memory card</source>
        <translation>cambie o vacíe la tarjeta de memoria</translation>
    </message>
</context>
<context>
    <name>device.charge-or-change-battery</name>
    <message>
        <source>charge or change the battery, or better, use a mains adapter, and switch the camera on again</source>
        <translation>cargue o cambie la batería (mejor, use un adaptador de corriente) y vuelva a encender la cámara</translation>
    </message>
</context>
<context>
    <name>device.check-cable-and-power</name>
    <message>
        <source>check its cable and its power</source>
        <translation>revise su cable y su alimentación</translation>
    </message>
</context>
<context>
    <name>device.check-cable-and-power-saving</name>
    <message>
        <source>check its cable, and switch off its power saving</source>
        <translation>revise su cable y desactive el ahorro de energía</translation>
    </message>
</context>
<context>
    <name>device.check-cable-network-and-programs</name>
    <message>
        <source>check the camera&apos;s cable and network card, and that no other program uses it</source>
        <translation>revise el cable y la tarjeta de red de la cámara, y que ningún otro programa la use</translation>
    </message>
</context>
<context>
    <name>device.check-cable-power-address</name>
    <message>
        <source>check its cable, its power and its address; `relucent-cli devices` lists what is there</source>
        <translation>revise su cable, su alimentación y su dirección; `relucent-cli devices` muestra los dispositivos presentes</translation>
    </message>
</context>
<context>
    <name>device.check-projector-and-aim</name>
    <message>
        <source>check that the projector is on and shows that output, aim the camera at it, and take its cap off; or choose another screen</source>
        <translation>compruebe que el proyector está encendido y muestra esa salida, apunte la cámara hacia él y quite la tapa del objetivo; o elija otra pantalla</translation>
    </message>
</context>
<context>
    <name>device.check-projector-or-aim-another</name>
    <message>
        <source>check that this projector is on and shows that output, and aim a camera at it; or remove it from the venue</source>
        <translation>compruebe que este proyector está encendido y muestra esa salida, y apunte una cámara hacia él; o quítelo del lugar</translation>
    </message>
</context>
<context>
    <name>device.choose-gain-in-range</name>
    <message>
        <source>choose a gain from {} to {}</source>
        <translation>la cámara admite de {} a {}</translation>
    </message>
</context>
<context>
    <name>device.choose-offered-iso</name>
    <message>
        <source>choose one of those that it has: {}</source>
        <translation>admite {}</translation>
    </message>
</context>
<context>
    <name>device.choose-or-aim-at-screen</name>
    <message>
        <source>choose {}, or aim the camera at {}</source>
        <translation>elija {} o apunte la cámara a {}</translation>
    </message>
</context>
<context>
    <name>device.choose-readable-pixel-format</name>
    <message>
        <source>it has {}; unpacked Mono, Bayer and RGB of 8 to 16 bits are read</source>
        <translation>admite {}; se leen Mono, Bayer y RGB sin empaquetar de 8 a 16 bits</translation>
    </message>
</context>
<context>
    <name>device.claimed-exposures-invalid</name>
    <message>
        <source>the camera claims exposures of {} to {} s</source>
        <translation>la cámara declara exposiciones de {} a {} s</translation>
    </message>
</context>
<context>
    <name>device.close-menus-and-live-view</name>
    <message>
        <source>close its menus and its playback, and leave live view</source>
        <translation>cierre sus menús y su reproducción, y termine la vista en directo</translation>
    </message>
</context>
<context>
    <name>device.close-menus-and-restart</name>
    <message>
        <source>close its menus, and switch it off and on</source>
        <translation>cierre sus menús, apáguela y vuelva a encenderla</translation>
    </message>
</context>
<context>
    <name>device.close-other-program</name>
    <message>
        <source>close the other program, a camera viewer or a second Relucent perhaps</source>
        <translation>cierre el otro programa, quizá un visor de cámara o un segundo Relucent</translation>
    </message>
</context>
<context>
    <name>device.close-other-programs</name>
    <message>
        <source>close other programs and try again</source>
        <translation>cierre otros programas e inténtelo de nuevo</translation>
    </message>
</context>
<context>
    <name>device.colour-filter-not-bayer</name>
    <message>
        <source>the camera&apos;s colour filter is not a Bayer filter</source>
        <translation>el filtro de color de la cámara no es un filtro de Bayer</translation>
    </message>
</context>
<context>
    <name>device.command-failed</name>
    <message>
        <source>the command failed with status {}</source>
        <translation>el comando falló con el estado {}</translation>
    </message>
</context>
<context>
    <name>device.command-failed-saying</name>
    <message>
        <source>the command failed with status {}, saying &quot;{}&quot;</source>
        <translation>el comando falló con el estado {} y el mensaje «{}»</translation>
    </message>
</context>
<context>
    <name>device.command-killed</name>
    <message>
        <source>the command was killed by signal {}</source>
        <translation>la señal {} terminó el comando</translation>
    </message>
</context>
<context>
    <name>device.command-killed-saying</name>
    <message>
        <source>the command was killed by signal {}, saying &quot;{}&quot;</source>
        <translation>la señal {} terminó el comando, con el mensaje «{}»</translation>
    </message>
</context>
<context>
    <name>device.command-too-long</name>
    <message>
        <source>the command took longer than {} s</source>
        <translation>el comando tardó más de {} s</translation>
    </message>
</context>
<context>
    <name>device.command-too-long-saying</name>
    <message>
        <source>the command took longer than {} s, saying &quot;{}&quot;</source>
        <translation>el comando tardó más de {} s, con el mensaje «{}»</translation>
    </message>
</context>
<context>
    <name>device.command-without-consent</name>
    <message>
        <source>the calibration runs a program to which nobody at this computer has agreed: {}</source>
        <translation>la calibración ejecuta un programa al que nadie ha dado su acuerdo en este equipo: {}</translation>
    </message>
</context>
<context>
    <name>device.command-wrote-nothing</name>
    <message>
        <source>the command ended well but wrote nothing, not {}</source>
        <translation>el comando terminó bien pero no escribió nada, ni siquiera {}</translation>
    </message>
</context>
<context>
    <name>device.command-wrote-something-else</name>
    <message>
        <source>the command ended well but wrote {}, not {}</source>
        <translation>el comando terminó bien pero escribió {} y no {}</translation>
    </message>
</context>
<context>
    <name>device.copy-or-retake-photograph</name>
    <message>
        <source>copy it again, or take the photograph again; a camera newer than this LibRaw needs DNG files</source>
        <translation>cópielo de nuevo o vuelva a tomar la fotografía; una cámara más reciente que esta versión de LibRaw necesita archivos DNG</translation>
    </message>
</context>
<context>
    <name>device.delivers-8-bits</name>
    <message>
        <source>delivers 8 bits: dark places stay uncertain</source>
        <translation>entrega 8 bits: las zonas oscuras quedan inciertas</translation>
    </message>
</context>
<context>
    <name>device.develop-linearly</name>
    <message>
        <source>develop the files linearly, as 16-bit TIFF, or use another camera</source>
        <translation>revele los archivos de forma lineal, como TIFF de 16 bits, o use otra cámara</translation>
    </message>
</context>
<context>
    <name>device.exposure-range-invalid</name>
    <message>
        <source>the shortest exposure must be above zero and no longer than the longest</source>
        <translation>la exposición más corta debe ser mayor que cero y no superar la más larga</translation>
    </message>
</context>
<context>
    <name>device.exposure-refused</name>
    <message>
        <source>the camera was asked to expose {} s but exposes {} s</source>
        <translation>se pidió a la cámara una exposición de {} s y se mantiene en {} s</translation>
    </message>
</context>
<context>
    <name>device.exposure-time-cannot-be-set</name>
    <message>
        <source>the camera&apos;s exposure time cannot be set</source>
        <translation>no se puede ajustar el tiempo de exposición de la cámara</translation>
    </message>
</context>
<context>
    <name>device.exposure-time-fixed</name>
    <message>
        <source>the camera exposes {} s whatever exposure it is asked for</source>
        <translation>la cámara se mantiene en {} s sea cual sea la exposición que se le pida</translation>
    </message>
</context>
<context>
    <name>device.focuses-by-itself</name>
    <message>
        <source>focuses by itself: switch its lens to manual focus</source>
        <translation>enfoca por sí sola: ponga el objetivo en enfoque manual</translation>
    </message>
</context>
<context>
    <name>device.free-space-or-record-elsewhere</name>
    <message>
        <source>free some space, or record elsewhere</source>
        <translation>libere espacio o grabe en otro lugar</translation>
    </message>
</context>
<context>
    <name>device.free-space-or-set-tmpdir</name>
    <message>
        <source>free some space there, or set TMPDIR to a folder that you may write to</source>
        <translation>libere espacio allí o indique en TMPDIR una carpeta en la que pueda escribir</translation>
    </message>
</context>
<context>
    <name>device.gain-out-of-range</name>
    <message>
        <source>a gain of {} is wanted</source>
        <translation>se pide una ganancia de {}</translation>
    </message>
</context>
<context>
    <name>device.gain-refused</name>
    <message>
        <source>was asked for a gain of {} but uses {}</source>
        <translation>se le pidió una ganancia de {} y se queda en {}</translation>
    </message>
</context>
<context>
    <name>device.genicam-missing</name>
    <message>
        <source>GigE Vision and USB3 Vision cameras: this build lacks Aravis; install libaravis-dev and build again</source>
        <translation>Cámaras GigE Vision y USB3 Vision: a este programa le falta Aravis; instale libaravis-dev y vuelva a compilarlo</translation>
    </message>
</context>
<context>
    <name>device.gphoto-missing</name>
    <message>
        <source>DSLR and mirrorless cameras: this build lacks libgphoto2 or LibRaw; install libgphoto2-dev and libraw-dev and build again</source>
        <translation>Cámaras réflex y sin espejo: a este programa le falta libgphoto2 o LibRaw; instale libgphoto2-dev y libraw-dev y vuelva a compilarlo</translation>
    </message>
</context>
<context>
    <name>device.held-by-desktop</name>
    <message>
        <source>another program is using the camera, usually the desktop, which mounts it like a memory stick</source>
        <translation>otro programa está usando la cámara, normalmente el escritorio, que la monta como una memoria USB</translation>
    </message>
</context>
<context>
    <name>device.install-aravis</name>
    <message>
        <source>install Aravis (libaravis-dev) and build again, or use another kind of camera</source>
        <translation>instale Aravis (libaravis-dev) y vuelva a compilar, o use otro tipo de cámara</translation>
    </message>
</context>
<context>
    <name>device.install-libgphoto2</name>
    <message>
        <source>install libgphoto2 and LibRaw (libgphoto2-dev, libraw-dev) and build again, or use a command</source>
        <translation>instale libgphoto2 y LibRaw (libgphoto2-dev, libraw-dev) y vuelva a compilar, o use un comando</translation>
    </message>
</context>
<context>
    <name>device.iso-refused</name>
    <message>
        <source>was asked for ISO {} but uses ISO {}</source>
        <translation>se le pidió ISO {} y se queda en ISO {}</translation>
    </message>
</context>
<context>
    <name>device.iso-wanted-not-there</name>
    <message>
        <source>ISO {} is wanted and the camera does not have it</source>
        <translation>se pide ISO {} y la cámara no lo tiene</translation>
    </message>
</context>
<context>
    <name>device.lift-exposure-limits</name>
    <message>
        <source>switch its automatic exposure and its frame rate limit off</source>
        <translation>desactive su exposición automática y su límite de velocidad de fotogramas</translation>
    </message>
</context>
<context>
    <name>device.longest-exposure-overstated</name>
    <message>
        <source>claims exposures up to {} s but reaches only {} s</source>
        <translation>declara exposiciones de hasta {} s pero se queda en {} s</translation>
    </message>
</context>
<context>
    <name>device.may-fire-flash</name>
    <message>
        <source>may fire its flash: close it</source>
        <translation>puede disparar el flash: ciérrelo</translation>
    </message>
</context>
<context>
    <name>device.may-take-dark-frame</name>
    <message>
        <source>may take a dark frame after long exposures, which doubles their time</source>
        <translation>puede tomar una imagen oscura tras exposiciones largas, lo que duplica su tiempo</translation>
    </message>
</context>
<context>
    <name>device.may-take-several-photographs</name>
    <message>
        <source>may take several photographs at once: switch it to single shots</source>
        <translation>puede tomar varias fotografías a la vez: póngala en disparo único</translation>
    </message>
</context>
<context>
    <name>device.mode-dial-not-manual</name>
    <message>
        <source>the camera&apos;s mode dial is set to {}, where the camera chooses exposures itself</source>
        <translation>el dial de modos de la cámara está en {}, donde la cámara elige ella misma las exposiciones</translation>
    </message>
</context>
<context>
    <name>device.name-camera-by-port</name>
    <message>
        <source>name one by its port: gphoto2:{} or gphoto2:{}</source>
        <translation>indique una por su puerto: gphoto2:{} o gphoto2:{}</translation>
    </message>
</context>
<context>
    <name>device.name-connected-camera</name>
    <message>
        <source>name that one: gphoto2:{}</source>
        <translation>indique esa: gphoto2:{}</translation>
    </message>
</context>
<context>
    <name>device.no-capture-times</name>
    <message>
        <source>does not say when pictures were captured: some are dropped before each photograph</source>
        <translation>no indica cuándo se captaron las imágenes: se descartan algunas antes de cada fotografía</translation>
    </message>
</context>
<context>
    <name>device.no-contrast</name>
    <message>
        <source>the camera sees no difference between white and black</source>
        <translation>la cámara no ve diferencia entre blanco y negro</translation>
    </message>
</context>
<context>
    <name>device.no-focus</name>
    <message>
        <source>the camera could not focus and took no photograph ({})</source>
        <translation>la cámara no ha podido enfocar y no ha tomado ninguna fotografía ({})</translation>
    </message>
</context>
<context>
    <name>device.no-genicam-camera-answers</name>
    <message>
        <source>no GenICam camera &apos;{}&apos; answers</source>
        <translation>no responde ninguna cámara GenICam «{}»</translation>
    </message>
</context>
<context>
    <name>device.no-photograph-came</name>
    <message>
        <source>a photograph was asked for and none came</source>
        <translation>se pidió una fotografía y no llegó ninguna</translation>
    </message>
</context>
<context>
    <name>device.no-raw-file-sent</name>
    <message>
        <source>the camera sent {} and no raw file</source>
        <translation>la cámara ha enviado {} y ningún archivo RAW</translation>
    </message>
</context>
<context>
    <name>device.no-raw-files</name>
    <message>
        <source>the camera does not deliver raw files</source>
        <translation>la cámara no entrega archivos RAW</translation>
    </message>
</context>
<context>
    <name>device.no-readable-pixel-format</name>
    <message>
        <source>none of the camera&apos;s pixel formats can be read</source>
        <translation>no se puede leer ninguno de los formatos de píxel de la cámara</translation>
    </message>
</context>
<context>
    <name>device.no-software-trigger</name>
    <message>
        <source>has no software trigger: each photograph may wait for one more exposure</source>
        <translation>no tiene disparo por software: cada fotografía puede esperar una exposición más</translation>
    </message>
</context>
<context>
    <name>device.no-video-pictures</name>
    <message>
        <source>the video device sends no pictures</source>
        <translation>el dispositivo de vídeo no envía imágenes</translation>
    </message>
</context>
<context>
    <name>device.only-other-camera-connected</name>
    <message>
        <source>no camera of this name is plugged in, but {} is</source>
        <translation>no hay conectada ninguna cámara con ese nombre, pero sí {}</translation>
    </message>
</context>
<context>
    <name>device.other-screen-seen</name>
    <message>
        <source>the camera sees {}, not {}</source>
        <translation>la cámara ve {} y no {}</translation>
    </message>
</context>
<context>
    <name>device.part-of-sensor-lost</name>
    <message>
        <source>the camera does not go back to the part of the sensor that it had</source>
        <translation>la cámara no vuelve a la parte del sensor que tenía</translation>
    </message>
</context>
<context>
    <name>device.parts-lost-on-the-way</name>
    <message>
        <source>parts of the photograph were lost on the way</source>
        <translation>partes de la fotografía se perdieron por el camino</translation>
    </message>
</context>
<context>
    <name>device.photograph-attempts-failed</name>
    <message>
        <source>{} attempts at a photograph failed: {}</source>
        <translation>han fallado {} intentos de tomar una fotografía: {}</translation>
    </message>
</context>
<context>
    <name>device.photograph-exceeds-sensor</name>
    <message>
        <source>{} pixels are wanted and the camera has {}</source>
        <translation>se piden {} píxeles y la cámara tiene {}</translation>
    </message>
</context>
<context>
    <name>device.photograph-format-changed</name>
    <message>
        <source>the photograph has {} pixels as {} where {} as {} were agreed</source>
        <translation>la fotografía tiene {} píxeles en formato {} cuando se habían acordado {} en formato {}</translation>
    </message>
</context>
<context>
    <name>device.photograph-larger-than-announced</name>
    <message>
        <source>the photograph is larger than the camera announced</source>
        <translation>la fotografía es mayor de lo que anunció la cámara</translation>
    </message>
</context>
<context>
    <name>device.photograph-not-finished</name>
    <message>
        <source>the photograph was not finished</source>
        <translation>la fotografía no se completó</translation>
    </message>
</context>
<context>
    <name>device.photograph-size-refused</name>
    <message>
        <source>{} pixels are wanted and the camera gives {}</source>
        <translation>se piden {} píxeles y la cámara da {}</translation>
    </message>
</context>
<context>
    <name>device.photograph-size-unexpected</name>
    <message>
        <source>the photograph has {} pixels where {} were announced</source>
        <translation>la fotografía tiene {} píxeles cuando se habían anunciado {}</translation>
    </message>
</context>
<context>
    <name>device.photograph-timed-out</name>
    <message>
        <source>no photograph came within {} s</source>
        <translation>no ha llegado ninguna fotografía en {} s</translation>
    </message>
</context>
<context>
    <name>device.photograph-truncated</name>
    <message>
        <source>a photograph of {} pixels as {} came with {} of {} bytes</source>
        <translation>una fotografía de {} píxeles en formato {} ha llegado con {} de {} bytes</translation>
    </message>
</context>
<context>
    <name>device.picture-not-settled</name>
    <message>
        <source>a new picture has not fully appeared after {} frames</source>
        <translation>una imagen nueva no aparece por completo tras {} fotogramas</translation>
    </message>
</context>
<context>
    <name>device.pixel-format-lost</name>
    <message>
        <source>the camera has forgotten the pixel format that it was set to</source>
        <translation>la cámara ha olvidado el formato de píxel que se le había fijado</translation>
    </message>
</context>
<context>
    <name>device.pixel-format-not-offered</name>
    <message>
        <source>the camera has no pixel format {} that can be read</source>
        <translation>la cámara no tiene un formato de píxel {} que se pueda leer</translation>
    </message>
</context>
<context>
    <name>device.projector-command-empty</name>
    <message>
        <source>the projector&apos;s command is empty</source>
        <translation>la orden del proyector está vacía</translation>
    </message>
</context>
<context>
    <name>device.projector-command-lacks</name>
    <message>
        <source>the projector&apos;s command does not contain {}</source>
        <translation>en la orden del proyector falta {}</translation>
    </message>
</context>
<context>
    <name>device.projector-size-out-of-range</name>
    <message>
        <source>a projector of {} pixels is impossible: each side is {} to {}</source>
        <translation>un proyector de {} píxeles es imposible: cada lado tiene de {} a {}</translation>
    </message>
</context>
<context>
    <name>device.projector-unseen</name>
    <message>
        <source>no camera sees what is shown on {}</source>
        <translation>ninguna cámara ve lo que se muestra en {}</translation>
    </message>
</context>
<context>
    <name>device.push-cable-in</name>
    <message>
        <source>push in the camera&apos;s cable at both ends</source>
        <translation>encaje el cable de la cámara en ambos extremos</translation>
    </message>
</context>
<context>
    <name>device.raw-file-empty</name>
    <message>
        <source>it is empty</source>
        <translation>está vacío</translation>
    </message>
</context>
<context>
    <name>device.raw-file-incomplete</name>
    <message>
        <source>parts of it are missing</source>
        <translation>faltan partes del archivo</translation>
    </message>
</context>
<context>
    <name>device.raw-file-unreadable</name>
    <message>
        <source>the raw file cannot be read ({})</source>
        <translation>no se puede leer el archivo RAW ({})</translation>
    </message>
</context>
<context>
    <name>device.raw-file-without-sensor-values</name>
    <message>
        <source>the raw file does not hold the sensor&apos;s own values</source>
        <translation>el archivo RAW no contiene los valores propios del sensor</translation>
    </message>
</context>
<context>
    <name>device.reconnect-same-camera</name>
    <message>
        <source>connect the camera that the measurement was begun with</source>
        <translation>conecte la cámara con la que se empezó la medición</translation>
    </message>
</context>
<context>
    <name>device.reconnected-camera-size-differs</name>
    <message>
        <source>the camera came back with {} pixels instead of {}</source>
        <translation>la cámara ha vuelto con {} píxeles en lugar de {}</translation>
    </message>
</context>
<context>
    <name>device.release-from-desktop</name>
    <message>
        <source>make the desktop release it with `gio mount -s gphoto2` (or eject it in the file manager) and close photo programs</source>
        <translation>haga que el escritorio la libere con `gio mount -s gphoto2` (o expúlsela en el gestor de archivos) y cierre los programas de fotografía</translation>
    </message>
</context>
<context>
    <name>device.remove-file-by-hand</name>
    <message>
        <source>remove it by hand, then try again</source>
        <translation>elimínelo a mano e inténtelo de nuevo</translation>
    </message>
</context>
<context>
    <name>device.request-refused</name>
    <message>
        <source>the camera refused what it was asked for ({})</source>
        <translation>la cámara ha rechazado lo que se le pidió ({})</translation>
    </message>
</context>
<context>
    <name>device.restart-or-change-pixel-format</name>
    <message>
        <source>switch the camera off and on, or choose another of its pixel formats</source>
        <translation>apague y vuelva a encender la cámara o elija otro de sus formatos de píxel</translation>
    </message>
</context>
<context>
    <name>device.restart-with-default-settings</name>
    <message>
        <source>switch it off and on, load its default settings with its maker&apos;s program, and try again</source>
        <translation>apáguela y vuelva a encenderla, cargue sus ajustes predeterminados con el programa del fabricante e inténtelo de nuevo</translation>
    </message>
</context>
<context>
    <name>device.run-command-in-terminal</name>
    <message>
        <source>run it in a terminal to find out why: {}</source>
        <translation>ejecútelo en un terminal para averiguar la causa: {}</translation>
    </message>
</context>
<context>
    <name>device.screen-loses-picture</name>
    <message>
        <source>the projector&apos;s screen keeps losing its picture</source>
        <translation>la pantalla del proyector pierde la imagen una y otra vez</translation>
    </message>
</context>
<context>
    <name>device.screen-not-seen</name>
    <message>
        <source>the camera does not see what is shown on {}</source>
        <translation>la cámara no ve lo que se muestra en {}</translation>
    </message>
</context>
<context>
    <name>device.screen-twice</name>
    <message>
        <source>screen {} is projector {} and projector {}: choose another screen</source>
        <translation>la pantalla {} es el proyector {} y el proyector {}: elija otra pantalla</translation>
    </message>
</context>
<context>
    <name>device.sees-no-colours</name>
    <message>
        <source>sees no colours: brightness can be compensated, colours cannot</source>
        <translation>no ve colores: se puede compensar el brillo, no los colores</translation>
    </message>
</context>
<context>
    <name>device.set-iso-100</name>
    <message>
        <source>set it to ISO 100 by hand</source>
        <translation>ajústela a mano a ISO 100</translation>
    </message>
</context>
<context>
    <name>device.set-manual-exposure-mode</name>
    <message>
        <source>set its exposure mode to timed and manual, or update its firmware</source>
        <translation>ponga su modo de exposición en temporizado y manual o actualice su firmware</translation>
    </message>
</context>
<context>
    <name>device.several-cameras-of-model</name>
    <message>
        <source>{} cameras of this model are plugged in</source>
        <translation>hay {} cámaras de este modelo conectadas</translation>
    </message>
</context>
<context>
    <name>device.shortest-exposure-understated</name>
    <message>
        <source>claims exposures from {} s but does not go below {} s</source>
        <translation>declara exposiciones desde {} s pero se queda en {} s</translation>
    </message>
</context>
<context>
    <name>device.simulated-camera-unplugged</name>
    <message>
        <source>the camera&apos;s cable is out</source>
        <translation>el cable de la cámara está suelto</translation>
    </message>
</context>
<context>
    <name>device.steady-view-and-expose-briefly</name>
    <message>
        <source>check that the camera&apos;s view is steady and its exposure short, and switch the projector&apos;s smoothing of motion off</source>
        <translation>compruebe que la imagen de la cámara es estable y su exposición corta, y desactive el suavizado de movimiento del proyector</translation>
    </message>
</context>
<context>
    <name>device.switch-off-automatic-exposure</name>
    <message>
        <source>switch its automatic exposure off; a camera without manual exposure cannot be used</source>
        <translation>desactive su exposición automática; no se puede usar una cámara sin exposición manual</translation>
    </message>
</context>
<context>
    <name>device.switch-off-with-makers-program</name>
    <message>
        <source>switch it off with the camera maker&apos;s program, or use another camera</source>
        <translation>desactívelo con el programa del fabricante de la cámara o use otra cámara</translation>
    </message>
</context>
<context>
    <name>device.switch-off-with-v4l2-ctl</name>
    <message>
        <source>switch it off with v4l2-ctl (--list-ctrls names what it has), or use another camera</source>
        <translation>desactívelo con v4l2-ctl (--list-ctrls enumera los controles disponibles) o use otra cámara</translation>
    </message>
</context>
<context>
    <name>device.switch-on-and-keep-awake</name>
    <message>
        <source>check its cable, switch it on and disable its automatic power-off</source>
        <translation>revise su cable, enciéndala y desactive su apagado automático</translation>
    </message>
</context>
<context>
    <name>device.switch-quality-to-raw</name>
    <message>
        <source>switch its picture quality to RAW by hand; a camera without RAW cannot be used</source>
        <translation>ponga a mano su calidad de imagen en RAW; no se puede usar una cámara sin RAW</translation>
    </message>
</context>
<context>
    <name>device.switch-to-full-size-raw</name>
    <message>
        <source>switch the camera to full-size RAW (no sRAW, mRAW, no linear DNG)</source>
        <translation>ponga la cámara en RAW de tamaño completo (ni sRAW, ni mRAW, ni DNG lineal)</translation>
    </message>
</context>
<context>
    <name>device.switch-to-manual-focus</name>
    <message>
        <source>switch its lens to manual focus</source>
        <translation>ponga su objetivo en enfoque manual</translation>
    </message>
</context>
<context>
    <name>device.switches-itself-off</name>
    <message>
        <source>switches itself off after a while: switch that off</source>
        <translation>se apaga sola al cabo de un rato: desactívelo</translation>
    </message>
</context>
<context>
    <name>device.take-photograph-by-hand</name>
    <message>
        <source>switch its lens to manual focus, close its menus, and take a photograph by hand to see what it complains of</source>
        <translation>ponga su objetivo en enfoque manual, cierre sus menús y tome una fotografía a mano para ver de qué se queja</translation>
    </message>
</context>
<context>
    <name>device.then-go-on</name>
    <message>
        <source>{}, then go on: every photograph so far is kept</source>
        <translation>{}; después, continúe: todas las fotografías tomadas hasta ahora se conservan</translation>
    </message>
</context>
<context>
    <name>device.trial-photograph-failed</name>
    <message>
        <source>the camera was asked for a photograph and took none</source>
        <translation>se pidió una fotografía a la cámara y no tomó ninguna</translation>
    </message>
</context>
<context>
    <name>device.turn-dial-or-change-camera</name>
    <message>
        <source>turn its mode dial to M; a camera without manual exposure cannot be used</source>
        <translation>gire su dial de modos a M; no se puede usar una cámara que no lo tenga</translation>
    </message>
</context>
<context>
    <name>device.turn-dial-to-m</name>
    <message>
        <source>turn it to M</source>
        <translation>gírelo a M</translation>
    </message>
</context>
<context>
    <name>device.use-manual-exposure-camera</name>
    <message>
        <source>use a camera with manual exposure</source>
        <translation>use una cámara con exposición manual</translation>
    </message>
</context>
<context>
    <name>device.video-device</name>
    <message>
        <source>video device</source>
        <translation>dispositivo de vídeo</translation>
    </message>
</context>
<context>
    <name>device.video-device-in-use</name>
    <message>
        <source>the video device cannot be opened: another program may be using it</source>
        <translation>no se puede abrir el dispositivo de vídeo: quizá lo esté usando otro programa</translation>
    </message>
</context>
<context>
    <name>device.video-device-missing</name>
    <message>
        <source>no such video device is plugged in</source>
        <translation>no está conectado ese dispositivo de vídeo</translation>
    </message>
</context>
<context>
    <name>device.video-device-unplugged</name>
    <message>
        <source>the video device has been unplugged</source>
        <translation>el dispositivo de vídeo se ha desconectado</translation>
    </message>
</context>
<context>
    <name>device.video-exposure-not-settable</name>
    <message>
        <source>the video device has no exposure that can be set</source>
        <translation>el dispositivo de vídeo no tiene una exposición ajustable</translation>
    </message>
</context>
<context>
    <name>device.video-size-refused</name>
    <message>
        <source>{} pixels are wanted and the video device gives {}</source>
        <translation>se piden {} píxeles y el dispositivo de vídeo da {}</translation>
    </message>
</context>
<context>
    <name>device.wake-camera</name>
    <message>
        <source>press its shutter button half way or switch it off and on, and disable its automatic power-off</source>
        <translation>pulse el disparador hasta la mitad, o apáguela y vuelva a encenderla, y desactive su apagado automático</translation>
    </message>
</context>
<context>
    <name>device.write-announced-size</name>
    <message>
        <source>let the command write that size, or begin again with the size that the camera delivers</source>
        <translation>haga que el comando escriba ese tamaño o empiece de nuevo con el tamaño que entrega la cámara</translation>
    </message>
</context>
<context>
    <name>device.write-photograph-to-output</name>
    <message>
        <source>let it write the photograph to {output}: {}</source>
        <translation>haga que escriba la fotografía en {output}: {}</translation>
    </message>
</context>
<context>
    <name>disk.cannot-create-folder</name>
    <message>
        <source>cannot create the folder ({})</source>
        <translation>no se puede crear la carpeta ({})</translation>
    </message>
</context>
<context>
    <name>disk.cannot-open</name>
    <message>
        <source>cannot open ({})</source>
        <translation>no se puede abrir ({})</translation>
    </message>
</context>
<context>
    <name>disk.cannot-read</name>
    <message>
        <source>cannot read ({})</source>
        <translation>no se puede leer ({})</translation>
    </message>
</context>
<context>
    <name>disk.cannot-write</name>
    <message>
        <source>cannot write ({})</source>
        <translation>no se puede escribir ({})</translation>
    </message>
</context>
<context>
    <name>disk.check-disk-and-cable</name>
    <message>
        <source>check the disk and its cable</source>
        <translation>revise el disco y su cable</translation>
    </message>
</context>
<context>
    <name>disk.check-path</name>
    <message>
        <source>check the path</source>
        <translation>revise la ruta</translation>
    </message>
</context>
<context>
    <name>disk.check-path-and-disk</name>
    <message>
        <source>check the path and the disk</source>
        <translation>revise la ruta y el disco</translation>
    </message>
</context>
<context>
    <name>disk.choose-scratch-folder</name>
    <message>
        <source>let the environment variable TMPDIR name a folder on a disk that you may write to; what has been photographed is safe</source>
        <translation>indique en la variable de entorno TMPDIR una carpeta de un disco en el que pueda escribir; lo fotografiado está a salvo</translation>
    </message>
</context>
<context>
    <name>disk.choose-writable-folder</name>
    <message>
        <source>choose a folder that you may write to, or ask for the permission</source>
        <translation>elija una carpeta en la que pueda escribir o solicite el permiso</translation>
    </message>
</context>
<context>
    <name>disk.free-scratch-room</name>
    <message>
        <source>free some space there; what has been photographed is safe</source>
        <translation>libere espacio allí; lo fotografiado está a salvo</translation>
    </message>
</context>
<context>
    <name>disk.free-space-or-check-disk</name>
    <message>
        <source>free some space there or check the disk, then try again</source>
        <translation>libere espacio allí o revise el disco e inténtelo de nuevo</translation>
    </message>
</context>
<context>
    <name>disk.free-space-or-choose-another</name>
    <message>
        <source>free some space there or choose another disk, then try again</source>
        <translation>libere espacio allí o elija otro disco e inténtelo de nuevo</translation>
    </message>
</context>
<context>
    <name>disk.no-scratch-room</name>
    <message>
        <source>there is no room for intermediate results ({})</source>
        <translation>no hay espacio para resultados intermedios ({})</translation>
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
        <translation>menos de un minuto</translation>
    </message>
</context>
<context>
    <name>engine.compute-on-processor</name>
    <message>
        <source>compute on the processor instead</source>
        <translation>deje que el procesador haga el trabajo</translation>
    </message>
</context>
<context>
    <name>engine.graphics-buffer-too-large</name>
    <message>
        <source>the graphics card can hold {} MB in one piece, but {} MB are needed</source>
        <translation>la tarjeta gráfica alcanza {} MB a la vez y se necesitan {} MB</translation>
    </message>
</context>
<context>
    <name>engine.graphics-card-lost</name>
    <message>
        <source>the graphics card was lost</source>
        <translation>se ha perdido la tarjeta gráfica</translation>
    </message>
</context>
<context>
    <name>engine.graphics-card-unusable</name>
    <message>
        <source>the graphics card cannot be used</source>
        <translation>no se puede usar la tarjeta gráfica</translation>
    </message>
</context>
<context>
    <name>engine.graphics-memory-exhausted</name>
    <message>
        <source>the graphics card has no {} MB of memory left</source>
        <translation>a la tarjeta gráfica no le quedan {} MB de memoria</translation>
    </message>
</context>
<context>
    <name>engine.install-driver</name>
    <message>
        <source>install the graphics card&apos;s driver, or compute on the processor</source>
        <translation>instale el controlador de la tarjeta gráfica o deje que el procesador haga el trabajo</translation>
    </message>
</context>
<context>
    <name>engine.no-graphics-card</name>
    <message>
        <source>there is no graphics card with OpenGL 4.3 and compute shaders</source>
        <translation>no hay ninguna tarjeta gráfica con OpenGL 4.3 y compute shaders</translation>
    </message>
</context>
<context>
    <name>engine.no-libegl-or-libopengl</name>
    <message>
        <source>there is no libEGL or no libOpenGL, which open graphics cards without a display</source>
        <translation>falta libEGL o libOpenGL, que abren tarjetas gráficas sin pantalla</translation>
    </message>
</context>
<context>
    <name>engine.no-opengl</name>
    <message>
        <source>there is no OpenGL 4.3 with compute shaders</source>
        <translation>no hay OpenGL 4.3 con compute shaders</translation>
    </message>
</context>
<context>
    <name>import.camera-taken-as-linear</name>
    <message>
        <source>The camera is taken to be linear, and one photograph counts as one second of exposure</source>
        <translation>se supone que la cámara es lineal, y una fotografía cuenta como un segundo de exposición</translation>
    </message>
</context>
<context>
    <name>import.lit-share</name>
    <message>
        <source>The projector lights {} % of the camera&apos;s pixels</source>
        <translation>el proyector ilumina el {} % de los píxeles de la cámara</translation>
    </message>
</context>
<context>
    <name>import.paired-by-time</name>
    <message>
        <source>The photographs were paired with the patterns in the order in which they were taken, from {} to {}, which is not that of their names</source>
        <translation>las fotografías se emparejaron con los patrones en el orden en que se tomaron, de {} a {}, que no es el de sus nombres</translation>
    </message>
</context>
<context>
    <name>import.patterns-and-photographs-grey</name>
    <message>
        <source>Patterns and photographs are grey: colours are not told apart, and T&apos;s blocks are neutral</source>
        <translation>los patrones y las fotografías son grises: no se distinguen los colores y los bloques de T son neutros</translation>
    </message>
</context>
<context>
    <name>import.patterns-black-and-white</name>
    <message>
        <source>The patterns hold black and white only: the projector&apos;s response is assumed to be a gamma of 2.2</source>
        <translation>los patrones solo contienen blanco y negro: se supone que la respuesta del proyector es una potencia de 2,2</translation>
    </message>
</context>
<context>
    <name>import.patterns-grey</name>
    <message>
        <source>The patterns are grey: how colours mix was not measured, and T&apos;s blocks are diagonal</source>
        <translation>los patrones son grises: no se midió cómo se mezclan los colores y los bloques de T son diagonales</translation>
    </message>
</context>
<context>
    <name>import.photographs-are-jpeg</name>
    <message>
        <source>The photographs are JPEG: they were made linear by the curve of sRGB, which cameras follow only roughly; develop them linearly, as TIFF or EXR, to measure more exactly</source>
        <translation>las fotografías son JPEG: se linealizaron con la curva de sRGB, que las cámaras solo siguen aproximadamente; revélelas linealmente, como TIFF o EXR, para medir con más exactitud</translation>
    </message>
</context>
<context>
    <name>import.photographs-grey</name>
    <message>
        <source>The photographs are grey: what each of the projector&apos;s colours contributes is known in brightness only</source>
        <translation>las fotografías son grises: lo que aporta cada color del proyector solo se conoce en luminosidad</translation>
    </message>
</context>
<context>
    <name>linearization.choose-overlapping-exposures</name>
    <message>
        <source>set them to ranges of exposure times that overlap</source>
        <translation>ajústelas a intervalos de tiempos de exposición que se solapen</translation>
    </message>
</context>
<context>
    <name>linearization.halves-brighter-than-whole</name>
    <message>
        <source>{}: two halves of a picture are {} % brighter than the whole; switch off the dynamic iris, dynamic contrast and any picture mode that adapts to the content</source>
        <translation>{}: dos mitades de una imagen son un {} % más claras que el conjunto; desactive el iris dinámico, el contraste dinámico y todo modo de imagen que se adapte al contenido</translation>
    </message>
</context>
<context>
    <name>linearization.halves-darker-than-whole</name>
    <message>
        <source>{}: two halves of a picture are {} % darker than the whole; switch off the dynamic iris, dynamic contrast and any picture mode that adapts to the content</source>
        <translation>{}: dos mitades de una imagen son un {} % más oscuras que el conjunto; desactive el iris dinámico, el contraste dinámico y todo modo de imagen que se adapte al contenido</translation>
    </message>
</context>
<context>
    <name>linearization.highlights-overexposed</name>
    <message>
        <source>{}: some highlights are overexposed even at {} s, the shortest exposure, and will not be compensated; close the aperture or add a grey filter if they matter</source>
        <translation>{}: algunos brillos están sobreexpuestos incluso a {} s, la exposición más corta, y no se compensarán; cierre el diafragma o añada un filtro gris si son importantes</translation>
    </message>
</context>
<context>
    <name>linearization.light-flickers</name>
    <message>
        <source>{}: the light changes by {} % from one photograph to the next; switch off the projector&apos;s dynamic lamp modes and other lamps nearby, and choose exposure times that are multiples of the mains period</source>
        <translation>{}: la luz cambia un {} % de una fotografía a la siguiente; desactive los modos de lámpara dinámicos del proyector, apague otras lámparas cercanas y elija tiempos de exposición que sean múltiplos del período de la red eléctrica</translation>
    </message>
</context>
<context>
    <name>linearization.no-common-exposure</name>
    <message>
        <source>the cameras have no exposure time in common</source>
        <translation>las cámaras no tienen ningún tiempo de exposición en común</translation>
    </message>
</context>
<context>
    <name>linearization.overexposed</name>
    <message>
        <source>{}: the projection is overexposed even at {} s, the shortest exposure; close the aperture, lower the gain or add a grey filter</source>
        <translation>{}: la proyección está sobreexpuesta incluso a {} s, la exposición más corta; cierre el diafragma, reduzca la ganancia o añada un filtro gris</translation>
    </message>
</context>
<context>
    <name>linearization.response-uneven</name>
    <message>
        <source>{}: the brightness curves are not the same everywhere in its picture, by up to {} % of white; switch off uniformity correction, local dimming and edge blending in the projector</source>
        <translation>{}: las curvas de brillo no son iguales en toda la imagen, con diferencias de hasta un {} % del blanco; desactive la corrección de uniformidad, la atenuación local y la fusión de bordes en el proyector</translation>
    </message>
</context>
<context>
    <name>linearization.underexposed</name>
    <message>
        <source>{}: the projection reaches only {} % of the camera&apos;s range at {} s, the longest exposure; open the aperture or raise the gain</source>
        <translation>{}: la proyección solo alcanza el {} % del rango de la cámara a {} s, la exposición más larga; abra el diafragma o aumente la ganancia</translation>
    </message>
</context>
<context>
    <name>linearization.white-brighter-than-colours</name>
    <message>
        <source>{}: white is {} % brighter than red, green and blue together; switch off the white segment (often called brilliant colour or bright mode) and choose a picture mode for video or sRGB</source>
        <translation>{}: el blanco es un {} % más claro que el rojo, el verde y el azul juntos; desactive el segmento blanco (a menudo llamado «Brilliant Color» o modo brillante) y elija un modo de imagen para vídeo o sRGB</translation>
    </message>
</context>
<context>
    <name>linearization.white-darker-than-colours</name>
    <message>
        <source>{}: white is {} % darker than red, green and blue together; switch off power saving, colour management and dynamic picture modes</source>
        <translation>{}: el blanco es un {} % más oscuro que el rojo, el verde y el azul juntos; desactive el ahorro de energía, la gestión de color y los modos de imagen dinámicos</translation>
    </message>
</context>
<context>
    <name>masks.draw-again</name>
    <message>
        <source>draw it again, or correct the file</source>
        <translation>dibújela de nuevo o corrija el archivo</translation>
    </message>
</context>
<context>
    <name>masks.unknown-key</name>
    <message>
        <source>mask {} has &quot;{}&quot;, which this version does not know</source>
        <translation>la máscara {} tiene «{}», que esta versión no conoce</translation>
    </message>
</context>
<context>
    <name>masks.unreadable</name>
    <message>
        <source>mask {} cannot be read: it needs points as [[x, y], ...], and may have camera, outline and feather</source>
        <translation>la máscara {} no se puede leer: necesita points como [[x, y], ...] y puede tener camera, outline y feather</translation>
    </message>
</context>
<context>
    <name>night.hours-began</name>
    <message>
        <source>the show&apos;s hours began before it was done</source>
        <translation>las horas del espectáculo empezaron antes de que terminara</translation>
    </message>
</context>
<context>
    <name>night.missed</name>
    <message>
        <source>it could not begin within two hours of its time: the show did not run, or the computer slept</source>
        <translation>no pudo empezar en las dos horas siguientes a su hora: el espectáculo no funcionaba o el ordenador dormía</translation>
    </message>
</context>
<context>
    <name>night.not-as-predicted</name>
    <message>
        <source>the picture has a colour error of {} where {} was predicted, and no repair helped</source>
        <translation>la imagen tiene un error de color de {} donde se predecía {}, y ninguna reparación ayudó</translation>
    </message>
</context>
<context>
    <name>night.part-not-as-predicted</name>
    <message>
        <source>a part of the surface looks otherwise than predicted, by a colour error of {}, and no repair helped</source>
        <translation>una parte de la superficie no se ve como se predijo, con un error de color de {}, y ninguna reparación ayudó</translation>
    </message>
</context>
<context>
    <name>night.too-long</name>
    <message>
        <source>it was not done within six hours</source>
        <translation>no terminó en seis horas</translation>
    </message>
</context>
<context>
    <name>perfect.camera-blinded</name>
    <message>
        <source>something blinds the camera: {} of its view is overexposed</source>
        <translation>algo deslumbra la cámara: el {} de su imagen está sobreexpuesto</translation>
    </message>
</context>
<context>
    <name>perfect.camera-moved</name>
    <message>
        <source>the view of camera {} has moved by {}, {} pixels since the venue was measured</source>
        <translation>el encuadre de la cámara {} se ha desplazado {}, {} píxeles desde la medición</translation>
    </message>
</context>
<context>
    <name>perfect.light-missing</name>
    <message>
        <source>light is missing: is the lens covered, or a projector asleep?</source>
        <translation>falta luz: ¿está tapado el objetivo o hay un proyector en reposo?</translation>
    </message>
</context>
<context>
    <name>perfect.something-else</name>
    <message>
        <source>the camera sees something else than expected: did somebody stand in the light, or did the room&apos;s light change?</source>
        <translation>la cámara ve algo distinto de lo esperado: ¿había alguien en la luz o cambió la luz de la sala?</translation>
    </message>
</context>
<context>
    <name>pjlink.address-twice</name>
    <message>
        <source>projectors {} and {} have the same address, {}</source>
        <translation>los proyectores {} y {} tienen la misma dirección, {}</translation>
    </message>
</context>
<context>
    <name>pjlink.cannot-search</name>
    <message>
        <source>projectors cannot be searched ({})</source>
        <translation>no se pueden buscar proyectores ({})</translation>
    </message>
</context>
<context>
    <name>pjlink.check-address-and-port</name>
    <message>
        <source>check the address and the port of the projector</source>
        <translation>compruebe la dirección y el puerto del proyector</translation>
    </message>
</context>
<context>
    <name>pjlink.check-lens</name>
    <message>
        <source>check lens caps, shutter and input of the projector, and where the camera looks</source>
        <translation>compruebe las tapas de los objetivos, el obturador y la entrada del proyector, y hacia dónde mira la cámara</translation>
    </message>
</context>
<context>
    <name>pjlink.check-network</name>
    <message>
        <source>check its address, its network cable, and that PJLink and the network in standby are switched on in its menu</source>
        <translation>compruebe su dirección, su cable de red y que PJLink y la red en espera estén activados en su menú</translation>
    </message>
</context>
<context>
    <name>pjlink.check-own-network</name>
    <message>
        <source>check this computer&apos;s network, or give the projector&apos;s address</source>
        <translation>compruebe la red de este ordenador, o indique la dirección del proyector</translation>
    </message>
</context>
<context>
    <name>pjlink.choose-class-one-authentication</name>
    <message>
        <source>choose the authentication of PJLink class 1 in its menu, or none</source>
        <translation>elija en su menú la autenticación de PJLink clase 1, o ninguna</translation>
    </message>
</context>
<context>
    <name>pjlink.closed</name>
    <message>
        <source>it closed the connection</source>
        <translation>cerró la conexión</translation>
    </message>
</context>
<context>
    <name>pjlink.end-dimming</name>
    <message>
        <source>switch off its dynamic contrast, lamp dimming and eco modes, and daylight in the room; or measure without waiting for its lamp</source>
        <translation>desactive el contraste dinámico, la atenuación de la lámpara y los modos eco, y evite la luz del día; o mida sin esperar a su lámpara</translation>
    </message>
</context>
<context>
    <name>pjlink.frozen</name>
    <message>
        <source>projector {} freezes its picture: end that in its menu</source>
        <translation>el proyector {} congela su imagen: desactívelo en su menú</translation>
    </message>
</context>
<context>
    <name>pjlink.give-password</name>
    <message>
        <source>give the PJLink password that is set in its menu</source>
        <translation>indique la contraseña de PJLink que figura en su menú</translation>
    </message>
</context>
<context>
    <name>pjlink.light-drifts</name>
    <message>
        <source>the light of projector {} still drifts by {} % within {} s after {} s</source>
        <translation>la luz del proyector {0} aún varía un {1} % en {2} s después de {3} s</translation>
    </message>
</context>
<context>
    <name>pjlink.light-unseen</name>
    <message>
        <source>no camera sees light of projector {}</source>
        <translation>ninguna cámara ve luz del proyector {}</translation>
    </message>
</context>
<context>
    <name>pjlink.look-at-projector</name>
    <message>
        <source>look at its lamps and its menu</source>
        <translation>mire sus indicadores y su menú</translation>
    </message>
</context>
<context>
    <name>pjlink.more-than-projectors</name>
    <message>
        <source>projector {} on the network is none of the {} that there are</source>
        <translation>el proyector {} en la red no es ninguno de los {} que hay</translation>
    </message>
</context>
<context>
    <name>pjlink.newer-authentication</name>
    <message>
        <source>the projector at {} asks for its password in a way that this version does not know</source>
        <translation>el proyector en {} pide su contraseña de un modo que esta versión no conoce</translation>
    </message>
</context>
<context>
    <name>pjlink.no-answer</name>
    <message>
        <source>the projector at {} does not answer ({})</source>
        <translation>el proyector en {} no responde ({})</translation>
    </message>
</context>
<context>
    <name>pjlink.no-signal</name>
    <message>
        <source>projector {} has no signal at its input {}: choose the input of this computer</source>
        <translation>el proyector {} no tiene señal en su entrada {}: elija la entrada de este ordenador</translation>
    </message>
</context>
<context>
    <name>pjlink.not-native</name>
    <message>
        <source>projector {} receives {} pixels and has {}: it scales the picture, which blurs the compensation; send it its own size</source>
        <translation>el proyector {} recibe {} píxeles y tiene {}: escala la imagen, lo que desenfoca la compensación; envíele su propio tamaño</translation>
    </message>
</context>
<context>
    <name>pjlink.not-on</name>
    <message>
        <source>projector {} was told to switch on and is not on after {} s</source>
        <translation>se ordenó encender el proyector {} y no está encendido después de {} s</translation>
    </message>
</context>
<context>
    <name>pjlink.not-pjlink</name>
    <message>
        <source>what answers at {} does not speak PJLink</source>
        <translation>lo que responde en {} no habla PJLink</translation>
    </message>
</context>
<context>
    <name>pjlink.open-shutter-by-hand</name>
    <message>
        <source>open it at the projector, and start again</source>
        <translation>ábralo en el proyector y empiece de nuevo</translation>
    </message>
</context>
<context>
    <name>pjlink.other-signal</name>
    <message>
        <source>projector {} receives {} pixels where {} are sent: something between scales the picture, or it shows another input</source>
        <translation>el proyector {} recibe {} píxeles y se envían {}: algo intermedio escala la imagen, o muestra otra entrada</translation>
    </message>
</context>
<context>
    <name>pjlink.own-failure</name>
    <message>
        <source>the projector at {} reports a failure of its own</source>
        <translation>el proyector en {} comunica un fallo propio</translation>
    </message>
</context>
<context>
    <name>pjlink.part-cover</name>
    <message>
        <source>cover open</source>
        <translation>tapa abierta</translation>
    </message>
</context>
<context>
    <name>pjlink.part-fan</name>
    <message>
        <source>fan</source>
        <translation>ventilador</translation>
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
        <translation>lámpara</translation>
    </message>
</context>
<context>
    <name>pjlink.part-other</name>
    <message>
        <source>something else</source>
        <translation>otra cosa</translation>
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
        <translation>el proyector {} comunica un error: {}</translation>
    </message>
</context>
<context>
    <name>pjlink.reports-warning</name>
    <message>
        <source>projector {} warns: {}</source>
        <translation>el proyector {} avisa: {}</translation>
    </message>
</context>
<context>
    <name>pjlink.shutter-stays-closed</name>
    <message>
        <source>the shutter of projector {} does not open</source>
        <translation>el obturador del proyector {} no se abre</translation>
    </message>
</context>
<context>
    <name>pjlink.still-warming</name>
    <message>
        <source>projector {} is still warming up or cooling down after {} s</source>
        <translation>el proyector {} sigue calentándose o enfriándose después de {} s</translation>
    </message>
</context>
<context>
    <name>pjlink.switch-on-by-hand</name>
    <message>
        <source>look at its lamps and its menu, switch it on by hand, and start again</source>
        <translation>mire sus indicadores y su menú, enciéndalo a mano y empiece de nuevo</translation>
    </message>
</context>
<context>
    <name>pjlink.too-slow</name>
    <message>
        <source>nothing complete came in time</source>
        <translation>no llegó nada completo a tiempo</translation>
    </message>
</context>
<context>
    <name>pjlink.wants-password</name>
    <message>
        <source>the projector at {} asks for a password</source>
        <translation>el proyector en {} pide una contraseña</translation>
    </message>
</context>
<context>
    <name>pjlink.wrong-password</name>
    <message>
        <source>the projector at {} refuses the password</source>
        <translation>el proyector en {} rechaza la contraseña</translation>
    </message>
</context>
<context>
    <name>reduction.binned</name>
    <message>
        <source>of the camera&apos;s {} pixels, {} are made: of the part around what is lit, every {} become one</source>
        <translation>de los {} píxeles de la cámara se hacen {}: de la parte en torno a lo iluminado, cada {} se convierten en uno</translation>
    </message>
</context>
<context>
    <name>reduction.binned-for-memory</name>
    <message>
        <source>of the camera&apos;s {} pixels, {} are made: every {} become one, as there is memory for no more</source>
        <translation>de los {} píxeles de la cámara se hacen {}: cada {} se convierten en uno, porque no hay memoria para más</translation>
    </message>
</context>
<context>
    <name>reduction.cropped</name>
    <message>
        <source>of the camera&apos;s {} pixels, the {} around what is lit are used</source>
        <translation>de los {} píxeles de la cámara se usan los {} en torno a lo iluminado</translation>
    </message>
</context>
<context>
    <name>reduction.fewer-camera-pixels</name>
    <message>
        <source>choose fewer camera pixels: automatic ones are as many as fit</source>
        <translation>elija menos píxeles de cámara: en automático son tantos como caben</translation>
    </message>
</context>
<context>
    <name>reduction.memory-too-little</name>
    <message>
        <source>measuring would take {} GB of memory, and {} GB may be taken</source>
        <translation>medir necesitaría {} GB de memoria, y hay {} GB disponibles</translation>
    </message>
</context>
<context>
    <name>reduction.more-memory-or-smaller-projector</name>
    <message>
        <source>use a computer or a limit with more memory, or a projector signal of fewer pixels</source>
        <translation>use un ordenador o un límite con más memoria, o una señal de proyector con menos píxeles</translation>
    </message>
</context>
<context>
    <name>reduction.other-size</name>
    <message>
        <source>the camera delivers {} pixels where {} were calibrated</source>
        <translation>la cámara entrega {} píxeles, pero se calibraron {}</translation>
    </message>
</context>
<context>
    <name>reduction.restore-camera-size</name>
    <message>
        <source>set the camera to the size that it had, or calibrate again</source>
        <translation>ajuste la cámara al tamaño que tenía o calibre de nuevo</translation>
    </message>
</context>
<context>
    <name>relucent::gui::AcquirePage</name>
    <message>
        <source>Paused, %1</source>
        <translation>En pausa, %1</translation>
    </message>
    <message>
        <source>Measuring, %1</source>
        <translation>Midiendo, %1</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s), %1</source>
        <translation>
            <numerusform>%n patrón, %1</numerusform>
            <numerusform>%n patrones, %1</numerusform>
        </translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Medido</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>Desactualizado</translation>
    </message>
    <message>
        <source>Stopped by a failure</source>
        <translation>Detenido por un fallo</translation>
    </message>
    <message>
        <source>Waiting for you. Nothing is being projected.</source>
        <translation>Esperando sus indicaciones. No se proyecta nada.</translation>
    </message>
    <message>
        <source>Every photograph is saved. Threshold opens when the last is taken.</source>
        <translation>Cada fotografía se guarda. Umbral se abre al tomar la última.</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>Los dispositivos están en uso en %1.</translation>
    </message>
    <message>
        <source>Measured in %1</source>
        <translation>Medido en %1</translation>
    </message>
    <message>
        <source>Leave the room dark and still, then start.</source>
        <translation>Deje la sala a oscuras y sin movimiento y empiece.</translation>
    </message>
    <message>
        <source>Show threshold</source>
        <translation>Mostrar umbral</translation>
    </message>
    <message>
        <source>Resume</source>
        <translation>Reanudar</translation>
    </message>
    <message>
        <source>Start measuring</source>
        <translation>Empezar a medir</translation>
    </message>
    <message>
        <source>Stop and keep</source>
        <translation>Detener y guardar</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Pausar</translation>
    </message>
    <message>
        <source>This measurement belongs to earlier settings</source>
        <translation>Esta medición corresponde a ajustes anteriores</translation>
    </message>
    <message>
        <source>It still works and stays until the new one is ready.</source>
        <translation>Sigue sirviendo y se conserva hasta que esté la nueva.</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>Medir de nuevo</translation>
    </message>
    <message>
        <source>The last session ended before it was finished</source>
        <translation>La última sesión terminó antes de tiempo</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>No se ha cambiado nada.</translation>
    </message>
    <message>
        <source>Fineness</source>
        <translation>Detalle</translation>
    </message>
    <message>
        <source>Acquire</source>
        <translation>Adquisición</translation>
    </message>
    <message>
        <source>Measure how every projector pixel lights every camera pixel. Leave the room dark and still.</source>
        <translation>Mida cómo ilumina cada píxel del proyector cada píxel de la cámara. Deje la sala a oscuras y sin movimiento.</translation>
    </message>
    <message>
        <source>Sent to the projector</source>
        <translation>Enviado al proyector</translation>
    </message>
    <message>
        <source>Seen by the camera</source>
        <translation>Visto por la cámara</translation>
    </message>
    <message>
        <source>Pattern that the projector shows</source>
        <translation>Patrón que muestra el proyector</translation>
    </message>
    <message>
        <source>Last photograph</source>
        <translation>Última fotografía</translation>
    </message>
    <message>
        <source>Appears when measuring begins. Nothing is projected before you start.</source>
        <translation>Aparece al empezar la medición. Antes no se proyecta nada.</translation>
    </message>
    <message>
        <source>How finely</source>
        <translation>Nivel de detalle</translation>
    </message>
    <message>
        <source>Fast</source>
        <translation>Rápido</translation>
    </message>
    <message>
        <source>a first look; misses weak bounces</source>
        <translation>un primer vistazo; omite rebotes débiles</translation>
    </message>
    <message>
        <source>Usual</source>
        <translation>Habitual</translation>
    </message>
    <message>
        <source>suits most surfaces</source>
        <translation>sirve para casi todo</translation>
    </message>
    <message>
        <source>Fine</source>
        <translation>Fino</translation>
    </message>
    <message>
        <source>glass, gloss, deep corners</source>
        <translation>vidrio, brillo, rincones profundos</translation>
    </message>
    <message>
        <source>Disk still needed</source>
        <translation>Disco aún necesario</translation>
    </message>
    <message>
        <source>Watching</source>
        <translation>Vigilancia</translation>
    </message>
    <message>
        <source>Paused</source>
        <translation>En pausa</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>Midiendo</translation>
    </message>
    <message>
        <source>about %1</source>
        <translation>unos %1</translation>
    </message>
    <message>
        <source>alarm beyond</source>
        <translation>alarma a partir de aquí</translation>
    </message>
    <message>
        <source>taken again</source>
        <translation>repetido</translation>
    </message>
    <message>
        <source>During the measurement</source>
        <translation>Durante la medición</translation>
    </message>
    <message>
        <source>light that would spoil photographs</source>
        <translation>luz que estropearía las fotografías</translation>
    </message>
    <message>
        <source>Minutes</source>
        <translation>Minutos</translation>
    </message>
    <message>
        <source>Room light, % of full light</source>
        <translation>Luz de la sala, % de la luz plena</translation>
    </message>
    <message>
        <source>Room light during the measurement</source>
        <translation>Luz de la sala durante la medición</translation>
    </message>
    <message>
        <source>Taken again</source>
        <translation>Repetido</translation>
    </message>
    <message numerus="yes">
        <source>About %n pattern(s), %1. Leave the room dark and still.</source>
        <translation>
            <numerusform>Aproximadamente %n patrón, %1. Deje la sala a oscuras y quieta.</numerusform>
            <numerusform>Aproximadamente %n patrones, %1. Deje la sala a oscuras y quieta.</numerusform>
        </translation>
    </message>
    <message>
        <source>What was measured</source>
        <translation>Lo que se midió</translation>
    </message>
    <message>
        <source>Patterns</source>
        <translation>Patrones</translation>
    </message>
    <message>
        <source>Error of the test patterns</source>
        <translation>Error de los patrones de prueba</translation>
    </message>
    <message>
        <source>Continue anyway</source>
        <translation>Continuar igualmente</translation>
    </message>
    <message>
        <source>Found while measuring</source>
        <translation>Hallado al medir</translation>
    </message>
    <message numerus="yes">
        <source>Begins in %n second(s)</source>
        <translation>
            <numerusform>Empieza en %n segundo</numerusform>
            <numerusform>Empieza en %n segundos</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Measuring begins in %n second(s). Leave the room dark and still.</source>
        <translation>
            <numerusform>La medición empieza en %n segundo. Deje la sala a oscuras y quieta.</numerusform>
            <numerusform>La medición empieza en %n segundos. Deje la sala a oscuras y quieta.</numerusform>
        </translation>
    </message>
    <message>
        <source>Start now</source>
        <translation>Empezar ahora</translation>
    </message>
    <message>
        <source>Not now</source>
        <translation>Ahora no</translation>
    </message>
    <message numerus="yes">
        <source>Compared with the start every %n pattern(s). What changed is photographed again; if that does not help, the measurement pauses and asks.</source>
        <translation>
            <numerusform>Se compara con el inicio tras cada patrón. Lo que ha cambiado se fotografía de nuevo; si no basta, la medición se pone en pausa y pregunta.</numerusform>
            <numerusform>Se compara con el inicio cada %n patrones. Lo que ha cambiado se fotografía de nuevo; si no basta, la medición se pone en pausa y pregunta.</numerusform>
        </translation>
    </message>
    <message>
        <source>Start</source>
        <translation>Inicio</translation>
    </message>
    <message>
        <source>Leave the room first</source>
        <translation>Salir antes de la sala</translation>
    </message>
    <message>
        <source>Time to leave the room before measuring begins</source>
        <translation>Tiempo para salir de la sala antes de que empiece la medición</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>A sound when it ends or needs me</source>
        <translation>Un sonido al terminar o si me necesita</translation>
    </message>
    <message>
        <source>Ready</source>
        <translation>Preparación</translation>
    </message>
    <message>
        <source>Dark enough</source>
        <translation>Suficientemente oscuro</translation>
    </message>
    <message>
        <source>Room light is %1 of full light, limit %2.</source>
        <translation>La luz de la sala es el %1 de la luz plena; límite, %2.</translation>
    </message>
    <message>
        <source>It is too bright here</source>
        <translation>Aquí hay demasiada luz</translation>
    </message>
    <message>
        <source>Room light is %1 of full light. Cover windows and lamps: less light, less noise.</source>
        <translation>La luz de la sala es el %1 de la luz plena. Cubra ventanas y lámparas: menos luz, menos ruido.</translation>
    </message>
    <message>
        <source>Needs %1 of %2.</source>
        <translation>Necesita %1 de %2.</translation>
    </message>
    <message>
        <source>Room on the disk</source>
        <translation>Espacio en el disco</translation>
    </message>
    <message>
        <source>The disk is too full</source>
        <translation>El disco está demasiado lleno</translation>
    </message>
    <message>
        <source>Floodlight image</source>
        <translation>Imagen a plena luz</translation>
    </message>
    <message>
        <source>the projector fully white</source>
        <translation>el proyector totalmente blanco</translation>
    </message>
    <message>
        <source>The surface in the projector&apos;s full light</source>
        <translation>La superficie a plena luz del proyector</translation>
    </message>
    <message>
        <source>%1 px</source>
        <translation>%1 px</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 de %2</translation>
    </message>
    <message>
        <source>Level %1 of %2, %3 of %4 patterns.</source>
        <translation>Nivel %1 de %2, %3 de %4 patrones.</translation>
    </message>
    <message>
        <source>Patterns for each block size</source>
        <translation>Patrones por tamaño de bloque</translation>
    </message>
    <message>
        <source>blocks are divided only where light needs it</source>
        <translation>los bloques solo se dividen donde la luz lo requiere</translation>
    </message>
    <message>
        <source>Stopped at %1 px</source>
        <translation>Detenido en %1 px</translation>
    </message>
    <message>
        <source>Measuring was stopped at blocks of %1 px</source>
        <translation>La medición se detuvo en bloques de %1 px</translation>
    </message>
    <message>
        <source>Finer light is missing. Go on any time, if nothing has moved.</source>
        <translation>Falta la luz más fina. Siga en cualquier momento, si nada se ha movido.</translation>
    </message>
    <message numerus="yes">
        <source>%1 dB expected, about %2 dB with %n more photograph(s), %3. Go on any time, if nothing has moved.</source>
        <translation>
            <numerusform>Se esperan %1 dB, unos %2 dB con %n foto más, %3. Continúe en cualquier momento si nada se ha movido.</numerusform>
            <numerusform>Se esperan %1 dB, unos %2 dB con %n fotos más, %3. Continúe en cualquier momento si nada se ha movido.</numerusform>
        </translation>
    </message>
    <message>
        <source>Pictures expected at</source>
        <translation>Imágenes esperadas a</translation>
    </message>
    <message>
        <source>rough</source>
        <translation>tosca</translation>
    </message>
    <message>
        <source>fair</source>
        <translation>aceptable</translation>
    </message>
    <message>
        <source>good</source>
        <translation>buena</translation>
    </message>
    <message>
        <source>very good</source>
        <translation>muy buena</translation>
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
        <translation>Los dB dicen cuánto se acerca la imagen a la deseada donde puede alcanzarse: 20 dB se ven toscos, 30 dB bien, y cada 6 dB más reducen la diferencia a la mitad.</translation>
    </message>
    <message>
        <source>Compensated so far</source>
        <translation>Compensado hasta ahora</translation>
    </message>
    <message>
        <source>A picture, compensated with what is measured so far</source>
        <translation>Una imagen, compensada con lo medido hasta ahora</translation>
    </message>
    <message>
        <source>Appears after the first patterns, and grows sharper.</source>
        <translation>Aparece tras los primeros patrones y se vuelve más nítida.</translation>
    </message>
    <message>
        <source>Expected now</source>
        <translation>Esperado ahora</translation>
    </message>
    <message>
        <source>Blocks of %1 px. Expected now: %2. In the end: %3.</source>
        <translation>Bloques de %1 px. Esperado ahora: %2. Al final: %3.</translation>
    </message>
    <message>
        <source>In the end</source>
        <translation>Al final</translation>
    </message>
    <message>
        <source>Waiting for room on the disk. Nothing is being projected.</source>
        <translation>Esperando espacio en el disco. No se proyecta nada.</translation>
    </message>
    <message>
        <source>Go on now</source>
        <translation>Seguir ahora</translation>
    </message>
    <message>
        <source>Photographs to keep</source>
        <translation>Fotografías que se conservan</translation>
    </message>
    <message>
        <source>Photographs to keep once all is measured</source>
        <translation>Fotografías que se conservan cuando todo está medido</translation>
    </message>
    <message>
        <source>All</source>
        <translation>Todas</translation>
    </message>
    <message>
        <source>Of the latest measurement</source>
        <translation>Las de la última medición</translation>
    </message>
    <message>
        <source>None: results only</source>
        <translation>Ninguna: solo resultados</translation>
    </message>
    <message>
        <source>Those that were set aside by measuring again are removed once all is measured.</source>
        <translation>Las que se apartaron al medir de nuevo se eliminan cuando todo está medido.</translation>
    </message>
    <message>
        <source>Removed once all is measured. Other settings then have to photograph everything again.</source>
        <translation>Se eliminan cuando todo está medido. Con otros ajustes hay que fotografiarlo todo de nuevo.</translation>
    </message>
    <message>
        <source>Measuring with other settings then needs fewer new photographs.</source>
        <translation>Medir con otros ajustes necesita entonces menos fotografías nuevas.</translation>
    </message>
    <message>
        <source>Those of the last measurement were removed: all are taken again.</source>
        <translation>Las de la última medición se eliminaron: se toman todas de nuevo.</translation>
    </message>
    <message>
        <source>Waiting for the projector&apos;s screen.</source>
        <translation>Esperando la pantalla del proyector.</translation>
    </message>
    <message>
        <source>Every photograph is saved. The earlier measurement is used until the new one is ready.</source>
        <translation>Cada fotografía se guarda. La medición anterior se usa hasta que esté la nueva.</translation>
    </message>
    <message>
        <source>To go on measuring, confirm that the room is clear.</source>
        <translation>Para seguir midiendo, confirme que la sala está despejada.</translation>
    </message>
    <message>
        <source>Takes every photograph again. What is measured stays until then.</source>
        <translation>Toma de nuevo todas las fotografías. Hasta entonces se conserva lo medido.</translation>
    </message>
    <message>
        <source>Measuring again has not ended</source>
        <translation>La nueva medición no ha terminado</translation>
    </message>
    <message>
        <source>Measuring with these settings.</source>
        <translation>Se está midiendo con estos ajustes.</translation>
    </message>
    <message>
        <source>Waiting for the camera.</source>
        <translation>Esperando la cámara.</translation>
    </message>
    <message>
        <source>Keep the earlier one</source>
        <translation>Conservar la anterior</translation>
    </message>
    <message>
        <source>The earlier measurement is used again, with all that followed from it.</source>
        <translation>Se vuelve a usar la medición anterior, con todo lo que siguió de ella.</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>Lo medido está a salvo.</translation>
    </message>
    <message>
        <source>Paused, about %1 left</source>
        <translation>En pausa, quedan aprox. %1</translation>
    </message>
    <message>
        <source>%1 of about %2</source>
        <translation>%1 de unos %2</translation>
    </message>
    <message>
        <source>About %1 left</source>
        <translation>Quedan aprox. %1</translation>
    </message>
    <message>
        <source>Ends near %1. %2</source>
        <translation>Termina hacia las %1. %2</translation>
    </message>
    <message>
        <source>Put the camera back</source>
        <translation>Recolocar la cámara</translation>
    </message>
    <message>
        <source>Test patterns are predicted from the measurement, then photographed: this is how far the two differ, the photographs&apos; noise included.</source>
        <translation>Los patrones de prueba se predicen a partir de la medición y luego se fotografían: esta es la diferencia, incluido el ruido de las fotografías.</translation>
    </message>
    <message>
        <source>%1; light right within about %2</source>
        <translation>%1; luz exacta en torno a %2</translation>
    </message>
    <message>
        <source>Reading, %1</source>
        <translation>Leyendo, %1</translation>
    </message>
    <message>
        <source>Waiting for your answer. Every photograph is saved.</source>
        <translation>Espera su respuesta. Todas las fotografías están guardadas.</translation>
    </message>
    <message>
        <source>Go on measuring</source>
        <translation>Seguir midiendo</translation>
    </message>
    <message>
        <source>Answer</source>
        <translation>Responder</translation>
    </message>
    <message>
        <source>Try again</source>
        <translation>Reintentar</translation>
    </message>
    <message>
        <source>The camera is back at its place</source>
        <translation>La cámara vuelve a estar en su sitio</translation>
    </message>
    <message>
        <source>It had moved while it measured, and looks again where it looked.</source>
        <translation>Se había movido durante la medición y vuelve a mirar adonde miraba.</translation>
    </message>
    <message numerus="yes">
        <source>“%1” photographs %n pattern(s) again, from No. %2 on, and goes on from there.</source>
        <translation>
            <numerusform>«%1» vuelve a fotografiar %n patrón desde el n.º %2 y sigue desde ahí.</numerusform>
            <numerusform>«%1» vuelve a fotografiar %n patrones desde el n.º %2 y sigue desde ahí.</numerusform>
        </translation>
    </message>
    <message>
        <source>“%1” looks once more, and goes on.</source>
        <translation>«%1» mira otra vez y sigue.</translation>
    </message>
    <message>
        <source>“%1” keeps all as it is: what changed will be wrong, and the report says so.</source>
        <translation>«%1» deja todo como está: lo que cambió quedará mal, y el informe lo dice.</translation>
    </message>
    <message>
        <source>Measuring waits for your answer.</source>
        <translation>La medición espera su respuesta.</translation>
    </message>
    <message>
        <source>Kept photographs are read first.</source>
        <translation>Primero se leen las fotografías guardadas.</translation>
    </message>
    <message>
        <source>Nothing is being projected.</source>
        <translation>No se proyecta nada.</translation>
    </message>
    <message>
        <source>Reading</source>
        <translation>Leyendo</translation>
    </message>
    <message>
        <source>Reading, under a minute left</source>
        <translation>Leyendo, queda menos de un minuto</translation>
    </message>
    <message>
        <source>Reading, about %1 left</source>
        <translation>Leyendo, quedan unos %1</translation>
    </message>
    <message>
        <source>Paused, under a minute left</source>
        <translation>En pausa, queda menos de un minuto</translation>
    </message>
    <message>
        <source>Under a minute left</source>
        <translation>Queda menos de un minuto</translation>
    </message>
    <message>
        <source>%1 expected</source>
        <translation>se esperan %1</translation>
    </message>
    <message>
        <source>To measure again, confirm that the room is clear.</source>
        <translation>Para medir de nuevo, confirme que la sala está despejada.</translation>
    </message>
    <message>
        <source>%1, %2 a minute</source>
        <translation>%1, %2 por minuto</translation>
    </message>
    <message>
        <source>all projectors fully white</source>
        <translation>todos los proyectores totalmente blancos</translation>
    </message>
    <message>
        <source>Reading what was measured</source>
        <translation>Leyendo lo medido</translation>
    </message>
    <message>
        <source>The camera is at its place</source>
        <translation>La cámara está en su sitio</translation>
    </message>
    <message>
        <source>It looks where it looked. Perhaps the light flickered.</source>
        <translation>Mira adonde miraba. Quizá la luz parpadeó.</translation>
    </message>
    <message>
        <source>Ended by a change</source>
        <translation>Terminada por un cambio</translation>
    </message>
    <message>
        <source>Put right what changed, then go on measuring.</source>
        <translation>Corrija lo que cambió y siga midiendo.</translation>
    </message>
    <message>
        <source>Measure again as it stands now, or put it back and go on measuring.</source>
        <translation>Mida de nuevo tal como está ahora, o recolóquelo y siga midiendo.</translation>
    </message>
    <message>
        <source>Measuring was stopped at blocks of %1 px: something had changed</source>
        <translation>La medición se detuvo en bloques de %1 px: algo había cambiado</translation>
    </message>
    <message>
        <source>Measuring ended, and something had changed</source>
        <translation>La medición terminó y algo había cambiado</translation>
    </message>
    <message>
        <source>What was photographed since the look before is left out, all before it is kept.</source>
        <translation>Se omite lo fotografiado desde la comprobación anterior; todo lo de antes se conserva.</translation>
    </message>
    <message>
        <source>Working out, %1</source>
        <translation>Calculando, %1</translation>
    </message>
    <message>
        <source>Working out the result</source>
        <translation>Calculando el resultado</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s)</source>
        <translation>
            <numerusform>%n patrón</numerusform>
            <numerusform>%n patrones</numerusform>
        </translation>
    </message>
    <message>
        <source>Waits for an answer</source>
        <translation>Espera respuesta</translation>
    </message>
    <message>
        <source>%1 too bright</source>
        <translation>%1 demasiado claro</translation>
    </message>
    <message>
        <source>%1 left out</source>
        <translation>%1 fuera</translation>
    </message>
    <message>
        <source>Waiting for your answer.</source>
        <translation>Espera su respuesta.</translation>
    </message>
    <message>
        <source>Stop and keep this one</source>
        <translation>Detener y guardar esta</translation>
    </message>
    <message>
        <source>Going on has not ended</source>
        <translation>La continuación no ha terminado</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s) expected, %1 of them checks; known exactly as each level begins</source>
        <translation>
            <numerusform>%n patrón previsto, %1 de comprobación; se sabe con exactitud al empezar cada nivel</numerusform>
            <numerusform>%n patrones previstos, %1 de comprobación; se sabe con exactitud al empezar cada nivel</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s), %1 of them checks</source>
        <translation>
            <numerusform>%n patrón, %1 de comprobación</numerusform>
            <numerusform>%n patrones, %1 de comprobación</numerusform>
        </translation>
    </message>
    <message>
        <source>Ending</source>
        <translation>Terminando</translation>
    </message>
    <message>
        <source>Measure with these settings</source>
        <translation>Medir con estos ajustes</translation>
    </message>
    <message>
        <source>Use the earlier one</source>
        <translation>Usar la anterior</translation>
    </message>
    <message>
        <source>Waiting</source>
        <translation>En espera</translation>
    </message>
    <message>
        <source>Waiting, under a minute left</source>
        <translation>En espera, queda menos de un minuto</translation>
    </message>
    <message>
        <source>Waiting, about %1 left</source>
        <translation>En espera, quedan aprox. %1</translation>
    </message>
    <message>
        <source>Keep the new ones</source>
        <translation>Conservar las nuevas</translation>
    </message>
    <message>
        <source>Keep the earlier measurement?</source>
        <translation>¿Conservar la medición anterior?</translation>
    </message>
    <message>
        <source>The new photographs are set aside and not used again: measuring again then takes every photograph again.</source>
        <translation>Las fotografías nuevas se apartan y no se vuelven a usar: medir de nuevo repite entonces todas las fotografías.</translation>
    </message>
    <message>
        <source>The earlier measurement, and all that followed from it.</source>
        <translation>La medición anterior y todo lo que siguió de ella.</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s) kept</source>
        <translation>
            <numerusform>%n patrón guardado</numerusform>
            <numerusform>%n patrones guardados</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The photographs of %n pattern(s) are read first. Then measuring goes on where it ended.</source>
        <translation>
            <numerusform>Primero se leen las fotografías de %n patrón. Después la medición sigue donde terminó.</numerusform>
            <numerusform>Primero se leen las fotografías de %n patrones. Después la medición sigue donde terminó.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The photographs of %n pattern(s) are safe. Resuming gives the same result as if nothing had happened.</source>
        <translation>
            <numerusform>Las fotografías de %n patrón están a salvo. Al reanudar, el resultado es el mismo que si no hubiera pasado nada.</numerusform>
            <numerusform>Las fotografías de %n patrones están a salvo. Al reanudar, el resultado es el mismo que si no hubiera pasado nada.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The new photographs of %n pattern(s) are safe: resume any time. Until then the earlier measurement is used.</source>
        <translation>
            <numerusform>Las fotografías nuevas de %n patrón están a salvo: reanude en cualquier momento. Hasta entonces se usa la medición anterior.</numerusform>
            <numerusform>Las fotografías nuevas de %n patrones están a salvo: reanude en cualquier momento. Hasta entonces se usa la medición anterior.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The photographs of %n pattern(s) are on the disk. The pattern under way is not counted.</source>
        <translation>
            <numerusform>Las fotografías de %n patrón están en el disco. El patrón en curso no se cuenta.</numerusform>
            <numerusform>Las fotografías de %n patrones están en el disco. El patrón en curso no se cuenta.</numerusform>
        </translation>
    </message>
    <message>
        <source>Photographs</source>
        <translation>Fotografías</translation>
    </message>
    <message numerus="yes">
        <source>Reading the photographs of %n pattern(s): %1.</source>
        <translation>
            <numerusform>Leyendo las fotografías de %n patrón: %1.</numerusform>
            <numerusform>Leyendo las fotografías de %n patrones: %1.</numerusform>
        </translation>
    </message>
    <message>
        <source>Keep the new one</source>
        <translation>Conservar la nueva</translation>
    </message>
    <message>
        <source>Use the earlier measurement?</source>
        <translation>¿Usar la medición anterior?</translation>
    </message>
    <message>
        <source>%1; lit, within the dashes: %2 of the view</source>
        <translation>%1; iluminado, dentro de los trazos: %2 de la vista</translation>
    </message>
    <message>
        <source>Stopped after %1</source>
        <translation>Detenido tras %1</translation>
    </message>
    <message>
        <source>Stopped early: light finer than blocks of %1 px is missing.</source>
        <translation>Detenido antes de tiempo: falta la luz más fina que bloques de %1 px.</translation>
    </message>
    <message>
        <source>Again, not ended</source>
        <translation>De nuevo, sin terminar</translation>
    </message>
    <message>
        <source>What was measured cannot be read</source>
        <translation>Lo medido no se puede leer</translation>
    </message>
    <message>
        <source>Use the earlier measurement, or measure again.</source>
        <translation>Use la medición anterior o mida de nuevo.</translation>
    </message>
    <message>
        <source>Measure again.</source>
        <translation>Mida de nuevo.</translation>
    </message>
    <message>
        <source>%1 dB expected: what was measured does not fit together, and pictures are no better than uncorrected.</source>
        <translation>Se esperan %1 dB: lo medido no concuerda y las imágenes no son mejores que sin corregir.</translation>
    </message>
    <message>
        <source>%1 dB expected. Go on any time, if nothing has moved.</source>
        <translation>Se esperan %1 dB. Continúe cuando quiera si nada se ha movido.</translation>
    </message>
    <message>
        <source>What was measured cannot be read.</source>
        <translation>Lo medido no se puede leer.</translation>
    </message>
    <message>
        <source>%1: what was photographed since the check before is taken again.</source>
        <translation>%1: lo fotografiado desde el control anterior se repite.</translation>
    </message>
    <message>
        <source>The light of the room was another one, too: see that it is as it was.</source>
        <translation>También la luz de la sala era otra: asegúrese de que esté como estaba.</translation>
    </message>
    <message>
        <source>Ending: what is begun is photographed to its end, and test patterns. Then all of it is kept.</source>
        <translation>Terminando: lo empezado se fotografía hasta el final, y patrones de prueba. Después se guarda todo.</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the patterns flash.</source>
        <translation>Confirme que la sala está despejada: los patrones destellan.</translation>
    </message>
    <message>
        <source>%1: all patterns are taken again, from the first.</source>
        <translation>%1: se vuelven a tomar todos los patrones, desde el primero.</translation>
    </message>
    <message>
        <source>Measured in %1, and repaired since</source>
        <translation>Medido en %1 y reparado después</translation>
    </message>
    <message>
        <source>Photographs of the repair since</source>
        <translation>Fotos de la reparación posterior</translation>
    </message>
    <message>
        <source>Stopped too early</source>
        <translation>Detenida demasiado pronto</translation>
    </message>
</context>
<context>
    <name>relucent::gui::AcquisitionTrace</name>
    <message>
        <source>the light flickered</source>
        <translation>la luz parpadeó</translation>
    </message>
    <message>
        <source>the room light changed</source>
        <translation>cambió la luz de la sala</translation>
    </message>
    <message>
        <source>the projector&apos;s light changed</source>
        <translation>cambió la luz del proyector</translation>
    </message>
    <message>
        <source>the camera or the projector moved</source>
        <translation>se movió la cámara o el proyector</translation>
    </message>
    <message>
        <source>the picture was not the one sent</source>
        <translation>la imagen no era la enviada</translation>
    </message>
    <message>
        <source>the camera saw nothing</source>
        <translation>la cámara no vio nada</translation>
    </message>
    <message>
        <source>the projector showed nothing</source>
        <translation>el proyector no mostró nada</translation>
    </message>
    <message>
        <source>too bright, shorter exposure</source>
        <translation>demasiado claro, exposición más corta</translation>
    </message>
    <message>
        <source>does not fit what was seen before</source>
        <translation>no encaja con lo visto antes</translation>
    </message>
    <message>
        <source>No. %1</source>
        <translation>N.º %1</translation>
    </message>
    <message>
        <source>No. %1 to %2</source>
        <translation>N.º %1 a %2</translation>
    </message>
    <message>
        <source>Room light</source>
        <translation>Luz de la sala</translation>
    </message>
    <message>
        <source>Camera and view</source>
        <translation>Cámara e imagen</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>Proyector</translation>
    </message>
    <message>
        <source>Flicker</source>
        <translation>Parpadeo</translation>
    </message>
    <message>
        <source>Room light steady</source>
        <translation>Luz de la sala estable</translation>
    </message>
    <message>
        <source>Room light changed</source>
        <translation>La luz de la sala ha cambiado</translation>
    </message>
    <message>
        <source>%1 of full light, changed by %2 since the start.</source>
        <translation>%1 de la luz plena, ha cambiado %2 desde el inicio.</translation>
    </message>
    <message>
        <source>Camera still</source>
        <translation>Cámara inmóvil</translation>
    </message>
    <message>
        <source>The view changed</source>
        <translation>La imagen ha cambiado</translation>
    </message>
    <message>
        <source>The view differs by %1 from the first.</source>
        <translation>La imagen difiere de la primera en %1.</translation>
    </message>
    <message>
        <source>Projector steady</source>
        <translation>Proyector estable</translation>
    </message>
    <message>
        <source>The projector&apos;s light changed</source>
        <translation>La luz del proyector ha cambiado</translation>
    </message>
    <message>
        <source>Its light drifted by %1 and is corrected.</source>
        <translation>Su luz ha derivado %1 y se corrige.</translation>
    </message>
    <message>
        <source>No flicker</source>
        <translation>Sin parpadeo</translation>
    </message>
    <message>
        <source>Photographs of one pattern agree within %1.</source>
        <translation>Las fotografías de un mismo patrón coinciden dentro del %1.</translation>
    </message>
    <message>
        <source>No difference between photographs of one pattern was found.</source>
        <translation>No hay diferencias entre las fotografías de un mismo patrón.</translation>
    </message>
    <message>
        <source>The camera or the projector moved</source>
        <translation>La cámara o el proyector se ha movido</translation>
    </message>
    <message>
        <source>The picture is not the one sent</source>
        <translation>La imagen no es la enviada</translation>
    </message>
    <message>
        <source>The camera sees nothing</source>
        <translation>La cámara no ve nada</translation>
    </message>
    <message>
        <source>The projector shows nothing</source>
        <translation>El proyector no muestra nada</translation>
    </message>
    <message>
        <source>Put right</source>
        <translation>Corregido</translation>
    </message>
    <message>
        <source>Looked at again at the next check.</source>
        <translation>Se vuelve a mirar en la próxima comprobación.</translation>
    </message>
    <message>
        <source>the light flickered, or something moved</source>
        <translation>la luz parpadeó o algo se movió</translation>
    </message>
    <message>
        <source>The light flickers, or something moves</source>
        <translation>La luz parpadea o algo se mueve</translation>
    </message>
    <message>
        <source>Not known while the view has changed.</source>
        <translation>No se sabe mientras la vista sea otra.</translation>
    </message>
    <message>
        <source>The light flickers, or was switched</source>
        <translation>La luz parpadea o se ha encendido o apagado</translation>
    </message>
    <message>
        <source>Photographed again</source>
        <translation>Fotografiado de nuevo</translation>
    </message>
    <message>
        <source>dark: lens covered for a moment?</source>
        <translation>oscura: ¿objetivo tapado un momento?</translation>
    </message>
    <message>
        <source>Found since the last check.</source>
        <translation>Encontrado desde la última comprobación.</translation>
    </message>
    <message>
        <source>something in the view changed</source>
        <translation>algo cambió en la vista</translation>
    </message>
    <message>
        <source>Something in the view changed</source>
        <translation>Algo cambió en la vista</translation>
    </message>
    <message>
        <source>Not known while the camera sees nothing.</source>
        <translation>No se sabe mientras la cámara no vea nada.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ActionBar</name>
    <message>
        <source>Progress of the measurement</source>
        <translation>Progreso de la medición</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Atrás</translation>
    </message>
    <message>
        <source>Show where</source>
        <translation>¿Dónde?</translation>
    </message>
</context>
<context>
    <name>relucent::gui::CameraPage</name>
    <message>
        <source>Choose</source>
        <translation>Elegir</translation>
    </message>
    <message>
        <source>Choose %1</source>
        <translation>Elegir %1</translation>
    </message>
    <message>
        <source>Choose the one that looks at the surface.</source>
        <translation>Elija la que apunta a la superficie.</translation>
    </message>
    <message>
        <source>Looking for cameras</source>
        <translation>Buscando cámaras</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>No se ha cambiado nada.</translation>
    </message>
    <message>
        <source>Checking</source>
        <translation>Comprobando</translation>
    </message>
    <message>
        <source>Checked %1</source>
        <translation>Comprobada: %1</translation>
    </message>
    <message>
        <source>Choose the camera that looks at the surface.</source>
        <translation>Elija la cámara que apunta a la superficie.</translation>
    </message>
    <message>
        <source>Opening the devices</source>
        <translation>Abriendo los dispositivos</translation>
    </message>
    <message>
        <source>%1 is too bright in every exposure.</source>
        <translation>El %1 está demasiado claro en toda exposición.</translation>
    </message>
    <message>
        <source>Look through the camera first.</source>
        <translation>Mire primero por la cámara.</translation>
    </message>
    <message>
        <source>Next: test patterns for the projector&apos;s response</source>
        <translation>Siguiente: patrones de prueba para la respuesta del proyector</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Pausar</translation>
    </message>
    <message>
        <source>Check again</source>
        <translation>Comprobar de nuevo</translation>
    </message>
    <message>
        <source>Choose another camera</source>
        <translation>Elegir otra cámara</translation>
    </message>
    <message>
        <source>Focus area</source>
        <translation>Área de enfoque</translation>
    </message>
    <message>
        <source>Nothing is measured at this step, so nothing is lost.</source>
        <translation>En este paso no se mide nada, así que no se pierde nada.</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Cámara</translation>
    </message>
    <message>
        <source>Frame the surface, focus, and let the exposures cover its brightest and darkest parts.</source>
        <translation>Encuadre la superficie, enfoque y deje que las exposiciones cubran sus partes más claras y más oscuras.</translation>
    </message>
    <message>
        <source>Focus, %1 of best</source>
        <translation>Enfoque, %1 del mejor</translation>
    </message>
    <message>
        <source>Camera view</source>
        <translation>Vista de cámara</translation>
    </message>
    <message>
        <source>What the camera sees now</source>
        <translation>Lo que ve la cámara ahora</translation>
    </message>
    <message>
        <source>The camera is not being looked through.</source>
        <translation>No se está mirando por la cámara.</translation>
    </message>
    <message>
        <source>Light in this exposure: red, green, blue</source>
        <translation>Luz en esta exposición: rojo, verde, azul</translation>
    </message>
    <message>
        <source>Signal</source>
        <translation>Señal</translation>
    </message>
    <message>
        <source>Focus</source>
        <translation>Enfoque</translation>
    </message>
    <message>
        <source>Turn the lens until the bar stays at the mark: the best so far.</source>
        <translation>Gire el objetivo hasta que la barra quede en la marca: lo mejor hasta ahora.</translation>
    </message>
    <message>
        <source>Exposures</source>
        <translation>Exposiciones</translation>
    </message>
    <message>
        <source>Checks</source>
        <translation>Comprobaciones</translation>
    </message>
    <message>
        <source>Signal, share of full</source>
        <translation>Señal, parte del máximo</translation>
    </message>
    <message>
        <source>Pixels</source>
        <translation>Píxeles</translation>
    </message>
    <message>
        <source>The camera sees the projector</source>
        <translation>La cámara ve el proyector</translation>
    </message>
    <message>
        <source>White and black differ as they should.</source>
        <translation>Blanco y negro difieren como deben.</translation>
    </message>
    <message>
        <source>Bright parts are covered</source>
        <translation>Partes claras cubiertas</translation>
    </message>
    <message>
        <source>%1 is too bright in every exposure</source>
        <translation>El %1 está demasiado claro en toda exposición</translation>
    </message>
    <message>
        <source>Close the lens a little, or shade lamps in the view.</source>
        <translation>Cierre un poco el diafragma o tape las lámparas de la vista.</translation>
    </message>
    <message>
        <source>Dark parts are covered</source>
        <translation>Partes oscuras cubiertas</translation>
    </message>
    <message>
        <source>%1 is too dark in every exposure</source>
        <translation>El %1 está demasiado oscuro en toda exposición</translation>
    </message>
    <message>
        <source>The projector may not reach there. Where it should, open the lens.</source>
        <translation>Quizá el proyector no llega ahí. Donde debería llegar, abra el diafragma.</translation>
    </message>
    <message>
        <source>Keep exposures</source>
        <translation>Conservar exposiciones</translation>
    </message>
    <message>
        <source>too bright to tell</source>
        <translation>demasiado claro para juzgar</translation>
    </message>
    <message>
        <source>Too bright %1</source>
        <translation>Demasiado claro %1</translation>
    </message>
    <message>
        <source>Too dark %1</source>
        <translation>Demasiado oscuro %1</translation>
    </message>
    <message>
        <source>No camera is chosen yet</source>
        <translation>Aún no se ha elegido cámara</translation>
    </message>
    <message>
        <source>Camera pixels</source>
        <translation>Píxeles de la cámara</translation>
    </message>
    <message>
        <source>As many as needed: %1</source>
        <translation>Los necesarios: %1</translation>
    </message>
    <message>
        <source>All: %1</source>
        <translation>Todos: %1</translation>
    </message>
    <message>
        <source>%1 become one: %2</source>
        <translation>%1 pasan a uno: %2</translation>
    </message>
    <message>
        <source>Camera pixels that are used</source>
        <translation>Píxeles de la cámara que se usan</translation>
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
        <translation>Tiempo</translation>
    </message>
    <message>
        <source>More camera pixels than projector pixels show nothing more. The photographs that prove the result stay as large as they are.</source>
        <translation>Más píxeles de cámara que de proyector no muestran nada más. Las fotografías que prueban el resultado conservan su tamaño.</translation>
    </message>
    <message>
        <source>Mark what is sharp</source>
        <translation>Marcar lo nítido</translation>
    </message>
    <message>
        <source>Checked before. Check again if camera or projector were moved.</source>
        <translation>Ya comprobado. Compruebe otra vez si se movió la cámara o el proyector.</translation>
    </message>
    <message>
        <source>Continue</source>
        <translation>Continuar</translation>
    </message>
    <message>
        <source>Exposure times</source>
        <translation>Tiempos de exposición</translation>
    </message>
    <message>
        <source>The projector&apos;s picture: the camera sees %1 of it</source>
        <translation>La imagen del proyector: la cámara ve el %1</translation>
    </message>
    <message>
        <source>at the left</source>
        <translation>a la izquierda</translation>
    </message>
    <message>
        <source>at the right</source>
        <translation>a la derecha</translation>
    </message>
    <message>
        <source>at the top</source>
        <translation>arriba</translation>
    </message>
    <message>
        <source>at the bottom</source>
        <translation>abajo</translation>
    </message>
    <message>
        <source>Missing are places within it: in shadow, or too dark for the camera.</source>
        <translation>Faltan zonas interiores: en sombra o demasiado oscuras para la cámara.</translation>
    </message>
    <message>
        <source>Missing: %1. Aim the camera there, or move it back.</source>
        <translation>Falta: %1. Apunte la cámara hacia allí o aléjela.</translation>
    </message>
    <message>
        <source>%1 of the projector&apos;s picture is seen</source>
        <translation>Se ve el %1 de la imagen del proyector</translation>
    </message>
    <message>
        <source>%1 of projector %2&apos;s picture is seen</source>
        <translation>Se ve el %1 de la imagen del proyector %2</translation>
    </message>
    <message>
        <source>Every exposure is a multiple of %1</source>
        <translation>Cada exposición es múltiplo de %1</translation>
    </message>
    <message>
        <source>The projector&apos;s light changes as quickly as that: each photograph has all of it.</source>
        <translation>La luz del proyector cambia así de rápido: cada fotografía la recoge entera.</translation>
    </message>
    <message>
        <source>Allow any exposure</source>
        <translation>Permitir cualquier exposición</translation>
    </message>
    <message>
        <source>Exposures shorter than %1 flicker</source>
        <translation>Las exposiciones más cortas que %1 parpadean</translation>
    </message>
    <message>
        <source>The projector&apos;s light changes within that time.</source>
        <translation>La luz del proyector cambia en ese tiempo.</translation>
    </message>
    <message>
        <source>Use multiples of %1</source>
        <translation>Usar múltiplos de %1</translation>
    </message>
    <message>
        <source>Checked before</source>
        <translation>Ya comprobado</translation>
    </message>
    <message>
        <source>These exposures are kept. “Check again” looks through the camera.</source>
        <translation>Estas exposiciones están guardadas. «Comprobar de nuevo» mira por la cámara.</translation>
    </message>
    <message>
        <source>Not checked yet</source>
        <translation>Aún sin comprobar</translation>
    </message>
    <message>
        <source>Missing: %1. A simulated camera stays where it stands: go on, what it does not see is left as it is.</source>
        <translation>Falta: %1. Una cámara simulada se queda donde está: siga, lo que no ve queda como está.</translation>
    </message>
    <message>
        <source>Exposures as measured</source>
        <translation>Exposiciones de la medición</translation>
    </message>
    <message>
        <source>Camera %1: %2 is too bright in every exposure.</source>
        <translation>Cámara %1: %2 es demasiado claro en toda exposición.</translation>
    </message>
    <message>
        <source>What %1 sees now</source>
        <translation>Lo que ve ahora %1</translation>
    </message>
    <message>
        <source>Focus %1</source>
        <translation>Enfoque %1</translation>
    </message>
    <message numerus="yes">
        <source>%n projector(s): %1</source>
        <translation>
            <numerusform>%n proyector: %1</numerusform>
            <numerusform>%n proyectores: %1</numerusform>
        </translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Luz</translation>
    </message>
    <message>
        <source>Overlap</source>
        <translation>Solape</translation>
    </message>
    <message>
        <source>how many projectors light each place</source>
        <translation>cuántos proyectores iluminan cada punto</translation>
    </message>
    <message>
        <source>Checks done</source>
        <translation>Comprobado</translation>
    </message>
    <message>
        <source>%1 of every picture is seen</source>
        <translation>Se ve el %1 de cada imagen</translation>
    </message>
    <message>
        <source>Exposures, kept</source>
        <translation>Exposiciones, conservadas</translation>
    </message>
    <message>
        <source>Check again to look with another one.</source>
        <translation>Compruebe de nuevo para mirar con otra.</translation>
    </message>
    <message>
        <source>Exposures, paused</source>
        <translation>Exposiciones, en pausa</translation>
    </message>
    <message>
        <source>places within it</source>
        <translation>zonas interiores</translation>
    </message>
    <message>
        <source>All of the view, by one exposure or another.</source>
        <translation>Toda la vista, con una u otra exposición.</translation>
    </message>
    <message>
        <source>All but %1 of the view, by one exposure or another.</source>
        <translation>Todo menos el %1 de la vista, con una u otra exposición.</translation>
    </message>
    <message>
        <source>%1 too bright</source>
        <translation>%1 demasiado claro</translation>
    </message>
    <message>
        <source>Keep the former camera</source>
        <translation>Conservar la cámara anterior</translation>
    </message>
    <message>
        <source>exposure %1, click to judge focus</source>
        <translation>exposición %1, clic para evaluar el enfoque</translation>
    </message>
    <message>
        <source>Checks under way</source>
        <translation>Comprobaciones en curso</translation>
    </message>
    <message>
        <source>Stop the checks</source>
        <translation>Detener las comprobaciones</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the checks begin with that.</source>
        <translation>Confirme que la sala está despejada: con ello empiezan las comprobaciones.</translation>
    </message>
    <message>
        <source>as it was seen last, exposure %1</source>
        <translation>como se vio por última vez, exposición %1</translation>
    </message>
    <message>
        <source>%1 of full light was too bright in every exposure. “Check again” looks through the camera.</source>
        <translation>%1 de la luz plena era demasiado brillante en cada exposición. «Comprobar de nuevo» mira por la cámara.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::CameraRows</name>
    <message>
        <source>Cameras</source>
        <translation>Cámaras</translation>
    </message>
    <message>
        <source>Look again</source>
        <translation>Buscar de nuevo</translation>
    </message>
    <message>
        <source>Looking for cameras</source>
        <translation>Buscando cámaras</translation>
    </message>
    <message>
        <source>Cannot be used: %1</source>
        <translation>No se puede usar: %1</translation>
    </message>
    <message numerus="yes">
        <source>%1 pixels, %n bit(s), exposures %2 to %3</source>
        <translation>
            <numerusform>%1 píxeles, %n bit, exposiciones de %2 a %3</numerusform>
            <numerusform>%1 píxeles, %n bits, exposiciones de %2 a %3</numerusform>
        </translation>
    </message>
    <message>
        <source>Recommended: it tells faint light apart best</source>
        <translation>Recomendada: distingue mejor la luz débil</translation>
    </message>
    <message>
        <source>Fewer bits: faint light is told apart less well</source>
        <translation>Menos bits: la luz débil se distingue peor</translation>
    </message>
    <message>
        <source>Recommended: its exposures cover most, from bright to dark</source>
        <translation>Recomendada: sus exposiciones abarcan más, de claro a oscuro</translation>
    </message>
    <message>
        <source>Fewer exposures: bright and dark are harder to cover</source>
        <translation>Menos exposiciones: cuesta más abarcar claros y oscuros</translation>
    </message>
    <message>
        <source>Recommended: it has most pixels</source>
        <translation>Recomendada: tiene más píxeles</translation>
    </message>
    <message>
        <source>Fewer pixels than the first</source>
        <translation>Menos píxeles que la primera</translation>
    </message>
    <message>
        <source>As suitable as the first</source>
        <translation>Tan adecuada como la primera</translation>
    </message>
    <message>
        <source>No camera answers. Check its cable and its power, and close other programs that use it.</source>
        <translation>Ninguna cámara responde. Revise su cable y su alimentación, y cierre otros programas que la usen.</translation>
    </message>
    <message>
        <source>These are found here: webcams and other video devices, industrial cameras by GigE Vision or USB3 Vision, and still cameras on USB.</source>
        <translation>Aquí se encuentran: webcams y otros dispositivos de vídeo, cámaras industriales por GigE Vision o USB3 Vision, y cámaras fotográficas por USB.</translation>
    </message>
    <message>
        <source>Any other is driven by a program of yours: go Back and choose “New venue by script”. The guide (F1) tells how cameras are set up.</source>
        <translation>Cualquier otra se maneja con un programa propio: pulse «Atrás» y elija «Nuevo lugar por script». La guía (F1) explica cómo se preparan las cámaras.</translation>
    </message>
    <message>
        <source>Any other is driven by a program of yours. The guide (F1) tells how cameras are set up.</source>
        <translation>Cualquier otra se maneja con un programa propio. La guía (F1) explica cómo se preparan las cámaras.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ClusterPage</name>
    <message>
        <source>What is measured is safe.</source>
        <translation>Lo medido está a salvo.</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>Desactualizado</translation>
    </message>
    <message>
        <source>Grouping again</source>
        <translation>Agrupando de nuevo</translation>
    </message>
    <message>
        <source>Grouping</source>
        <translation>Agrupando</translation>
    </message>
    <message>
        <source>Reading the light transport</source>
        <translation>Leyendo el transporte de luz</translation>
    </message>
    <message>
        <source>Preview content</source>
        <translation>Previsualizar</translation>
    </message>
    <message>
        <source>The clusters that are kept belong to an earlier threshold</source>
        <translation>Los clústeres guardados corresponden a un umbral anterior</translation>
    </message>
    <message>
        <source>What you see here has been grouped again. Going on keeps it.</source>
        <translation>Lo que ve aquí está agrupado de nuevo. Al continuar se guarda.</translation>
    </message>
    <message>
        <source>Cluster</source>
        <translation>Clústeres</translation>
    </message>
    <message>
        <source>Cluster map</source>
        <translation>Mapa de clústeres</translation>
    </message>
    <message>
        <source>click a pixel</source>
        <translation>clic en un píxel</translation>
    </message>
    <message>
        <source>Error map</source>
        <translation>Mapa de error</translation>
    </message>
    <message>
        <source>Flat</source>
        <translation>Plano</translation>
    </message>
    <message>
        <source>Relief</source>
        <translation>Relieve</translation>
    </message>
    <message>
        <source>Cluster sizes</source>
        <translation>Tamaños de clúster</translation>
    </message>
    <message>
        <source>Projector pixels in the cluster</source>
        <translation>Píxeles de proyector en el clúster</translation>
    </message>
    <message>
        <source>Clusters</source>
        <translation>Clústeres</translation>
    </message>
    <message>
        <source>%1, %2: in no cluster</source>
        <translation>%1, %2: en ningún clúster</translation>
    </message>
    <message>
        <source>Error map, median %1</source>
        <translation>Mapa de error, mediana %1</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>Distancia</translation>
    </message>
    <message>
        <source>small, sharp</source>
        <translation>pequeños, nítidos</translation>
    </message>
    <message>
        <source>large, fast</source>
        <translation>grandes, rápidos</translation>
    </message>
    <message>
        <source>Share of the brightest</source>
        <translation>Parte de lo más brillante</translation>
    </message>
    <message>
        <source>more detail</source>
        <translation>más detalle</translation>
    </message>
    <message>
        <source>more speed</source>
        <translation>más velocidad</translation>
    </message>
    <message>
        <source>Largest cluster</source>
        <translation>Clúster máximo</translation>
    </message>
    <message>
        <source>fast</source>
        <translation>rápido</translation>
    </message>
    <message>
        <source>exact</source>
        <translation>exacto</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>Resultado</translation>
    </message>
    <message>
        <source>Light kept in clusters</source>
        <translation>Luz dentro de clústeres</translation>
    </message>
    <message>
        <source>Median error</source>
        <translation>Error mediano</translation>
    </message>
    <message>
        <source>%1 px</source>
        <translation>%1 px</translation>
    </message>
    <message>
        <source>%1 of light</source>
        <translation>%1 de la luz</translation>
    </message>
    <message numerus="yes">
        <source>%n cluster(s)</source>
        <translation>
            <numerusform>%n clúster</numerusform>
            <numerusform>%n clústeres</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n cluster(s), median %1 px</source>
        <translation>
            <numerusform>%n clúster, mediana de %1 px</numerusform>
            <numerusform>%n clústeres, mediana de %1 px</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1, %2: %n projector pixel(s), error %3</source>
        <translation>
            <numerusform>%1, %2: %n píxel de proyector, error %3</numerusform>
            <numerusform>%1, %2: %n píxeles de proyector, error %3</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Cluster map, %n cluster(s), largest %1</source>
        <translation>
            <numerusform>Mapa de clústeres, %n clúster, el mayor %1</numerusform>
            <numerusform>Mapa de clústeres, %n clústeres, el mayor %1</numerusform>
        </translation>
    </message>
    <message>
        <source>95 % of pixels below</source>
        <translation>95 % de los píxeles por debajo de</translation>
    </message>
    <message numerus="yes">
        <source>%1, %2: %n projector pixel(s)</source>
        <translation>
            <numerusform>%1, %2: %n píxel de proyector</numerusform>
            <numerusform>%1, %2: %n píxeles de proyector</numerusform>
        </translation>
    </message>
    <message>
        <source>error</source>
        <translation>error</translation>
    </message>
    <message>
        <source>limit %1</source>
        <translation>límite %1</translation>
    </message>
    <message>
        <source>over %1</source>
        <translation>más de %1</translation>
    </message>
    <message>
        <source>about %1</source>
        <translation>unas %1</translation>
    </message>
    <message>
        <source>Cut off by the size limit</source>
        <translation>Cortada por el límite</translation>
    </message>
    <message>
        <source>Films, frames a second</source>
        <translation>Vídeo, imágenes por segundo</translation>
    </message>
    <message>
        <source>What this computer manages in Full HD with the light that Threshold keeps. The groups make no difference to it: films are solved in overlapping windows.</source>
        <translation>Lo que este ordenador consigue en Full HD con la luz que conserva Umbral. Los grupos no lo cambian: el vídeo se resuelve en ventanas que se solapan.</translation>
    </message>
    <message>
        <source>Without a size limit, one cluster would cover %1 of the picture.</source>
        <translation>Sin límite de tamaño, un clúster ocuparía el %1 de la imagen.</translation>
    </message>
    <message>
        <source>The surface is blurred across neighbouring pixels, so groups join up. The limit keeps them apart.</source>
        <translation>La superficie se desenfoca entre píxeles vecinos y los grupos se unen. El límite los mantiene separados.</translation>
    </message>
    <message>
        <source>The clusters that are kept belong to an earlier measurement</source>
        <translation>Los clústeres guardados corresponden a una medición anterior</translation>
    </message>
    <message>
        <source>Films are shown by “All bounces, for films”, whatever the clusters are. Clusters tell which places light each other, and can be compared at Preview.</source>
        <translation>Los vídeos usan «Todos los rebotes, para vídeo», sean como sean los clústeres. Los clústeres indican qué sitios se iluminan entre sí y pueden compararse en la vista previa.</translation>
    </message>
    <message>
        <source>See which parts of the surface light each other, and split them into groups that can be solved on their own.</source>
        <translation>Ver qué partes de la superficie se iluminan entre sí y dividirlas en grupos que se resuelven por separado.</translation>
    </message>
    <message>
        <source>Grouped anew</source>
        <translation>Agrupado de nuevo</translation>
    </message>
    <message>
        <source>Changed: it is applied as soon as you go on.</source>
        <translation>Cambiado: se aplica en cuanto continúe.</translation>
    </message>
    <message>
        <source>What was measured is too coarse to group. Go on measuring.</source>
        <translation>Lo medido es demasiado basto para agrupar. Siga midiendo.</translation>
    </message>
    <message>
        <source>No light is strong enough to group.</source>
        <translation>Ninguna luz es lo bastante fuerte para agrupar.</translation>
    </message>
    <message>
        <source>Reliefs need OpenGL, which is not there.</source>
        <translation>Los relieves necesitan OpenGL, que no está.</translation>
    </message>
    <message>
        <source>An error of %1 is normal here.</source>
        <translation>Un error de %1 es normal aquí.</translation>
    </message>
    <message>
        <source>Grouping drops the blur of the lens on purpose: little where it is sharp, 70 to 80 % where it is blurred. Look for patches that stand out from their surroundings.</source>
        <translation>La agrupación descarta a propósito el desenfoque del objetivo: poco donde es nítido, del 70 al 80 % donde está desenfocado. Busque manchas que destaquen de su entorno.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::CornerView</name>
    <message>
        <source>Top left corner, %1, %2.</source>
        <translation>Esquina superior izquierda, %1, %2.</translation>
    </message>
    <message>
        <source>Top right corner, %1, %2.</source>
        <translation>Esquina superior derecha, %1, %2.</translation>
    </message>
    <message>
        <source>Bottom right corner, %1, %2.</source>
        <translation>Esquina inferior derecha, %1, %2.</translation>
    </message>
    <message>
        <source>Bottom left corner, %1, %2.</source>
        <translation>Esquina inferior izquierda, %1, %2.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::DevicePage</name>
    <message>
        <source>A show is playing</source>
        <translation>Se está reproduciendo un show</translation>
    </message>
    <message>
        <source>What is begun here shines in its place. The show is seen again once it has ended.</source>
        <translation>Lo que se inicie aquí se proyecta en su lugar. El show vuelve a verse cuando termine.</translation>
    </message>
    <message>
        <source>Another program plays a show of this venue</source>
        <translation>Otro programa está reproduciendo un show de este lugar</translation>
    </message>
    <message>
        <source>The show plays on.</source>
        <translation>El show continúa.</translation>
    </message>
    <message>
        <source>End that show</source>
        <translation>Terminar ese show</translation>
    </message>
    <message>
        <source>End the show</source>
        <translation>Terminar el show</translation>
    </message>
    <message>
        <source>Let it play</source>
        <translation>Dejar que siga</translation>
    </message>
    <message>
        <source>The show that another program plays of this venue: the projector&apos;s screen goes dark.</source>
        <translation>El show de este lugar que reproduce otro programa: la pantalla del proyector se oscurece.</translation>
    </message>
    <message>
        <source>Venue and playlist stay. An installed show starts again at the next log-in.</source>
        <translation>El lugar y la lista se conservan. Un show instalado vuelve a empezar en el próximo inicio de sesión.</translation>
    </message>
    <message>
        <source>Its pictures shine on the projector whatever is shown from here, and may come between patterns that are measured.</source>
        <translation>Sus imágenes se ven en el proyector, se muestre lo que se muestre desde aquí, y pueden aparecer entre los patrones que se miden.</translation>
    </message>
    <message>
        <source>It is ending</source>
        <translation>Está terminando</translation>
    </message>
    <message>
        <source>The show that another program plays of another venue: the projector&apos;s screen goes dark.</source>
        <translation>El show de otro lugar que reproduce otro programa: la pantalla del proyector queda a oscuras.</translation>
    </message>
    <message>
        <source>Another program plays a show of another venue on this projector</source>
        <translation>Otro programa está reproduciendo un show de otro lugar en este proyector</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged. Plug it in again: the show comes back by itself.</source>
        <translation>La pantalla del proyector está desconectada. Vuelva a conectarla: el show vuelve por sí solo.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::DeviceSelector</name>
    <message>
        <source>Projector that is shown</source>
        <translation>Proyector mostrado</translation>
    </message>
    <message>
        <source>Camera that is shown</source>
        <translation>Cámara mostrada</translation>
    </message>
</context>
<context>
    <name>relucent::gui::EndingDialog</name>
    <message>
        <source>Ending</source>
        <translation>Terminando</translation>
    </message>
    <message>
        <source>Ending…</source>
        <translation>Terminando…</translation>
    </message>
    <message>
        <source>Everything that was measured is safe. The devices finish what they are doing, which can take half a minute; then this window closes by itself.</source>
        <translation>Todo lo medido está a salvo. Los dispositivos acaban lo que están haciendo, lo que puede tardar medio minuto; después esta ventana se cierra sola.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::FailureDialog</name>
    <message>
        <source>The disk did not do what was asked</source>
        <translation>El disco no hizo lo que se le pidió</translation>
    </message>
    <message>
        <source>The memory is full</source>
        <translation>La memoria está llena</translation>
    </message>
    <message>
        <source>A file cannot be read</source>
        <translation>No se puede leer un archivo</translation>
    </message>
    <message>
        <source>This cannot be done as it is</source>
        <translation>Esto no se puede hacer tal como está</translation>
    </message>
    <message>
        <source>The computation failed</source>
        <translation>El cálculo ha fallado</translation>
    </message>
    <message>
        <source>What happened</source>
        <translation>Qué ha pasado</translation>
    </message>
    <message>
        <source>What is safe</source>
        <translation>Qué está a salvo</translation>
    </message>
    <message>
        <source>What to do</source>
        <translation>Qué hacer</translation>
    </message>
    <message>
        <source>Copy details</source>
        <translation>Copiar detalles</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Cerrar</translation>
    </message>
    <message>
        <source>What it ends</source>
        <translation>Qué termina</translation>
    </message>
    <message>
        <source>What happens</source>
        <translation>Qué ocurre</translation>
    </message>
    <message>
        <source>A device did not do what was asked</source>
        <translation>Un dispositivo no hizo lo que se le pidió</translation>
    </message>
</context>
<context>
    <name>relucent::gui::FlashConsent</name>
    <message>
        <source>The projector shows patterns that change as quickly as the devices can, perhaps more than 3 times a second.</source>
        <translation>El proyector muestra patrones que cambian tan rápido como permiten los dispositivos, quizá más de 3 veces por segundo.</translation>
    </message>
    <message>
        <source>The room is clear</source>
        <translation>La sala está despejada</translation>
    </message>
    <message>
        <source>Flashing light</source>
        <translation>Luz intermitente</translation>
    </message>
    <message>
        <source>The room is clear and everyone here knows</source>
        <translation>La sala está despejada y todos los presentes lo saben</translation>
    </message>
    <message>
        <source>Flashing light can cause seizures. Clear the room and cover the entrance.</source>
        <translation>La luz intermitente puede causar crisis epilépticas. Despeje la sala y tape la entrada.</translation>
    </message>
    <message numerus="yes">
        <source>The projector shows patterns that change about %n time(s) a second, and at times more often.</source>
        <translation>
            <numerusform>El proyector muestra patrones que cambian aproximadamente una vez por segundo, a ratos más a menudo.</numerusform>
            <numerusform>El proyector muestra patrones que cambian unas %n veces por segundo, a ratos más a menudo.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::gui::HelpWindow</name>
    <message>
        <source>Help</source>
        <translation>Ayuda</translation>
    </message>
    <message>
        <source>Search the guide</source>
        <translation>Buscar en la guía</translation>
    </message>
    <message>
        <source>Pages of the guide</source>
        <translation>Páginas de la guía</translation>
    </message>
    <message>
        <source>The page</source>
        <translation>La página</translation>
    </message>
    <message>
        <source>No page holds these words.</source>
        <translation>Ninguna página contiene esas palabras.</translation>
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
        <translation>¿Líneas nítidas? Entonces esta es la resolución nativa del proyector.</translation>
    </message>
    <message>
        <source>Screen %1</source>
        <translation>Pantalla %1</translation>
    </message>
</context>
<context>
    <name>relucent::gui::LinearizePage</name>
    <message>
        <source>The photographs of this step are still in the folder.</source>
        <translation>Las fotografías de este paso siguen en la carpeta.</translation>
    </message>
    <message>
        <source>Measuring, %1</source>
        <translation>Midiendo, %1</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Medido</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>Desactualizado</translation>
    </message>
    <message>
        <source>Stopped by a failure</source>
        <translation>Detenido por un fallo</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>Los dispositivos están en uso en %1.</translation>
    </message>
    <message>
        <source>The colours do not add up. Continuing is recorded in the report.</source>
        <translation>Los colores no suman. Si continúa, constará en el informe.</translation>
    </message>
    <message>
        <source>Measured in %1</source>
        <translation>Medido en %1</translation>
    </message>
    <message>
        <source>Plan acquisition</source>
        <translation>Preparar adquisición</translation>
    </message>
    <message>
        <source>Continue anyway</source>
        <translation>Continuar igualmente</translation>
    </message>
    <message>
        <source>Measure response</source>
        <translation>Medir respuesta</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Detener</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>Medir de nuevo</translation>
    </message>
    <message>
        <source>These curves belong to earlier settings</source>
        <translation>Estas curvas corresponden a ajustes anteriores</translation>
    </message>
    <message>
        <source>They still work and stay until the new ones are measured.</source>
        <translation>Siguen sirviendo y se conservan hasta medir las nuevas.</translation>
    </message>
    <message>
        <source>Levels</source>
        <translation>Niveles</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>No se ha cambiado nada.</translation>
    </message>
    <message>
        <source>Try again</source>
        <translation>Reintentar</translation>
    </message>
    <message>
        <source>Every photograph that was taken is on the disk. Trying again goes on from there.</source>
        <translation>Todas las fotografías tomadas están en el disco. Al reintentar se sigue desde ahí.</translation>
    </message>
    <message>
        <source>Linearize</source>
        <translation>Linealización</translation>
    </message>
    <message>
        <source>Measure how much light each step of the projector&apos;s three colours really gives.</source>
        <translation>Mida cuánta luz da en realidad cada nivel de los tres colores del proyector.</translation>
    </message>
    <message>
        <source>Red</source>
        <translation>Rojo</translation>
    </message>
    <message>
        <source>Green</source>
        <translation>Verde</translation>
    </message>
    <message>
        <source>Blue</source>
        <translation>Azul</translation>
    </message>
    <message>
        <source>Sent to the projector</source>
        <translation>Enviado al proyector</translation>
    </message>
    <message>
        <source>Seen by the camera</source>
        <translation>Visto por la cámara</translation>
    </message>
    <message>
        <source>Pattern that the projector shows</source>
        <translation>Patrón que muestra el proyector</translation>
    </message>
    <message>
        <source>Last photograph</source>
        <translation>Última fotografía</translation>
    </message>
    <message>
        <source>Appears when measuring begins.</source>
        <translation>Aparece al empezar la medición.</translation>
    </message>
    <message>
        <source>%1, photograph %2</source>
        <translation>%1, fotografía %2</translation>
    </message>
    <message>
        <source>Response of the projector</source>
        <translation>Respuesta del proyector</translation>
    </message>
    <message>
        <source>Level sent to the projector</source>
        <translation>Nivel enviado al proyector</translation>
    </message>
    <message>
        <source>Light, % of full</source>
        <translation>Luz, % del máximo</translation>
    </message>
    <message>
        <source>Light of every level, three colours</source>
        <translation>Luz de cada nivel, tres colores</translation>
    </message>
    <message>
        <source>as it is measured</source>
        <translation>según se mide</translation>
    </message>
    <message numerus="yes">
        <source>%n level(s) a colour, drift removed</source>
        <translation>
            <numerusform>%n nivel por color, sin deriva</numerusform>
            <numerusform>%n niveles por color, sin deriva</numerusform>
        </translation>
    </message>
    <message>
        <source>not measured yet</source>
        <translation>aún sin medir</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>Resultado</translation>
    </message>
    <message>
        <source>Exposures</source>
        <translation>Exposiciones</translation>
    </message>
    <message>
        <source>Chosen for this venue</source>
        <translation>Elegidas para este lugar</translation>
    </message>
    <message>
        <source>Measure with</source>
        <translation>Medir con</translation>
    </message>
    <message>
        <source>Levels a colour</source>
        <translation>Niveles por color</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>Midiendo</translation>
    </message>
    <message>
        <source>Not measured yet</source>
        <translation>Aún sin medir</translation>
    </message>
    <message>
        <source>Whether the colours add up, the camera is linear and every level is brighter than the one below is told when all levels are measured.</source>
        <translation>Si los colores suman, si la cámara es lineal y si cada nivel es más claro que el anterior se sabrá cuando estén medidos todos los niveles.</translation>
    </message>
    <message>
        <source>The colours add up</source>
        <translation>Los colores suman</translation>
    </message>
    <message>
        <source>Red, green and blue together give white within %1.</source>
        <translation>Rojo, verde y azul juntos dan el blanco con un margen del %1.</translation>
    </message>
    <message>
        <source>The colours do not add up</source>
        <translation>Los colores no suman</translation>
    </message>
    <message>
        <source>White differs by %1 from its colours. Turn off “brilliant” or “dynamic” in the projector&apos;s menu, then measure again.</source>
        <translation>El blanco difiere de sus colores en un %1. Desactive «brillante» o «dinámico» en el menú del proyector y mida de nuevo.</translation>
    </message>
    <message>
        <source>The camera is linear</source>
        <translation>La cámara es lineal</translation>
    </message>
    <message>
        <source>The camera&apos;s curve is known</source>
        <translation>La curva de la cámara se conoce</translation>
    </message>
    <message>
        <source>Doubling the exposure doubles the signal.</source>
        <translation>Al duplicar la exposición se duplica la señal.</translation>
    </message>
    <message>
        <source>Its photographs are brought back to linear light.</source>
        <translation>Sus fotografías se convierten de nuevo a luz lineal.</translation>
    </message>
    <message>
        <source>Curves rise everywhere</source>
        <translation>Las curvas siempre suben</translation>
    </message>
    <message>
        <source>No level is darker than the one below it.</source>
        <translation>Ningún nivel es más oscuro que el anterior.</translation>
    </message>
    <message>
        <source>Found while measuring</source>
        <translation>Hallado al medir</translation>
    </message>
    <message numerus="yes">
        <source>About %n test pattern(s)</source>
        <translation>
            <numerusform>Alrededor de %n patrón de prueba</numerusform>
            <numerusform>Unos %n patrones de prueba</numerusform>
        </translation>
    </message>
    <message>
        <source>Go on now</source>
        <translation>Seguir ahora</translation>
    </message>
    <message>
        <source>Measuring with these settings. Stop to change them.</source>
        <translation>Se está midiendo con estos ajustes. Deténgalo para cambiarlos.</translation>
    </message>
    <message>
        <source>Keep the earlier one</source>
        <translation>Conservar la anterior</translation>
    </message>
    <message>
        <source>The earlier curves are used again, with all that followed from them.</source>
        <translation>Se vuelven a usar las curvas anteriores, con todo lo que siguió de ellas.</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>Lo medido está a salvo.</translation>
    </message>
    <message>
        <source>Black level</source>
        <translation>Nivel de negro</translation>
    </message>
    <message>
        <source>Contrast</source>
        <translation>Contraste</translation>
    </message>
    <message>
        <source>%1 of full light</source>
        <translation>%1 de la luz plena</translation>
    </message>
    <message>
        <source>Colours within %1</source>
        <translation>Colores con error de %1</translation>
    </message>
    <message>
        <source>How far each level&apos;s light is from the fitted curve</source>
        <translation>Cuánto se aparta de la curva la luz de cada nivel</translation>
    </message>
    <message>
        <source>within ±%1</source>
        <translation>dentro de ±%1</translation>
    </message>
    <message>
        <source>One test pattern shows many levels side by side, so few patterns are enough.</source>
        <translation>Un patrón de prueba muestra muchos niveles a la vez; por eso bastan pocos.</translation>
    </message>
    <message>
        <source>Off the curve</source>
        <translation>Desvío de la curva</translation>
    </message>
    <message>
        <source>Residuals: what was photographed, less the curve that was fitted to it.</source>
        <translation>Residuos: lo fotografiado menos la curva ajustada a ello.</translation>
    </message>
    <message>
        <source>Off the curve, % of full</source>
        <translation>Desvío de la curva, % del máximo</translation>
    </message>
    <message>
        <source>Stopping after the photograph under way.</source>
        <translation>Se detiene tras la fotografía en curso.</translation>
    </message>
    <message>
        <source>To measure again, confirm that the room is clear.</source>
        <translation>Para medir de nuevo, confirme que la sala está despejada.</translation>
    </message>
    <message>
        <source>Colours off by %1</source>
        <translation>Colores desviados un %1</translation>
    </message>
    <message>
        <source>The photographs contradict each other. See that nothing covers the lens, then measure again.</source>
        <translation>Las fotografías se contradicen. Compruebe que nada tape el objetivo y mida de nuevo.</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the patterns flash.</source>
        <translation>Confirme que la sala está despejada: los patrones destellan.</translation>
    </message>
    <message>
        <source>The photographs contradict each other</source>
        <translation>Las fotografías se contradicen</translation>
    </message>
    <message>
        <source>White differs by %1 from its colours, and levels by up to %2 from their curve: no picture mode does that. Something covered the lens or the picture, or the light changed. Nothing else is told from these photographs; measure again.</source>
        <translation>El blanco difiere en %1 de sus colores, y los niveles hasta en %2 de su curva: ningún modo de imagen causa eso. Algo tapaba el objetivo o la imagen, o cambió la luz. De estas fotografías no se deduce nada más; mida de nuevo.</translation>
    </message>
    <message>
        <source>The camera sees hardly any light of the projector</source>
        <translation>La cámara apenas ve luz del proyector</translation>
    </message>
    <message>
        <source>See that nothing covers the lens or the picture. What is photographed meanwhile is lost: stop, and measure again.</source>
        <translation>Compruebe que nada tape el objetivo ni la imagen. Lo que se fotografíe mientras tanto se pierde: detenga y mida de nuevo.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MainWindow</name>
    <message>
        <source>Dim pictures</source>
        <translation>Atenuar imágenes</translation>
    </message>
    <message>
        <source>Pictures dimmed</source>
        <translation>Imágenes atenuadas</translation>
    </message>
    <message>
        <source>Settings</source>
        <translation>Ajustes</translation>
    </message>
    <message>
        <source>Help</source>
        <translation>Ayuda</translation>
    </message>
    <message>
        <source>F1</source>
        <translation>F1</translation>
    </message>
    <message>
        <source>Less light from this screen falls into the room (F9)</source>
        <translation>Cae menos luz de esta pantalla en la sala (F9)</translation>
    </message>
    <message>
        <source>Undone: %1</source>
        <translation>Deshecho: %1</translation>
    </message>
    <message>
        <source>Nothing to undo here</source>
        <translation>Aquí no hay nada que deshacer</translation>
    </message>
    <message>
        <source>Done again: %1</source>
        <translation>Rehecho: %1</translation>
    </message>
    <message>
        <source>Nothing to do again</source>
        <translation>Nada que rehacer</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MaskEditing</name>
    <message>
        <source>This is no mask: %1.</source>
        <translation>Esto no es una máscara: %1.</translation>
    </message>
    <message>
        <source>New mask</source>
        <translation>Máscara nueva</translation>
    </message>
    <message>
        <source>Outline of a mask</source>
        <translation>Contorno de una máscara</translation>
    </message>
    <message>
        <source>Feather of a mask</source>
        <translation>Borde suave de una máscara</translation>
    </message>
    <message>
        <source>Removed mask</source>
        <translation>Máscara quitada</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MaskView</name>
    <message numerus="yes">
        <source>Drawing a mask: %n point(s). Space sets one at %1, %2. Return closes it, Escape leaves it.</source>
        <translation>
            <numerusform>Dibujando una máscara: %n punto. Espacio pone uno en %1, %2. Intro la cierra, Escape la abandona.</numerusform>
            <numerusform>Dibujando una máscara: %n puntos. Espacio pone uno en %1, %2. Intro la cierra, Escape la abandona.</numerusform>
        </translation>
    </message>
    <message>
        <source>Point %1 of %2, %3, %4.</source>
        <translation>Punto %1 de %2, %3, %4.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MatrixView</name>
    <message>
        <source>camera %1
projector %2</source>
        <translation>cámara %1
proyector %2</translation>
    </message>
    <message>
        <source>%1
%2</source>
        <translation>%1
%2</translation>
    </message>
    <message>
        <source>transport</source>
        <translation>transporte</translation>
    </message>
    <message>
        <source>projector x, y</source>
        <translation>proyector x, y</translation>
    </message>
    <message>
        <source>projector line</source>
        <translation>línea proyector</translation>
    </message>
    <message>
        <source>camera x, y</source>
        <translation>cámara x, y</translation>
    </message>
    <message>
        <source>camera line</source>
        <translation>línea cámara</translation>
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
        <translation>Nombre</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Cancelar</translation>
    </message>
    <message>
        <source>Type a name.</source>
        <translation>Escriba un nombre.</translation>
    </message>
    <message>
        <source>It has this name.</source>
        <translation>Ya tiene este nombre.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Nights</name>
    <message>
        <source>The venue was as it was measured.</source>
        <translation>El lugar estaba como se midió.</translation>
    </message>
    <message>
        <source>Repaired.</source>
        <translation>Reparada.</translation>
    </message>
    <message>
        <source>Something has changed, and no better picture came of a repair.</source>
        <translation>Algo ha cambiado, y de una reparación no salió una imagen mejor.</translation>
    </message>
    <message>
        <source>%1 dB</source>
        <translation>%1 dB</translation>
    </message>
    <message>
        <source>Photographed</source>
        <translation>Fotografiado</translation>
    </message>
    <message>
        <source>Predicted</source>
        <translation>Previsto</translation>
    </message>
    <message>
        <source>Repaired</source>
        <translation>Reparada</translation>
    </message>
    <message>
        <source>Alarm</source>
        <translation>Alarma</translation>
    </message>
    <message>
        <source>Days before the last night</source>
        <translation>Días antes de la última noche</translation>
    </message>
    <message>
        <source>Colour error ΔE</source>
        <translation>Error de color ΔE</translation>
    </message>
    <message numerus="yes">
        <source>%n night(s).</source>
        <translation>
            <numerusform>%n noche.</numerusform>
            <numerusform>%n noches.</numerusform>
        </translation>
    </message>
    <message>
        <source>Photographed: %1 to %2, last %3.</source>
        <translation>Fotografiado: %1 a %2, el último %3.</translation>
    </message>
    <message>
        <source>Repairs: %1. Alarms: %2.</source>
        <translation>Reparaciones: %1. Alarmas: %2.</translation>
    </message>
    <message>
        <source>Left out: %1</source>
        <translation>Omitida: %1</translation>
    </message>
    <message>
        <source>Alarm: %1</source>
        <translation>Alarma: %1</translation>
    </message>
    <message numerus="yes">
        <source>%n picture(s) perfected.</source>
        <translation>
            <numerusform>%n imagen perfeccionada.</numerusform>
            <numerusform>%n imágenes perfeccionadas.</numerusform>
        </translation>
    </message>
    <message>
        <source>Photographed: %1, predicted: %2.</source>
        <translation>Fotografiado: %1, previsto: %2.</translation>
    </message>
    <message>
        <source>Nobody was told: %1</source>
        <translation>No se avisó a nadie: %1</translation>
    </message>
    <message>
        <source>Quality, dB</source>
        <translation>Calidad, dB</translation>
    </message>
</context>
<context>
    <name>relucent::gui::NightsDialog</name>
    <message>
        <source>Quality over weeks</source>
        <translation>Calidad por semanas</translation>
    </message>
    <message>
        <source>Colour error</source>
        <translation>Error de color</translation>
    </message>
    <message>
        <source>What the photograph of each night&apos;s proof came to, beside what was predicted.</source>
        <translation>Lo que dio la fotografía de verificación de cada noche, junto a lo previsto.</translation>
    </message>
    <message>
        <source>Quality of the picture, night by night</source>
        <translation>Calidad de la imagen, noche a noche</translation>
    </message>
    <message>
        <source>What came of each night, the last one first</source>
        <translation>El resultado de cada noche, la última primero</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Cerrar</translation>
    </message>
    <message>
        <source>Quality</source>
        <translation>Calidad</translation>
    </message>
    <message>
        <source>Colour error: CIEDE2000, less is better. Quality: peak signal-to-noise ratio, PSNR, in dB; more is better.</source>
        <translation>Error de color: CIEDE2000, menos es mejor. Calidad: relación señal-ruido de pico, PSNR, en dB; más es mejor.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::NightsPart</name>
    <message>
        <source>Every night</source>
        <translation>Cada noche</translation>
    </message>
    <message>
        <source>Quality over weeks</source>
        <translation>Calidad por semanas</translation>
    </message>
    <message>
        <source>A chart of all nights, and what came of each.</source>
        <translation>Un gráfico de todas las noches y el resultado de cada una.</translation>
    </message>
    <message>
        <source>There was no night yet</source>
        <translation>Aún no ha habido ninguna noche</translation>
    </message>
    <message>
        <source>Somebody has to look, %1</source>
        <translation>Alguien tiene que mirar, %1</translation>
    </message>
    <message>
        <source>Left out, %1</source>
        <translation>Omitida, %1</translation>
    </message>
    <message>
        <source>All is well, %1</source>
        <translation>Todo va bien, %1</translation>
    </message>
    <message>
        <source>Look after the picture</source>
        <translation>Cuidar de la imagen</translation>
    </message>
    <message>
        <source>never</source>
        <translation>nunca</translation>
    </message>
    <message>
        <source>at %1</source>
        <translation>a las %1</translation>
    </message>
    <message>
        <source>A show can look after the picture by itself at night: it checks, repairs, perfects and proves, and tells here what came of it. Its camera has to stay where it is.</source>
        <translation>Un show puede cuidar por sí solo de la imagen de noche: comprueba, repara, perfecciona y prueba, y dice aquí el resultado. Su cámara debe quedarse donde está.</translation>
    </message>
    <message>
        <source>No show of a rehearsal is looked after.</source>
        <translation>El show de un ensayo no se cuida.</translation>
    </message>
    <message>
        <source>The installed show has its first one at %1, if it plays by then. Its camera has to stay where it is.</source>
        <translation>El show instalado tiene la primera a las %1, si para entonces está en marcha. Su cámara tiene que quedarse donde está.</translation>
    </message>
    <message>
        <source>A night is under way</source>
        <translation>Hay una noche en curso</translation>
    </message>
    <message>
        <source>The show makes way while its picture is looked after. What comes of it is told here.</source>
        <translation>El show cede el paso mientras se cuida su imagen. Aquí se dirá el resultado.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::NudgeDialog</name>
    <message>
        <source>fits</source>
        <translation>encaja</translation>
    </message>
    <message>
        <source>Turn the camera to the right and down.</source>
        <translation>Gire la cámara a la derecha y hacia abajo.</translation>
    </message>
    <message>
        <source>Turn the camera to the right and up.</source>
        <translation>Gire la cámara a la derecha y hacia arriba.</translation>
    </message>
    <message>
        <source>Turn the camera to the left and down.</source>
        <translation>Gire la cámara a la izquierda y hacia abajo.</translation>
    </message>
    <message>
        <source>Turn the camera to the left and up.</source>
        <translation>Gire la cámara a la izquierda y hacia arriba.</translation>
    </message>
    <message>
        <source>Turn the camera to the right.</source>
        <translation>Gire la cámara a la derecha.</translation>
    </message>
    <message>
        <source>Turn the camera to the left.</source>
        <translation>Gire la cámara a la izquierda.</translation>
    </message>
    <message>
        <source>Turn the camera down.</source>
        <translation>Gire la cámara hacia abajo.</translation>
    </message>
    <message>
        <source>Turn the camera up.</source>
        <translation>Gire la cámara hacia arriba.</translation>
    </message>
    <message>
        <source>Tilt the camera clockwise.</source>
        <translation>Incline la cámara en el sentido de las agujas del reloj.</translation>
    </message>
    <message>
        <source>Tilt the camera anticlockwise.</source>
        <translation>Incline la cámara en sentido contrario a las agujas del reloj.</translation>
    </message>
    <message>
        <source>What the camera saw, and what it sees now</source>
        <translation>Lo que la cámara veía y lo que ve ahora</translation>
    </message>
    <message>
        <source>The projector shows full light. Left of the line stands what the camera saw when the venue was measured, right of it what it sees now.</source>
        <translation>El proyector muestra luz plena. A la izquierda de la línea está lo que la cámara veía al medir el lugar; a la derecha, lo que ve ahora.</translation>
    </message>
    <message>
        <source>Sideways</source>
        <translation>De lado</translation>
    </message>
    <message>
        <source>Up and down</source>
        <translation>Arriba y abajo</translation>
    </message>
    <message>
        <source>Tilt</source>
        <translation>Inclinación</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Cerrar</translation>
    </message>
    <message>
        <source>Opening the devices</source>
        <translation>Abriendo los dispositivos</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Medido</translation>
    </message>
    <message>
        <source>Now</source>
        <translation>Ahora</translation>
    </message>
    <message>
        <source>%1 px to the right</source>
        <translation>%1 px a la derecha</translation>
    </message>
    <message>
        <source>%1 px to the left</source>
        <translation>%1 px a la izquierda</translation>
    </message>
    <message>
        <source>%1 px down</source>
        <translation>%1 px hacia abajo</translation>
    </message>
    <message>
        <source>%1 px up</source>
        <translation>%1 px hacia arriba</translation>
    </message>
    <message>
        <source>%1°</source>
        <translation>%1°</translation>
    </message>
    <message>
        <source>Looking through the camera</source>
        <translation>Mirando por la cámara</translation>
    </message>
    <message>
        <source>The camera looks where it looked.</source>
        <translation>La cámara mira adonde miraba.</translation>
    </message>
    <message>
        <source>Fasten it, look once more, and close this window.</source>
        <translation>Fíjela, mire otra vez y cierre esta ventana.</translation>
    </message>
    <message>
        <source>The arrow shows where. If the projector was bumped instead, move its picture the other way.</source>
        <translation>La flecha indica hacia dónde. Si lo que se movió fue el proyector, desplace su imagen en sentido contrario.</translation>
    </message>
    <message>
        <source>What is seen is not the view that was measured.</source>
        <translation>Lo que se ve no es la vista que se midió.</translation>
    </message>
    <message>
        <source>Turn the camera until both halves look alike. If they do, the light or the surface has changed.</source>
        <translation>Gire la cámara hasta que ambas mitades se parezcan. Si ya se parecen, ha cambiado la luz o la superficie.</translation>
    </message>
    <message>
        <source>Put the camera back</source>
        <translation>Recolocar la cámara</translation>
    </message>
    <message>
        <source>In a rehearsal it comes back by itself while you look.</source>
        <translation>En un ensayo vuelve sola mientras usted mira.</translation>
    </message>
    <message>
        <source>%1° clockwise</source>
        <translation>%1° en el sentido de las agujas del reloj</translation>
    </message>
    <message>
        <source>%1° anticlockwise</source>
        <translation>%1° en sentido contrario a las agujas del reloj</translation>
    </message>
    <message>
        <source>If the projector was bumped instead, move its picture the other way.</source>
        <translation>Si lo golpeado fue el proyector, mueva su imagen en sentido contrario.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputPage</name>
    <message>
        <source>Projector&apos;s screen</source>
        <translation>Pantalla del proyector</translation>
    </message>
    <message>
        <source>This screen</source>
        <translation>Esta pantalla</translation>
    </message>
    <message>
        <source>%1: measured ΔE %2, predicted %3</source>
        <translation>%1: ΔE medida %2, prevista %3</translation>
    </message>
    <message>
        <source>Not photographed yet</source>
        <translation>Aún sin fotografiar</translation>
    </message>
    <message>
        <source>One photograph shows whether the surface looks as predicted.</source>
        <translation>Una fotografía muestra si la superficie se ve según lo previsto.</translation>
    </message>
    <message>
        <source>Corrected</source>
        <translation>Corregido</translation>
    </message>
    <message>
        <source>Original</source>
        <translation>Original</translation>
    </message>
    <message>
        <source>%1 of the picture can be reached.</source>
        <translation>El %1 de la imagen es alcanzable.</translation>
    </message>
    <message>
        <source>The surface looks as predicted</source>
        <translation>La superficie se ve según lo previsto</translation>
    </message>
    <message>
        <source>The camera or projector may have moved.</source>
        <translation>La cámara o el proyector pueden haberse movido.</translation>
    </message>
    <message>
        <source>Error of the test patterns: %1, when measured %2. %3 of the view changed.</source>
        <translation>Error de los patrones de prueba: %1, al medir %2. Ha cambiado el %3 de la vista.</translation>
    </message>
    <message>
        <source>The measurement still holds</source>
        <translation>La medición sigue siendo válida</translation>
    </message>
    <message>
        <source>Verification</source>
        <translation>Verificación</translation>
    </message>
    <message>
        <source>Take verification photograph</source>
        <translation>Tomar fotografía de verificación</translation>
    </message>
    <message>
        <source>Ctrl+Shift+V</source>
        <translation>Ctrl+Mayús+V</translation>
    </message>
    <message>
        <source>Check for drift</source>
        <translation>Comprobar deriva</translation>
    </message>
    <message>
        <source>Photographs the test patterns of the measurement again, ten or so.</source>
        <translation>Fotografía de nuevo los patrones de prueba de la medición, unos diez.</translation>
    </message>
    <message>
        <source>Hand over</source>
        <translation>Entrega</translation>
    </message>
    <message>
        <source>Save report</source>
        <translation>Guardar informe</translation>
    </message>
    <message>
        <source>Installed. The show starts at the next log-in, without camera or wizard.</source>
        <translation>Instalado. El show empieza en el próximo inicio de sesión, sin cámara ni asistente.</translation>
    </message>
    <message>
        <source>Playlist</source>
        <translation>Lista de reproducción</translation>
    </message>
    <message>
        <source>The picture stands in its middle, pixel for pixel.</source>
        <translation>La imagen se muestra en su centro, píxel por píxel.</translation>
    </message>
    <message>
        <source>Still pictures: %1</source>
        <translation>Imágenes fijas: %1</translation>
    </message>
    <message>
        <source>Films and cross-fades use windows and steps, which are quick enough.</source>
        <translation>Los vídeos y los fundidos usan ventanas y pasos, que son lo bastante rápidos.</translation>
    </message>
    <message>
        <source>Make the list again.</source>
        <translation>Vuelva a crear la lista.</translation>
    </message>
    <message>
        <source>Black</source>
        <translation>Negro</translation>
    </message>
    <message>
        <source>Frozen</source>
        <translation>Congelado</translation>
    </message>
    <message>
        <source>Playing</source>
        <translation>Reproduciendo</translation>
    </message>
    <message>
        <source>Add a picture or a film to the playlist.</source>
        <translation>Añada una imagen o un vídeo a la lista.</translation>
    </message>
    <message>
        <source>Choose the projector&apos;s screen.</source>
        <translation>Elija la pantalla del proyector.</translation>
    </message>
    <message>
        <source>Playing. Hold A to compare.</source>
        <translation>Reproduciendo. Mantenga A para comparar.</translation>
    </message>
    <message>
        <source>Take a verification photograph, or install without proof.</source>
        <translation>Tome una fotografía de verificación o instale sin prueba.</translation>
    </message>
    <message>
        <source>Nothing is projected before you open the output.</source>
        <translation>No se proyecta nada hasta que abra la salida.</translation>
    </message>
    <message>
        <source>Install show</source>
        <translation>Instalar show</translation>
    </message>
    <message>
        <source>Install without proof</source>
        <translation>Instalar sin prueba</translation>
    </message>
    <message>
        <source>Open output</source>
        <translation>Abrir salida</translation>
    </message>
    <message>
        <source>Play</source>
        <translation>Reproducir</translation>
    </message>
    <message>
        <source>Freeze</source>
        <translation>Congelar</translation>
    </message>
    <message>
        <source>Show again</source>
        <translation>Quitar negro</translation>
    </message>
    <message>
        <source>Close output</source>
        <translation>Cerrar salida</translation>
    </message>
    <message>
        <source>Add to the playlist</source>
        <translation>Añadir a la lista</translation>
    </message>
    <message>
        <source>Remove from the playlist</source>
        <translation>Quitar de la lista</translation>
    </message>
    <message>
        <source>Order of the playlist</source>
        <translation>Orden de la lista</translation>
    </message>
    <message>
        <source>Repeat</source>
        <translation>Repetir</translation>
    </message>
    <message>
        <source>Cross-fade</source>
        <translation>Fundido</translation>
    </message>
    <message>
        <source>The calibration is as it was.</source>
        <translation>La calibración está como estaba.</translation>
    </message>
    <message>
        <source>Output</source>
        <translation>Salida</translation>
    </message>
    <message>
        <source>Play corrected content, prove that it works with one photograph, and hand the venue over.</source>
        <translation>Reproduzca contenido corregido, demuestre con una fotografía que funciona y entregue el lugar.</translation>
    </message>
    <message>
        <source>Playback</source>
        <translation>Reproducción</translation>
    </message>
    <message>
        <source>frames a second</source>
        <translation>fotogramas/s</translation>
    </message>
    <message>
        <source>frame time</source>
        <translation>por fotograma</translation>
    </message>
    <message>
        <source>frames late</source>
        <translation>con retraso</translation>
    </message>
    <message>
        <source>Seconds</source>
        <translation>Segundos</translation>
    </message>
    <message>
        <source>Frame time, ms</source>
        <translation>Tiempo por fotograma, ms</translation>
    </message>
    <message>
        <source>Frame times of the last minute</source>
        <translation>Tiempos por fotograma del último minuto</translation>
    </message>
    <message>
        <source>%1 ms</source>
        <translation>%1 ms</translation>
    </message>
    <message>
        <source>closed</source>
        <translation>cerrada</translation>
    </message>
    <message>
        <source>on %1</source>
        <translation>en %1</translation>
    </message>
    <message>
        <source>still picture, on %1</source>
        <translation>imagen fija, en %1</translation>
    </message>
    <message>
        <source>On the projector now</source>
        <translation>Ahora en el proyector</translation>
    </message>
    <message>
        <source>What the projector shows</source>
        <translation>Lo que muestra el proyector</translation>
    </message>
    <message>
        <source>Photograph of the surface</source>
        <translation>Fotografía de la superficie</translation>
    </message>
    <message>
        <source>What was wanted at the left of the divider, the photograph at the right</source>
        <translation>Lo deseado a la izquierda del divisor, la fotografía a la derecha</translation>
    </message>
    <message>
        <source>No verification photograph has been taken.</source>
        <translation>No se ha tomado ninguna fotografía de verificación.</translation>
    </message>
    <message>
        <source>Photograph against wanted</source>
        <translation>Fotografía frente a lo deseado</translation>
    </message>
    <message>
        <source>colour difference</source>
        <translation>diferencia de color</translation>
    </message>
    <message>
        <source>Colour difference between the photograph and what was wanted</source>
        <translation>Diferencia de color entre la fotografía y lo deseado</translation>
    </message>
    <message>
        <source>A verification photograph shows here what is left to see.</source>
        <translation>Una fotografía de verificación muestra aquí lo que aún se nota.</translation>
    </message>
    <message>
        <source>taken %1</source>
        <translation>tomada: %1</translation>
    </message>
    <message>
        <source>Wanted</source>
        <translation>Deseado</translation>
    </message>
    <message>
        <source>Photograph</source>
        <translation>Fotografía</translation>
    </message>
    <message>
        <source>Delete removes an item, Ctrl+Up and Ctrl+Down move it. Files can be dropped here.</source>
        <translation>Supr quita un elemento, Ctrl+Arriba y Ctrl+Abajo lo mueven. Se pueden soltar archivos aquí.</translation>
    </message>
    <message>
        <source>%1, playing</source>
        <translation>%1, en reproducción</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Añadir</translation>
    </message>
    <message>
        <source>Add files to the playlist</source>
        <translation>Añadir archivos a la lista</translation>
    </message>
    <message>
        <source>Move up</source>
        <translation>Subir</translation>
    </message>
    <message>
        <source>Move down</source>
        <translation>Bajar</translation>
    </message>
    <message>
        <source>Cross-fade, tenths of a second</source>
        <translation>Fundido, décimas de segundo</translation>
    </message>
    <message>
        <source>Add pictures or films</source>
        <translation>Añadir imágenes o vídeos</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>Skipped: %1</source>
        <translation>Omitido: %1</translation>
    </message>
    <message>
        <source>This screen&apos;s resolution is not that of the projector that was measured.</source>
        <translation>La resolución de esta pantalla no es la del proyector medido.</translation>
    </message>
    <message>
        <source>Written to %1, and for paper to report.pdf beside it.</source>
        <translation>Escrito en %1 y, para papel, en report.pdf a su lado.</translation>
    </message>
    <message>
        <source>The projector is another screen now</source>
        <translation>El proyector es ahora otra pantalla</translation>
    </message>
    <message>
        <source>Show installed</source>
        <translation>Show instalado</translation>
    </message>
    <message>
        <source>Installed at %1: the show starts at the next log-in. Hold A to compare.</source>
        <translation>Instalado a las %1: el show empieza en el próximo inicio de sesión. Mantenga A para comparar.</translation>
    </message>
    <message>
        <source>The output will cover this window. Esc closes the output.</source>
        <translation>La salida cubrirá esta ventana. Esc cierra la salida.</translation>
    </message>
    <message>
        <source>Install again</source>
        <translation>Instalar de nuevo</translation>
    </message>
    <message>
        <source>The projector&apos;s screen %1 is not there. Plug it in, or choose another.</source>
        <translation>La pantalla %1 del proyector no está. Conéctela o elija otra.</translation>
    </message>
    <message>
        <source>Choose a screen for projector %1.</source>
        <translation>Elija una pantalla para el proyector %1.</translation>
    </message>
    <message numerus="yes">
        <source>Each of the %n projector(s) needs a screen of its own. Plug in another one.</source>
        <translation>
            <numerusform>El proyector necesita una pantalla propia. Conecte una.</numerusform>
            <numerusform>Cada uno de los %n proyectores necesita una pantalla propia. Conecte otra.</numerusform>
        </translation>
    </message>
    <message>
        <source>There is one screen only. Plug the projector in and extend the desktop to it, or choose this screen.</source>
        <translation>Solo hay una pantalla. Conecte el proyector y extienda el escritorio a él, o elija esta pantalla.</translation>
    </message>
    <message>
        <source>still picture, %1 of the pixels at their limit</source>
        <translation>imagen fija, %1 de los píxeles en su límite</translation>
    </message>
    <message>
        <source>%1 fps, %2 ms, %3 of the pixels at their limit</source>
        <translation>%1 fps, %2 ms, %3 de los píxeles en su límite</translation>
    </message>
    <message>
        <source>Screen unplugged</source>
        <translation>Pantalla desconectada</translation>
    </message>
    <message>
        <source>The surface does not look as predicted. Find out whether something moved.</source>
        <translation>La superficie no se ve como se predijo. Averigüe si algo se movió.</translation>
    </message>
    <message>
        <source>Something has changed since it was measured. Measure again, then install.</source>
        <translation>Algo ha cambiado desde la medición. Mida de nuevo y luego instale.</translation>
    </message>
    <message>
        <source>Install anyway</source>
        <translation>Instalar de todos modos</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>Medir de nuevo</translation>
    </message>
    <message>
        <source>Aim again</source>
        <translation>Orientar de nuevo</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged</source>
        <translation>La pantalla del proyector está desconectada</translation>
    </message>
    <message>
        <source>Nothing is lost. Plug it in again: the show comes back by itself.</source>
        <translation>No se ha perdido nada. Vuelva a conectarla: el show vuelve por sí solo.</translation>
    </message>
    <message>
        <source>The camera&apos;s view has moved by %1 px sideways and %2 px up or down.</source>
        <translation>La vista de la cámara se ha desplazado %1 px de lado y %2 px arriba o abajo.</translation>
    </message>
    <message>
        <source>Shows full light, and where the camera has to be turned to look where it looked.</source>
        <translation>Muestra luz plena y hacia dónde girar la cámara para que mire adonde miraba.</translation>
    </message>
    <message>
        <source>Limit for %1 frames a second: %2 ms</source>
        <translation>Límite para %1 imágenes por segundo: %2 ms</translation>
    </message>
    <message>
        <source>the processor</source>
        <translation>el procesador</translation>
    </message>
    <message>
        <source>Next test chart (T)</source>
        <translation>Siguiente carta de prueba (T)</translation>
    </message>
    <message>
        <source>Figures over the picture (O)</source>
        <translation>Cifras sobre la imagen (O)</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>Los dispositivos están en uso en %1.</translation>
    </message>
    <message>
        <source>Put the camera back</source>
        <translation>Recolocar la cámara</translation>
    </message>
    <message>
        <source>On this page only</source>
        <translation>Solo en esta página</translation>
    </message>
    <message>
        <source>The photograph is out of date</source>
        <translation>La fotografía está desactualizada</translation>
    </message>
    <message>
        <source>Another venue&apos;s show starts at log-in. Installing this one replaces it.</source>
        <translation>El show de otro lugar empieza al iniciar sesión. Instalar este lo reemplaza.</translation>
    </message>
    <message>
        <source>Another venue&apos;s show starts at log-in. This is a rehearsal, which is not installed.</source>
        <translation>El show de otro lugar empieza al iniciar sesión. Esto es un ensayo, que no se instala.</translation>
    </message>
    <message>
        <source>Once installed, the show starts at every log-in, without camera or wizard.</source>
        <translation>Una vez instalado, el show empieza en cada inicio de sesión, sin cámara ni asistente.</translation>
    </message>
    <message>
        <source>This is a rehearsal with simulated devices: its show is not installed. That of a real venue starts at every log-in.</source>
        <translation>Esto es un ensayo con dispositivos simulados: su show no se instala. El de un lugar real empieza en cada inicio de sesión.</translation>
    </message>
    <message>
        <source>Remove installed show</source>
        <translation>Quitar el show instalado</translation>
    </message>
    <message>
        <source>It does not start at log-in any more. Venue and playlist stay.</source>
        <translation>Ya no empieza al iniciar sesión. El lugar y la lista se conservan.</translation>
    </message>
    <message>
        <source>Proof out of date</source>
        <translation>Prueba desactualizada</translation>
    </message>
    <message>
        <source>Take a verification photograph: it proves that the venue is measured well.</source>
        <translation>Tome una fotografía de verificación: prueba que el lugar está bien medido.</translation>
    </message>
    <message>
        <source>This rehearsal plays on this page only: nothing is projected.</source>
        <translation>Este ensayo se reproduce solo en esta página: no se proyecta nada.</translation>
    </message>
    <message>
        <source>Black: the show goes on unseen until you show it again.</source>
        <translation>Negro: el show sigue sin verse hasta que lo muestre de nuevo.</translation>
    </message>
    <message>
        <source>Frozen: this picture stands until you press Play.</source>
        <translation>Congelado: esta imagen se queda hasta que pulse Reproducir.</translation>
    </message>
    <message>
        <source>Rehearsed to the end. A simulated venue is not installed. Hold A to compare.</source>
        <translation>Ensayado hasta el final. Un lugar simulado no se instala. Mantenga A para comparar.</translation>
    </message>
    <message>
        <source>The verification photograph is out of date</source>
        <translation>La fotografía de verificación está desactualizada</translation>
    </message>
    <message>
        <source>taken %1, out of date</source>
        <translation>tomada: %1, desactualizada</translation>
    </message>
    <message>
        <source>No screen chosen</source>
        <translation>Ninguna pantalla elegida</translation>
    </message>
    <message>
        <source>%1, unplugged</source>
        <translation>%1, desconectada</translation>
    </message>
    <message>
        <source>Not to be proved yet</source>
        <translation>Aún no se puede verificar</translation>
    </message>
    <message>
        <source>What it was taken of has been measured or chosen anew since, or is another set. Take it again to prove what is shown now.</source>
        <translation>Lo que muestra se ha medido o elegido de nuevo desde entonces, o es otra variante. Tómela otra vez para verificar lo que se muestra ahora.</translation>
    </message>
    <message>
        <source>As predicted, but errors are plain to see</source>
        <translation>Según lo previsto, pero los errores se ven claramente</translation>
    </message>
    <message>
        <source>Nothing has moved: the prediction itself is coarse. Measuring finer or darker content helps.</source>
        <translation>Nada se ha movido: la propia previsión es tosca. Ayuda medir con más detalle o un contenido más oscuro.</translation>
    </message>
    <message>
        <source>Waiting for the projector&apos;s screen to come back.</source>
        <translation>Esperando a que vuelva la pantalla del proyector.</translation>
    </message>
    <message>
        <source>What plays is not what was measured or chosen last. Show that first.</source>
        <translation>Lo que se reproduce no es lo último medido o elegido. Muéstrelo primero.</translation>
    </message>
    <message>
        <source>Look at it first</source>
        <translation>Verla antes</translation>
    </message>
    <message>
        <source>What was measured or chosen since is not on the projector yet.</source>
        <translation>Lo medido o elegido desde entonces aún no está en el proyector.</translation>
    </message>
    <message>
        <source>What was measured or chosen since is not on the projector yet. Steps that are out of date count with what was chosen there before.</source>
        <translation>Lo medido o elegido desde entonces aún no está en el proyector. Los pasos desactualizados valen como se eligieron antes.</translation>
    </message>
    <message>
        <source>The screen %1 is unplugged. Nothing is projected.</source>
        <translation>La pantalla %1 está desconectada. No se proyecta nada.</translation>
    </message>
    <message>
        <source>Camera %1: %2, as predicted</source>
        <translation>Cámara %1: %2, como se predijo</translation>
    </message>
    <message>
        <source>Camera %1: %2, not as predicted</source>
        <translation>Cámara %1: %2, no como se predijo</translation>
    </message>
    <message>
        <source>The view of camera %3 has moved by %1 px sideways and %2 px up or down.</source>
        <translation>La vista de la cámara %3 se ha movido %1 px a un lado y %2 px arriba o abajo.</translation>
    </message>
    <message>
        <source>Camera %1 or a projector may have moved.</source>
        <translation>La cámara %1 o un proyector pueden haberse movido.</translation>
    </message>
    <message>
        <source>Something has changed. Repair the calibration.</source>
        <translation>Algo ha cambiado. Repare la calibración.</translation>
    </message>
    <message>
        <source>Something has changed since it was measured. Repair the calibration: only that is measured again.</source>
        <translation>Algo ha cambiado desde la medición. Repare la calibración: solo eso se mide de nuevo.</translation>
    </message>
    <message>
        <source>Repair the calibration</source>
        <translation>Reparar la calibración</translation>
    </message>
    <message>
        <source>Nothing to repair</source>
        <translation>Nada que reparar</translation>
    </message>
    <message>
        <source>The venue is as it was measured.</source>
        <translation>El lugar está como se midió.</translation>
    </message>
    <message>
        <source>Not repaired</source>
        <translation>No reparada</translation>
    </message>
    <message>
        <source>No better picture came of it: the measurement is used as before.</source>
        <translation>La imagen no mejoró con ello: la medición se usa como antes.</translation>
    </message>
    <message>
        <source>Repaired, %1</source>
        <translation>Reparada, %1</translation>
    </message>
    <message>
        <source>Colour error of a photographed picture: %1 before, %2 now.</source>
        <translation>Error de color de una imagen fotografiada: antes %1, ahora %2.</translation>
    </message>
    <message>
        <source>Finds what has changed, measures only that again, and keeps it if a photograph of the picture is better by it.</source>
        <translation>Encuentra lo que ha cambiado, mide de nuevo solo eso y lo conserva si una fotografía de la imagen mejora con ello.</translation>
    </message>
    <message>
        <source>Use the measurement before</source>
        <translation>Usar la medición anterior</translation>
    </message>
    <message>
        <source>Takes the repair back.</source>
        <translation>Deshace la reparación.</translation>
    </message>
    <message>
        <source>arrival to light</source>
        <translation>de la llegada a la luz</translation>
    </message>
    <message>
        <source>From a live picture&apos;s arrival at this computer until the projectors have it: the longest of the last five seconds. The way there is not in it.</source>
        <translation>Desde que una imagen en vivo llega a este ordenador hasta que los proyectores la tienen: el máximo de los últimos cinco segundos. El camino hasta aquí no está incluido.</translation>
    </message>
    <message>
        <source>Connecting to %1</source>
        <translation>Conectando con %1</translation>
    </message>
    <message>
        <source>Lost: %1. %2</source>
        <translation>Perdido: %1. %2</translation>
    </message>
    <message>
        <source>Add a stream</source>
        <translation>Añadir una transmisión</translation>
    </message>
    <message>
        <source>A live picture from the network, as cameras and encoders send it.</source>
        <translation>Una imagen en vivo de la red, como la envían cámaras y codificadores.</translation>
    </message>
    <message>
        <source>Nothing has moved: of the light only %1 is kept at Threshold, so that bounces are missing, in the prediction too. Keep more of it.</source>
        <translation>Nada se ha movido: en «Umbral» solo se conserva el %1 de la luz, de modo que faltan rebotes, también en la previsión. Conserve más.</translation>
    </message>
    <message>
        <source>The show of another venue will no longer start at log-in.</source>
        <translation>El show de otro lugar ya no empezará al iniciar sesión.</translation>
    </message>
    <message>
        <source>The show of this venue will no longer start at log-in.</source>
        <translation>El show de este lugar ya no empezará al iniciar sesión.</translation>
    </message>
    <message>
        <source>Venue and playlist stay. It can be installed again from its venue&apos;s Output.</source>
        <translation>El lugar y la lista se conservan. Puede instalarse de nuevo desde la Salida de su lugar.</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Quitar</translation>
    </message>
    <message>
        <source>Keep</source>
        <translation>Conservar</translation>
    </message>
    <message>
        <source>To end it, hold Esc for two seconds at the projector&apos;s screen.</source>
        <translation>Para terminarlo, mantenga Esc dos segundos en la pantalla del proyector.</translation>
    </message>
    <message>
        <source>Test chart</source>
        <translation>Carta de prueba</translation>
    </message>
    <message>
        <source>A test chart is on the surface. T shows the next one, then the playlist.</source>
        <translation>Hay una carta de prueba en la superficie. T muestra la siguiente y después la lista.</translation>
    </message>
    <message>
        <source>Show the playlist</source>
        <translation>Mostrar la lista</translation>
    </message>
    <message>
        <source>A test chart is on the surface</source>
        <translation>Hay una carta de prueba en la superficie</translation>
    </message>
    <message>
        <source>The playlist runs on unseen until you show it again.</source>
        <translation>La lista sigue sin verse hasta que la muestre de nuevo.</translation>
    </message>
    <message>
        <source>Times of sets</source>
        <translation>Horas de las variantes</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>Variante</translation>
    </message>
    <message>
        <source>Times of the day…</source>
        <translation>Horas del día…</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1: %2</translation>
    </message>
    <message>
        <source>The installed show plays this one all day.</source>
        <translation>El show instalado muestra esta todo el día.</translation>
    </message>
    <message>
        <source>The picture is being perfected.</source>
        <translation>La imagen se está perfeccionando.</translation>
    </message>
    <message>
        <source>The output is being opened.</source>
        <translation>Se está abriendo la salida.</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged.</source>
        <translation>Pantalla del proyector desconectada.</translation>
    </message>
    <message>
        <source>There is nothing else on the list.</source>
        <translation>No hay nada más en la lista.</translation>
    </message>
    <message>
        <source>The playlist is empty.</source>
        <translation>La lista de reproducción está vacía.</translation>
    </message>
    <message>
        <source>There is no other set.</source>
        <translation>No hay otra variante.</translation>
    </message>
    <message>
        <source>The show changes by itself, here too: %1</source>
        <translation>El show cambia solo, también aquí: %1</translation>
    </message>
    <message>
        <source>Choose in the desktop&apos;s dialog what to show as %1</source>
        <translation>Elija en el diálogo del escritorio qué muestra %1</translation>
    </message>
    <message>
        <source>Add a screen or window</source>
        <translation>Añadir una pantalla o ventana</translation>
    </message>
    <message>
        <source>The live picture of a screen of this computer, or of a window on it.</source>
        <translation>La imagen en vivo de una pantalla de este ordenador, o de una ventana en ella.</translation>
    </message>
    <message>
        <source>A screen, chosen in the desktop&apos;s dialog</source>
        <translation>Una pantalla, elegida en el diálogo del escritorio</translation>
    </message>
    <message>
        <source>A window, chosen in the desktop&apos;s dialog</source>
        <translation>Una ventana, elegida en el diálogo del escritorio</translation>
    </message>
    <message>
        <source>Screen %1</source>
        <translation>Pantalla %1</translation>
    </message>
    <message>
        <source>Window %1</source>
        <translation>Ventana %1</translation>
    </message>
    <message>
        <source>There is no desktop whose screens could be shown.</source>
        <translation>No hay ningún escritorio cuyas pantallas se puedan mostrar.</translation>
    </message>
    <message>
        <source>The camera is back at its place</source>
        <translation>La cámara vuelve a estar en su sitio</translation>
    </message>
    <message>
        <source>Put the camera back, or repair the calibration.</source>
        <translation>Recoloque la cámara o repare la calibración.</translation>
    </message>
    <message>
        <source>Perfecting</source>
        <translation>Perfeccionando</translation>
    </message>
    <message>
        <source>Photographing</source>
        <translation>Fotografiando</translation>
    </message>
    <message>
        <source>Checking for drift</source>
        <translation>Comprobando la deriva</translation>
    </message>
    <message>
        <source>Repairing</source>
        <translation>Reparando</translation>
    </message>
    <message>
        <source>The output is closed. Patterns to be photographed are projected.</source>
        <translation>La salida está cerrada. Se proyectan patrones para fotografiarlos.</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Detener</translation>
    </message>
    <message>
        <source>Not as predicted</source>
        <translation>No como se predijo</translation>
    </message>
    <message>
        <source>The output is closed. The devices are in use at %1.</source>
        <translation>La salida está cerrada. Los dispositivos están en uso en %1.</translation>
    </message>
    <message>
        <source>Show the current correction</source>
        <translation>Mostrar la corrección actual</translation>
    </message>
    <message>
        <source>The projector still shows another correction. Show the current one, then take the photograph.</source>
        <translation>El proyector muestra aún otra corrección. Muestre la actual y luego tome la fotografía.</translation>
    </message>
    <message>
        <source>Another correction</source>
        <translation>Otra corrección</translation>
    </message>
    <message>
        <source>The camera&apos;s view has moved. Put it back, then photograph again.</source>
        <translation>La vista de la cámara se ha movido. Recolóquela y fotografíe otra vez.</translation>
    </message>
    <message>
        <source>The show still plays another correction</source>
        <translation>El show aún usa otra corrección</translation>
    </message>
    <message>
        <source>Another correction plays. Show the current one first.</source>
        <translation>Se muestra otra corrección. Muestre primero la actual.</translation>
    </message>
    <message>
        <source>Another correction still plays.</source>
        <translation>Aún se muestra otra corrección.</translation>
    </message>
    <message>
        <source>Covered by %1</source>
        <translation>Tapado por %1</translation>
    </message>
    <message>
        <source>The projector shows the light of another step: %1</source>
        <translation>El proyector muestra la luz de otro paso: %1</translation>
    </message>
    <message>
        <source>The show goes on behind it, and is seen again when that has ended.</source>
        <translation>El show continúa detrás y se verá de nuevo cuando eso termine.</translation>
    </message>
    <message>
        <source>The light of another step is before the show.</source>
        <translation>La luz de otro paso está delante del show.</translation>
    </message>
    <message>
        <source>Time of a picture</source>
        <translation>Duración de una imagen</translation>
    </message>
    <message>
        <source>%1, skipped</source>
        <translation>%1, omitido</translation>
    </message>
    <message>
        <source>Seconds that the chosen picture stands</source>
        <translation>Segundos que permanece la imagen elegida</translation>
    </message>
    <message>
        <source> s</source>
        <translation> s</translation>
    </message>
    <message>
        <source>Picture stands for</source>
        <translation>La imagen permanece</translation>
    </message>
    <message>
        <source>Photographed %1.</source>
        <translation>Fotografiada: %1.</translation>
    </message>
    <message>
        <source>Photographed %1, before the last check for drift.</source>
        <translation>Fotografiada: %1, antes de la última comprobación de deriva.</translation>
    </message>
    <message>
        <source>The surface looked as predicted then</source>
        <translation>La superficie se veía entonces según lo previsto</translation>
    </message>
    <message>
        <source>Checked %1.</source>
        <translation>Comprobado: %1.</translation>
    </message>
    <message>
        <source>Hold A for the original, Ctrl+P freezes, B makes it black, T shows test charts, O figures.</source>
        <translation>Mantenga A para ver el original, Ctrl+P congela, B lo pone en negro, T muestra cartas de prueba, O cifras.</translation>
    </message>
    <message>
        <source>No program here opens it: open it by hand, or take it to another computer.</source>
        <translation>Ningún programa de aquí lo abre: ábralo a mano o llévelo a otro ordenador.</translation>
    </message>
    <message>
        <source>Picture: %1</source>
        <translation>Imagen: %1</translation>
    </message>
    <message>
        <source>The check was ended: the room is not said to be clear</source>
        <translation>La comprobación terminó: la sala ya no consta como despejada</translation>
    </message>
    <message>
        <source>It came to no result. Check again when the room is clear.</source>
        <translation>No dio ningún resultado. Compruebe de nuevo cuando la sala esté despejada.</translation>
    </message>
    <message>
        <source>The repair was ended: the room is not said to be clear</source>
        <translation>La reparación terminó: la sala ya no consta como despejada</translation>
    </message>
    <message>
        <source>The measurement is used as before. Repair again when the room is clear.</source>
        <translation>La medición se usa como antes. Repare de nuevo cuando la sala esté despejada.</translation>
    </message>
    <message>
        <source>The output is closed. A picture to be photographed is projected.</source>
        <translation>La salida está cerrada. Se proyecta una imagen para fotografiarla.</translation>
    </message>
    <message>
        <source>The room is brighter by %1 of full light.</source>
        <translation>La sala es más clara en un %1 de la luz plena.</translation>
    </message>
    <message>
        <source>The room is darker by %1 of full light.</source>
        <translation>La sala es más oscura en un %1 de la luz plena.</translation>
    </message>
    <message>
        <source>The projector gives %1 of the light that it gave.</source>
        <translation>El proyector da el %1 de la luz que daba.</translation>
    </message>
    <message>
        <source>The output is closed. Nothing is projected from here.</source>
        <translation>La salida está cerrada. Desde aquí no se proyecta nada.</translation>
    </message>
    <message>
        <source>A photograph is being taken.</source>
        <translation>Se está tomando una fotografía.</translation>
    </message>
    <message>
        <source>Slowly, as the room is not said to be clear: nothing flashes.</source>
        <translation>Despacio, pues la sala no consta como despejada: nada destella.</translation>
    </message>
    <message>
        <source>It plays this playlist with the measurement that is in use by then.</source>
        <translation>Reproduce esta lista con la medición que se use entonces.</translation>
    </message>
    <message>
        <source>The output is closed here. Another program plays a show of this venue.</source>
        <translation>La salida está cerrada aquí. Otro programa está reproduciendo un show de este lugar.</translation>
    </message>
    <message>
        <source>Hardly anything fits. Put the camera back or repair the calibration; if neither helps, aim and measure again.</source>
        <translation>Casi nada encaja. Devuelva la cámara a su sitio o repare la calibración; si nada ayuda, apunte y mida de nuevo.</translation>
    </message>
    <message>
        <source>Almost nothing of the projector&apos;s light is seen. Look at the lens and at the projector, then check again.</source>
        <translation>Apenas se ve luz del proyector. Revise el objetivo y el proyector, y compruebe de nuevo.</translation>
    </message>
    <message>
        <source>Installed. The show starts at the next log-in, without wizard. The camera stays: at night it looks after the picture.</source>
        <translation>Instalado. El show empieza en el próximo inicio de sesión, sin asistente. La cámara se queda: de noche cuida la imagen.</translation>
    </message>
    <message>
        <source>Another program plays</source>
        <translation>Otro programa reproduce</translation>
    </message>
    <message>
        <source>Hardly anything fits. Put the camera back, repair the calibration, or aim and measure again.</source>
        <translation>Casi nada encaja. Devuelva la cámara a su sitio, repare la calibración, o apunte y mida de nuevo.</translation>
    </message>
    <message>
        <source>Another program plays a show of this venue.</source>
        <translation>Otro programa está reproduciendo un show de este lugar.</translation>
    </message>
    <message>
        <source>The room&apos;s light has changed. Restore it and check again, or repair the calibration.</source>
        <translation>La luz de la sala ha cambiado. Restablézcala y compruebe de nuevo, o repare la calibración.</translation>
    </message>
    <message>
        <source>The camera looks elsewhere</source>
        <translation>La cámara mira a otro sitio</translation>
    </message>
    <message>
        <source>It was left %1 px from where it looked when it was measured. Put it back, or repair the calibration.</source>
        <translation>Quedó a %1 px de donde miraba al medir. Devuélvala a su sitio o repare la calibración.</translation>
    </message>
    <message>
        <source>Put the camera back, or measure again.</source>
        <translation>Recoloque la cámara o mida de nuevo.</translation>
    </message>
    <message>
        <source>Something has changed. Measure again.</source>
        <translation>Algo ha cambiado. Mida de nuevo.</translation>
    </message>
    <message>
        <source>Hardly anything fits. Put the camera back, or aim and measure again.</source>
        <translation>Casi nada encaja. Devuelva la cámara a su sitio, o apunte y mida de nuevo.</translation>
    </message>
    <message>
        <source>Keep the repaired one</source>
        <translation>Conservar la reparada</translation>
    </message>
    <message>
        <source>Use the measurement before?</source>
        <translation>¿Usar la medición anterior?</translation>
    </message>
    <message>
        <source>What was repaired is measured again if you repair once more.</source>
        <translation>Lo reparado se mide de nuevo si repara otra vez.</translation>
    </message>
    <message>
        <source>The measurement from before the repair is used as it was, with all that followed from it.</source>
        <translation>La medición de antes de la reparación se usa tal como era, con todo lo que siguió de ella.</translation>
    </message>
    <message>
        <source>Screen %1, which this plays on</source>
        <translation>Pantalla %1, en la que se reproduce</translation>
    </message>
    <message>
        <source>They are larger than predicted. A check for drift tells whether something has moved.</source>
        <translation>Son mayores de lo previsto. Una comprobación de deriva muestra si algo se ha movido.</translation>
    </message>
    <message>
        <source>Once installed, the show starts at every log-in, without wizard. The camera stays: at night it looks after the picture.</source>
        <translation>Una vez instalado, el show empieza en cada inicio de sesión, sin asistente. La cámara se queda: de noche cuida de la imagen.</translation>
    </message>
    <message>
        <source>Take a verification photograph. What was found before is not settled.</source>
        <translation>Tome una fotografía de verificación. Lo hallado antes no está resuelto.</translation>
    </message>
    <message>
        <source>The surface did not look as predicted. Open the output: it leads to what helps.</source>
        <translation>La superficie no se veía como se predijo. Abra la salida: lleva a lo que ayuda.</translation>
    </message>
    <message>
        <source>Black: the frozen picture stands unseen until you show it again.</source>
        <translation>Negro: la imagen congelada queda oculta hasta que vuelva a mostrarla.</translation>
    </message>
    <message>
        <source>still picture, perfected by photographs</source>
        <translation>imagen fija, perfeccionada con fotografías</translation>
    </message>
    <message>
        <source>Nothing has moved: part of the picture is out of the projector&apos;s reach, in a shadow, darker than its black or brighter than its white there. Another picture, or another place for it, helps.</source>
        <translation>Nada se ha movido: parte de la imagen está fuera del alcance del proyector, en una sombra, más oscura que su negro o más clara que su blanco en ese lugar. Ayuda otra imagen u otro lugar para ella.</translation>
    </message>
    <message>
        <source>Errors are plain to see</source>
        <translation>Los errores se ven claramente</translation>
    </message>
    <message>
        <source>The frozen picture stands unseen until you show it again.</source>
        <translation>La imagen congelada sigue ahí sin verse hasta que la muestre de nuevo.</translation>
    </message>
    <message>
        <source>The output is closed here. Another program plays a show of another venue on this projector.</source>
        <translation>La salida está cerrada aquí. Otro programa está reproduciendo un show de otro lugar en este proyector.</translation>
    </message>
    <message>
        <source>Another program plays a show of another venue on this projector.</source>
        <translation>Otro programa está reproduciendo un show de otro lugar en este proyector.</translation>
    </message>
    <message>
        <source>Two shows at once</source>
        <translation>Dos shows a la vez</translation>
    </message>
    <message>
        <source>The output is open here and in another program: whose picture is seen is not known. End one.</source>
        <translation>La salida está abierta aquí y en otro programa: no se sabe qué imagen se ve. Termine una.</translation>
    </message>
    <message>
        <source>Perhaps under another program&apos;s picture</source>
        <translation>Quizá debajo de la imagen de otro programa</translation>
    </message>
    <message>
        <source>Black: the test chart stands unseen. T shows the next one, then the playlist.</source>
        <translation>Negro: la carta de prueba sigue ahí sin verse. T muestra la siguiente y luego la lista.</translation>
    </message>
    <message>
        <source>Hide the figures</source>
        <translation>Ocultar las cifras</translation>
    </message>
    <message>
        <source>Figures are on the surface</source>
        <translation>Hay cifras sobre la superficie</translation>
    </message>
    <message>
        <source>Whoever is in the room reads them over the picture.</source>
        <translation>Quien está en la sala las lee sobre la imagen.</translation>
    </message>
    <message>
        <source>Installed as it is. %1</source>
        <translation>Instalado tal como está. %1</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the patterns flash.</source>
        <translation>Confirme que la sala está despejada: los patrones destellan.</translation>
    </message>
    <message>
        <source>No picture has come yet: black</source>
        <translation>Aún no ha llegado ninguna imagen: negro</translation>
    </message>
    <message>
        <source>The live picture is lost: black</source>
        <translation>Se ha perdido la imagen en directo: negro</translation>
    </message>
    <message>
        <source>The live picture is lost: its last one stands</source>
        <translation>Se ha perdido la imagen en directo: queda la última</translation>
    </message>
    <message>
        <source>A film plays to its end.</source>
        <translation>Una película se reproduce hasta el final.</translation>
    </message>
    <message>
        <source>A part of the surface looks otherwise than predicted, by ΔE %1.</source>
        <translation>Una parte de la superficie no se ve como se predijo: ΔE %1.</translation>
    </message>
    <message>
        <source>Installed, but the show cannot start with what was measured last.</source>
        <translation>Instalado, pero el show no puede empezar con lo último que se midió.</translation>
    </message>
    <message>
        <source>Go on measuring, or use the earlier one, at Acquire.</source>
        <translation>Siga midiendo o use la anterior, en «Adquisición».</translation>
    </message>
    <message>
        <source>Go on measuring at Acquire.</source>
        <translation>Siga midiendo en «Adquisición».</translation>
    </message>
    <message>
        <source>What was measured is too coarse to place content. Go on measuring.</source>
        <translation>Lo medido es demasiado basto para colocar contenido. Siga midiendo.</translation>
    </message>
    <message>
        <source>Not all was decided on what is measured now</source>
        <translation>No todo se decidió con lo medido ahora</translation>
    </message>
    <message>
        <source>Steps that are out of date count with what was chosen there before.</source>
        <translation>Los pasos desactualizados cuentan con lo que se eligió antes en ellos.</translation>
    </message>
    <message>
        <source>The test patterns fit, the photograph does not</source>
        <translation>Los patrones de prueba encajan, la fotografía no</translation>
    </message>
    <message>
        <source>Few patterns can miss a small part. Where another photograph differs, too, a repair looks closer.</source>
        <translation>Pocos patrones pueden pasar por alto una parte pequeña. Si otra fotografía también difiere, una reparación mira más de cerca.</translation>
    </message>
    <message>
        <source>This picture was perfected after the photograph.</source>
        <translation>Esta imagen se perfeccionó después de la fotografía.</translation>
    </message>
    <message>
        <source>In the camera&apos;s picture it is %1 from the left and %2 from the top.</source>
        <translation>En la imagen de la cámara está al %1 desde la izquierda y al %2 desde arriba.</translation>
    </message>
    <message>
        <source>What was found before may have come of that: a photograph shows what is left of it.</source>
        <translation>Lo que se encontró antes puede haberse debido a eso: una fotografía de verificación muestra lo que queda.</translation>
    </message>
    <message>
        <source>Black. %1</source>
        <translation>Negro. %1</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputPlaylist</name>
    <message>
        <source>Demonstration picture</source>
        <translation>Imagen de demostración</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputProjection</name>
    <message>
        <source>Open the output again.</source>
        <translation>Abra la salida de nuevo.</translation>
    </message>
    <message>
        <source>Relucent is projecting</source>
        <translation>Relucent está proyectando</translation>
    </message>
    <message>
        <source>%1, shown without OpenGL</source>
        <translation>%1, mostrado sin OpenGL</translation>
    </message>
    <message>
        <source>The output goes on as before.</source>
        <translation>La salida sigue como antes.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputProof</name>
    <message>
        <source>No venue is open.</source>
        <translation>No hay ningún lugar abierto.</translation>
    </message>
    <message>
        <source>A photograph is being taken.</source>
        <translation>Se está tomando una fotografía.</translation>
    </message>
    <message>
        <source>Drift is being checked.</source>
        <translation>Se está comprobando la deriva.</translation>
    </message>
    <message>
        <source>It is being repaired.</source>
        <translation>Se está reparando.</translation>
    </message>
    <message>
        <source>The report is being written.</source>
        <translation>Se está escribiendo el informe.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Perfecting</name>
    <message>
        <source>%1 The picture is shown as before. Try again.</source>
        <translation>%1 La imagen se muestra como antes. Inténtelo de nuevo.</translation>
    </message>
    <message>
        <source>The photographs found nothing better. The picture is shown as before.</source>
        <translation>Las fotografías no encontraron nada mejor. La imagen se muestra como antes.</translation>
    </message>
    <message>
        <source>The picture is being perfected</source>
        <translation>La imagen se está perfeccionando</translation>
    </message>
    <message numerus="yes">
        <source>%n photograph(s) by now. Keep the room as it is.</source>
        <translation>
            <numerusform>%n fotografía hasta ahora. Deje la sala como está.</numerusform>
            <numerusform>%n fotografías hasta ahora. Deje la sala como está.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1: %2 before, %3 now, by %n photograph(s).</source>
        <translation>
            <numerusform>%1: antes %2, ahora %3, con %n fotografía.</numerusform>
            <numerusform>%1: antes %2, ahora %3, con %n fotografías.</numerusform>
        </translation>
    </message>
    <message>
        <source>This picture is perfected</source>
        <translation>Esta imagen está perfeccionada</translation>
    </message>
    <message>
        <source>The picture is as it was</source>
        <translation>La imagen está como estaba</translation>
    </message>
    <message>
        <source>Not perfected</source>
        <translation>Sin perfeccionar</translation>
    </message>
    <message>
        <source>A picture that stands can be corrected by photographs of itself, some eight of them. It is kept for this venue, placed as it is now.</source>
        <translation>Una imagen fija puede corregirse con fotografías de sí misma, unas ocho. Se guarda para este lugar, colocada como ahora.</translation>
    </message>
    <message>
        <source>Perfect a picture</source>
        <translation>Perfeccionar una imagen</translation>
    </message>
    <message>
        <source>Perfect this picture</source>
        <translation>Perfeccionar esta imagen</translation>
    </message>
    <message>
        <source>Stop and keep the best</source>
        <translation>Parar y conservar lo mejor</translation>
    </message>
    <message>
        <source>Show it as before</source>
        <translation>Mostrar como antes</translation>
    </message>
    <message>
        <source>What the photographs corrected is dropped.</source>
        <translation>Se descarta lo que corrigieron las fotografías.</translation>
    </message>
    <message>
        <source>Perfect it again</source>
        <translation>Perfeccionar otra vez</translation>
    </message>
    <message>
        <source>No venue is open.</source>
        <translation>No hay ningún lugar abierto.</translation>
    </message>
    <message>
        <source>The picture is being perfected.</source>
        <translation>La imagen se está perfeccionando.</translation>
    </message>
    <message>
        <source>perfected, %1 before, %2 now.</source>
        <translation>perfeccionada, antes %1, ahora %2.</translation>
    </message>
    <message>
        <source>Tried last, %1: %2</source>
        <translation>Último intento, %1: %2</translation>
    </message>
    <message>
        <source>Slowly, as the room is not said to be clear: nothing flashes.</source>
        <translation>Despacio, pues la sala no consta como despejada: nada destella.</translation>
    </message>
    <message>
        <source>Picture: %1</source>
        <translation>Imagen: %1</translation>
    </message>
    <message>
        <source>Not perfected since it changed</source>
        <translation>Sin perfeccionar desde el cambio</translation>
    </message>
    <message>
        <source>It was perfected for an earlier measurement, for another set, with other light or masks, or placed otherwise. That is kept, and is of no use now: perfect it once more.</source>
        <translation>Se perfeccionó para una medición anterior, para otra variante, con otra luz u otras máscaras, o colocada de otro modo. Eso se conserva, pero ahora no sirve: perfecciónela otra vez.</translation>
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
        <translation>Esc para volver</translation>
    </message>
</context>
<context>
    <name>relucent::gui::PreviewPage</name>
    <message>
        <source>Demonstration picture</source>
        <translation>Imagen de demostración</translation>
    </message>
    <message>
        <source>Content</source>
        <translation>Contenido</translation>
    </message>
    <message>
        <source>Change</source>
        <translation>Cambiar</translation>
    </message>
    <message>
        <source>Whole</source>
        <translation>Entera</translation>
    </message>
    <message>
        <source>Fill</source>
        <translation>Llenar</translation>
    </message>
    <message>
        <source>Stretch</source>
        <translation>Estirar</translation>
    </message>
    <message>
        <source>Place automatically</source>
        <translation>Colocar automáticamente</translation>
    </message>
    <message>
        <source>In the largest upright rectangle that can be reached</source>
        <translation>En el mayor rectángulo sin girar que sea alcanzable</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Luz</translation>
    </message>
    <message>
        <source>May stay too dark</source>
        <translation>Puede quedar oscuro</translation>
    </message>
    <message>
        <source>Share of the content that may stay too dark, percent</source>
        <translation>Parte del contenido que puede quedar demasiado oscura, en porcentaje</translation>
    </message>
    <message>
        <source>Lift of the blacks</source>
        <translation>Elevación de negros</translation>
    </message>
    <message>
        <source>Lift of the blacks, percent</source>
        <translation>Elevación de negros, en porcentaje</translation>
    </message>
    <message>
        <source>Reach</source>
        <translation>Alcance</translation>
    </message>
    <message>
        <source>Can be reached</source>
        <translation>Alcanzable</translation>
    </message>
    <message>
        <source>Too dark to reach</source>
        <translation>Demasiado oscuro</translation>
    </message>
    <message>
        <source>Never black enough</source>
        <translation>Nunca bastante negro</translation>
    </message>
    <message>
        <source>Colour error</source>
        <translation>Error de color</translation>
    </message>
    <message>
        <source>Part of the picture gets no light from this projector.</source>
        <translation>Parte de la imagen no recibe luz de este proyector.</translation>
    </message>
    <message>
        <source>A second could fill it.</source>
        <translation>Un segundo proyector podría cubrirla.</translation>
    </message>
    <message>
        <source>Choose a picture</source>
        <translation>Elegir una imagen</translation>
    </message>
    <message>
        <source>Fit</source>
        <translation>Ajuste</translation>
    </message>
    <message>
        <source>Brightness</source>
        <translation>Brillo</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>Lo medido está a salvo.</translation>
    </message>
    <message>
        <source>Picture</source>
        <translation>Imagen</translation>
    </message>
    <message>
        <source>The picture of before stays.</source>
        <translation>Se mantiene la imagen anterior.</translation>
    </message>
    <message>
        <source>Preparing the preview</source>
        <translation>Preparando la vista previa</translation>
    </message>
    <message>
        <source>The corners cross over. Drag them apart.</source>
        <translation>Las esquinas se cruzan. Sepárelas arrastrando.</translation>
    </message>
    <message>
        <source>Corners</source>
        <translation>Esquinas</translation>
    </message>
    <message>
        <source>Automatic place</source>
        <translation>Posición automática</translation>
    </message>
    <message>
        <source>Preparing</source>
        <translation>Preparando</translation>
    </message>
    <message>
        <source>%1 in reach</source>
        <translation>%1 alcanzable</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>Desactualizado</translation>
    </message>
    <message>
        <source>The preview is not prepared.</source>
        <translation>La vista previa no está preparada.</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>Los dispositivos están en uso en %1.</translation>
    </message>
    <message>
        <source>Predicting</source>
        <translation>Calculando la previsión</translation>
    </message>
    <message>
        <source>Predicted from the measurement. Nothing is projected now.</source>
        <translation>Previsto a partir de la medición. Ahora no se proyecta nada.</translation>
    </message>
    <message>
        <source>Preview</source>
        <translation>Vista previa</translation>
    </message>
    <message>
        <source>Place the content in the camera&apos;s view and see what the audience will see before you project it.</source>
        <translation>Coloque el contenido en la vista de cámara y vea lo que verá el público antes de proyectarlo.</translation>
    </message>
    <message>
        <source>Audience view</source>
        <translation>Vista del público</translation>
    </message>
    <message>
        <source>Reachable light</source>
        <translation>Luz alcanzable</translation>
    </message>
    <message>
        <source>Difference</source>
        <translation>Diferencia</translation>
    </message>
    <message>
        <source>What the audience will see, uncorrected at the left of the divider and corrected at the right</source>
        <translation>Lo que verá el público, sin corregir a la izquierda del divisor y corregido a la derecha</translation>
    </message>
    <message>
        <source>Colour difference between what is wanted and what is predicted</source>
        <translation>Diferencia de color entre lo deseado y lo previsto</translation>
    </message>
    <message>
        <source>Methods</source>
        <translation>Métodos</translation>
    </message>
    <message>
        <source>predicted for this content; click one to use it</source>
        <translation>previsto para este contenido; clic en uno para usarlo</translation>
    </message>
    <message>
        <source>Comparison of methods</source>
        <translation>Comparación de métodos</translation>
    </message>
    <message>
        <source>Method</source>
        <translation>Método</translation>
    </message>
    <message>
        <source>Notes</source>
        <translation>Notas</translation>
    </message>
    <message>
        <source>blind to bounces</source>
        <translation>ignora rebotes</translation>
    </message>
    <message>
        <source>limit of this venue</source>
        <translation>límite de este lugar</translation>
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
        <translation>Sin corregir</translation>
    </message>
    <message>
        <source>Corrected, predicted</source>
        <translation>Corregido, previsto</translation>
    </message>
    <message>
        <source>of white</source>
        <translation>del blanco</translation>
    </message>
    <message>
        <source>The larger this share, the brighter the picture, and the more of it stays too dark.</source>
        <translation>Cuanto mayor es esta parte, más brillante es la imagen y más de ella queda oscura.</translation>
    </message>
    <message>
        <source>Part of the picture gets no light from any projector.</source>
        <translation>Una parte de la imagen no recibe luz de ningún proyector.</translation>
    </message>
    <message>
        <source>Another one could fill it.</source>
        <translation>Otro podría cubrirla.</translation>
    </message>
    <message>
        <source>Go to output</source>
        <translation>Ir a la salida</translation>
    </message>
    <message>
        <source>under 1 ms</source>
        <translation>menos de 1 ms</translation>
    </message>
    <message>
        <source>Uncorrected, too</source>
        <translation>También sin corregir</translation>
    </message>
    <message>
        <source>What was measured is too coarse to place content. Go on measuring.</source>
        <translation>Lo medido es demasiado basto para colocar contenido. Siga midiendo.</translation>
    </message>
    <message>
        <source>All of it can be reached</source>
        <translation>Se alcanza todo</translation>
    </message>
    <message>
        <source>no note</source>
        <translation>sin nota</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged.</source>
        <translation>La pantalla del proyector está desconectada.</translation>
    </message>
    <message>
        <source>On the surface now: the corrected picture.</source>
        <translation>Ahora en la superficie: la imagen corregida.</translation>
    </message>
    <message>
        <source>On the surface now: the uncorrected picture.</source>
        <translation>Ahora en la superficie: la imagen sin corregir.</translation>
    </message>
    <message>
        <source>Stop shining</source>
        <translation>Dejar de proyectar</translation>
    </message>
    <message>
        <source>Shine on surface</source>
        <translation>Proyectar en la superficie</translation>
    </message>
    <message>
        <source>Shows this picture on the surface until you stop it or leave.</source>
        <translation>Muestra esta imagen en la superficie hasta que la detenga o salga.</translation>
    </message>
    <message>
        <source>Show uncorrected</source>
        <translation>Mostrar sin corregir</translation>
    </message>
    <message>
        <source>Show corrected</source>
        <translation>Mostrar corregida</translation>
    </message>
    <message>
        <source>There is no preview yet.</source>
        <translation>Aún no hay vista previa.</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is not there. Plug it in and extend the desktop to it.</source>
        <translation>No está la pantalla del proyector. Conéctela y extienda el escritorio a ella.</translation>
    </message>
    <message>
        <source>The brightest light that can be reached; hatched where the content is out of reach</source>
        <translation>La luz más intensa que se alcanza; rayado donde el contenido queda fuera de alcance</translation>
    </message>
    <message>
        <source>Hatched: %1 cannot be reached</source>
        <translation>Rayado: %1 fuera de alcance</translation>
    </message>
    <message>
        <source>It has been measured again since the content was placed</source>
        <translation>Se ha medido de nuevo desde que se colocó el contenido</translation>
    </message>
    <message>
        <source>The threshold has been changed since the content was placed</source>
        <translation>Se ha cambiado el umbral desde que se colocó el contenido</translation>
    </message>
    <message>
        <source>What you see here is predicted anew. Going to the output keeps it.</source>
        <translation>Lo que ve aquí está previsto de nuevo. Al pasar a la salida se guarda.</translation>
    </message>
    <message>
        <source>Still picture</source>
        <translation>Imagen fija</translation>
    </message>
    <message>
        <source>How long a still picture takes to be solved, once. Films always play by “All bounces, for films” in the quicker show engine: how fast is said at Cluster.</source>
        <translation>Cuánto tarda en calcularse una imagen fija, una sola vez. Los vídeos usan siempre «Todos los rebotes, para vídeo» en el motor del show, más rápido: la velocidad está en Clústeres.</translation>
    </message>
    <message>
        <source>Of this content, where it can be reached. What Acquire expects is a mean of other pictures: the two may differ by some dB.</source>
        <translation>De este contenido, donde es alcanzable. Lo que espera la medición es una media de otras imágenes: ambos pueden diferir en algunos dB.</translation>
    </message>
    <message>
        <source>blind to light between clusters</source>
        <translation>ciego entre clústeres</translation>
    </message>
    <message>
        <source>recommended</source>
        <translation>recomendado</translation>
    </message>
    <message>
        <source>Compare</source>
        <translation>Comparar</translation>
    </message>
    <message>
        <source>Hide</source>
        <translation>Ocultar</translation>
    </message>
    <message>
        <source>This content comes to %1. Acquire expected %2 on average of three other pictures, by the recommended method.</source>
        <translation>Este contenido alcanza %1. «Adquisición» esperaba %2 de media en otras tres imágenes, con el método recomendado.</translation>
    </message>
    <message>
        <source>Place of a camera</source>
        <translation>Lugar de una cámara</translation>
    </message>
    <message>
        <source>no content</source>
        <translation>sin contenido</translation>
    </message>
    <message>
        <source>%1 dB, ΔE %2</source>
        <translation>%1 dB, ΔE %2</translation>
    </message>
    <message>
        <source>%1, counts %2</source>
        <translation>%1, cuenta %2</translation>
    </message>
    <message>
        <source>Views</source>
        <translation>Vistas</translation>
    </message>
    <message>
        <source>On the surface</source>
        <translation>En la superficie</translation>
    </message>
    <message>
        <source>Upright from here</source>
        <translation>Recto desde aquí</translation>
    </message>
    <message>
        <source>Weight of this view</source>
        <translation>Peso de esta vista</translation>
    </message>
    <message>
        <source>Weight of the shown view, percent</source>
        <translation>Peso de la vista mostrada, por ciento</translation>
    </message>
    <message>
        <source>For one viewer who moves</source>
        <translation>Para un espectador que se mueve</translation>
    </message>
    <message>
        <source>Where the viewer stands, from the first camera to the last</source>
        <translation>Dónde está el espectador, de la primera cámara a la última</translation>
    </message>
    <message>
        <source>Place in this view</source>
        <translation>Lugar en esta vista</translation>
    </message>
    <message>
        <source>Weight of a view</source>
        <translation>Peso de una vista</translation>
    </message>
    <message>
        <source>Drag the cameras to where they stand, then move the viewer.</source>
        <translation>Arrastre las cámaras adonde están y mueva luego al espectador.</translation>
    </message>
    <message>
        <source>As little as hides where projectors end</source>
        <translation>Lo mínimo que oculta los bordes de los proyectores</translation>
    </message>
    <message>
        <source>Place of the viewer</source>
        <translation>Lugar del espectador</translation>
    </message>
    <message>
        <source>Contradiction</source>
        <translation>Contradicción</translation>
    </message>
    <message>
        <source>How much worse a view is because of what the other views ask for</source>
        <translation>Cuánto empeora una vista por lo que piden las demás</translation>
    </message>
    <message>
        <source>Comparing the views</source>
        <translation>Comparando las vistas</translation>
    </message>
    <message>
        <source>Visibly worse because of other views: %1</source>
        <translation>Visiblemente peor por otras vistas: %1</translation>
    </message>
    <message>
        <source>Visibly worse because of other views</source>
        <translation>Visiblemente peor por otras vistas</translation>
    </message>
    <message>
        <source>Even</source>
        <translation>Uniforme</translation>
    </message>
    <message>
        <source>One white for all pictures, as bright as most of the surface can show it.</source>
        <translation>Un blanco para todas las imágenes, tan brillante como la mayor parte de la superficie pueda mostrarlo.</translation>
    </message>
    <message>
        <source>By picture</source>
        <translation>Por imagen</translation>
    </message>
    <message>
        <source>Each picture has the white at which the least of it is lost: dark ones become brighter, bright ones dimmer.</source>
        <translation>Cada imagen tiene el blanco con el que menos se pierde de ella: las oscuras ganan brillo, las claras lo ceden.</translation>
    </message>
    <message>
        <source>By region</source>
        <translation>Por zona</translation>
    </message>
    <message>
        <source>The same for each part of the picture, smoothly from one to the next: the least is lost of all.</source>
        <translation>Lo mismo para cada parte de la imagen, con transiciones suaves: así es como menos se pierde.</translation>
    </message>
    <message>
        <source>How bright white is</source>
        <translation>Lo brillante que es el blanco</translation>
    </message>
    <message>
        <source>The picture is shown as before.</source>
        <translation>La imagen se muestra como antes.</translation>
    </message>
    <message>
        <source>Bright</source>
        <translation>Brillante</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show are as bright as can be: white on a yellow wall turns yellow.</source>
        <translation>Los colores que la superficie no puede mostrar son tan brillantes como sea posible: el blanco sobre una pared amarilla se vuelve amarillo.</translation>
    </message>
    <message>
        <source>Between</source>
        <translation>Intermedio</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show become somewhat dimmer and shift less.</source>
        <translation>Los colores que la superficie no puede mostrar se oscurecen un poco y cambian menos.</translation>
    </message>
    <message>
        <source>True</source>
        <translation>Fiel</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show are dimmed until their hue is right: for faces and logos.</source>
        <translation>Los colores que la superficie no puede mostrar se oscurecen hasta que su tono es correcto: para caras y logotipos.</translation>
    </message>
    <message>
        <source>Colours out of reach</source>
        <translation>Colores fuera de alcance</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show</source>
        <translation>Colores que la superficie no puede mostrar</translation>
    </message>
    <message>
        <source>Uncertainty</source>
        <translation>Incertidumbre</translation>
    </message>
    <message>
        <source>95 of 100 pixels come within this of what is predicted, in percent of white. More photographs or longer exposures make it smaller.</source>
        <translation>95 de cada 100 píxeles se apartan como mucho esto de lo previsto, en porcentaje del blanco. Más fotografías o exposiciones más largas lo reducen.</translation>
    </message>
    <message>
        <source>How far the light may be from what is predicted, by the measurement&apos;s noise</source>
        <translation>Cuánto puede apartarse la luz de lo previsto por el ruido de la medición</translation>
    </message>
    <message>
        <source>95 of 100 pixels come within the value shown, on average %1 of white</source>
        <translation>95 de cada 100 píxeles quedan dentro del valor mostrado, en promedio %1 del blanco</translation>
    </message>
    <message>
        <source>Quality</source>
        <translation>Calidad</translation>
    </message>
    <message>
        <source>Detail kept</source>
        <translation>Detalle conservado</translation>
    </message>
    <message>
        <source>Peak signal-to-noise ratio, PSNR: 20 dB looks rough, 30 dB good.</source>
        <translation>Relación señal-ruido de pico, PSNR: 20 dB se ven toscos, 30 dB bien.</translation>
    </message>
    <message>
        <source>Structural similarity, SSIM: 1 is all of it.</source>
        <translation>Similitud estructural, SSIM: 1 es todo.</translation>
    </message>
    <message>
        <source>What of it is shown</source>
        <translation>Qué se muestra de ello</translation>
    </message>
    <message>
        <source>Mask %1</source>
        <translation>Máscara %1</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1, %2</translation>
    </message>
    <message>
        <source>Masks</source>
        <translation>Máscaras</translation>
    </message>
    <message>
        <source>No light falls on these parts: doors, windows, where visitors sit.</source>
        <translation>Sobre estas partes no cae luz: puertas, ventanas, asientos de los visitantes.</translation>
    </message>
    <message>
        <source>Draw a mask</source>
        <translation>Dibujar una máscara</translation>
    </message>
    <message>
        <source>Click points in the picture, and the first one again to close. With the keyboard: arrow keys, Space, Return; Escape leaves it.</source>
        <translation>Haga clic en puntos de la imagen y de nuevo en el primero para cerrar. Con el teclado: flechas, Espacio, Intro; Escape abandona.</translation>
    </message>
    <message>
        <source>Straight</source>
        <translation>Rectas</translation>
    </message>
    <message>
        <source>Curved</source>
        <translation>Curvas</translation>
    </message>
    <message>
        <source>How the points of the mask are joined</source>
        <translation>Cómo se unen los puntos de la máscara</translation>
    </message>
    <message>
        <source>Feather</source>
        <translation>Borde suave</translation>
    </message>
    <message>
        <source>How far beyond the mask the light comes back, thousandths of the view</source>
        <translation>Hasta dónde vuelve la luz más allá de la máscara, en milésimas de la vista</translation>
    </message>
    <message>
        <source>Remove the mask</source>
        <translation>Quitar la máscara</translation>
    </message>
    <message>
        <source>Stop drawing</source>
        <translation>Dejar de dibujar</translation>
    </message>
    <message>
        <source>errors weighed as an eye does</source>
        <translation>errores pesados como lo hace el ojo</translation>
    </message>
    <message>
        <source>No venue is open.</source>
        <translation>No hay ningún lugar abierto.</translation>
    </message>
    <message>
        <source>The sets are as they were.</source>
        <translation>Las variantes siguen como estaban.</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>Variante</translation>
    </message>
    <message>
        <source>Without a name</source>
        <translation>Sin nombre</translation>
    </message>
    <message>
        <source>More</source>
        <translation>Más</translation>
    </message>
    <message>
        <source>More for the set</source>
        <translation>Más sobre la variante</translation>
    </message>
    <message>
        <source>Save as…</source>
        <translation>Guardar como…</translation>
    </message>
    <message>
        <source>Rename…</source>
        <translation>Cambiar nombre…</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Quitar</translation>
    </message>
    <message>
        <source>It is placed automatically.</source>
        <translation>Está colocada automáticamente.</translation>
    </message>
    <message>
        <source>A picture is on the surface.</source>
        <translation>Hay una imagen en la superficie.</translation>
    </message>
    <message>
        <source>The output is open. Close it first.</source>
        <translation>La salida está abierta. Ciérrela antes.</translation>
    </message>
    <message>
        <source>Shine on %1</source>
        <translation>Proyectar en %1</translation>
    </message>
    <message>
        <source>A rehearsal has no surface: this lights the screen %1 until you stop it or leave.</source>
        <translation>Un ensayo no tiene superficie: esto ilumina la pantalla %1 hasta que lo detenga o salga.</translation>
    </message>
    <message>
        <source>Part of the picture lies where the view is left out.</source>
        <translation>Parte de la imagen cae donde se deja fuera la vista.</translation>
    </message>
    <message>
        <source>It stays uncorrected. Acquire says why.</source>
        <translation>Queda sin corregir. Adquisición dice por qué.</translation>
    </message>
    <message>
        <source>Predicted from the measurement. The output stays as it is.</source>
        <translation>Predicho a partir de la medición. La salida queda como está.</translation>
    </message>
    <message>
        <source>The content was placed on another measurement or threshold</source>
        <translation>El contenido se colocó sobre otra medición u otro umbral</translation>
    </message>
    <message>
        <source>To shine on the surface, close the output first.</source>
        <translation>Para proyectar sobre la superficie, cierre primero la salida.</translation>
    </message>
    <message>
        <source>Uncorrected, in blocks of %1 px</source>
        <translation>Sin corregir, en bloques de %1 px</translation>
    </message>
    <message>
        <source>Predicted from the measurement. Another program&apos;s show is projected.</source>
        <translation>Previsto a partir de la medición. Se proyecta el show de otro programa.</translation>
    </message>
    <message>
        <source>The preview is being prepared.</source>
        <translation>Se está preparando la vista previa.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::RenameDialog</name>
    <message>
        <source>Rename a venue</source>
        <translation>Cambiar el nombre de un lugar</translation>
    </message>
    <message>
        <source>Its folder has the same name and is renamed with it. A show that starts at log-in follows.</source>
        <translation>Su carpeta se llama igual y cambia con él. Un show que empieza al iniciar sesión lo sigue.</translation>
    </message>
    <message>
        <source>Rename</source>
        <translation>Cambiar nombre</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Session</name>
    <message>
        <source>%1 is at work. What is chosen here can be kept when that has ended.</source>
        <translation>%1 está en marcha. Lo que se elija aquí podrá guardarse cuando termine.</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>Dispositivos en uso en %1.</translation>
    </message>
    <message>
        <source>Confirm that the room is clear.</source>
        <translation>Confirme que la sala está despejada.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::SetNameDialog</name>
    <message>
        <source>Save as a set</source>
        <translation>Guardar como variante</translation>
    </message>
    <message>
        <source>Rename a set</source>
        <translation>Cambiar el nombre de una variante</translation>
    </message>
    <message>
        <source>Day, night, school class</source>
        <translation>Día, noche, clase escolar</translation>
    </message>
    <message>
        <source>What you see becomes this set, and is changed in it from now on.</source>
        <translation>Lo que ve pasa a ser esta variante, y a partir de ahora se cambia en ella.</translation>
    </message>
    <message>
        <source>Playlists and controllers that call it by its present name have to be changed, too.</source>
        <translation>También hay que cambiar las listas y los controladores que la llaman por su nombre actual.</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>Guardar</translation>
    </message>
    <message>
        <source>Rename</source>
        <translation>Cambiar nombre</translation>
    </message>
    <message>
        <source>There is a set of this name already.</source>
        <translation>Ya hay una variante con este nombre.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::SetTimesDialog</name>
    <message>
        <source>Sets by the time of the day</source>
        <translation>Variantes según la hora del día</translation>
    </message>
    <message>
        <source>From each time on the installed show plays that set, every day, until the next time.</source>
        <translation>Desde cada hora, el show instalado muestra esa variante, todos los días, hasta la hora siguiente.</translation>
    </message>
    <message>
        <source>From this time on</source>
        <translation>Desde esta hora</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>Variante</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Añadir</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Quitar</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Cancelar</translation>
    </message>
    <message>
        <source>Apply</source>
        <translation>Aplicar</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1: %2</translation>
    </message>
    <message>
        <source>There are no times yet.</source>
        <translation>Aún no hay horas.</translation>
    </message>
    <message>
        <source>Type a time of the day, such as %1.</source>
        <translation>Escriba una hora del día, por ejemplo %1.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::SettingsDialog</name>
    <message>
        <source>Settings</source>
        <translation>Ajustes</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Cerrar</translation>
    </message>
    <message>
        <source>Look</source>
        <translation>Aspecto</translation>
    </message>
    <message>
        <source>Dark</source>
        <translation>Oscuro</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Claro</translation>
    </message>
    <message>
        <source>Theme. The dark one is for the dark room.</source>
        <translation>Tema. El oscuro es para la sala a oscuras.</translation>
    </message>
    <message>
        <source>Dim pictures: the laptop is room light</source>
        <translation>Atenuar imágenes: el portátil ilumina la sala</translation>
    </message>
    <message>
        <source>As the computer</source>
        <translation>Idioma del sistema</translation>
    </message>
    <message>
        <source>Language</source>
        <translation>Idioma</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>Medición</translation>
    </message>
    <message>
        <source>As quickly as the devices can, after a consent</source>
        <translation>Lo más rápido posible, con consentimiento</translation>
    </message>
    <message numerus="yes">
        <source>At most %n change(s) a second</source>
        <translation>
            <numerusform>Como máximo %n cambio por segundo</numerusform>
            <numerusform>Como máximo %n cambios por segundo</numerusform>
        </translation>
    </message>
    <message>
        <source>Flashing light of the projector</source>
        <translation>Luz intermitente del proyector</translation>
    </message>
    <message>
        <source>More than three changes a second can cause seizures. Slower measuring needs no consent.</source>
        <translation>Más de tres cambios por segundo pueden causar crisis epilépticas. Medir más despacio no requiere consentimiento.</translation>
    </message>
    <message>
        <source>A sound when a measurement ends</source>
        <translation>Sonido al terminar una medición</translation>
    </message>
    <message>
        <source>New venues</source>
        <translation>Nuevos lugares</translation>
    </message>
    <message>
        <source>Folder for new venues</source>
        <translation>Carpeta para nuevos lugares</translation>
    </message>
    <message>
        <source>Choose a folder</source>
        <translation>Elegir una carpeta</translation>
    </message>
    <message>
        <source>Folder</source>
        <translation>Carpeta</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Show</name>
    <message>
        <source>A show is playing.</source>
        <translation>Hay un show en reproducción.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StatusPage</name>
    <message>
        <source>State</source>
        <translation>Estado</translation>
    </message>
    <message>
        <source>Updated</source>
        <translation>Actualizado</translation>
    </message>
    <message>
        <source>Computed on</source>
        <translation>Calculado en</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>Fotogramas</translation>
    </message>
    <message>
        <source>Late frames</source>
        <translation>Fotogramas tardíos</translation>
    </message>
    <message>
        <source>Frames per second</source>
        <translation>Fotogramas por segundo</translation>
    </message>
    <message>
        <source>Time per frame (ms)</source>
        <translation>Tiempo por fotograma (ms)</translation>
    </message>
    <message>
        <source>Delay behind the viewer (ms)</source>
        <translation>Retraso respecto al espectador (ms)</translation>
    </message>
    <message>
        <source>Clipped share</source>
        <translation>Parte saturada</translation>
    </message>
    <message>
        <source>Steps</source>
        <translation>Pasos</translation>
    </message>
    <message>
        <source>Perfected</source>
        <translation>Perfeccionada</translation>
    </message>
    <message>
        <source>Item</source>
        <translation>Elemento</translation>
    </message>
    <message>
        <source>Items skipped</source>
        <translation>Elementos omitidos</translation>
    </message>
    <message>
        <source>Failures</source>
        <translation>Fallos</translation>
    </message>
    <message>
        <source>Most memory used (bytes)</source>
        <translation>Memoria máxima usada (bytes)</translation>
    </message>
    <message>
        <source>Displays</source>
        <translation>Pantallas</translation>
    </message>
    <message>
        <source>Connector</source>
        <translation>Conector</translation>
    </message>
    <message>
        <source>Shining</source>
        <translation>Iluminando</translation>
    </message>
    <message>
        <source>Drawn by</source>
        <translation>Dibujado por</translation>
    </message>
    <message>
        <source>Projectors</source>
        <translation>Proyectores</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>Proyector</translation>
    </message>
    <message>
        <source>Address</source>
        <translation>Dirección</translation>
    </message>
    <message>
        <source>Answers</source>
        <translation>Responde</translation>
    </message>
    <message>
        <source>Problem</source>
        <translation>Problema</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Nombre</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>Modelo</translation>
    </message>
    <message>
        <source>Power</source>
        <translation>Alimentación</translation>
    </message>
    <message>
        <source>Shutter</source>
        <translation>Obturador</translation>
    </message>
    <message>
        <source>Lamp hours</source>
        <translation>Horas de lámpara</translation>
    </message>
    <message>
        <source>Filter hours</source>
        <translation>Horas de filtro</translation>
    </message>
    <message>
        <source>Input</source>
        <translation>Entrada</translation>
    </message>
    <message>
        <source>Signal</source>
        <translation>Señal</translation>
    </message>
    <message>
        <source>Own pixels</source>
        <translation>Píxeles propios</translation>
    </message>
    <message>
        <source>Remarks</source>
        <translation>Observaciones</translation>
    </message>
    <message>
        <source>yes</source>
        <translation>sí</translation>
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
        <translation>Alarma</translation>
    </message>
    <message>
        <source>Last night</source>
        <translation>Última noche</translation>
    </message>
    <message>
        <source>When</source>
        <translation>Cuándo</translation>
    </message>
    <message>
        <source>Outcome</source>
        <translation>Resultado</translation>
    </message>
    <message>
        <source>Pictures perfected</source>
        <translation>Imágenes perfeccionadas</translation>
    </message>
    <message>
        <source>Colour error (ΔE)</source>
        <translation>Error de color (ΔE)</translation>
    </message>
    <message>
        <source>Predicted colour error (ΔE)</source>
        <translation>Error de color previsto (ΔE)</translation>
    </message>
    <message>
        <source>Nobody was told</source>
        <translation>No se avisó a nadie</translation>
    </message>
    <message>
        <source>Next night</source>
        <translation>Próxima noche</translation>
    </message>
    <message>
        <source>Somebody has to look</source>
        <translation>Alguien tiene que mirar</translation>
    </message>
    <message>
        <source>Watched by camera</source>
        <translation>Vigilado por cámara</translation>
    </message>
    <message>
        <source>Photographs</source>
        <translation>Fotografías</translation>
    </message>
    <message>
        <source>Photographs used</source>
        <translation>Fotografías utilizadas</translation>
    </message>
    <message>
        <source>Share that can be told</source>
        <translation>Parte evaluable</translation>
    </message>
    <message>
        <source>Time per photograph (ms)</source>
        <translation>Tiempo por fotografía (ms)</translation>
    </message>
    <message>
        <source>What has changed</source>
        <translation>Qué ha cambiado</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>Tipo</translation>
    </message>
    <message>
        <source>How much</source>
        <translation>Cuánto</translation>
    </message>
    <message>
        <source>What happened</source>
        <translation>Qué ha ocurrido</translation>
    </message>
    <message>
        <source>What to do</source>
        <translation>Qué hacer</translation>
    </message>
    <message>
        <source>Delay of the live picture (ms)</source>
        <translation>Retraso de la imagen en vivo (ms)</translation>
    </message>
    <message>
        <source>Streams</source>
        <translation>Transmisiones</translation>
    </message>
    <message>
        <source>Losses</source>
        <translation>Pérdidas</translation>
    </message>
    <message>
        <source>Pixels</source>
        <translation>Píxeles</translation>
    </message>
    <message>
        <source>Time from the sender, by its clock (ms)</source>
        <translation>Tiempo desde el emisor, según su reloj (ms)</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>Variante</translation>
    </message>
    <message>
        <source>Black</source>
        <translation>Negro</translation>
    </message>
    <message>
        <source>Frozen</source>
        <translation>Congelado</translation>
    </message>
    <message>
        <source>Corrected</source>
        <translation>Corregido</translation>
    </message>
    <message>
        <source>Brightness</source>
        <translation>Brillo</translation>
    </message>
    <message>
        <source>Test chart</source>
        <translation>Carta de prueba</translation>
    </message>
    <message>
        <source>starting</source>
        <translation>arrancando</translation>
    </message>
    <message>
        <source>playing</source>
        <translation>en reproducción</translation>
    </message>
    <message>
        <source>resting until its hours</source>
        <translation>en reposo hasta su horario</translation>
    </message>
    <message>
        <source>photographing</source>
        <translation>fotografiando</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>fallido</translation>
    </message>
    <message>
        <source>stopped</source>
        <translation>detenido</translation>
    </message>
    <message>
        <source>connecting</source>
        <translation>conectando</translation>
    </message>
    <message>
        <source>asking whether it may</source>
        <translation>pidiendo permiso</translation>
    </message>
    <message>
        <source>lost</source>
        <translation>perdido</translation>
    </message>
    <message>
        <source>opening</source>
        <translation>abriendo</translation>
    </message>
    <message>
        <source>watching</source>
        <translation>observando</translation>
    </message>
    <message>
        <source>paused</source>
        <translation>en pausa</translation>
    </message>
    <message>
        <source>no camera</source>
        <translation>sin cámara</translation>
    </message>
    <message>
        <source>no calibration</source>
        <translation>sin calibración</translation>
    </message>
    <message>
        <source>black, until somebody ends it</source>
        <translation>en negro, hasta que alguien lo termine</translation>
    </message>
    <message>
        <source>test chart</source>
        <translation>carta de prueba</translation>
    </message>
    <message>
        <source>frozen, until somebody ends it</source>
        <translation>congelado, hasta que alguien lo termine</translation>
    </message>
    <message>
        <source>playing, but no display shows it</source>
        <translation>en reproducción, pero ninguna pantalla lo muestra</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StatusStrip</name>
    <message>
        <source>Projector</source>
        <translation>Proyector</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Cámara</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>Disco</translation>
    </message>
    <message>
        <source>none chosen</source>
        <translation>sin elegir</translation>
    </message>
    <message>
        <source>%1 free</source>
        <translation>%1 libres</translation>
    </message>
    <message>
        <source>simulated</source>
        <translation>simulado</translation>
    </message>
    <message>
        <source>by script</source>
        <translation>por script</translation>
    </message>
    <message>
        <source>%1, in use</source>
        <translation>%1, en uso</translation>
    </message>
    <message>
        <source>Saved %1</source>
        <translation>Guardado: %1</translation>
    </message>
    <message>
        <source>Room light</source>
        <translation>Luz ambiente</translation>
    </message>
    <message>
        <source>%1, unplugged</source>
        <translation>%1, desconectado</translation>
    </message>
    <message>
        <source>%1 of full light, steady</source>
        <translation>%1 de la luz plena, estable</translation>
    </message>
    <message>
        <source>%1 of full light, changed</source>
        <translation>%1 de la luz plena, cambió</translation>
    </message>
    <message>
        <source>%1, silent</source>
        <translation>%1, sin respuesta</translation>
    </message>
    <message numerus="yes">
        <source>%n screen(s)</source>
        <translation>
            <numerusform>%n pantalla</numerusform>
            <numerusform>%n pantallas</numerusform>
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
            <numerusform>%n, simulada</numerusform>
            <numerusform>%n, simuladas</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n camera(s)</source>
        <translation>
            <numerusform>%n cámara</numerusform>
            <numerusform>%n cámaras</numerusform>
        </translation>
    </message>
    <message>
        <source>none in use</source>
        <translation>sin uso</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StepRail</name>
    <message>
        <source>locked</source>
        <translation>bloqueado</translation>
    </message>
    <message>
        <source>done</source>
        <translation>hecho</translation>
    </message>
    <message>
        <source>out of date</source>
        <translation>desactualizado</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>fallido</translation>
    </message>
    <message>
        <source>current</source>
        <translation>actual</translation>
    </message>
    <message>
        <source>open</source>
        <translation>pendiente</translation>
    </message>
    <message>
        <source>Step %1, %2, %3</source>
        <translation>Paso %1, %2, %3</translation>
    </message>
    <message>
        <source>No venue open</source>
        <translation>Ningún lugar abierto</translation>
    </message>
    <message>
        <source>stopped early</source>
        <translation>detenido antes de tiempo</translation>
    </message>
    <message>
        <source>under way</source>
        <translation>en curso</translation>
    </message>
    <message>
        <source>doubtful</source>
        <translation>dudoso</translation>
    </message>
    <message>
        <source>Opens once %1 is done.</source>
        <translation>Se abre cuando «%1» está hecho.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StreamDialog</name>
    <message>
        <source>Add a stream</source>
        <translation>Añadir una transmisión</translation>
    </message>
    <message>
        <source>A live picture from the network, without its sound: RTSP, SRT, RTP, UDP, HTTP or RTMP. While it plays, this computer is connected to that address.</source>
        <translation>Una imagen en vivo de la red, sin su sonido: RTSP, SRT, RTP, UDP, HTTP o RTMP. Mientras se reproduce, este ordenador está conectado a esa dirección.</translation>
    </message>
    <message>
        <source>Address</source>
        <translation>Dirección</translation>
    </message>
    <message>
        <source>User name and password stand before the host, as in rtsp://user:password@host. They are kept in the playlist, and shown nowhere.</source>
        <translation>El nombre de usuario y la contraseña van antes del host, como en rtsp://user:password@host. Se guardan en la lista de reproducción y no se muestran en ninguna parte.</translation>
    </message>
    <message>
        <source>While it is lost</source>
        <translation>Mientras está perdida</translation>
    </message>
    <message>
        <source>Its last picture</source>
        <translation>Su última imagen</translation>
    </message>
    <message>
        <source>Black</source>
        <translation>Negro</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Cancelar</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Añadir</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ThresholdPage</name>
    <message>
        <source>%1 of light kept</source>
        <translation>%1 de luz conservada</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>Desactualizado</translation>
    </message>
    <message>
        <source>Reading the light transport</source>
        <translation>Leyendo el transporte de luz</translation>
    </message>
    <message>
        <source>Below 95 % of the light, bounces are lost.</source>
        <translation>Por debajo del 95&#xa0;% de la luz se pierden rebotes.</translation>
    </message>
    <message>
        <source>Next: groups of pixels that can be solved on their own</source>
        <translation>Siguiente: grupos de píxeles que se resuelven por separado</translation>
    </message>
    <message>
        <source>Group into clusters</source>
        <translation>Agrupar en clústeres</translation>
    </message>
    <message>
        <source>The threshold was chosen for an earlier measurement</source>
        <translation>El umbral se eligió para una medición anterior</translation>
    </message>
    <message>
        <source>Look at it again, then go on.</source>
        <translation>Revíselo y continúe.</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>Lo medido está a salvo.</translation>
    </message>
    <message>
        <source>Threshold</source>
        <translation>Umbral</translation>
    </message>
    <message>
        <source>Choose the faintest light worth keeping. Less is faster and smaller; too little loses the bounces.</source>
        <translation>Elija la luz más débil que vale la pena conservar. Menos luz es más rápido y ocupa menos; con demasiado poca se pierden los rebotes.</translation>
    </message>
    <message>
        <source>Camera view</source>
        <translation>Vista de cámara</translation>
    </message>
    <message>
        <source>The surface in full light</source>
        <translation>La superficie con luz plena</translation>
    </message>
    <message>
        <source>Pixel %1, %2</source>
        <translation>Píxel %1, %2</translation>
    </message>
    <message>
        <source>Projector pixels that light the picked camera pixel</source>
        <translation>Píxeles del proyector que iluminan el píxel de cámara elegido</translation>
    </message>
    <message>
        <source>Pick a pixel in the camera view.</source>
        <translation>Elija un píxel en la vista de cámara.</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Cámara</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>Proyector</translation>
    </message>
    <message>
        <source>transport</source>
        <translation>transporte</translation>
    </message>
    <message>
        <source>Transport matrix</source>
        <translation>Matriz de transporte</translation>
    </message>
    <message>
        <source>click an entry</source>
        <translation>clic en un elemento</translation>
    </message>
    <message>
        <source>Light transport matrix, camera pixels down, projector pixels across</source>
        <translation>Matriz de transporte de luz, píxeles de cámara en vertical, de proyector en horizontal</translation>
    </message>
    <message>
        <source>Transport value, camera signal a second</source>
        <translation>Valor de transporte, señal de cámara por segundo</translation>
    </message>
    <message>
        <source>How much light flows through each connection</source>
        <translation>Cuánta luz fluye por cada conexión</translation>
    </message>
    <message>
        <source>drag the cut, or use the arrow keys</source>
        <translation>arrastre el corte o use las flechas</translation>
    </message>
    <message>
        <source>Connections</source>
        <translation>Conexiones</translation>
    </message>
    <message>
        <source>Cut</source>
        <translation>Corte</translation>
    </message>
    <message>
        <source>Cut at %1, keeps %2</source>
        <translation>Corte en %1, conserva el %2</translation>
    </message>
    <message>
        <source>Everything is kept</source>
        <translation>Se conserva todo</translation>
    </message>
    <message>
        <source>Leave out light below</source>
        <translation>Descartar luz por debajo de</translation>
    </message>
    <message>
        <source>One value</source>
        <translation>Un valor</translation>
    </message>
    <message>
        <source>What stays</source>
        <translation>Lo que queda</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Luz</translation>
    </message>
    <message>
        <source>Memory</source>
        <translation>Memoria</translation>
    </message>
    <message>
        <source>What is left out is put back in proportion, so that the surface keeps its brightness.</source>
        <translation>Lo que se descarta se repone en proporción, para que la superficie conserve su brillo.</translation>
    </message>
    <message>
        <source>Picked pixel</source>
        <translation>Píxel elegido</translation>
    </message>
    <message>
        <source>Lit by</source>
        <translation>Iluminado por</translation>
    </message>
    <message>
        <source>Strongest</source>
        <translation>El más intenso</translation>
    </message>
    <message>
        <source>From around it</source>
        <translation>De su entorno</translation>
    </message>
    <message>
        <source>Light from elsewhere</source>
        <translation>Luz de otros puntos</translation>
    </message>
    <message>
        <source>Use suggested, %1</source>
        <translation>Usar el sugerido, %1</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 de %2</translation>
    </message>
    <message>
        <source>Picked pixel %1, %2</source>
        <translation>Píxel elegido %1, %2</translation>
    </message>
    <message numerus="yes">
        <source>%n pixel(s)</source>
        <translation>
            <numerusform>%n píxel</numerusform>
            <numerusform>%n píxeles</numerusform>
        </translation>
    </message>
    <message>
        <source>Cut, camera signal a second</source>
        <translation>Corte, señal de cámara por segundo</translation>
    </message>
    <message>
        <source>Use picked pixel</source>
        <translation>Usar el píxel elegido</translation>
    </message>
    <message>
        <source>For each camera pixel</source>
        <translation>Por píxel de cámara</translation>
    </message>
    <message>
        <source>Suggested: three times the noise of the measurement.</source>
        <translation>Sugerencia: el triple del ruido de la medición.</translation>
    </message>
    <message>
        <source>Suggested: keeps nearly all of the light.</source>
        <translation>Sugerencia: conserva casi toda la luz.</translation>
    </message>
    <message>
        <source>%1 on average</source>
        <translation>%1 de media</translation>
    </message>
    <message>
        <source>Kind of cut</source>
        <translation>Tipo de corte</translation>
    </message>
    <message>
        <source>Share of each pixel</source>
        <translation>Parte por píxel</translation>
    </message>
    <message>
        <source>Share of the strongest light of each camera pixel, in tenths of a percent</source>
        <translation>Parte de la luz más fuerte de cada píxel de la cámara, en décimas de porcentaje</translation>
    </message>
    <message>
        <source>Below %1 of the strongest light that each camera pixel gets</source>
        <translation>Por debajo del %1 de la luz más fuerte que recibe cada píxel de la cámara</translation>
    </message>
    <message>
        <source>Of each camera pixel the strongest connection always stays, however high the cut.</source>
        <translation>De cada píxel de la cámara queda siempre la conexión más fuerte, por alto que sea el corte.</translation>
    </message>
    <message>
        <source>“%1” is not a cut: type a number, 0 or more. The cut is still %2.</source>
        <translation>«%1» no es un corte: escriba un número, 0 o más. El corte sigue en %2.</translation>
    </message>
    <message>
        <source>At three times the noise, %1, only %2 of the light would stay: much faint light adds up. Suggested: keep everything.</source>
        <translation>Con el triple del ruido, %1, solo quedaría el %2 de la luz: mucha luz débil se suma. Sugerencia: conservarlo todo.</translation>
    </message>
    <message>
        <source>Keep everything</source>
        <translation>Conservar todo</translation>
    </message>
    <message>
        <source>Changed: it is applied as soon as you go on.</source>
        <translation>Cambiado: se aplica en cuanto continúe.</translation>
    </message>
    <message>
        <source>What was measured is being read.</source>
        <translation>Se está leyendo lo medido.</translation>
    </message>
    <message>
        <source>Pick a pixel in a picture.</source>
        <translation>Elija un píxel en una imagen.</translation>
    </message>
    <message>
        <source>It is in use.</source>
        <translation>Está en uso.</translation>
    </message>
    <message>
        <source>No light of the picked pixel was kept.</source>
        <translation>Del píxel elegido no quedó luz.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::TidyDialog</name>
    <message>
        <source>All</source>
        <translation>Todas</translation>
    </message>
    <message>
        <source>Of the latest measurement</source>
        <translation>Las de la última medición</translation>
    </message>
    <message>
        <source>None: results only</source>
        <translation>Ninguna: solo resultados</translation>
    </message>
    <message>
        <source>Only what nothing reads goes, and old files are compressed without loss.</source>
        <translation>Solo se va lo que nada lee; los archivos antiguos se comprimen sin pérdida.</translation>
    </message>
    <message>
        <source>Those that were set aside by measuring again go too. Nothing reads them.</source>
        <translation>También se van las que se apartaron al medir de nuevo. Nada las lee.</translation>
    </message>
    <message>
        <source>All that was measured and computed stays. The photographs go.</source>
        <translation>Todo lo medido y calculado se queda. Las fotografías se van.</translation>
    </message>
    <message>
        <source>Showing, checking and reports need results only. Other settings, and better methods of later versions, then have to photograph everything again.</source>
        <translation>Mostrar, comprobar y los informes solo necesitan resultados. Otros ajustes, y métodos mejores de versiones posteriores, tendrán que fotografiarlo todo de nuevo.</translation>
    </message>
    <message numerus="yes">
        <source>%n photograph(s)</source>
        <translation>
            <numerusform>%n fotografía</numerusform>
            <numerusform>%n fotografías</numerusform>
        </translation>
    </message>
    <message>
        <source>What was freed until then is free. Nothing that is needed is lost.</source>
        <translation>Lo liberado hasta entonces queda libre. No se ha perdido nada necesario.</translation>
    </message>
    <message>
        <source>Photographs to keep</source>
        <translation>Fotografías que se conservan</translation>
    </message>
    <message>
        <source>This venue is not measured to the end.</source>
        <translation>Este lugar no está medido hasta el final.</translation>
    </message>
    <message>
        <source>All its photographs stay: going on needs them.</source>
        <translation>Se quedan todas sus fotografías: hacen falta para continuar.</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Atrás</translation>
    </message>
    <message>
        <source>Freeing the disk</source>
        <translation>Liberando el disco</translation>
    </message>
    <message>
        <source>%1 will be removed for good.</source>
        <translation>Se eliminarán para siempre: %1.</translation>
    </message>
    <message>
        <source>%1 will be freed.</source>
        <translation>Se liberarán %1.</translation>
    </message>
    <message>
        <source>%1 freed, %2 removed</source>
        <translation>%1 liberados, %2 eliminadas</translation>
    </message>
    <message>
        <source>%1 Nothing that is needed is lost.</source>
        <translation>%1 No se ha perdido nada necesario.</translation>
    </message>
    <message>
        <source>frees %1</source>
        <translation>libera %1</translation>
    </message>
    <message>
        <source>nothing to free</source>
        <translation>nada que liberar</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Cancelar</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Detener</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Cerrar</translation>
    </message>
    <message>
        <source>Free %1…</source>
        <translation>Liberar %1…</translation>
    </message>
    <message>
        <source>Free %1</source>
        <translation>Liberar %1</translation>
    </message>
    <message>
        <source>No photograph goes: everything stays possible.</source>
        <translation>No se va ninguna fotografía: todo sigue siendo posible.</translation>
    </message>
    <message>
        <source>The latest measurement keeps its photographs: everything stays possible.</source>
        <translation>La última medición conserva sus fotografías: todo sigue siendo posible.</translation>
    </message>
    <message>
        <source>Looking up what could be freed. Nothing is removed yet.</source>
        <translation>Se busca lo que se puede liberar. Todavía no se elimina nada.</translation>
    </message>
    <message>
        <source>Free disk space</source>
        <translation>Liberar espacio en disco</translation>
    </message>
    <message>
        <source>Disk space of %1</source>
        <translation>Espacio en disco de %1</translation>
    </message>
    <message>
        <source>Freeing space was stopped.</source>
        <translation>Se detuvo la liberación de espacio.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VenueNetwork</name>
    <message>
        <source>“%1” is no network address of a projector. Write its number or name, as 192.168.1.50.</source>
        <translation>«%1» no es la dirección de red de un proyector. Escriba su número o su nombre, como 192.168.1.50.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VenuePage</name>
    <message>
        <source>Unplugged. Plug it in or choose another.</source>
        <translation>Desconectada. Conéctela o elija otra.</translation>
    </message>
    <message>
        <source>%1, %2 by %3, chosen</source>
        <translation>%1, %2 por %3, elegida</translation>
    </message>
    <message>
        <source>%1, %2 by %3</source>
        <translation>%1, %2 por %3</translation>
    </message>
    <message>
        <source>Screens</source>
        <translation>Pantallas</translation>
    </message>
    <message>
        <source>Choose the one that shines on the surface. Its pixels are the projector&apos;s.</source>
        <translation>Elija la que ilumina la superficie. Sus píxeles son los del proyector.</translation>
    </message>
    <message>
        <source>Identify screens</source>
        <translation>Identificar pantallas</translation>
    </message>
    <message>
        <source>I</source>
        <translation>I</translation>
    </message>
    <message>
        <source>The projector shares your screen</source>
        <translation>El proyector comparte su pantalla</translation>
    </message>
    <message>
        <source>Real devices</source>
        <translation>Dispositivos reales</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>Proyector</translation>
    </message>
    <message>
        <source>Glossy corner</source>
        <translation>Rincón brillante</translation>
    </message>
    <message>
        <source>Light bounces between two cards</source>
        <translation>La luz rebota entre dos cartulinas</translation>
    </message>
    <message>
        <source>Bust before a brick wall</source>
        <translation>Busto ante muro de ladrillo</translation>
    </message>
    <message>
        <source>Texture, shadow and light between surfaces</source>
        <translation>Textura, sombra y luz entre superficies</translation>
    </message>
    <message>
        <source>Many depths</source>
        <translation>Varias profundidades</translation>
    </message>
    <message>
        <source>Some surfaces are out of focus</source>
        <translation>Algunas superficies están desenfocadas</translation>
    </message>
    <message>
        <source>Dome</source>
        <translation>Cúpula</translation>
    </message>
    <message>
        <source>Every part lights every other part</source>
        <translation>Cada parte ilumina todas las demás</translation>
    </message>
    <message>
        <source>Wine glass</source>
        <translation>Copa de vino</translation>
    </message>
    <message>
        <source>Light is refracted both ways</source>
        <translation>La luz se refracta a la ida y a la vuelta</translation>
    </message>
    <message>
        <source>Painted wall</source>
        <translation>Pared pintada</translation>
    </message>
    <message>
        <source>Flat, with diamonds; the easiest</source>
        <translation>Plana, con rombos; la más fácil</translation>
    </message>
    <message>
        <source>%1, a first look</source>
        <translation>%1, primer vistazo</translation>
    </message>
    <message>
        <source>%1, quick</source>
        <translation>%1, rápido</translation>
    </message>
    <message>
        <source>%1, usual</source>
        <translation>%1, habitual</translation>
    </message>
    <message>
        <source>%1, fine</source>
        <translation>%1, fino</translation>
    </message>
    <message>
        <source>Venue</source>
        <translation>Lugar</translation>
    </message>
    <message>
        <source>Rehearse in a simulated venue</source>
        <translation>Ensayar en un lugar simulado</translation>
    </message>
    <message>
        <source>New venue by script</source>
        <translation>Nuevo lugar por script</translation>
    </message>
    <message>
        <source>New venue</source>
        <translation>Nuevo lugar</translation>
    </message>
    <message>
        <source>Say which screen shines, which programs show and photograph, and where the work is kept.</source>
        <translation>Indique qué pantalla ilumina, qué programas muestran y fotografían, y dónde se guarda el trabajo.</translation>
    </message>
    <message>
        <source>Setting up</source>
        <translation>En preparación</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1, %2</translation>
    </message>
    <message>
        <source>simulated, %1</source>
        <translation>simulado, %1</translation>
    </message>
    <message>
        <source>by script, %1</source>
        <translation>por script, %1</translation>
    </message>
    <message>
        <source>%1 is open</source>
        <translation>%1 está abierto</translation>
    </message>
    <message>
        <source>Enter opens the highlighted choice</source>
        <translation>Intro abre la opción resaltada</translation>
    </message>
    <message>
        <source>Check camera</source>
        <translation>Comprobar cámara</translation>
    </message>
    <message>
        <source>Start rehearsal</source>
        <translation>Iniciar ensayo</translation>
    </message>
    <message>
        <source>Nothing was changed in that folder.</source>
        <translation>No se ha cambiado nada en esa carpeta.</translation>
    </message>
    <message>
        <source>Give the venue a name.</source>
        <translation>Dé un nombre al lugar.</translation>
    </message>
    <message>
        <source>A name cannot hold a slash.</source>
        <translation>Un nombre no puede contener una barra (/).</translation>
    </message>
    <message>
        <source>There is a folder of that name. Choose another name.</source>
        <translation>Ya hay una carpeta con ese nombre. Elija otro.</translation>
    </message>
    <message>
        <source>Choose the screen that shines on the surface.</source>
        <translation>Elija la pantalla que ilumina la superficie.</translation>
    </message>
    <message>
        <source>Free %1 or choose another folder.</source>
        <translation>Libere %1 o elija otra carpeta.</translation>
    </message>
    <message>
        <source>Confirm that the room is clear.</source>
        <translation>Confirme que la sala está despejada.</translation>
    </message>
    <message>
        <source>Nothing was measured yet.</source>
        <translation>Aún no se ha medido nada.</translation>
    </message>
    <message>
        <source>Programs</source>
        <translation>Programas</translation>
    </message>
    <message>
        <source>Any projector and any camera that a command can drive</source>
        <translation>Cualquier proyector y cámara que se manejen con un comando</translation>
    </message>
    <message>
        <source>Photographs {exposure} seconds into the file {output}: float EXR, 16-bit PNG or TIFF</source>
        <translation>Fotografía {exposure} segundos en el archivo {output}: EXR flotante, PNG o TIFF de 16 bits</translation>
    </message>
    <message>
        <source>Projector&apos;s pixels</source>
        <translation>Píxeles del proyector</translation>
    </message>
    <message>
        <source>Width</source>
        <translation>Ancho</translation>
    </message>
    <message>
        <source>Height</source>
        <translation>Alto</translation>
    </message>
    <message>
        <source>Rehearsal. Opened %1</source>
        <translation>Ensayo. Abierto: %1</translation>
    </message>
    <message>
        <source>Opened %1</source>
        <translation>Abierto: %1</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Abrir</translation>
    </message>
    <message>
        <source>Open %1</source>
        <translation>Abrir %1</translation>
    </message>
    <message>
        <source>Open a venue</source>
        <translation>Abrir un lugar</translation>
    </message>
    <message>
        <source>Rehearse</source>
        <translation>Ensayar</translation>
    </message>
    <message>
        <source>Learn every step in a simulated venue. No devices needed.</source>
        <translation>Aprenda cada paso en un lugar simulado. No hacen falta dispositivos.</translation>
    </message>
    <message>
        <source>Continue where you stopped, or change the content.</source>
        <translation>Continúe donde lo dejó o cambie el contenido.</translation>
    </message>
    <message>
        <source>Measure a surface with a projector and a camera at this computer.</source>
        <translation>Mida una superficie con un proyector y una cámara en este equipo.</translation>
    </message>
    <message>
        <source>Projector and camera are driven by programs of yours.</source>
        <translation>Sus propios programas manejan el proyector y la cámara.</translation>
    </message>
    <message>
        <source>Recent</source>
        <translation>Recientes</translation>
    </message>
    <message>
        <source>No venues yet</source>
        <translation>Aún no hay lugares</translation>
    </message>
    <message>
        <source>The venues that you measure are listed here, newest first.</source>
        <translation>Aquí aparecen los lugares que mida, los más nuevos primero.</translation>
    </message>
    <message>
        <source>A first rehearsal takes a few minutes.</source>
        <translation>Un primer ensayo dura unos minutos.</translation>
    </message>
    <message>
        <source>This venue</source>
        <translation>Este lugar</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Nombre</translation>
    </message>
    <message>
        <source>Name of the venue</source>
        <translation>Nombre del lugar</translation>
    </message>
    <message>
        <source>Folder</source>
        <translation>Carpeta</translation>
    </message>
    <message>
        <source>Folder that holds the venue</source>
        <translation>Carpeta que contiene el lugar</translation>
    </message>
    <message>
        <source>Choose a folder</source>
        <translation>Elegir una carpeta</translation>
    </message>
    <message>
        <source>Expected</source>
        <translation>Previsto</translation>
    </message>
    <message>
        <source>Patterns</source>
        <translation>Patrones</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>Disco</translation>
    </message>
    <message>
        <source>about %1</source>
        <translation>unos %1</translation>
    </message>
    <message>
        <source>Simulated devices</source>
        <translation>Dispositivos simulados</translation>
    </message>
    <message>
        <source>Pixels of the simulated projector</source>
        <translation>Píxeles del proyector simulado</translation>
    </message>
    <message>
        <source>More pixels show finer detail and take longer. The first time, the light of the venue is traced; later it is remembered.</source>
        <translation>Más píxeles muestran más detalle y tardan más. La primera vez se traza la luz del lugar; después se reutiliza.</translation>
    </message>
    <message numerus="yes">
        <source>About %n pattern(s), %1</source>
        <translation>
            <numerusform>Alrededor de %n patrón, %1</numerusform>
            <numerusform>Unos %n patrones, %1</numerusform>
        </translation>
    </message>
    <message>
        <source>Shows the file {image} and ends as soon as the projector shines it</source>
        <translation>Muestra el archivo {image} y termina en cuanto el proyector lo emite</translation>
    </message>
    <message>
        <source>Relief, two projectors</source>
        <translation>Relieve, dos proyectores</translation>
    </message>
    <message>
        <source>Each shines into the other&apos;s shadows</source>
        <translation>Cada uno ilumina las sombras del otro</translation>
    </message>
    <message>
        <source>The projector&apos;s screen</source>
        <translation>La pantalla del proyector</translation>
    </message>
    <message>
        <source>Say which screen the projector is now. What was measured stays.</source>
        <translation>Indique qué pantalla es ahora el proyector. Lo medido se conserva.</translation>
    </message>
    <message>
        <source>Nothing is measured again.</source>
        <translation>No se vuelve a medir nada.</translation>
    </message>
    <message>
        <source>Use this screen</source>
        <translation>Usar esta pantalla</translation>
    </message>
    <message>
        <source>Change the screen</source>
        <translation>Cambiar la pantalla</translation>
    </message>
    <message>
        <source>The projector&apos;s screen %1 is not there</source>
        <translation>La pantalla %1 del proyector no está</translation>
    </message>
    <message>
        <source>Plug it in, or say which screen the projector is now.</source>
        <translation>Conéctela o indique qué pantalla es ahora el proyector.</translation>
    </message>
    <message>
        <source>%1 is not the folder of a venue: it has no %2 in it.</source>
        <translation>%1 no es la carpeta de un lugar: no contiene %2.</translation>
    </message>
    <message numerus="yes">
        <source>There are %n venue(s) within it: open one of them.</source>
        <translation>
            <numerusform>Contiene %n lugar: ábralo.</numerusform>
            <numerusform>Contiene %n lugares: abra uno de ellos.</numerusform>
        </translation>
    </message>
    <message>
        <source>Choose a venue&apos;s own folder. It has the venue&apos;s name.</source>
        <translation>Elija la carpeta de un lugar. Lleva el nombre del lugar.</translation>
    </message>
    <message>
        <source>This folder is not a venue</source>
        <translation>Esta carpeta no es un lugar</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>No se cambió nada.</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>Los dispositivos se están usando en %1.</translation>
    </message>
    <message>
        <source>Choose another screen.</source>
        <translation>Elija otra pantalla.</translation>
    </message>
    <message>
        <source>Only your own screen is there. Plug the projector in, and extend the desktop to it.</source>
        <translation>Solo está su propia pantalla. Conecte el proyector y extienda el escritorio a él.</translation>
    </message>
    <message>
        <source>Nothing is measured again</source>
        <translation>No se vuelve a medir nada</translation>
    </message>
    <message>
        <source>Measured at</source>
        <translation>Medido en</translation>
    </message>
    <message>
        <source>Used at</source>
        <translation>Usado en</translation>
    </message>
    <message>
        <source>Pixels</source>
        <translation>Píxeles</translation>
    </message>
    <message>
        <source>A screen is known again by its maker&apos;s names and serial number. Where it tells none, it is known by its connector: then a cable that is plugged in elsewhere has to be said here.</source>
        <translation>Una pantalla se reconoce por su fabricante y número de serie. Si no los da, se reconoce por su conector: entonces hay que indicar aquí un cable enchufado en otro sitio.</translation>
    </message>
    <message>
        <source>Is open</source>
        <translation>Está abierto</translation>
    </message>
    <message>
        <source>Time, by camera</source>
        <translation>Tiempo, según la cámara</translation>
    </message>
    <message>
        <source>Industrial cameras and video devices are fast, still cameras slow.</source>
        <translation>Las cámaras industriales y los dispositivos de vídeo son rápidos; las cámaras de fotos, lentas.</translation>
    </message>
    <message>
        <source>%1 to %2</source>
        <translation>%1 a %2</translation>
    </message>
    <message>
        <source>%1 free</source>
        <translation>%1 libres</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 de %2</translation>
    </message>
    <message>
        <source>Free the disk of what %1 does not need</source>
        <translation>Liberar el disco de lo que %1 no necesita</translation>
    </message>
    <message>
        <source>Resume</source>
        <translation>Reanudar</translation>
    </message>
    <message>
        <source>Resume %1</source>
        <translation>Reanudar %1</translation>
    </message>
    <message>
        <source>Free space…</source>
        <translation>Liberar espacio…</translation>
    </message>
    <message>
        <source>Somebody bumps the camera</source>
        <translation>Alguien golpea la cámara</translation>
    </message>
    <message>
        <source>A light is switched on</source>
        <translation>Se enciende una luz</translation>
    </message>
    <message>
        <source>The camera&apos;s cable comes out</source>
        <translation>Se suelta el cable de la cámara</translation>
    </message>
    <message>
        <source>Surprises</source>
        <translation>Sorpresas</translation>
    </message>
    <message>
        <source>Each comes once while Acquire measures, at a moment that nobody knows. Practise what the wizard says, before it happens in front of a client.</source>
        <translation>Cada una llega una vez mientras Adquisición mide, en un momento que nadie conoce. Practique lo que dice el asistente antes de que ocurra ante un cliente.</translation>
    </message>
    <message>
        <source>Measures how a surface changes what is projected on it, and corrects pictures and films until they look right there.</source>
        <translation>Mide cómo una superficie cambia lo que se proyecta en ella y corrige imágenes y películas hasta que se ven bien.</translation>
    </message>
    <message>
        <source>Easy. Measuring takes %1</source>
        <translation>Fácil. Medir lleva %1</translation>
    </message>
    <message>
        <source>Medium. Measuring takes %1</source>
        <translation>Medio. Medir lleva %1</translation>
    </message>
    <message>
        <source>Hard. Measuring takes %1</source>
        <translation>Difícil. Medir lleva %1</translation>
    </message>
    <message>
        <source>Name of %1</source>
        <translation>Nombre de %1</translation>
    </message>
    <message>
        <source>Projectors</source>
        <translation>Proyectores</translation>
    </message>
    <message>
        <source>None chosen yet.</source>
        <translation>Ninguno elegido aún.</translation>
    </message>
    <message>
        <source>Add a projector</source>
        <translation>Añadir un proyector</translation>
    </message>
    <message>
        <source>Projector %1</source>
        <translation>Proyector %1</translation>
    </message>
    <message>
        <source>Remove projector %1</source>
        <translation>Quitar el proyector %1</translation>
    </message>
    <message>
        <source>%1: choose its screen</source>
        <translation>%1: elija su pantalla</translation>
    </message>
    <message>
        <source>Cameras</source>
        <translation>Cámaras</translation>
    </message>
    <message>
        <source>Camera %1</source>
        <translation>Cámara %1</translation>
    </message>
    <message>
        <source>Remove camera %1</source>
        <translation>Quitar la cámara %1</translation>
    </message>
    <message>
        <source>Add one from the list, or choose it at the next step.</source>
        <translation>Añada una de la lista, o elíjala en el paso siguiente.</translation>
    </message>
    <message>
        <source>Content is placed in the view of the first one.</source>
        <translation>El contenido se coloca en la vista de la primera.</translation>
    </message>
    <message>
        <source>Add those that look at the surface.</source>
        <translation>Añada las que miran a la superficie.</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Quitar</translation>
    </message>
    <message>
        <source>Remove %1</source>
        <translation>Quitar %1</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Añadir</translation>
    </message>
    <message>
        <source>Add %1</source>
        <translation>Añadir %1</translation>
    </message>
    <message>
        <source>Say which screens shine on the surface, which cameras watch, and where the work is kept.</source>
        <translation>Indique qué pantallas iluminan la superficie, qué cámaras miran y dónde se guarda el trabajo.</translation>
    </message>
    <message numerus="yes">
        <source>%n projector(s)</source>
        <translation>
            <numerusform>%n proyector</numerusform>
            <numerusform>%n proyectores</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n camera(s)</source>
        <translation>
            <numerusform>%n cámara</numerusform>
            <numerusform>%n cámaras</numerusform>
        </translation>
    </message>
    <message>
        <source>This screen is projector %1 already.</source>
        <translation>Esta pantalla ya es el proyector %1.</translation>
    </message>
    <message>
        <source>That screen is projector %1. Choose another screen.</source>
        <translation>Esa pantalla es el proyector %1. Elija otra.</translation>
    </message>
    <message>
        <source>Dome, four projectors</source>
        <translation>Cúpula, cuatro proyectores</translation>
    </message>
    <message>
        <source>They overlap; two cameras watch</source>
        <translation>Se solapan; miran dos cámaras</translation>
    </message>
    <message>
        <source>Bust from three sides</source>
        <translation>Busto visto de tres lados</translation>
    </message>
    <message>
        <source>Two projectors, three cameras: for an audience that walks</source>
        <translation>Dos proyectores, tres cámaras: para un público que camina</translation>
    </message>
    <message>
        <source>Projector whose screen is changed</source>
        <translation>Proyector cuya pantalla se cambia</translation>
    </message>
    <message>
        <source>Network address (PJLink)</source>
        <translation>Dirección de red (PJLink)</translation>
    </message>
    <message>
        <source>Password, if it has one</source>
        <translation>Contraseña, si la tiene</translation>
    </message>
    <message>
        <source>On the network</source>
        <translation>En la red</translation>
    </message>
    <message>
        <source>Optional: a projector with a network address is switched on, and its lamp waited for until it is steady, before anything is measured.</source>
        <translation>Opcional: un proyector con dirección de red se enciende, y se espera a que su lámpara sea estable, antes de medir nada.</translation>
    </message>
    <message>
        <source>Find projectors</source>
        <translation>Buscar proyectores</translation>
    </message>
    <message>
        <source>Looking for projectors…</source>
        <translation>Buscando proyectores…</translation>
    </message>
    <message>
        <source>None answers. Only PJLink class 2 can be searched: type the address.</source>
        <translation>Ninguno responde. Solo se puede buscar PJLink clase 2: escriba la dirección.</translation>
    </message>
    <message numerus="yes">
        <source>%n answer. Choose from the list of each.</source>
        <translation>
            <numerusform>%n responde. Elíjalo en la lista.</numerusform>
            <numerusform>%n responden. Elija en la lista de cada uno.</numerusform>
        </translation>
    </message>
    <message>
        <source>Move to the trash</source>
        <translation>Llevar a la papelera</translation>
    </message>
    <message>
        <source>Keep it</source>
        <translation>Conservarlo</translation>
    </message>
    <message>
        <source>Try again then.</source>
        <translation>Inténtelo de nuevo después.</translation>
    </message>
    <message>
        <source>Nothing of the venue is lost.</source>
        <translation>No se ha perdido nada del lugar.</translation>
    </message>
    <message>
        <source>Remove a venue</source>
        <translation>Quitar un lugar</translation>
    </message>
    <message>
        <source>“%1” goes to the trash, with its photographs, results and playlist.</source>
        <translation>«%1» va a la papelera, con sus fotografías, resultados y lista de reproducción.</translation>
    </message>
    <message>
        <source>Until the trash is emptied it can be taken back from there.</source>
        <translation>Hasta que se vacíe la papelera se puede recuperar de allí.</translation>
    </message>
    <message>
        <source>More</source>
        <translation>Más</translation>
    </message>
    <message>
        <source>More for %1</source>
        <translation>Más para %1</translation>
    </message>
    <message>
        <source>Rename…</source>
        <translation>Cambiar nombre…</translation>
    </message>
    <message>
        <source>Remove…</source>
        <translation>Quitar…</translation>
    </message>
    <message>
        <source>Setting up another</source>
        <translation>Se prepara otro</translation>
    </message>
    <message>
        <source>Allow them</source>
        <translation>Permitirlos</translation>
    </message>
    <message>
        <source>Open without them</source>
        <translation>Abrir sin ellos</translation>
    </message>
    <message>
        <source>Programs of a venue</source>
        <translation>Programas de un lugar</translation>
    </message>
    <message>
        <source>“%1” names programs of its own as projector or camera. They would run on this computer as you, and nobody here has agreed to that yet:</source>
        <translation>«%1» indica programas propios como proyector o cámara. Se ejecutarían en este equipo en su nombre, y aquí nadie ha dado todavía su acuerdo:</translation>
    </message>
    <message>
        <source>None of them was run. Without them everything that was measured can be looked at and shown.</source>
        <translation>No se ha ejecutado ninguno. Sin ellos se puede ver y mostrar todo lo medido.</translation>
    </message>
    <message>
        <source>Allow them if you know what they do, or know who made this venue.</source>
        <translation>Permítalos si sabe qué hacen o quién hizo este lugar.</translation>
    </message>
    <message>
        <source>No other screen is plugged in.</source>
        <translation>No hay otra pantalla conectada.</translation>
    </message>
    <message>
        <source>The same steps, with a simulated projector and camera. Nothing is projected unless you choose a screen.</source>
        <translation>Los mismos pasos, con proyector y cámara simulados. No se proyecta nada, salvo que elija una pantalla.</translation>
    </message>
    <message>
        <source>Programs of this venue</source>
        <translation>Programas de este lugar</translation>
    </message>
    <message>
        <source>Say which commands drive these devices from now on. What was measured stays.</source>
        <translation>Indique qué órdenes manejan estos aparatos a partir de ahora. Lo medido se conserva.</translation>
    </message>
    <message>
        <source>Use these commands</source>
        <translation>Usar estas órdenes</translation>
    </message>
    <message>
        <source>Change the programs</source>
        <translation>Cambiar los programas</translation>
    </message>
    <message>
        <source>Type another command.</source>
        <translation>Escriba otra orden.</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Cámara</translation>
    </message>
    <message>
        <source>A program that fails ends with another status than 0. What it says last is told with it. Try it in a terminal, with a file in place of {image} or {output} and seconds in place of {exposure}.</source>
        <translation>Un programa que falla termina con un estado distinto de 0, y se muestra también lo último que dice. Pruébelo en un terminal, con un archivo en lugar de {image} u {output} y segundos en lugar de {exposure}.</translation>
    </message>
    <message>
        <source>Relucent shows the pictures on it, unless a program of yours does.</source>
        <translation>Relucent muestra en ella las imágenes, salvo que lo haga un programa suyo.</translation>
    </message>
    <message>
        <source>Not needed with a screen. %1</source>
        <translation>No hace falta con una pantalla. %1</translation>
    </message>
    <message>
        <source>Choose the projector&apos;s screen, or type the command that shows.</source>
        <translation>Elija la pantalla del proyector o escriba la orden que muestra.</translation>
    </message>
    <message>
        <source>%1, %2, unplugged</source>
        <translation>%1, %2, desconectada</translation>
    </message>
    <message>
        <source>As many as the chosen screen has.</source>
        <translation>Tantos como tiene la pantalla elegida.</translation>
    </message>
    <message>
        <source>Continue</source>
        <translation>Continuar</translation>
    </message>
    <message>
        <source>A show plays on %1</source>
        <translation>Se reproduce un show en %1</translation>
    </message>
    <message>
        <source>Another program shows it. End it before anything is measured there: Camera has the button.</source>
        <translation>La muestra otro programa. Termínelo antes de medir allí: el botón está en Cámara.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VenueTidy</name>
    <message>
        <source>Try again then.</source>
        <translation>Inténtelo de nuevo después.</translation>
    </message>
    <message>
        <source>%1 is at work. Space can be freed when it has ended.</source>
        <translation>%1 está trabajando. Se podrá liberar espacio cuando termine.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ViewerPlan</name>
    <message>
        <source>Plan of the cameras and of the viewer, seen from above</source>
        <translation>Plano de las cámaras y del espectador, visto desde arriba</translation>
    </message>
    <message>
        <source>Camera %1</source>
        <translation>Cámara %1</translation>
    </message>
    <message>
        <source>Viewer</source>
        <translation>Espectador</translation>
    </message>
    <message>
        <source>%1: %2 m to the left, %3 m from the surface</source>
        <translation>%1: %2 m a la izquierda, a %3 m de la superficie</translation>
    </message>
    <message>
        <source>%1: %2 m to the right, %3 m from the surface</source>
        <translation>%1: %2 m a la derecha, a %3 m de la superficie</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VtkView</name>
    <message>
        <source>This view needs OpenGL 3.2, and this computer draws without it. Everything else works: pictures and maps are shown without depth.</source>
        <translation>Esta vista necesita OpenGL 3.2 y este equipo dibuja sin él. Todo lo demás funciona: imágenes y mapas se muestran sin profundidad.</translation>
    </message>
    <message>
        <source>For this view, install the graphics card&apos;s driver and start Relucent again.</source>
        <translation>Para esta vista, instale el controlador de la tarjeta gráfica y reinicie Relucent.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Wizard</name>
    <message>
        <source>Not applied yet</source>
        <translation>Aún sin aplicar</translation>
    </message>
</context>
<context>
    <name>repair.camera-moved</name>
    <message>
        <source>the view of camera {} has moved by {} and {} pixels and turned by {} degrees</source>
        <translation>la vista de la cámara {} se ha desplazado {} y {} píxeles y ha girado {} grados</translation>
    </message>
</context>
<context>
    <name>repair.light-changed</name>
    <message>
        <source>projector {} gives {} % of the red, {} % of the green and {} % of the blue light that it gave</source>
        <translation>el proyector {} da el {} % de la luz roja, el {} % de la verde y el {} % de la azul que daba</translation>
    </message>
</context>
<context>
    <name>repair.light-elsewhere</name>
    <message>
        <source>in {} % of the cameras&apos; pixels light arrives otherwise than it did</source>
        <translation>en el {} % de los píxeles de las cámaras la luz llega de otro modo que antes</translation>
    </message>
</context>
<context>
    <name>repair.picture-moved</name>
    <message>
        <source>the projected picture has moved by {} and {} pixels as camera {} sees it</source>
        <translation>la imagen proyectada se ha desplazado {} y {} píxeles según la ve la cámara {}</translation>
    </message>
</context>
<context>
    <name>repair.room-brighter</name>
    <message>
        <source>the room is brighter by {} % of the projectors&apos; full light</source>
        <translation>la sala es más clara en un {} % de la luz plena de los proyectores</translation>
    </message>
</context>
<context>
    <name>repair.room-darker</name>
    <message>
        <source>the room is darker by {} % of the projectors&apos; full light</source>
        <translation>la sala es más oscura en un {} % de la luz plena de los proyectores</translation>
    </message>
</context>
<context>
    <name>repair.surface-changed</name>
    <message>
        <source>{} % of what the cameras see is brighter, darker or of another colour than it was</source>
        <translation>el {} % de lo que ven las cámaras es más claro, más oscuro o de otro color que antes</translation>
    </message>
</context>
<context>
    <name>report.cannot-write</name>
    <message>
        <source>the report cannot be written</source>
        <translation>no se puede escribir el informe</translation>
    </message>
</context>
<context>
    <name>report.free-some-space</name>
    <message>
        <source>free some space</source>
        <translation>libere espacio</translation>
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
        <translation>el otro programa no puede terminarse desde aquí</translation>
    </message>
</context>
<context>
    <name>session.close-other-window</name>
    <message>
        <source>go on there, or close it there first</source>
        <translation>continúe allí, o ciérrelo allí primero</translation>
    </message>
</context>
<context>
    <name>session.end-show-itself</name>
    <message>
        <source>hold Esc on the projector&apos;s picture for two seconds</source>
        <translation>mantenga pulsado Esc dos segundos en la imagen del proyector</translation>
    </message>
</context>
<context>
    <name>session.open-in-another-window</name>
    <message>
        <source>this venue is open in another window of Relucent</source>
        <translation>este lugar está abierto en otra ventana de Relucent</translation>
    </message>
</context>
<context>
    <name>sets.choose-name</name>
    <message>
        <source>choose another name, as day or school class</source>
        <translation>elija otro nombre, como día o clase escolar</translation>
    </message>
</context>
<context>
    <name>sets.choose-one</name>
    <message>
        <source>choose one of {}</source>
        <translation>elija una de {}</translation>
    </message>
</context>
<context>
    <name>sets.damaged</name>
    <message>
        <source>the sets of this calibration cannot be read</source>
        <translation>no se pueden leer las variantes de esta calibración</translation>
    </message>
</context>
<context>
    <name>sets.in-use</name>
    <message>
        <source>the set &apos;{}&apos; is in use</source>
        <translation>la variante «{}» está en uso</translation>
    </message>
</context>
<context>
    <name>sets.name-empty</name>
    <message>
        <source>a set needs a name</source>
        <translation>una variante necesita un nombre</translation>
    </message>
</context>
<context>
    <name>sets.name-odd</name>
    <message>
        <source>the name of a set is plain text that neither begins nor ends with a space</source>
        <translation>el nombre de una variante es texto sencillo que no empieza ni termina con un espacio</translation>
    </message>
</context>
<context>
    <name>sets.name-taken</name>
    <message>
        <source>there is a set &apos;{}&apos; already</source>
        <translation>ya hay una variante «{}»</translation>
    </message>
</context>
<context>
    <name>sets.name-too-long</name>
    <message>
        <source>the name of a set has at most {} bytes</source>
        <translation>el nombre de una variante tiene como máximo {} bytes</translation>
    </message>
</context>
<context>
    <name>sets.of-newer-version</name>
    <message>
        <source>a newer Relucent wrote the sets of this calibration</source>
        <translation>un Relucent más reciente escribió las variantes de esta calibración</translation>
    </message>
</context>
<context>
    <name>sets.remove-section</name>
    <message>
        <source>take &quot;sets&quot; out of the settings in {}, or copy the calibration again from where it was made</source>
        <translation>quite «sets» de los ajustes en {}, o copie de nuevo la calibración desde donde se hizo</translation>
    </message>
</context>
<context>
    <name>sets.save-first</name>
    <message>
        <source>this calibration has no sets yet: save one first</source>
        <translation>esta calibración aún no tiene variantes: guarde primero una</translation>
    </message>
</context>
<context>
    <name>sets.unknown</name>
    <message>
        <source>there is no set &apos;{}&apos;</source>
        <translation>no hay ninguna variante «{}»</translation>
    </message>
</context>
<context>
    <name>sets.use-another-first</name>
    <message>
        <source>use another one first</source>
        <translation>use primero otra</translation>
    </message>
</context>
<context>
    <name>show.allow-commands</name>
    <message>
        <source>look at what it does, then open the venue in the wizard and allow its programs</source>
        <translation>mire qué hace, abra luego el lugar en el asistente y permita sus programas</translation>
    </message>
</context>
<context>
    <name>show.cannot-enable-service</name>
    <message>
        <source>the service cannot be switched on ({})</source>
        <translation>no se puede activar el servicio ({})</translation>
    </message>
</context>
<context>
    <name>show.cannot-remove-entry</name>
    <message>
        <source>it cannot be removed ({})</source>
        <translation>no se puede eliminar ({})</translation>
    </message>
</context>
<context>
    <name>show.cannot-write-log</name>
    <message>
        <source>the log cannot be written ({})</source>
        <translation>no se puede escribir el registro ({})</translation>
    </message>
</context>
<context>
    <name>show.check-folder-permissions</name>
    <message>
        <source>check the folder&apos;s permissions</source>
        <translation>revise los permisos de la carpeta</translation>
    </message>
</context>
<context>
    <name>show.choose-another-log-folder</name>
    <message>
        <source>choose another folder with --log</source>
        <translation>elija otra carpeta con --log</translation>
    </message>
</context>
<context>
    <name>show.engine-lost-device</name>
    <message>
        <source>the engine lost its graphics card</source>
        <translation>el motor ha perdido su dispositivo</translation>
    </message>
</context>
<context>
    <name>show.no-camera</name>
    <message>
        <source>this show has no camera: its calibration names none</source>
        <translation>este espectáculo no tiene cámara: su calibración no nombra ninguna</translation>
    </message>
</context>
<context>
    <name>show.no-xwayland</name>
    <message>
        <source>in a Wayland session, take QT_QPA_PLATFORM=xcb out of the environment; else take away the desktop&apos;s rules for windows of Relucent, then try again</source>
        <translation>en una sesión Wayland, quite QT_QPA_PLATFORM=xcb del entorno; si no, quite las reglas del escritorio para las ventanas de Relucent e inténtelo de nuevo</translation>
    </message>
</context>
<context>
    <name>show.projector-by-command</name>
    <message>
        <source>this calibration shows pictures by a command of its own, which does not know of the show: stop the show and use relucent-cli verify and perfect</source>
        <translation>esta calibración muestra imágenes con una orden propia que no sabe del espectáculo: detén el espectáculo y usa relucent-cli verify y perfect</translation>
    </message>
</context>
<context>
    <name>show.restore-resolution</name>
    <message>
        <source>set its resolution back in the desktop&apos;s settings, then try again</source>
        <translation>restablezca su resolución en los ajustes del escritorio e inténtelo de nuevo</translation>
    </message>
</context>
<context>
    <name>show.screen-asleep</name>
    <message>
        <source>the projector&apos;s screen is asleep and does not wake</source>
        <translation>la pantalla del proyector está en reposo y no se activa</translation>
    </message>
</context>
<context>
    <name>show.screen-size-changed</name>
    <message>
        <source>the projector&apos;s screen has {} pixels now and {} were calibrated</source>
        <translation>la pantalla del proyector tiene ahora {} píxeles y se calibraron {}</translation>
    </message>
</context>
<context>
    <name>show.start-show-again</name>
    <message>
        <source>start the show again</source>
        <translation>inicie el show de nuevo</translation>
    </message>
</context>
<context>
    <name>show.switch-off-power-saving</name>
    <message>
        <source>switch off its power saving and the screen saver in the desktop&apos;s settings, then try again</source>
        <translation>desactive su ahorro de energía y el salvapantallas en los ajustes del escritorio e inténtelo de nuevo</translation>
    </message>
</context>
<context>
    <name>show.window-elsewhere</name>
    <message>
        <source>the desktop puts the projector&apos;s picture on the screen {} instead</source>
        <translation>el escritorio pone la imagen del proyector en la pantalla {} en su lugar</translation>
    </message>
</context>
<context>
    <name>stage.adapting-light-transport</name>
    <message>
        <source>fitting the light transport to what is seen</source>
        <translation>ajustando el transporte de luz a lo que se ve</translation>
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
        <translation>Componiendo el transporte de luz</translation>
    </message>
</context>
<context>
    <name>stage.awaiting-steady-light</name>
    <message>
        <source>Waiting until the lamps are steady</source>
        <translation>Esperando a que las lámparas sean estables</translation>
    </message>
</context>
<context>
    <name>stage.black-and-full-light</name>
    <message>
        <source>black and full light</source>
        <translation>negro y luz plena</translation>
    </message>
</context>
<context>
    <name>stage.calibrating</name>
    <message>
        <source>Calibrating</source>
        <translation>Calibrando</translation>
    </message>
</context>
<context>
    <name>stage.capped-clusters</name>
    <message>
        <source>Clusters held to a size</source>
        <translation>Clústeres de tamaño limitado</translation>
    </message>
</context>
<context>
    <name>stage.capping-clusters</name>
    <message>
        <source>Holding clusters to a size</source>
        <translation>Limitando el tamaño de clústeres</translation>
    </message>
</context>
<context>
    <name>stage.checking-additivity</name>
    <message>
        <source>Checking that the colours of {} add up</source>
        <translation>Comprobando la suma de colores: {}</translation>
    </message>
</context>
<context>
    <name>stage.checking-drift</name>
    <message>
        <source>Checking for drift</source>
        <translation>Comprobando la deriva</translation>
    </message>
</context>
<context>
    <name>stage.checking-projector-and-camera</name>
    <message>
        <source>Checking projector and camera</source>
        <translation>Comprobando proyector y cámara</translation>
    </message>
</context>
<context>
    <name>stage.choosing-camera-pixels</name>
    <message>
        <source>Finding the camera pixels that are needed</source>
        <translation>Buscando los píxeles de cámara necesarios</translation>
    </message>
</context>
<context>
    <name>stage.clustering-light-transport</name>
    <message>
        <source>Clustering the light transport</source>
        <translation>Agrupando el transporte de luz</translation>
    </message>
</context>
<context>
    <name>stage.comparing-cluster-inverses-in-venue</name>
    <message>
        <source>Comparing the inverses of clusters in {}</source>
        <translation>Comparando inversas de clústeres: {}</translation>
    </message>
</context>
<context>
    <name>stage.comparing-methods</name>
    <message>
        <source>Comparing the methods</source>
        <translation>Comparando los métodos</translation>
    </message>
</context>
<context>
    <name>stage.comparing-methods-in-venue</name>
    <message>
        <source>Comparing the methods in {}</source>
        <translation>Comparando los métodos: {}</translation>
    </message>
</context>
<context>
    <name>stage.comparing-views</name>
    <message>
        <source>Comparing what the views want</source>
        <translation>Comparando lo que pide cada vista</translation>
    </message>
</context>
<context>
    <name>stage.compensating</name>
    <message>
        <source>Compensating</source>
        <translation>Compensando</translation>
    </message>
</context>
<context>
    <name>stage.concluding-measurement</name>
    <message>
        <source>what may be expected of the result</source>
        <translation>lo que cabe esperar del resultado</translation>
    </message>
</context>
<context>
    <name>stage.decoding</name>
    <message>
        <source>Decoding</source>
        <translation>Decodificando</translation>
    </message>
</context>
<context>
    <name>stage.dense-patterns</name>
    <message>
        <source>patterns in blocks of {} px</source>
        <translation>patrones en bloques de {} px</translation>
    </message>
</context>
<context>
    <name>stage.estimating-light-transport</name>
    <message>
        <source>Estimating the light transport</source>
        <translation>Estimando el transporte de luz</translation>
    </message>
</context>
<context>
    <name>stage.estimating-response-and-colours</name>
    <message>
        <source>Estimating response and colours</source>
        <translation>Estimando respuesta y colores</translation>
    </message>
</context>
<context>
    <name>stage.evaluating</name>
    <message>
        <source>Evaluating</source>
        <translation>Evaluando</translation>
    </message>
</context>
<context>
    <name>stage.finding-defocus</name>
    <message>
        <source>Finding the defocus</source>
        <translation>Determinando el desenfoque</translation>
    </message>
</context>
<context>
    <name>stage.finding-exposure</name>
    <message>
        <source>Finding the exposure</source>
        <translation>Determinando la exposición</translation>
    </message>
</context>
<context>
    <name>stage.finding-exposures</name>
    <message>
        <source>Finding the exposures</source>
        <translation>Determinando las exposiciones</translation>
    </message>
</context>
<context>
    <name>stage.finding-projector-picture</name>
    <message>
        <source>Looking for the projector&apos;s picture</source>
        <translation>Buscando la imagen del proyector</translation>
    </message>
</context>
<context>
    <name>stage.finding-shadows</name>
    <message>
        <source>Looking for shadows</source>
        <translation>Buscando sombras</translation>
    </message>
</context>
<context>
    <name>stage.finding-uncorrectable-pixels</name>
    <message>
        <source>Looking for what cannot be corrected</source>
        <translation>Buscando lo que no se puede corregir</translation>
    </message>
</context>
<context>
    <name>stage.finding-what-is-seen</name>
    <message>
        <source>Finding which part of the picture is seen</source>
        <translation>Buscando qué parte de la imagen se ve</translation>
    </message>
</context>
<context>
    <name>stage.fitting-light-spread</name>
    <message>
        <source>Fitting the spread of light</source>
        <translation>Ajustando la dispersión de la luz</translation>
    </message>
</context>
<context>
    <name>stage.forming-patches</name>
    <message>
        <source>Forming patches</source>
        <translation>Formando parches</translation>
    </message>
</context>
<context>
    <name>stage.inverting-clusters</name>
    <message>
        <source>Inverting the clusters</source>
        <translation>Invirtiendo los clústeres</translation>
    </message>
</context>
<context>
    <name>stage.inverting-light-transport</name>
    <message>
        <source>Inverting the light transport</source>
        <translation>Invirtiendo el transporte de luz</translation>
    </message>
</context>
<context>
    <name>stage.inverting-venue</name>
    <message>
        <source>Inverting {}</source>
        <translation>Invirtiendo: {}</translation>
    </message>
</context>
<context>
    <name>stage.joining-clusters</name>
    <message>
        <source>Joining clusters</source>
        <translation>Uniendo clústeres</translation>
    </message>
</context>
<context>
    <name>stage.judging-light</name>
    <message>
        <source>Judging the light</source>
        <translation>Evaluando la luz</translation>
    </message>
</context>
<context>
    <name>stage.level-of-tree</name>
    <message numerus="yes">
        <source>level {} of {}: {} patterns</source>
        <comment>level {} of {}: {} pattern</comment>
        <translation>
            <numerusform>nivel {} de {}: {} patrón</numerusform>
            <numerusform>nivel {} de {}: {} patrones</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>stage.light-transport</name>
    <message>
        <source>light transport</source>
        <translation>transporte de luz</translation>
    </message>
</context>
<context>
    <name>stage.linearizing</name>
    <message>
        <source>Linearizing</source>
        <translation>Linealizando</translation>
    </message>
</context>
<context>
    <name>stage.looking-for-changes</name>
    <message>
        <source>Looking for what has changed</source>
        <translation>Buscando lo que ha cambiado</translation>
    </message>
</context>
<context>
    <name>stage.looking-for-hot-pixels</name>
    <message>
        <source>Looking for hot pixels of the camera</source>
        <translation>Buscando píxeles calientes de la cámara</translation>
    </message>
</context>
<context>
    <name>stage.looking-through-camera</name>
    <message>
        <source>Looking through the camera</source>
        <translation>Mirando por la cámara</translation>
    </message>
</context>
<context>
    <name>stage.measuring-brightness-curves</name>
    <message>
        <source>Measuring the brightness curves of {}</source>
        <translation>Midiendo las curvas de brillo: {}</translation>
    </message>
</context>
<context>
    <name>stage.measuring-camera</name>
    <message>
        <source>Measuring the camera</source>
        <translation>Midiendo la cámara</translation>
    </message>
</context>
<context>
    <name>stage.measuring-latency</name>
    <message>
        <source>Measuring the latency</source>
        <translation>Midiendo la latencia</translation>
    </message>
</context>
<context>
    <name>stage.measuring-light-transport</name>
    <message>
        <source>Measuring the light transport</source>
        <translation>Midiendo el transporte de luz</translation>
    </message>
</context>
<context>
    <name>stage.measuring-response</name>
    <message>
        <source>Measuring the response</source>
        <translation>Midiendo la respuesta</translation>
    </message>
</context>
<context>
    <name>stage.measuring-venue</name>
    <message>
        <source>Measuring {}</source>
        <translation>Midiendo: {}</translation>
    </message>
</context>
<context>
    <name>stage.measuring-what-changed</name>
    <message>
        <source>measuring what is no longer as it was</source>
        <translation>midiendo lo que ya no es como era</translation>
    </message>
</context>
<context>
    <name>stage.opening-devices</name>
    <message>
        <source>Opening the devices</source>
        <translation>Abriendo los dispositivos</translation>
    </message>
</context>
<context>
    <name>stage.perfecting</name>
    <message>
        <source>Correcting the picture by photographs of itself</source>
        <translation>Corrigiendo la imagen con fotografías de sí misma</translation>
    </message>
</context>
<context>
    <name>stage.photographing-projections</name>
    <message>
        <source>Photographing the projections</source>
        <translation>Fotografiando las proyecciones</translation>
    </message>
</context>
<context>
    <name>stage.photographing-test-patterns</name>
    <message>
        <source>Photographing test patterns</source>
        <translation>Fotografiando los patrones de prueba</translation>
    </message>
</context>
<context>
    <name>stage.predicting-held-out-patterns</name>
    <message>
        <source>Predicting held-out patterns</source>
        <translation>Prediciendo los patrones reservados</translation>
    </message>
</context>
<context>
    <name>stage.preparing-benchmarks</name>
    <message>
        <source>Preparing the benchmarks</source>
        <translation>Preparando las pruebas de rendimiento</translation>
    </message>
</context>
<context>
    <name>stage.preparing-devices</name>
    <message>
        <source>Preparing the devices</source>
        <translation>Preparando los dispositivos</translation>
    </message>
</context>
<context>
    <name>stage.preparing-engine</name>
    <message>
        <source>Preparing the engine</source>
        <translation>Preparando el motor</translation>
    </message>
</context>
<context>
    <name>stage.preparing-preview</name>
    <message>
        <source>Preparing the preview</source>
        <translation>Preparando la vista previa</translation>
    </message>
</context>
<context>
    <name>stage.preparing-venue</name>
    <message>
        <source>Preparing the venue</source>
        <translation>Preparando el lugar</translation>
    </message>
</context>
<context>
    <name>stage.reading-calibration</name>
    <message>
        <source>Reading the calibration</source>
        <translation>Leyendo la calibración</translation>
    </message>
</context>
<context>
    <name>stage.reading-light-transport</name>
    <message>
        <source>Reading the light transport</source>
        <translation>Leyendo el transporte de luz</translation>
    </message>
</context>
<context>
    <name>stage.reading-patterns</name>
    <message>
        <source>Reading the patterns</source>
        <translation>Leyendo los patrones</translation>
    </message>
</context>
<context>
    <name>stage.reading-photographs</name>
    <message>
        <source>Reading the photographs</source>
        <translation>Leyendo las fotografías</translation>
    </message>
</context>
<context>
    <name>stage.reading-pictures</name>
    <message>
        <source>Reading the pictures</source>
        <translation>Leyendo las imágenes</translation>
    </message>
</context>
<context>
    <name>stage.reading-response</name>
    <message>
        <source>Reading the response</source>
        <translation>Leyendo la respuesta</translation>
    </message>
</context>
<context>
    <name>stage.reading-venue</name>
    <message>
        <source>Reading {}</source>
        <translation>Leyendo: {}</translation>
    </message>
</context>
<context>
    <name>stage.remeasuring-flagged-pixels</name>
    <message numerus="yes">
        <source>measuring {} flagged pixels again</source>
        <comment>measuring {} flagged pixel again</comment>
        <translation>
            <numerusform>midiendo de nuevo {} píxel marcado</numerusform>
            <numerusform>midiendo de nuevo {} píxeles marcados</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>stage.scaling-to-flood-image</name>
    <message>
        <source>Scaling to the flood image</source>
        <translation>Escalando a la imagen de luz plena</translation>
    </message>
</context>
<context>
    <name>stage.separating-direct-and-indirect-light</name>
    <message>
        <source>Separating direct and indirect light</source>
        <translation>Separando luz directa e indirecta</translation>
    </message>
</context>
<context>
    <name>stage.sharing-leaves</name>
    <message>
        <source>light that neighbouring pixels share</source>
        <translation>luz que comparten los píxeles vecinos</translation>
    </message>
</context>
<context>
    <name>stage.sharpening</name>
    <message>
        <source>Sharpening</source>
        <translation>Aplicando nitidez</translation>
    </message>
</context>
<context>
    <name>stage.solving</name>
    <message>
        <source>Solving</source>
        <translation>Resolviendo</translation>
    </message>
</context>
<context>
    <name>stage.storing-light-transport</name>
    <message>
        <source>storing the light transport</source>
        <translation>guardado del transporte de luz</translation>
    </message>
</context>
<context>
    <name>stage.switching-projectors-on</name>
    <message>
        <source>Switching the projectors on</source>
        <translation>Encendiendo los proyectores</translation>
    </message>
</context>
<context>
    <name>stage.taking-verification-photograph</name>
    <message>
        <source>Taking the verification photograph</source>
        <translation>Tomando la fotografía de verificación</translation>
    </message>
</context>
<context>
    <name>stage.test-patterns</name>
    <message>
        <source>test patterns</source>
        <translation>patrones de prueba</translation>
    </message>
</context>
<context>
    <name>stage.timing-engine</name>
    <message>
        <source>Timing the engine</source>
        <translation>Cronometrando el motor</translation>
    </message>
</context>
<context>
    <name>stage.tracing-simulated-venue</name>
    <message>
        <source>tracing the simulated venue</source>
        <translation>trazando la luz del lugar simulado</translation>
    </message>
</context>
<context>
    <name>stage.windows</name>
    <message>
        <source>Computing the windows of the inverse</source>
        <translation>Ventanas</translation>
    </message>
</context>
<context>
    <name>stage.working-out-finest-blocks</name>
    <message>
        <source>working out the finest blocks</source>
        <translation>cálculo de los bloques más finos</translation>
    </message>
</context>
<context>
    <name>stage.writing</name>
    <message>
        <source>Writing</source>
        <translation>Escribiendo</translation>
    </message>
</context>
<context>
    <name>stage.writing-out-light-transport</name>
    <message>
        <source>Writing out the light transport</source>
        <translation>Escribiendo el transporte de luz</translation>
    </message>
</context>
<context>
    <name>stage.writing-report</name>
    <message>
        <source>Writing the report</source>
        <translation>Escribiendo el informe</translation>
    </message>
</context>
<context>
    <name>stage.writing-results</name>
    <message>
        <source>Writing the results</source>
        <translation>Escribiendo los resultados</translation>
    </message>
</context>
<context>
    <name>stream.address-incomplete</name>
    <message>
        <source>in a stream&apos;s address the host or its port is missing or wrong</source>
        <translation>en la dirección de la transmisión falta el host o su puerto, o es incorrecto</translation>
    </message>
</context>
<context>
    <name>stream.check-host</name>
    <message>
        <source>check the name in the address, or write the number</source>
        <translation>revise el nombre en la dirección o escriba el número</translation>
    </message>
</context>
<context>
    <name>stream.check-network</name>
    <message>
        <source>check the network and the address</source>
        <translation>revise la red y la dirección</translation>
    </message>
</context>
<context>
    <name>stream.check-path</name>
    <message>
        <source>check what stands behind the host in the address</source>
        <translation>revise lo que sigue al host en la dirección</translation>
    </message>
</context>
<context>
    <name>stream.check-sender</name>
    <message>
        <source>check the sender, the network, and the address</source>
        <translation>revise el emisor, la red y la dirección</translation>
    </message>
</context>
<context>
    <name>stream.end-other</name>
    <message>
        <source>end that program, or send to another port</source>
        <translation>cierre ese programa o envíe a otro puerto</translation>
    </message>
</context>
<context>
    <name>stream.ended</name>
    <message>
        <source>it has ended</source>
        <translation>ha terminado</translation>
    </message>
</context>
<context>
    <name>stream.host-unknown</name>
    <message>
        <source>its host is not found</source>
        <translation>no se encuentra su host</translation>
    </message>
</context>
<context>
    <name>stream.list-once</name>
    <message>
        <source>put it into the playlist once</source>
        <translation>póngalo una sola vez en la lista de reproducción</translation>
    </message>
</context>
<context>
    <name>stream.no-memory</name>
    <message>
        <source>there is not enough memory for its pictures</source>
        <translation>no hay memoria suficiente para sus imágenes</translation>
    </message>
</context>
<context>
    <name>stream.no-such-path</name>
    <message>
        <source>there is nothing at its path</source>
        <translation>no hay nada en su ruta</translation>
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
        <translation>aún no ha dado ninguna imagen</translation>
    </message>
</context>
<context>
    <name>stream.open-already</name>
    <message>
        <source>this program plays it already</source>
        <translation>este programa ya lo reproduce</translation>
    </message>
</context>
<context>
    <name>stream.port-in-use</name>
    <message>
        <source>another program receives at its port</source>
        <translation>otro programa recibe en su puerto</translation>
    </message>
</context>
<context>
    <name>stream.refused</name>
    <message>
        <source>the connection was refused</source>
        <translation>la conexión fue rechazada</translation>
    </message>
</context>
<context>
    <name>stream.send-h264</name>
    <message>
        <source>let it be sent as H.264 or Motion JPEG</source>
        <translation>haga que se envíe como H.264 o Motion JPEG</translation>
    </message>
</context>
<context>
    <name>stream.silent</name>
    <message>
        <source>no picture came within {} s</source>
        <translation>no llegó ninguna imagen en {} s</translation>
    </message>
</context>
<context>
    <name>stream.stalled</name>
    <message>
        <source>no picture has come for {} s</source>
        <translation>no ha llegado ninguna imagen desde hace {} s</translation>
    </message>
</context>
<context>
    <name>stream.start-sender</name>
    <message>
        <source>start the sender, and check the port</source>
        <translation>inicie el emisor y revise el puerto</translation>
    </message>
</context>
<context>
    <name>stream.start-sender-again</name>
    <message>
        <source>start the sender again</source>
        <translation>inicie de nuevo el emisor</translation>
    </message>
</context>
<context>
    <name>stream.unknown-hold</name>
    <message>
        <source>the stream&apos;s address ends in an unknown choice</source>
        <translation>la dirección de la transmisión termina en una opción desconocida</translation>
    </message>
</context>
<context>
    <name>stream.unknown-scheme</name>
    <message>
        <source>this is no address of a stream</source>
        <translation>esto no es una dirección de transmisión</translation>
    </message>
</context>
<context>
    <name>stream.unreachable</name>
    <message>
        <source>its host cannot be reached</source>
        <translation>no se puede llegar a su host</translation>
    </message>
</context>
<context>
    <name>stream.unreadable</name>
    <message>
        <source>it cannot be read ({})</source>
        <translation>no se puede leer ({})</translation>
    </message>
</context>
<context>
    <name>stream.unusable</name>
    <message>
        <source>what comes is no video that can be shown</source>
        <translation>lo que llega no es un vídeo que se pueda mostrar</translation>
    </message>
</context>
<context>
    <name>stream.wants-password</name>
    <message>
        <source>it wants another user name and password</source>
        <translation>pide otro nombre de usuario y otra contraseña</translation>
    </message>
</context>
<context>
    <name>stream.write-address</name>
    <message>
        <source>write it like {}, and in user names and passwords % and two digits for signs like @, : and /</source>
        <translation>escríbala como {}, y en nombres de usuario y contraseñas % y dos cifras para signos como @, : y /</translation>
    </message>
</context>
<context>
    <name>stream.write-hold</name>
    <message>
        <source>write #hold=last or #hold=black</source>
        <translation>escriba #hold=last o #hold=black</translation>
    </message>
</context>
<context>
    <name>stream.write-password</name>
    <message>
        <source>write them into the address before the host: {}</source>
        <translation>escríbalos en la dirección antes del host: {}</translation>
    </message>
</context>
<context>
    <name>stream.write-scheme</name>
    <message>
        <source>let it begin with one of {}</source>
        <translation>haga que empiece por uno de estos: {}</translation>
    </message>
</context>
<context>
    <name>venue.cannot-open-folder</name>
    <message>
        <source>the folder cannot be opened ({})</source>
        <translation>la carpeta no se puede abrir ({})</translation>
    </message>
</context>
<context>
    <name>venue.cannot-rename</name>
    <message>
        <source>the folder cannot be renamed ({})</source>
        <translation>no se puede cambiar el nombre de la carpeta ({})</translation>
    </message>
</context>
<context>
    <name>venue.no-trash</name>
    <message>
        <source>it cannot be moved to the trash</source>
        <translation>no se puede llevar a la papelera</translation>
    </message>
</context>
<context>
    <name>venue.remove-folder-yourself</name>
    <message>
        <source>this disk may have none: remove the folder with the file manager</source>
        <translation>puede que este disco no tenga ninguna: quite la carpeta con el gestor de archivos</translation>
    </message>
</context>
<context>
    <name>venue.used-by-another</name>
    <message>
        <source>another program is working on this venue</source>
        <translation>otro programa está trabajando en este lugar</translation>
    </message>
</context>
<context>
    <name>venue.wait-for-another</name>
    <message>
        <source>wait until it has finished, or close it, then try again</source>
        <translation>espere a que termine o ciérrelo, e inténtelo de nuevo</translation>
    </message>
</context>
<context>
    <name>view.cannot-write-picture</name>
    <message>
        <source>the picture could not be written</source>
        <translation>no se ha podido escribir la imagen</translation>
    </message>
</context>
<context>
    <name>view.choose-writable-folder</name>
    <message>
        <source>choose a folder that you may write to, with free space</source>
        <translation>elija una carpeta en la que pueda escribir y con espacio libre</translation>
    </message>
</context>
<context>
    <name>wizard.allow-commands</name>
    <message>
        <source>open the venue anew and allow its programs</source>
        <translation>abra de nuevo el lugar y permita sus programas</translation>
    </message>
</context>
</TS>
