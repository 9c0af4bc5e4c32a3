<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="ar">
<context>
    <name>About</name>
    <message>
        <source>About Relucent</source>
        <translation>حول Relucent</translation>
    </message>
    <message>
        <source>Version %1, with these libraries: %2.</source>
        <translation>الإصدار ⁨%1⁩، مع هذه المكتبات: ⁨%2⁩.</translation>
    </message>
</context>
<context>
    <name>ContentFiles</name>
    <message>
        <source>Pictures and films</source>
        <translation>صور وأفلام</translation>
    </message>
    <message>
        <source>Pictures</source>
        <translation>صور</translation>
    </message>
    <message>
        <source>All files</source>
        <translation>كل الملفات</translation>
    </message>
</context>
<context>
    <name>DeviceLabel</name>
    <message>
        <source>Projector %1</source>
        <translation>جهاز العرض %1</translation>
    </message>
    <message>
        <source>Camera %1</source>
        <translation>الكاميرا %1</translation>
    </message>
</context>
<context>
    <name>EndQuestion</name>
    <message>
        <source>A measurement is under way</source>
        <translation>هناك قياس جارٍ</translation>
    </message>
    <message>
        <source>%1 in the venue “%2”.</source>
        <translation>⁨%1⁩ في الموقع «⁨%2⁩».</translation>
    </message>
    <message>
        <source>Every photograph is on the disk. Opened again, the venue goes on from there.</source>
        <translation>كل اللقطات على القرص. عند فتح الموقع من جديد يُتابَع العمل من هناك.</translation>
    </message>
    <message>
        <source>End it for now</source>
        <translation>إنهاؤه الآن</translation>
    </message>
    <message>
        <source>Go on measuring</source>
        <translation>متابعة القياس</translation>
    </message>
    <message>
        <source>The show of the venue “%1”: the projector&apos;s screen goes dark.</source>
        <translation>عرض الموقع «⁨%1⁩»: تُظلم شاشة جهاز العرض.</translation>
    </message>
    <message>
        <source>Playlist and results are on the disk. Open the output again to play the show again.</source>
        <translation>قائمة التشغيل والنتائج على القرص. افتح الإخراج من جديد لتشغيل العرض مرة أخرى.</translation>
    </message>
    <message>
        <source>A measurement and a show are under way</source>
        <translation>هناك قياس وعرض جاريان</translation>
    </message>
    <message>
        <source>End both</source>
        <translation>إنهاء كليهما</translation>
    </message>
    <message>
        <source>Let both go on</source>
        <translation>متابعة كليهما</translation>
    </message>
    <message>
        <source>A show is playing</source>
        <translation>هناك عرض قيد التشغيل</translation>
    </message>
    <message>
        <source>End the show</source>
        <translation>إنهاء العرض</translation>
    </message>
    <message>
        <source>Go on playing</source>
        <translation>متابعة التشغيل</translation>
    </message>
    <message>
        <source>The show of the venue “%1”.</source>
        <translation>عرض الموقع «%1».</translation>
    </message>
</context>
<context>
    <name>Failure</name>
    <message>
        <source>The computer has no memory left.</source>
        <translation>نفدت ذاكرة الحاسوب.</translation>
    </message>
    <message>
        <source>Close other programs, or choose fewer pixels.</source>
        <translation>أغلق البرامج الأخرى، أو اختر عدد بكسلات أقل.</translation>
    </message>
    <message>
        <source>Relucent made a mistake.</source>
        <translation>وقع Relucent في خطأ.</translation>
    </message>
    <message>
        <source>What is saved is safe. Copy the details for whoever looks after the program, then try again.</source>
        <translation>كل ما حُفظ آمن. انسخ التفاصيل لمن يعتني بالبرنامج، ثم حاول مجددًا.</translation>
    </message>
    <message>
        <source>What is saved is safe. Try again.</source>
        <translation>كل ما حُفظ آمن. حاول مجددًا.</translation>
    </message>
    <message>
        <source>The camera does not see this projector</source>
        <translation>الكاميرا لا ترى جهاز العرض هذا</translation>
    </message>
    <message>
        <source>A program of this venue failed</source>
        <translation>أخفق أحد برامج هذا الموقع</translation>
    </message>
    <message>
        <source>Another command is typed at the step Venue, by “Change the programs”.</source>
        <translation>يُكتب أمر آخر في خطوة «الموقع»، عبر «غيّر البرامج».</translation>
    </message>
</context>
<context>
    <name>FullDisk</name>
    <message>
        <source>The disk is full. Measuring has paused.</source>
        <translation>القرص ممتلئ. توقف القياس مؤقتًا.</translation>
    </message>
    <message>
        <source>Every photograph is safe. %1 are free, %2 are needed: then measuring goes on by itself.</source>
        <translation>كل اللقطات آمنة. المتاح ⁨%1⁩ والمطلوب ⁨%2⁩، وعندها يتابع القياس تلقائيًا.</translation>
    </message>
</context>
<context>
    <name>LostDevice</name>
    <message>
        <source>The projector&apos;s screen is unplugged</source>
        <translation>شاشة جهاز العرض غير موصولة</translation>
    </message>
    <message>
        <source>Everything so far is safe. Plug it in again: it goes on by itself.</source>
        <translation>كل ما سبق آمن. أعد توصيلها، فيُتابَع العمل تلقائيًا.</translation>
    </message>
    <message>
        <source>Everything so far is safe. Push in its cable at both ends, and do not move the tripod: it goes on by itself.</source>
        <translation>كل ما سبق آمن. ثبّت الكابل من طرفيه ولا تحرّك الحامل: يُتابَع العمل تلقائيًا.</translation>
    </message>
    <message>
        <source>The camera does not answer</source>
        <translation>الكاميرا لا تستجيب</translation>
    </message>
    <message>
        <source>Screen unplugged</source>
        <translation>الشاشة مفصولة</translation>
    </message>
    <message>
        <source>Camera silent</source>
        <translation>الكاميرا صامتة</translation>
    </message>
    <message>
        <source>%1: its screen is unplugged</source>
        <extracomment>%1 is a projector: its name, or &quot;Projector 2&quot;</extracomment>
        <translation>%1: شاشته غير موصولة</translation>
    </message>
    <message>
        <source>%1 does not answer</source>
        <extracomment>%1 is a camera: its name, or &quot;Camera 2&quot;</extracomment>
        <translation>%1 لا تستجيب</translation>
    </message>
    <message>
        <source>Everything so far is safe. Plug it in again, then resume.</source>
        <translation>كل ما سبق آمن. أعد توصيلها، ثم استأنف.</translation>
    </message>
    <message>
        <source>Everything so far is safe. Push in its cable at both ends, and do not move the tripod, then resume.</source>
        <translation>كل ما سبق آمن. ثبّت الكابل من طرفيه ولا تحرّك الحامل، ثم استأنف.</translation>
    </message>
</context>
<context>
    <name>Method</name>
    <message>
        <source>Each pixel&apos;s brightness</source>
        <translation>سطوع كل بكسل</translation>
    </message>
    <message>
        <source>Each pixel on its own</source>
        <translation>كل بكسل على حدة</translation>
    </message>
    <message>
        <source>Each pixel, sharpened</source>
        <translation>كل بكسل، بحدّة أعلى</translation>
    </message>
    <message>
        <source>Clusters</source>
        <translation>التجمّعات</translation>
    </message>
    <message>
        <source>Windows</source>
        <translation>النوافذ</translation>
    </message>
    <message>
        <source>All bounces, for films</source>
        <translation>كل الانعكاسات، للأفلام</translation>
    </message>
    <message>
        <source>Uncorrected</source>
        <translation>دون تصحيح</translation>
    </message>
    <message>
        <source>All bounces, solved, for stills</source>
        <translation>حلّ كامل، صور ثابتة</translation>
    </message>
</context>
<context>
    <name>NumberText</name>
    <message>
        <source>%1 million</source>
        <translation>%1 مليون</translation>
    </message>
    <message>
        <source>%1 billion</source>
        <translation>%1 مليار</translation>
    </message>
</context>
<context>
    <name>Overlay</name>
    <message>
        <source>%1 frames a second, %2 ms a frame, %3 of %4 late</source>
        <translation>%1 إطار/ث، ⁨%2 ms⁩ للإطار، تأخّر %3 من %4</translation>
    </message>
    <message>
        <source>not compensated</source>
        <translation>دون تعويض</translation>
    </message>
    <message>
        <source>frozen</source>
        <translation>مجمّد</translation>
    </message>
    <message>
        <source>test chart: %1</source>
        <translation>لوحة اختبار: ⁨%1⁩</translation>
    </message>
    <message numerus="yes">
        <source>compensated, %n step(s), %1 % out of reach</source>
        <translation>
            <numerusform>مع تعويض، دون خطوات، خارج المدى: ⁨%1 %⁩</numerusform>
            <numerusform>مع تعويض، خطوة واحدة، خارج المدى: ⁨%1 %⁩</numerusform>
            <numerusform>مع تعويض، خطوتان، خارج المدى: ⁨%1 %⁩</numerusform>
            <numerusform>مع تعويض، %n خطوات، خارج المدى: ⁨%1 %⁩</numerusform>
            <numerusform>مع تعويض، %n خطوة، خارج المدى: ⁨%1 %⁩</numerusform>
            <numerusform>مع تعويض، %n خطوة، خارج المدى: ⁨%1 %⁩</numerusform>
        </translation>
    </message>
    <message>
        <source>still picture</source>
        <translation>صورة ثابتة</translation>
    </message>
    <message>
        <source>follows a viewer within %1 ms</source>
        <translation>يتبع المشاهد خلال %1 مللي ثانية</translation>
    </message>
    <message>
        <source>perfected by photographs</source>
        <translation>حُسِّنت بالصور</translation>
    </message>
    <message>
        <source>live picture within %1 ms of its arrival</source>
        <translation>الصورة الحية خلال %1 مللي ثانية من وصولها</translation>
    </message>
</context>
<context>
    <name>RecentVenues</name>
    <message>
        <source>Nothing measured yet</source>
        <translation>لم يُقَس شيء بعد</translation>
    </message>
    <message>
        <source>Acquire is next</source>
        <translation>التالي: القياس</translation>
    </message>
    <message>
        <source>Ready to play</source>
        <translation>جاهز للتشغيل</translation>
    </message>
    <message>
        <source>Preview out of date</source>
        <translation>المعاينة بحاجة إلى تحديث</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>تم القياس</translation>
    </message>
    <message numerus="yes">
        <source>Interrupted: %n pattern(s) are safe</source>
        <translation>
            <numerusform>انقطع القياس: لا أنماط محفوظة</numerusform>
            <numerusform>انقطع القياس: نمط واحد محفوظ</numerusform>
            <numerusform>انقطع القياس: نمطان محفوظان</numerusform>
            <numerusform>انقطع القياس: %n أنماط محفوظة</numerusform>
            <numerusform>انقطع القياس: %n نمطًا محفوظًا</numerusform>
            <numerusform>انقطع القياس: %n نمط محفوظ</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Measured; %n newer pattern(s) are safe</source>
        <translation>
            <numerusform>تم القياس؛ لا أنماط أحدث</numerusform>
            <numerusform>تم القياس؛ نمط أحدث واحد محفوظ</numerusform>
            <numerusform>تم القياس؛ نمطان أحدث محفوظان</numerusform>
            <numerusform>تم القياس؛ %n أنماط أحدث محفوظة</numerusform>
            <numerusform>تم القياس؛ %n نمطًا أحدث محفوظًا</numerusform>
            <numerusform>تم القياس؛ %n نمط أحدث محفوظ</numerusform>
        </translation>
    </message>
    <message>
        <source>Ended by a change</source>
        <translation>أنهاه تغيّر</translation>
    </message>
    <message>
        <source>Stopped at blocks of %1 px</source>
        <translation>أُوقف عند كتل من ⁨%1 px⁩</translation>
    </message>
    <message>
        <source>Stopped at %1 px; newer patterns: %2</source>
        <translation>أُوقف عند ⁨%1 px⁩؛ أنماط أحدث: %2</translation>
    </message>
    <message>
        <source>A show plays</source>
        <translation>عرض قيد التشغيل</translation>
    </message>
</context>
<context>
    <name>ScreenChoice</name>
    <message>
        <source>This computer</source>
        <translation>هذا الحاسوب</translation>
    </message>
    <message>
        <source>%1, %2 × %3, %4 Hz</source>
        <translation>⁨%1⁩، ⁨%2 × %3⁩، ⁨%4 Hz⁩</translation>
    </message>
    <message>
        <source>There is no other screen: the patterns cover this window while they are shown. Plug the projector in, and switch the desktop to extended screens, to keep both apart.</source>
        <translation>لا توجد شاشة أخرى: تغطي الأنماط هذه النافذة أثناء عرضها. صِل جهاز العرض، واضبط سطح المكتب على الشاشات الموسّعة، للفصل بينهما.</translation>
    </message>
    <message>
        <source>This is the screen that you work on. Choose the projector&apos;s.</source>
        <translation>هذه هي الشاشة التي تعمل عليها. اختر شاشة جهاز العرض.</translation>
    </message>
    <message>
        <source>The projector was measured with %1 pixels. Set this screen to that size.</source>
        <translation>قيس جهاز العرض بحجم %1 بكسل. اضبط هذه الشاشة على ذلك الحجم.</translation>
    </message>
    <message>
        <source>This is another projector than the one that was measured. Its light and its place differ: take a verification photograph, and measure again where that does not look as predicted.</source>
        <translation>هذا جهاز عرض غير الذي قيس، وضوؤه ومكانه مختلفان: التقط لقطة تحقق، وأعد القياس إن لم تبدُ كما هو متوقع.</translation>
    </message>
    <message>
        <source>Measured at %1, used at %2. If it is the same projector in the same place, everything that was measured holds; a verification photograph tells.</source>
        <translation>قيس على %1 ويُستخدم على %2. إن كان جهاز العرض نفسه في المكان نفسه فكل ما قيس باقٍ؛ ولقطة التحقق تبيّن ذلك.</translation>
    </message>
</context>
<context>
    <name>StoppedEarly</name>
    <message>
        <source>Measuring was stopped at blocks of %1 px</source>
        <translation>أُوقف القياس عند كتل من ⁨%1 px⁩</translation>
    </message>
    <message>
        <source>All that follows is as coarse. Go on measuring any time.</source>
        <translation>كل ما يلي خشن بالقدر نفسه. تابع القياس في أي وقت.</translation>
    </message>
    <message>
        <source>Go on at Acquire</source>
        <translation>المتابعة في «القياس»</translation>
    </message>
    <message>
        <source>What was measured does not fit together</source>
        <translation>ما قيس لا يتوافق بعضه مع بعض</translation>
    </message>
    <message>
        <source>Corrected pictures are expected at %1: that is no better than uncorrected. Measure again.</source>
        <translation>المتوقع للصور المصحَّحة ⁨%1⁩: ليس ذلك أفضل من دون تصحيح. قِس من جديد.</translation>
    </message>
    <message>
        <source>%1 dB</source>
        <translation>⁨%1 dB⁩</translation>
    </message>
    <message>
        <source>Go to Acquire</source>
        <translation>إلى «القياس»</translation>
    </message>
    <message>
        <source>Measuring ended because something had changed</source>
        <translation>انتهى القياس لأن شيئًا تغيّر</translation>
    </message>
    <message>
        <source>What follows is of before. See at Acquire what helps.</source>
        <translation>ما يلي من قبل التغيّر. انظر في «القياس» ما يفيد.</translation>
    </message>
    <message>
        <source>%1 of the view is too bright for the camera</source>
        <translation>%1 من المشهد ساطع جدًا للكاميرا</translation>
    </message>
    <message>
        <source>Nothing is corrected there. Close the lens a little, check the camera, then measure again.</source>
        <translation>لا يُصحَّح شيء هناك. أغلق العدسة قليلًا، وافحص الكاميرا، ثم قِس من جديد.</translation>
    </message>
    <message>
        <source>%1 of the view is left out</source>
        <translation>%1 من المشهد مستبعَد</translation>
    </message>
    <message>
        <source>Test patterns looked different there from what was measured, and nothing is corrected. See that all stands still, then measure again.</source>
        <translation>بدت أنماط الاختبار هناك مختلفة عما قيس، فلا يُصحَّح شيء. تأكد من ثبات كل شيء، ثم قِس من جديد.</translation>
    </message>
    <message>
        <source>Measuring was stopped before anything was told apart</source>
        <translation>أُوقف القياس قبل تمييز أي شيء</translation>
    </message>
    <message>
        <source>No picture can be corrected by it. Go on measuring, or use the earlier one, at Acquire.</source>
        <translation>لا يمكن تصحيح أي صورة به. تابع القياس أو استعمل السابق، في «القياس».</translation>
    </message>
    <message>
        <source>No picture can be corrected by it. Go on measuring any time.</source>
        <translation>لا يمكن تصحيح أي صورة به. تابع القياس في أي وقت.</translation>
    </message>
    <message>
        <source>Measuring again has not ended</source>
        <translation>لم تنتهِ إعادة القياس</translation>
    </message>
    <message>
        <source>What was measured is out of date: it belongs to earlier settings</source>
        <translation>ما قيس قديم: يخصّ إعدادات سابقة</translation>
    </message>
    <message>
        <source>It still works, and what you see follows from the earlier measurement, until the new one is ready.</source>
        <translation>ما زال القياس السابق صالحًا، وما تراه ناتج عنه، حتى يكتمل الجديد.</translation>
    </message>
</context>
<context>
    <name>VenueKeeping</name>
    <message>
        <source>It is being measured.</source>
        <translation>يجري قياسه.</translation>
    </message>
    <message>
        <source>It is open. Open another venue, then come back.</source>
        <translation>إنه مفتوح. افتح موقعًا آخر ثم عد.</translation>
    </message>
    <message>
        <source>Give the venue a name.</source>
        <translation>أعطِ الموقع اسمًا.</translation>
    </message>
    <message>
        <source>A name cannot hold a slash.</source>
        <translation>لا يجوز في الاسم شرطة مائلة.</translation>
    </message>
    <message>
        <source>A name cannot begin with a full stop: its folder would be hidden.</source>
        <translation>لا يمكن أن يبدأ الاسم بنقطة: سيكون مجلده مخفيًا.</translation>
    </message>
    <message>
        <source>There is a folder of that name. Choose another name.</source>
        <translation>يوجد مجلد بهذا الاسم. اختر اسمًا آخر.</translation>
    </message>
    <message>
        <source>Its show starts at log-in. Open it, and remove the installed show at Output first.</source>
        <translation>يبدأ عرضه عند تسجيل الدخول. افتحه وأزل العرض المثبّت في «الخرج» أولًا.</translation>
    </message>
</context>
<context>
    <name>ViewActions</name>
    <message>
        <source>Show everything</source>
        <translation>إظهار الكل</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>حفظ</translation>
    </message>
    <message>
        <source>Picture as seen</source>
        <translation>الصورة كما تُرى</translation>
    </message>
    <message>
        <source>Save the picture</source>
        <translation>حفظ الصورة</translation>
    </message>
    <message>
        <source>Pictures (*.png)</source>
        <translation>صور ‎(*.png)</translation>
    </message>
    <message>
        <source>Values</source>
        <translation>القيم</translation>
    </message>
    <message>
        <source>Save the values</source>
        <translation>حفظ القيم</translation>
    </message>
    <message>
        <source>OpenEXR (*.exr)</source>
        <translation>OpenEXR (*.exr)</translation>
    </message>
    <message>
        <source>Whole screen, save</source>
        <translation>ملء الشاشة، حفظ</translation>
    </message>
    <message>
        <source>Whole screen (F11 in the picture)</source>
        <translation>ملء الشاشة (F11 في الصورة)</translation>
    </message>
</context>
<context>
    <name>WindowProjector</name>
    <message>
        <source>The desktop scales this screen by %1, which blurs every pixel. Set its scale to 100 %.</source>
        <translation>يطبّق سطح المكتب على هذه الشاشة مقياس %1، فيموّه كل بكسل. اضبط المقياس على 100 %.</translation>
    </message>
    <message>
        <source>A venue is being measured</source>
        <translation>يجري قياس أحد المواقع</translation>
    </message>
</context>
<context>
    <name>acquisition.alarm-skipped</name>
    <message>
        <source>accepted before pattern {}: {}</source>
        <translation>قُبل قبل النمط ⁨{}⁩: {}</translation>
    </message>
</context>
<context>
    <name>acquisition.ended-by-change</name>
    <message>
        <source>measuring ended with a change: {}; photographs from No. {} on are left out</source>
        <translation>انتهى القياس بتغيّر: {}؛ تُترك اللقطات من رقم ⁨{}⁩ فصاعدًا</translation>
    </message>
</context>
<context>
    <name>acquisition.light-drifted</name>
    <message>
        <source>The light changed by {} % between the first and the last photograph; this was compensated for, but let the projector warm up before the next time</source>
        <translation>تغيّر الضوء بمقدار ⁨{} %⁩ بين اللقطة الأولى والأخيرة؛ أُخذ ذلك في الحسبان، لكن دع جهاز العرض يسخن قبل المرة القادمة</translation>
    </message>
</context>
<context>
    <name>acquisition.overexposed</name>
    <message>
        <source>{} % of the camera pixels are overexposed even at the shortest exposure: close the camera&apos;s aperture a little, then measure again</source>
        <translation>⁨{} %⁩ من بكسلات الكاميرا مفرطة التعريض حتى عند أقصر تعريض: أغلق فتحة عدسة الكاميرا قليلًا، ثم أعد القياس</translation>
    </message>
</context>
<context>
    <name>acquisition.pixels-flagged</name>
    <message>
        <source>{} % of the camera pixels do not see what was predicted for the test patterns: check that nothing moved or flickered; these pixels are left out of the compensation</source>
        <translation>⁨{} %⁩ من بكسلات الكاميرا ترى في أنماط الاختبار غير المتوقَّع: تحقق من أن شيئًا لم يتحرك أو يرتعش؛ تُستثنى هذه البكسلات من التعويض</translation>
    </message>
</context>
<context>
    <name>acquisition.poor-quality</name>
    <message>
        <source>What was measured does not fit together: corrected pictures are expected at {} dB, no better than uncorrected; see that projector, camera and surface stand still and that no other light changes, then measure again</source>
        <translation>ما قيس لا يتوافق بعضه مع بعض: المتوقع للصور المصحَّحة ⁨{} dB⁩، أي ليس أفضل من دون تصحيح؛ تأكد من ثبات جهاز العرض والكاميرا والسطح ومن عدم تغيّر أي ضوء آخر، ثم قِس من جديد</translation>
    </message>
</context>
<context>
    <name>acquisition.stopped-early</name>
    <message>
        <source>Measuring was stopped at blocks of {} px: what is finer is missing, and pictures are compensated less sharply; go on measuring any time as long as nothing has moved</source>
        <translation>أُوقف القياس عند كتل من ⁨{} px⁩: ما هو أدق ناقص، وتُعوَّض الصور بحدّة أقل؛ تابع القياس في أي وقت ما دام شيء لم يتحرّك</translation>
    </message>
</context>
<context>
    <name>acquisition.stopped-with-forecast</name>
    <message numerus="yes">
        <source>Stopped at {} px blocks; {} dB expected, about {} dB with {} more photographs, {}; go on measuring any time as long as nothing has moved</source>
        <comment>Stopped at {} px blocks; {} dB expected, about {} dB with {} more photograph, {}; go on measuring any time as long as nothing has moved</comment>
        <translation>
            <numerusform>أُوقف عند كتل من ⁨{} px⁩؛ المتوقع ⁨{} dB⁩، ونحو ⁨{} dB⁩ مع {} لقطة أخرى، {}؛ تابع القياس في أي وقت ما لم يتحرّك شيء</numerusform>
            <numerusform>أُوقف عند كتل من ⁨{} px⁩؛ المتوقع ⁨{} dB⁩، ونحو ⁨{} dB⁩ مع {} لقطة أخرى، {}؛ تابع القياس في أي وقت ما لم يتحرّك شيء</numerusform>
            <numerusform>أُوقف عند كتل من ⁨{} px⁩؛ المتوقع ⁨{} dB⁩، ونحو ⁨{} dB⁩ مع {} لقطة أخرى، {}؛ تابع القياس في أي وقت ما لم يتحرّك شيء</numerusform>
            <numerusform>أُوقف عند كتل من ⁨{} px⁩؛ المتوقع ⁨{} dB⁩، ونحو ⁨{} dB⁩ مع {} لقطات أخرى، {}؛ تابع القياس في أي وقت ما لم يتحرّك شيء</numerusform>
            <numerusform>أُوقف عند كتل من ⁨{} px⁩؛ المتوقع ⁨{} dB⁩، ونحو ⁨{} dB⁩ مع {} لقطة أخرى، {}؛ تابع القياس في أي وقت ما لم يتحرّك شيء</numerusform>
            <numerusform>أُوقف عند كتل من ⁨{} px⁩؛ المتوقع ⁨{} dB⁩، ونحو ⁨{} dB⁩ مع {} لقطة أخرى، {}؛ تابع القياس في أي وقت ما لم يتحرّك شيء</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>acquisition.taken-again</name>
    <message numerus="yes">
        <source>{}: {} patterns from No. {} on were photographed again</source>
        <comment>{}: {} pattern from No. {} on was photographed again</comment>
        <translation>
            <numerusform>{}: أُعيد تصوير {} نمط بدءًا من رقم {}</numerusform>
            <numerusform>{}: أُعيد تصوير {} نمط بدءًا من رقم {}</numerusform>
            <numerusform>{}: أُعيد تصوير {} نمط بدءًا من رقم {}</numerusform>
            <numerusform>{}: أُعيد تصوير {} نمط بدءًا من رقم {}</numerusform>
            <numerusform>{}: أُعيد تصوير {} نمط بدءًا من رقم {}</numerusform>
            <numerusform>{}: أُعيد تصوير {} نمط بدءًا من رقم {}</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>alarm.by-resuming</name>
    <message>
        <source>{} by resuming the calibration; {}</source>
        <translation>{} باستئناف المعايرة؛ {}</translation>
    </message>
</context>
<context>
    <name>alarm.camera-sees-nothing</name>
    <message>
        <source>the camera sees nothing at all</source>
        <translation>لا ترى الكاميرا شيئًا على الإطلاق</translation>
    </message>
</context>
<context>
    <name>alarm.check-screen</name>
    <message>
        <source>check that the right screen is chosen and nothing covers the picture, then try again</source>
        <translation>تحقق من أن الشاشة الصحيحة مختارة وأن لا شيء يحجب الصورة، ثم أعد المحاولة</translation>
    </message>
</context>
<context>
    <name>alarm.clear-the-view</name>
    <message>
        <source>take away what is in the light or in the view, then try again</source>
        <translation>أزل ما يعترض الضوء أو مجال الرؤية، ثم أعد المحاولة</translation>
    </message>
</context>
<context>
    <name>alarm.lamp-changed</name>
    <message>
        <source>the projector&apos;s light changed by {} % within a few photographs</source>
        <translation>تغيّر ضوء جهاز العرض بمقدار ⁨{} %⁩ خلال بضع لقطات</translation>
    </message>
</context>
<context>
    <name>alarm.leave-it-as-it-is</name>
    <message>
        <source>leave it as it is now, then try again: measuring begins again</source>
        <translation>اتركه كما هو الآن ثم حاول مرة أخرى: يبدأ القياس من جديد</translation>
    </message>
</context>
<context>
    <name>alarm.light-flickers</name>
    <message>
        <source>the light flickers or was switched: photographs of one pattern differ by {} %</source>
        <translation>الضوء يرتعش أو شُغّل أو أُطفئ: صور النمط نفسه تختلف بمقدار ⁨{} %⁩</translation>
    </message>
</context>
<context>
    <name>alarm.light-room-or-measure-again</name>
    <message>
        <source>switch on again what shone when measuring began, then try again; or stop, and measure again in the light as it is now</source>
        <translation>أعد تشغيل ما كان مضاءً عند بدء القياس ثم حاول مرة أخرى؛ أو أوقف القياس وقِس من جديد في الإضاءة الحالية</translation>
    </message>
</context>
<context>
    <name>alarm.moved</name>
    <message>
        <source>a camera or projector has moved: the view of camera {} is shifted by {}, {} pixels and turned by {} degrees</source>
        <translation>تحرّكت كاميرا أو جهاز عرض: انزاح مجال رؤية الكاميرا ⁨{}⁩ بمقدار ⁨{}, {}⁩ بكسل واستدار بمقدار ⁨{}⁩ درجة</translation>
    </message>
</context>
<context>
    <name>alarm.moved-besides</name>
    <message>
        <source>{}; besides, {}</source>
        <translation>{}؛ وفوق ذلك {}</translation>
    </message>
</context>
<context>
    <name>alarm.photograph-dark</name>
    <message>
        <source>one of two photographs of a pattern is dark: the lens was covered, or the projector&apos;s picture gone</source>
        <translation>إحدى صورتين للنمط مظلمة: غُطيت العدسة، أو اختفت صورة جهاز العرض</translation>
    </message>
</context>
<context>
    <name>alarm.photographs-differ</name>
    <message>
        <source>photographs of one pattern differ by {} %: the light flickers, or something moved between them</source>
        <translation>تختلف لقطات النمط الواحد بمقدار ⁨{} %⁩: الضوء يرتعش، أو تحرّك شيء بينها</translation>
    </message>
</context>
<context>
    <name>alarm.picture-mirrored</name>
    <message>
        <source>the picture of projector {} appears mirrored</source>
        <translation>تظهر صورة جهاز العرض ⁨{}⁩ معكوسة</translation>
    </message>
</context>
<context>
    <name>alarm.projector-shows-nothing</name>
    <message>
        <source>the projector shows nothing, though the room&apos;s own light is still seen</source>
        <translation>لا يعرض جهاز العرض شيئًا، وما زالت إضاءة القاعة مرئية</translation>
    </message>
</context>
<context>
    <name>alarm.put-back-or-measure-again</name>
    <message>
        <source>put it back, then try again; or stop, and measure again without it</source>
        <translation>أعده ثم حاول مرة أخرى؛ أو أوقف القياس وقِس من جديد من دونه</translation>
    </message>
</context>
<context>
    <name>alarm.put-it-back</name>
    <message>
        <source>put it back to within half a pixel, then try again</source>
        <translation>أعد الجهاز إلى موضعه بفارق لا يتجاوز نصف بكسل، ثم أعد المحاولة</translation>
    </message>
</context>
<context>
    <name>alarm.put-it-back-and-restore-light</name>
    <message>
        <source>put it back to within half a pixel and restore the light of the room, then try again</source>
        <translation>أعد الجهاز إلى موضعه بفارق لا يتجاوز نصف بكسل، وأعد إضاءة الغرفة كما كانت، ثم أعد المحاولة</translation>
    </message>
</context>
<context>
    <name>alarm.restore-room-light</name>
    <message>
        <source>restore the light of the room, keep doors and curtains closed, then try again</source>
        <translation>أعد الإضاءة كما كانت، وأبقِ الأبواب والستائر مغلقة، ثم أعد المحاولة</translation>
    </message>
</context>
<context>
    <name>alarm.room-brighter</name>
    <message>
        <source>the light of the room became brighter</source>
        <translation>أصبحت إضاءة القاعة أسطع</translation>
    </message>
</context>
<context>
    <name>alarm.room-darker</name>
    <message>
        <source>the light of the room became darker</source>
        <translation>أصبحت إضاءة القاعة أضعف</translation>
    </message>
</context>
<context>
    <name>alarm.safe-before-check</name>
    <message>
        <source>every photograph up to the previous check is safe</source>
        <translation>كل اللقطات حتى الفحص السابق آمنة</translation>
    </message>
</context>
<context>
    <name>alarm.safe-before-light-transport</name>
    <message>
        <source>every photograph before the light transport is safe</source>
        <translation>كل اللقطات السابقة لقياس نقل الضوء آمنة</translation>
    </message>
</context>
<context>
    <name>alarm.something-gone</name>
    <message>
        <source>{} % of the view of camera {} are brighter than before: what stood there is gone</source>
        <translation>{} % من مشهد الكاميرا {} أسطع من قبل: ما كان هناك لم يعد موجودًا</translation>
    </message>
</context>
<context>
    <name>alarm.steady-all</name>
    <message>
        <source>see that camera, projector and surface stand still, switch off dimmed and fluorescent lamps and the projector&apos;s power saving, then try again</source>
        <translation>تأكّد من ثبات الكاميرا وجهاز العرض والسطح، وأطفئ المصابيح المخفّتة ومصابيح الفلورسنت، وأوقف توفير الطاقة في جهاز العرض، ثم أعد المحاولة</translation>
    </message>
</context>
<context>
    <name>alarm.switch-off-dimmed-lamps</name>
    <message>
        <source>switch off dimmed and fluorescent lamps and the projector&apos;s power saving, then try again</source>
        <translation>أطفئ المصابيح المخفّتة ومصابيح الفلورسنت، وأوقف توفير الطاقة في جهاز العرض، ثم أعد المحاولة</translation>
    </message>
</context>
<context>
    <name>alarm.switch-off-eco-modes</name>
    <message>
        <source>switch off its automatic brightness and eco modes, let it warm up, then try again</source>
        <translation>أوقف السطوع التلقائي والأوضاع الاقتصادية في جهاز العرض، ودعه يسخن، ثم أعد المحاولة</translation>
    </message>
</context>
<context>
    <name>alarm.switch-off-rear-projection</name>
    <message>
        <source>switch off the projector&apos;s rear or ceiling mode, or allow a mirrored picture, then try again</source>
        <translation>أوقف وضع العرض الخلفي أو السقفي في جهاز العرض، أو اسمح بصورة معكوسة، ثم أعد المحاولة</translation>
    </message>
</context>
<context>
    <name>alarm.uncover-lens</name>
    <message>
        <source>uncover the lens, check that the projector is on, then try again</source>
        <translation>اكشف العدسة، وتحقق من أن جهاز العرض يعمل، ثم أعد المحاولة</translation>
    </message>
</context>
<context>
    <name>alarm.view-changed</name>
    <message>
        <source>{} % of the view of camera {} look different from before</source>
        <translation>يبدو ⁨{} %⁩ من مجال رؤية الكاميرا ⁨{}⁩ مختلفًا عمّا كان</translation>
    </message>
</context>
<context>
    <name>alarm.wake-projector</name>
    <message>
        <source>wake the projector, switch off its and the screen&apos;s power saving, then try again</source>
        <translation>أيقظ جهاز العرض، وأوقف توفير الطاقة فيه وفي الشاشة، ثم أعد المحاولة</translation>
    </message>
</context>
<context>
    <name>alarm.wrong-picture</name>
    <message>
        <source>projector {} does not show the picture that it is given</source>
        <translation>لا يعرض جهاز العرض ⁨{}⁩ الصورة المرسلة إليه</translation>
    </message>
</context>
<context>
    <name>calibration.allow-writing-then-resume</name>
    <message>
        <source>check that the folder may be written to, then go on</source>
        <translation>تحقق من أن الكتابة في المجلد مسموحة، ثم تابع</translation>
    </message>
</context>
<context>
    <name>calibration.allow-writing-then-retry</name>
    <message>
        <source>check that the folder may be written to, then try again</source>
        <translation>تحقق من أن الكتابة في المجلد مسموحة، ثم حاول مجددًا</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-list-folder</name>
    <message>
        <source>cannot look into the folder ({})</source>
        <translation>تتعذّر قراءة محتويات المجلد (⁨{}⁩)</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-move-photograph</name>
    <message>
        <source>a photograph cannot be moved ({})</source>
        <translation>يتعذّر نقل لقطة (⁨{}⁩)</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-open-folder</name>
    <message>
        <source>cannot open the folder ({})</source>
        <translation>يتعذّر فتح المجلد (⁨{}⁩)</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-remove-photograph</name>
    <message>
        <source>a photograph cannot be removed ({})</source>
        <translation>يتعذّر حذف لقطة (⁨{}⁩)</translation>
    </message>
</context>
<context>
    <name>calibration.check-path-and-permission</name>
    <message>
        <source>check the path and that you may read it</source>
        <translation>تحقق من المسار ومن أن القراءة مسموحة لك</translation>
    </message>
</context>
<context>
    <name>calibration.check-permission-or-name</name>
    <message>
        <source>check that you may read it, or choose another name</source>
        <translation>تحقق من أن القراءة مسموحة لك، أو اختر اسمًا آخر</translation>
    </message>
</context>
<context>
    <name>calibration.choose-another-or-copy-again</name>
    <message>
        <source>choose another calibration, or copy it again from where it was measured</source>
        <translation>اختر معايرة أخرى، أو انسخ هذه مجددًا من حيث قيست</translation>
    </message>
</context>
<context>
    <name>calibration.disk-full</name>
    <message>
        <source>the disk is full</source>
        <translation>القرص ممتلئ</translation>
    </message>
</context>
<context>
    <name>calibration.give-addresses-again</name>
    <message>
        <source>give the projectors&apos; addresses again</source>
        <translation>أعطِ عناوين أجهزة العرض من جديد</translation>
    </message>
</context>
<context>
    <name>calibration.make-room-then-resume</name>
    <message>
        <source>every photograph so far is safe: free at least {} MB there, then resume</source>
        <translation>كل اللقطات حتى الآن آمنة: أخلِ هناك ⁨{} MB⁩ على الأقل، ثم استأنف</translation>
    </message>
</context>
<context>
    <name>calibration.manifest-damaged</name>
    <message>
        <source>the file that describes the venue is damaged</source>
        <translation>الملف الذي يصف الموقع تالف</translation>
    </message>
</context>
<context>
    <name>calibration.network-unreadable</name>
    <message>
        <source>the addresses of the projectors on the network cannot be read ({})</source>
        <translation>تعذّرت قراءة عناوين أجهزة العرض على الشبكة ({})</translation>
    </message>
</context>
<context>
    <name>calibration.not-a-calibration</name>
    <message>
        <source>this is not a calibration of Relucent</source>
        <translation>هذه ليست معايرة من Relucent</translation>
    </message>
</context>
<context>
    <name>calibration.result-file-missing</name>
    <message>
        <source>a file of the calibration&apos;s {} is missing</source>
        <translation>أحد ملفات المعايرة في مرحلة «⁨{}⁩» مفقود</translation>
    </message>
</context>
<context>
    <name>calibration.result-file-size-wrong</name>
    <message>
        <source>a file of the calibration&apos;s {} has {} bytes instead of {}</source>
        <translation>حجم أحد ملفات المعايرة في مرحلة «⁨{}⁩» هو ⁨{}⁩ بايت بدلًا من ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>cast.check-screen</name>
    <message>
        <source>see whether the screen is on, or the window open</source>
        <translation>تحقق من أن الشاشة مشغّلة، أو أن النافذة مفتوحة</translation>
    </message>
</context>
<context>
    <name>cast.choice-refused</name>
    <message>
        <source>the desktop no longer gives what was chosen for it</source>
        <translation>لم يعد سطح المكتب يقدّم ما اختير من قبل</translation>
    </message>
</context>
<context>
    <name>cast.choose-again</name>
    <message>
        <source>play it again, and choose there what is shown</source>
        <translation>شغّله مرة أخرى واختر هناك ما يُعرض</translation>
    </message>
</context>
<context>
    <name>cast.choose-in-wizard</name>
    <message>
        <source>play it once in the wizard, on Output, and choose there; a show then takes the same</source>
        <translation>شغّله مرة في المعالج، في صفحة «الخرج»، واختر هناك؛ ثم يأخذ العرض الاختيار نفسه</translation>
    </message>
</context>
<context>
    <name>cast.ended</name>
    <message>
        <source>the desktop has ended it</source>
        <translation>أنهاه سطح المكتب</translation>
    </message>
</context>
<context>
    <name>cast.install-pipewire</name>
    <message>
        <source>install pipewire and wireplumber, and log in again</source>
        <translation>ثبّت pipewire و wireplumber، ثم سجّل الدخول من جديد</translation>
    </message>
</context>
<context>
    <name>cast.install-portal</name>
    <message>
        <source>install xdg-desktop-portal and its part for this desktop, and log in again</source>
        <translation>ثبّت xdg-desktop-portal والجزء الخاص منه بسطح المكتب هذا، ثم سجّل الدخول من جديد</translation>
    </message>
</context>
<context>
    <name>cast.log-in-again</name>
    <message>
        <source>log in again</source>
        <translation>سجّل الدخول من جديد</translation>
    </message>
</context>
<context>
    <name>cast.no-pipewire</name>
    <message>
        <source>PipeWire, which brings the picture, does not answer</source>
        <translation>لا يستجيب PipeWire الذي ينقل الصورة</translation>
    </message>
</context>
<context>
    <name>cast.no-portal</name>
    <message>
        <source>this desktop has no portal that gives the picture of a screen</source>
        <translation>ليس لسطح المكتب هذا بوابة تقدّم صورة شاشة</translation>
    </message>
</context>
<context>
    <name>cast.no-windows</name>
    <message>
        <source>this desktop gives pictures of screens, not of windows</source>
        <translation>يقدّم سطح المكتب هذا صور الشاشات، لا صور النوافذ</translation>
    </message>
</context>
<context>
    <name>cast.not-chosen</name>
    <message>
        <source>nobody has chosen in the desktop&apos;s dialog what is shown</source>
        <translation>لم يختر أحد في مربع حوار سطح المكتب ما يُعرض</translation>
    </message>
</context>
<context>
    <name>cast.play-screen</name>
    <message>
        <source>play the screen on which the window is</source>
        <translation>شغّل الشاشة التي عليها النافذة</translation>
    </message>
</context>
<context>
    <name>cast.portal-failed</name>
    <message>
        <source>the desktop&apos;s portal gives no picture ({})</source>
        <translation>لا تقدّم بوابة سطح المكتب أي صورة ({})</translation>
    </message>
</context>
<context>
    <name>cast.portal-silent</name>
    <message>
        <source>the desktop&apos;s portal has not answered for {} s</source>
        <translation>لم تستجب بوابة سطح المكتب منذ {} ث</translation>
    </message>
</context>
<context>
    <name>cast.refused</name>
    <message>
        <source>it was refused in the desktop&apos;s dialog</source>
        <translation>رُفض ذلك في مربع حوار سطح المكتب</translation>
    </message>
</context>
<context>
    <name>cast.unusable</name>
    <message>
        <source>what the desktop sends is no picture that can be shown</source>
        <translation>ما يرسله سطح المكتب ليس صورة يمكن عرضها</translation>
    </message>
</context>
<context>
    <name>cast.update-desktop</name>
    <message>
        <source>update the desktop&apos;s portal and PipeWire</source>
        <translation>حدّث بوابة سطح المكتب و PipeWire</translation>
    </message>
</context>
<context>
    <name>check.colour-wheel</name>
    <message>
        <source>The colours come one after the other, as through a colour wheel ({} % in {} ms): expose whole frames, multiples of {} ms.</source>
        <translation>تظهر الألوان واحدًا بعد آخر كما في عجلة ألوان (⁨{} %⁩ خلال ⁨{} ms⁩): عرّض إطارات كاملة، مضاعفات ⁨{} ms⁩.</translation>
    </message>
</context>
<context>
    <name>check.dithering</name>
    <message>
        <source>The projector mixes greys in time, pixel by pixel ({} %): expose several whole frames, and switch its smoothing and 3D modes off.</source>
        <translation>يمزج جهاز العرض درجات الرمادي زمنيًا، بكسلًا بكسلًا (⁨{} %⁩): عرّض عدة إطارات كاملة، وأوقف التنعيم وأوضاع ثلاثية الأبعاد.</translation>
    </message>
</context>
<context>
    <name>check.lamp-flickers</name>
    <message>
        <source>The lamp flickers within a frame, by {} % in {} ms: expose whole frames, multiples of {} ms.</source>
        <translation>يرتعش المصباح داخل الإطار بمقدار ⁨{} %⁩ خلال ⁨{} ms⁩: عرّض إطارات كاملة، مضاعفات ⁨{} ms⁩.</translation>
    </message>
</context>
<context>
    <name>check.light-even</name>
    <message>
        <source>The light is even: no flicker, colour wheel, bands or dithering is seen.</source>
        <translation>الضوء متجانس: لا يُرى ارتعاش ولا عجلة ألوان ولا أشرطة ولا تدرّج نقطي.</translation>
    </message>
</context>
<context>
    <name>check.light-unsteady</name>
    <message>
        <source>The light changes by {} % between exposures of whole frames: let the lamp warm up, and switch off dynamic brightness and the lamps in the room.</source>
        <translation>يتغيّر الضوء بمقدار ⁨{} %⁩ بين تعريضات إطارات كاملة: دع المصباح يسخن، وأوقف السطوع الديناميكي ومصابيح القاعة.</translation>
    </message>
</context>
<context>
    <name>check.no-brief-exposure</name>
    <message>
        <source>The camera cannot expose for a part of a frame, or sees too little then: flicker within a frame cannot be detected.</source>
        <translation>لا تستطيع الكاميرا التعريض لجزء من إطار، أو ترى القليل جدًا عندئذ: لا يمكن تمييز الارتعاش داخل الإطار.</translation>
    </message>
</context>
<context>
    <name>check.other-screen-seen</name>
    <message>
        <source>The camera sees {} and not {}.</source>
        <translation>ترى الكاميرا ⁨{}⁩ وليس ⁨{}⁩.</translation>
    </message>
</context>
<context>
    <name>check.picture-takes</name>
    <message>
        <source>A picture takes {} ms to appear: each one is waited for that long.</source>
        <translation>تستغرق الصورة ⁨{}⁩ ms حتى تظهر: يُنتظر كل منها هذه المدة.</translation>
    </message>
</context>
<context>
    <name>check.pictures-late</name>
    <message numerus="yes">
        <source>Pictures arrive {} photographs late: measure the latency, so that it is waited for.</source>
        <comment>Pictures arrive {} photograph late: measure the latency, so that it is waited for.</comment>
        <translation>
            <numerusform>تصل الصور دون تأخر: يجب قياس زمن التأخير وانتظاره.</numerusform>
            <numerusform>تتأخر الصور بمقدار صورة واحدة: يجب قياس زمن التأخير وانتظاره.</numerusform>
            <numerusform>تتأخر الصور بمقدار صورتين: يجب قياس زمن التأخير وانتظاره.</numerusform>
            <numerusform>تتأخر الصور بمقدار {} صور: يجب قياس زمن التأخير وانتظاره.</numerusform>
            <numerusform>تتأخر الصور بمقدار {} صورة: يجب قياس زمن التأخير وانتظاره.</numerusform>
            <numerusform>تتأخر الصور بمقدار {} صورة: يجب قياس زمن التأخير وانتظاره.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>check.rolling-shutter</name>
    <message>
        <source>The camera exposes its rows one after the other (rolling shutter): brief exposures have bands of {} %. Expose whole frames, multiples of {} ms.</source>
        <translation>تعرّض الكاميرا صفوفها واحدًا بعد آخر (غالق متدحرج): في التعريضات القصيرة أشرطة بمقدار ⁨{} %⁩. عرّض إطارات كاملة، مضاعفات ⁨{} ms⁩.</translation>
    </message>
</context>
<context>
    <name>check.screen-mirrored</name>
    <message>
        <source>The picture appears mirrored. If it is not meant to (rear projection, a mirror), switch that off in the projector&apos;s menu.</source>
        <translation>تظهر الصورة معكوسة. إن لم يكن ذلك مقصودًا (عرض خلفي أو مرآة)، فأوقفه من قائمة جهاز العرض.</translation>
    </message>
</context>
<context>
    <name>check.screen-not-seen</name>
    <message>
        <source>The camera does not see {}.</source>
        <translation>لا ترى الكاميرا ⁨{}⁩.</translation>
    </message>
</context>
<context>
    <name>check.screen-seen</name>
    <message>
        <source>The camera sees {}: {} % of its view follow the test pattern.</source>
        <translation>ترى الكاميرا ⁨{}⁩: يتبع ⁨{} %⁩ من مجال رؤيتها نمط الاختبار.</translation>
    </message>
</context>
<context>
    <name>check.white-changes</name>
    <message>
        <source>White changes by {} % from photograph to photograph: expose whole frames of the projector, multiples of {} ms, and switch its dynamic brightness off.</source>
        <translation>يتغيّر الأبيض بمقدار ⁨{} %⁩ من صورة إلى أخرى: عرّض إطارات كاملة لجهاز العرض، مضاعفات ⁨{} ms⁩، وأوقف السطوع الديناميكي.</translation>
    </message>
</context>
<context>
    <name>compensation.draw-masks-of-cameras</name>
    <message>
        <source>draw masks in the views of the cameras that measured this calibration</source>
        <translation>ارسم الأقنعة في مشاهد الكاميرات التي قاست هذه المعايرة</translation>
    </message>
</context>
<context>
    <name>compensation.mask-crosses-itself</name>
    <message>
        <source>its outline crosses itself</source>
        <translation>محيطه يتقاطع مع نفسه</translation>
    </message>
</context>
<context>
    <name>compensation.mask-encloses-nothing</name>
    <message>
        <source>its outline encloses nothing</source>
        <translation>محيطه لا يحيط بشيء</translation>
    </message>
</context>
<context>
    <name>compensation.mask-feather-out-of-range</name>
    <message>
        <source>its feather must lie between 0 and half of the view&apos;s larger side</source>
        <translation>يجب أن يكون تدرّج حافته بين 0 ونصف الضلع الأطول للمشهد</translation>
    </message>
</context>
<context>
    <name>compensation.mask-not-finite</name>
    <message>
        <source>its points must be finite numbers</source>
        <translation>يجب أن تكون نقاطه أعدادًا منتهية</translation>
    </message>
</context>
<context>
    <name>compensation.mask-of-no-camera</name>
    <message>
        <source>a mask was drawn in the view of camera {}, but there are {} cameras</source>
        <translation>رُسم قناع في مشهد الكاميرا {}، لكن عدد الكاميرات {}</translation>
    </message>
</context>
<context>
    <name>compensation.mask-outside-view</name>
    <message>
        <source>its points must lie within the view, from 0 to 1 along both sides</source>
        <translation>يجب أن تقع نقاطه داخل المشهد، من 0 إلى 1 على الجانبين</translation>
    </message>
</context>
<context>
    <name>compensation.mask-point-twice</name>
    <message>
        <source>two points of its outline are the same</source>
        <translation>نقطتان من محيطه متطابقتان</translation>
    </message>
</context>
<context>
    <name>compensation.mask-too-few-points</name>
    <message>
        <source>its outline needs three points at least</source>
        <translation>يحتاج محيطه إلى ثلاث نقاط على الأقل</translation>
    </message>
</context>
<context>
    <name>compensation.mask-too-many-points</name>
    <message>
        <source>its outline may have {} points at most</source>
        <translation>لا يجوز أن تزيد نقاط محيطه على {}</translation>
    </message>
</context>
<context>
    <name>compensation.masks-cover-everything</name>
    <message>
        <source>the masks cover the whole picture</source>
        <translation>الأقنعة تغطي الصورة كلها</translation>
    </message>
</context>
<context>
    <name>compensation.of-mask</name>
    <message>
        <source>mask {}: {}</source>
        <translation>القناع {}: {}</translation>
    </message>
</context>
<context>
    <name>compensation.shrink-masks</name>
    <message>
        <source>make a mask smaller, or remove one</source>
        <translation>صغّر قناعًا أو أزل واحدًا</translation>
    </message>
</context>
<context>
    <name>content.choose-picture-folder</name>
    <message>
        <source>choose a folder with PNG, JPEG, TIFF or EXR files</source>
        <translation>اختر مجلدًا فيه ملفات PNG أو JPEG أو TIFF أو EXR</translation>
    </message>
</context>
<context>
    <name>content.choose-supported-picture</name>
    <message>
        <source>choose a PNG, JPEG, TIFF or EXR picture</source>
        <translation>اختر صورة PNG أو JPEG أو TIFF أو EXR</translation>
    </message>
</context>
<context>
    <name>content.connect-capture-device</name>
    <message>
        <source>plug it in, close other programs that use it, and try again</source>
        <translation>صِل الجهاز، وأغلق البرامج الأخرى التي تستخدمه، ثم حاول مجددًا</translation>
    </message>
</context>
<context>
    <name>content.log-in-to-xorg</name>
    <message>
        <source>log in to a desktop, or play files</source>
        <translation>سجّل الدخول إلى سطح مكتب، أو شغّل ملفات</translation>
    </message>
</context>
<context>
    <name>content.no-pictures</name>
    <message>
        <source>no pictures in this folder</source>
        <translation>لا صور في هذا المجلد</translation>
    </message>
</context>
<context>
    <name>content.no-x-server</name>
    <message>
        <source>the live picture of a screen needs an X server, and none answers</source>
        <translation>تحتاج الصورة الحية للشاشة إلى خادم X، ولا يستجيب أي خادم</translation>
    </message>
</context>
<context>
    <name>content.nothing-captured</name>
    <message>
        <source>the capture device gives no picture</source>
        <translation>لا يعطي جهاز الالتقاط أي صورة</translation>
    </message>
</context>
<context>
    <name>content.open-first</name>
    <message>
        <source>open it first</source>
        <translation>افتحها أولًا</translation>
    </message>
</context>
<context>
    <name>content.open-first-or-choose</name>
    <message>
        <source>open it first; there are: {}</source>
        <translation>افتحها أولًا؛ الموجود: {}</translation>
    </message>
</context>
<context>
    <name>content.picture-unreadable</name>
    <message>
        <source>not a picture that can be read</source>
        <translation>ليست صورة تُقرأ</translation>
    </message>
</context>
<context>
    <name>content.sequence-empty</name>
    <message>
        <source>the sequence has no pictures</source>
        <translation>لا صور في التسلسل</translation>
    </message>
</context>
<context>
    <name>content.unknown-window</name>
    <message>
        <source>there is no window &apos;{}&apos;</source>
        <translation>لا نافذة «{}»</translation>
    </message>
</context>
<context>
    <name>device.aim-uncover-and-expose-longer</name>
    <message>
        <source>aim it at the projection, take off its lens cap, and expose longer</source>
        <translation>وجّه الكاميرا إلى الصورة المعروضة، وانزع غطاء عدستها، وأطِل التعريض</translation>
    </message>
</context>
<context>
    <name>device.allow-command-more-time</name>
    <message>
        <source>check the device, or allow the command more time: {}</source>
        <translation>افحص الجهاز، أو امنح الأمر وقتًا أطول: ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.another-program-holds-camera</name>
    <message>
        <source>another program holds the camera</source>
        <translation>برنامج آخر يحجز الكاميرا</translation>
    </message>
</context>
<context>
    <name>device.ask-for-fewer-pixels</name>
    <message>
        <source>ask for that or less</source>
        <translation>اطلب هذا الحجم أو أصغر منه</translation>
    </message>
</context>
<context>
    <name>device.ask-for-given-size</name>
    <message>
        <source>ask for the size that it gives</source>
        <translation>اطلب الحجم الذي تعطيه الكاميرا</translation>
    </message>
</context>
<context>
    <name>device.ask-for-listed-size</name>
    <message>
        <source>ask for a size that it has: v4l2-ctl --list-formats-ext names them</source>
        <translation>اطلب أحد الأحجام المتاحة: يسردها الأمر ⁨v4l2-ctl --list-formats-ext⁩</translation>
    </message>
</context>
<context>
    <name>device.automatic-exposure-stays</name>
    <message>
        <source>the video device&apos;s automatic exposure cannot be switched off</source>
        <translation>لا يمكن إيقاف التعريض التلقائي في جهاز الفيديو</translation>
    </message>
</context>
<context>
    <name>device.automatic-focus-stays</name>
    <message>
        <source>the video device&apos;s automatic focus cannot be switched off</source>
        <translation>لا يمكن إيقاف التركيز التلقائي في جهاز الفيديو</translation>
    </message>
</context>
<context>
    <name>device.automatic-function-stays</name>
    <message>
        <source>{} cannot be switched off</source>
        <translation>لا يمكن إيقاف ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.automatic-iso</name>
    <message>
        <source>the camera chooses its sensitivity itself (automatic ISO)</source>
        <translation>تختار الكاميرا حساسيتها بنفسها (ISO تلقائي)</translation>
    </message>
</context>
<context>
    <name>device.automatic-white-balance-stays</name>
    <message>
        <source>the video device&apos;s automatic white balance cannot be switched off</source>
        <translation>لا يمكن إيقاف توازن الأبيض التلقائي في جهاز الفيديو</translation>
    </message>
</context>
<context>
    <name>device.battery-empty</name>
    <message>
        <source>the camera&apos;s battery seems to be empty ({} % when it was last asked)</source>
        <translation>يبدو أن بطارية الكاميرا فارغة (⁨{} %⁩ عند آخر قراءة)</translation>
    </message>
</context>
<context>
    <name>device.battery-low</name>
    <message>
        <source>has {} % left in its battery: a measurement needs a full one or a mains adapter</source>
        <translation>بقي في بطاريتها {} %: يحتاج القياس إلى بطارية ممتلئة أو محوّل كهرباء</translation>
    </message>
</context>
<context>
    <name>device.built-without-genicam</name>
    <message>
        <source>this build of Relucent does not know GenICam cameras</source>
        <translation>نسخة Relucent هذه لا تدعم كاميرات GenICam</translation>
    </message>
</context>
<context>
    <name>device.built-without-gphoto</name>
    <message>
        <source>this build of Relucent does not know DSLR and mirrorless cameras</source>
        <translation>نسخة Relucent هذه لا تدعم كاميرات DSLR والكاميرات عديمة المرآة</translation>
    </message>
</context>
<context>
    <name>device.camera-asleep</name>
    <message>
        <source>the camera is there but does not answer, it may be asleep</source>
        <translation>الكاميرا موجودة لكنها لا تستجيب، وقد تكون في وضع السكون</translation>
    </message>
</context>
<context>
    <name>device.camera-command-empty</name>
    <message>
        <source>the camera&apos;s command is empty</source>
        <translation>أمر الكاميرا فارغ</translation>
    </message>
</context>
<context>
    <name>device.camera-command-lacks</name>
    <message>
        <source>the camera&apos;s command does not contain {}</source>
        <translation>ينقص أمرَ الكاميرا ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.camera-given-up</name>
    <message>
        <source>the camera does not answer</source>
        <translation>الكاميرا لا تستجيب</translation>
    </message>
</context>
<context>
    <name>device.camera-given-up-advice</name>
    <message>
        <source>push in its cable at both ends and switch it on, then go on: every photograph so far is kept</source>
        <translation>أحكم إدخال الكابل من طرفيه وشغّلها ثم تابع: كل اللقطات السابقة محفوظة</translation>
    </message>
</context>
<context>
    <name>device.camera-gone</name>
    <message>
        <source>the camera has been unplugged or switched off, or has fallen asleep</source>
        <translation>فُصلت الكاميرا أو أُطفئت، أو دخلت في وضع السكون</translation>
    </message>
</context>
<context>
    <name>device.camera-no-longer-answers</name>
    <message>
        <source>the camera no longer answers ({}: {})</source>
        <translation>لم تعد الكاميرا تستجيب (⁨{}⁩: ⁨{}⁩)</translation>
    </message>
</context>
<context>
    <name>device.camera-not-back</name>
    <message>
        <source>the camera has been gone for {} s: {}</source>
        <translation>الكاميرا غائبة منذ ⁨{}⁩ ث: {}</translation>
    </message>
</context>
<context>
    <name>device.camera-refuses</name>
    <message>
        <source>the camera refuses ({}: {})</source>
        <translation>ترفض الكاميرا (⁨{}⁩: ⁨{}⁩)</translation>
    </message>
</context>
<context>
    <name>device.camera-sends-no-stream</name>
    <message>
        <source>the camera sends no stream</source>
        <translation>لا ترسل الكاميرا أي دفق من الصور</translation>
    </message>
</context>
<context>
    <name>device.camera-size-out-of-range</name>
    <message>
        <source>a camera of {} pixels is impossible: each side is {} to {}</source>
        <translation>لا وجود لكاميرا بحجم ⁨{}⁩ بكسل: كل ضلع من ⁨{}⁩ إلى ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.camera-stays-busy</name>
    <message>
        <source>the camera stays busy</source>
        <translation>ما زالت الكاميرا مشغولة</translation>
    </message>
</context>
<context>
    <name>device.camera-twice</name>
    <message>
        <source>{} is camera {} and camera {}: choose another camera, or one with a serial number of its own</source>
        <translation>{} هي الكاميرا {} والكاميرا {}: اختر كاميرا أخرى، أو واحدة لها رقم تسلسلي خاص بها</translation>
    </message>
</context>
<context>
    <name>device.cannot-create-temporary-folder</name>
    <message>
        <source>cannot create a temporary folder ({})</source>
        <translation>يتعذّر إنشاء مجلد مؤقت (⁨{}⁩)</translation>
    </message>
</context>
<context>
    <name>device.cannot-remove-file</name>
    <message>
        <source>cannot remove the file ({})</source>
        <translation>يتعذّر حذف الملف (⁨{}⁩)</translation>
    </message>
</context>
<context>
    <name>device.cannot-reopen-video-device</name>
    <message>
        <source>the video device cannot be opened again</source>
        <translation>تتعذّر إعادة فتح جهاز الفيديو</translation>
    </message>
</context>
<context>
    <name>device.cannot-start-command</name>
    <message>
        <source>the command cannot be started ({})</source>
        <translation>يتعذّر بدء الأمر (⁨{}⁩)</translation>
    </message>
</context>
<context>
    <name>device.cannot-write-recording</name>
    <message>
        <source>the recording cannot be written ({})</source>
        <translation>تتعذّر كتابة التسجيل (⁨{}⁩)</translation>
    </message>
</context>
<context>
    <name>device.card-full</name>
    <message>
        <source>the camera has no room left for a photograph: its memory card is full</source>
        <translation>لم تبقَ في الكاميرا مساحة للقطة: بطاقة ذاكرتها ممتلئة</translation>
    </message>
</context>
<context>
    <name>device.change-or-empty-card</name>
    <message>
        <source>change or empty the memory card</source>
        <translation>غيّر بطاقة الذاكرة أو أفرغها</translation>
    </message>
</context>
<context>
    <name>device.charge-or-change-battery</name>
    <message>
        <source>charge or change the battery, or better, use a mains adapter, and switch the camera on again</source>
        <translation>اشحن البطارية أو غيّرها، والأفضل استخدام محوّل كهربائي، ثم شغّل الكاميرا مجددًا</translation>
    </message>
</context>
<context>
    <name>device.check-cable-and-power</name>
    <message>
        <source>check its cable and its power</source>
        <translation>افحص كابل الكاميرا وتغذيتها</translation>
    </message>
</context>
<context>
    <name>device.check-cable-and-power-saving</name>
    <message>
        <source>check its cable, and switch off its power saving</source>
        <translation>افحص كابل الشاشة، وأوقف توفير الطاقة فيها</translation>
    </message>
</context>
<context>
    <name>device.check-cable-network-and-programs</name>
    <message>
        <source>check the camera&apos;s cable and network card, and that no other program uses it</source>
        <translation>افحص كابل الكاميرا وبطاقة الشبكة، وتحقق من أن لا برنامج آخر يستخدم الكاميرا</translation>
    </message>
</context>
<context>
    <name>device.check-cable-power-address</name>
    <message>
        <source>check its cable, its power and its address; `relucent-cli devices` lists what is there</source>
        <translation>افحص كابل الكاميرا وتغذيتها وعنوانها؛ يسرد ⁨`relucent-cli devices`⁩ الأجهزة الموجودة</translation>
    </message>
</context>
<context>
    <name>device.check-projector-and-aim</name>
    <message>
        <source>check that the projector is on and shows that output, aim the camera at it, and take its cap off; or choose another screen</source>
        <translation>تحقق من أن جهاز العرض يعمل ويعرض هذا الخرج، ووجّه الكاميرا إلى صورته، وانزع غطاء عدستها؛ أو اختر شاشة أخرى</translation>
    </message>
</context>
<context>
    <name>device.check-projector-or-aim-another</name>
    <message>
        <source>check that this projector is on and shows that output, and aim a camera at it; or remove it from the venue</source>
        <translation>تحقق من أن جهاز العرض هذا يعمل ويعرض هذا المخرج، ووجّه كاميرا إليه؛ أو أزله من الموقع</translation>
    </message>
</context>
<context>
    <name>device.choose-gain-in-range</name>
    <message>
        <source>choose a gain from {} to {}</source>
        <translation>المتاح في الكاميرا من ⁨{}⁩ إلى ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.choose-offered-iso</name>
    <message>
        <source>choose one of those that it has: {}</source>
        <translation>القيم المتاحة: ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.choose-or-aim-at-screen</name>
    <message>
        <source>choose {}, or aim the camera at {}</source>
        <translation>اختر ⁨{}⁩، أو وجّه الكاميرا إلى ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.choose-readable-pixel-format</name>
    <message>
        <source>it has {}; unpacked Mono, Bayer and RGB of 8 to 16 bits are read</source>
        <translation>التنسيقات المتاحة: ⁨{}⁩؛ تُقرأ تنسيقات Mono وBayer وRGB غير المحزومة (unpacked) بعمق 8 إلى 16 بت</translation>
    </message>
</context>
<context>
    <name>device.claimed-exposures-invalid</name>
    <message>
        <source>the camera claims exposures of {} to {} s</source>
        <translation>تعلن الكاميرا عن تعريضات من ⁨{}⁩ إلى ⁨{}⁩ ث</translation>
    </message>
</context>
<context>
    <name>device.close-menus-and-live-view</name>
    <message>
        <source>close its menus and its playback, and leave live view</source>
        <translation>أغلق قوائم الكاميرا ووضع استعراض الصور فيها، وأنهِ المعاينة الحية</translation>
    </message>
</context>
<context>
    <name>device.close-menus-and-restart</name>
    <message>
        <source>close its menus, and switch it off and on</source>
        <translation>أغلق قوائم الكاميرا، ثم أطفئها وشغّلها</translation>
    </message>
</context>
<context>
    <name>device.close-other-program</name>
    <message>
        <source>close the other program, a camera viewer or a second Relucent perhaps</source>
        <translation>أغلق البرنامج الآخر، ربما عارض كاميرا أو نسخة ثانية من Relucent</translation>
    </message>
</context>
<context>
    <name>device.close-other-programs</name>
    <message>
        <source>close other programs and try again</source>
        <translation>أغلق البرامج الأخرى وحاول مجددًا</translation>
    </message>
</context>
<context>
    <name>device.colour-filter-not-bayer</name>
    <message>
        <source>the camera&apos;s colour filter is not a Bayer filter</source>
        <translation>مرشّح الألوان في الكاميرا ليس مرشّح Bayer</translation>
    </message>
</context>
<context>
    <name>device.command-failed</name>
    <message>
        <source>the command failed with status {}</source>
        <translation>فشل الأمر برمز الحالة ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.command-failed-saying</name>
    <message>
        <source>the command failed with status {}, saying &quot;{}&quot;</source>
        <translation>فشل الأمر برمز الحالة ⁨{}⁩، ورسالته: «⁨{}⁩»</translation>
    </message>
</context>
<context>
    <name>device.command-killed</name>
    <message>
        <source>the command was killed by signal {}</source>
        <translation>أُنهي الأمر قسرًا بالإشارة ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.command-killed-saying</name>
    <message>
        <source>the command was killed by signal {}, saying &quot;{}&quot;</source>
        <translation>أُنهي الأمر قسرًا بالإشارة ⁨{}⁩، ورسالته: «⁨{}⁩»</translation>
    </message>
</context>
<context>
    <name>device.command-too-long</name>
    <message>
        <source>the command took longer than {} s</source>
        <translation>استغرق الأمر أكثر من ⁨{}⁩ ث</translation>
    </message>
</context>
<context>
    <name>device.command-too-long-saying</name>
    <message>
        <source>the command took longer than {} s, saying &quot;{}&quot;</source>
        <translation>استغرق الأمر أكثر من ⁨{}⁩ ث، ورسالته: «⁨{}⁩»</translation>
    </message>
</context>
<context>
    <name>device.command-without-consent</name>
    <message>
        <source>the calibration runs a program to which nobody at this computer has agreed: {}</source>
        <translation>تُشغّل المعايرة برنامجًا لم يوافق عليه أحد على هذا الحاسوب: {}</translation>
    </message>
</context>
<context>
    <name>device.command-wrote-nothing</name>
    <message>
        <source>the command ended well but wrote nothing, not {}</source>
        <translation>انتهى الأمر بنجاح لكنه لم يكتب شيئًا، والمطلوب ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.command-wrote-something-else</name>
    <message>
        <source>the command ended well but wrote {}, not {}</source>
        <translation>انتهى الأمر بنجاح لكنه كتب ⁨{}⁩ وليس ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.copy-or-retake-photograph</name>
    <message>
        <source>copy it again, or take the photograph again; a camera newer than this LibRaw needs DNG files</source>
        <translation>انسخ الملف مجددًا، أو أعد التقاط اللقطة؛ الكاميرا الأحدث من إصدار LibRaw هذا تحتاج إلى ملفات DNG</translation>
    </message>
</context>
<context>
    <name>device.delivers-8-bits</name>
    <message>
        <source>delivers 8 bits: dark places stay uncertain</source>
        <translation>تعطي 8 بتات: تبقى المناطق المعتمة غير مؤكدة</translation>
    </message>
</context>
<context>
    <name>device.develop-linearly</name>
    <message>
        <source>develop the files linearly, as 16-bit TIFF, or use another camera</source>
        <translation>حوّل الملفات تحويلًا خطيًا إلى TIFF بعمق 16 بت، أو استخدم كاميرا أخرى</translation>
    </message>
</context>
<context>
    <name>device.exposure-range-invalid</name>
    <message>
        <source>the shortest exposure must be above zero and no longer than the longest</source>
        <translation>يجب أن يكون أقصر تعريض أكبر من الصفر وألا يتجاوز أطوله</translation>
    </message>
</context>
<context>
    <name>device.exposure-refused</name>
    <message>
        <source>the camera was asked to expose {} s but exposes {} s</source>
        <translation>طُلب من الكاميرا تعريض مدته ⁨{}⁩ ث لكنها تبقى على ⁨{}⁩ ث</translation>
    </message>
</context>
<context>
    <name>device.exposure-time-cannot-be-set</name>
    <message>
        <source>the camera&apos;s exposure time cannot be set</source>
        <translation>لا يمكن ضبط زمن التعريض في الكاميرا</translation>
    </message>
</context>
<context>
    <name>device.exposure-time-fixed</name>
    <message>
        <source>the camera exposes {} s whatever exposure it is asked for</source>
        <translation>تبقى الكاميرا على ⁨{}⁩ ث أيًا كان التعريض المطلوب</translation>
    </message>
</context>
<context>
    <name>device.focuses-by-itself</name>
    <message>
        <source>focuses by itself: switch its lens to manual focus</source>
        <translation>تضبط البؤرة تلقائيًا: حوّل العدسة إلى الضبط اليدوي</translation>
    </message>
</context>
<context>
    <name>device.free-space-or-record-elsewhere</name>
    <message>
        <source>free some space, or record elsewhere</source>
        <translation>أخلِ بعض المساحة، أو سجّل في مكان آخر</translation>
    </message>
</context>
<context>
    <name>device.free-space-or-set-tmpdir</name>
    <message>
        <source>free some space there, or set TMPDIR to a folder that you may write to</source>
        <translation>أخلِ بعض المساحة هناك، أو اجعل TMPDIR يشير إلى مجلد يمكنك الكتابة فيه</translation>
    </message>
</context>
<context>
    <name>device.gain-out-of-range</name>
    <message>
        <source>a gain of {} is wanted</source>
        <translation>المطلوب كسب مقداره ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.gain-refused</name>
    <message>
        <source>was asked for a gain of {} but uses {}</source>
        <translation>طُلب منها كسب {} وبقيت على {}</translation>
    </message>
</context>
<context>
    <name>device.genicam-missing</name>
    <message>
        <source>GigE Vision and USB3 Vision cameras: this build lacks Aravis; install libaravis-dev and build again</source>
        <translation>كاميرات GigE Vision وUSB3 Vision: ينقص هذا البناء Aravis؛ ثبّت libaravis-dev وأعد البناء</translation>
    </message>
</context>
<context>
    <name>device.gphoto-missing</name>
    <message>
        <source>DSLR and mirrorless cameras: this build lacks libgphoto2 or LibRaw; install libgphoto2-dev and libraw-dev and build again</source>
        <translation>كاميرات DSLR وعديمة المرآة: ينقص هذا البناء libgphoto2 أو LibRaw؛ ثبّت libgphoto2-dev وlibraw-dev وأعد البناء</translation>
    </message>
</context>
<context>
    <name>device.held-by-desktop</name>
    <message>
        <source>another program is using the camera, usually the desktop, which mounts it like a memory stick</source>
        <translation>برنامج آخر يحجز الكاميرا، وهو غالبًا سطح المكتب الذي يتعامل معها كذاكرة USB</translation>
    </message>
</context>
<context>
    <name>device.install-aravis</name>
    <message>
        <source>install Aravis (libaravis-dev) and build again, or use another kind of camera</source>
        <translation>ثبّت Aravis (⁨libaravis-dev⁩) وأعد بناء البرنامج، أو استخدم نوعًا آخر من الكاميرات</translation>
    </message>
</context>
<context>
    <name>device.install-libgphoto2</name>
    <message>
        <source>install libgphoto2 and LibRaw (libgphoto2-dev, libraw-dev) and build again, or use a command</source>
        <translation>ثبّت libgphoto2 وLibRaw (⁨libgphoto2-dev, libraw-dev⁩) وأعد بناء البرنامج، أو استخدم أمرًا</translation>
    </message>
</context>
<context>
    <name>device.iso-refused</name>
    <message>
        <source>was asked for ISO {} but uses ISO {}</source>
        <translation>طُلب منها ISO {} وبقيت على ISO {}</translation>
    </message>
</context>
<context>
    <name>device.iso-wanted-not-there</name>
    <message>
        <source>ISO {} is wanted and the camera does not have it</source>
        <translation>المطلوب ⁨ISO {}⁩ وهو غير متاح في الكاميرا</translation>
    </message>
</context>
<context>
    <name>device.lift-exposure-limits</name>
    <message>
        <source>switch its automatic exposure and its frame rate limit off</source>
        <translation>أوقف التعريض التلقائي وحدّ معدل الإطارات في الكاميرا</translation>
    </message>
</context>
<context>
    <name>device.longest-exposure-overstated</name>
    <message>
        <source>claims exposures up to {} s but reaches only {} s</source>
        <translation>تعلن تعريضًا يصل إلى {} ث لكنها تلتزم {} ث</translation>
    </message>
</context>
<context>
    <name>device.may-fire-flash</name>
    <message>
        <source>may fire its flash: close it</source>
        <translation>قد تُطلق وميضها: أغلقه</translation>
    </message>
</context>
<context>
    <name>device.may-take-dark-frame</name>
    <message>
        <source>may take a dark frame after long exposures, which doubles their time</source>
        <translation>قد تلتقط صورة معتمة بعد التعريض الطويل، ما يضاعف زمنه</translation>
    </message>
</context>
<context>
    <name>device.may-take-several-photographs</name>
    <message>
        <source>may take several photographs at once: switch it to single shots</source>
        <translation>قد تلتقط عدة صور دفعة واحدة: حوّلها إلى اللقطة المفردة</translation>
    </message>
</context>
<context>
    <name>device.mode-dial-not-manual</name>
    <message>
        <source>the camera&apos;s mode dial is set to {}, where the camera chooses exposures itself</source>
        <translation>قرص الأوضاع في الكاميرا على ⁨{}⁩، وفي هذا الوضع تختار الكاميرا التعريض بنفسها</translation>
    </message>
</context>
<context>
    <name>device.name-camera-by-port</name>
    <message>
        <source>name one by its port: gphoto2:{} or gphoto2:{}</source>
        <translation>حدّد إحداها بمنفذها: ⁨gphoto2:{}⁩ أو ⁨gphoto2:{}⁩</translation>
    </message>
</context>
<context>
    <name>device.name-connected-camera</name>
    <message>
        <source>name that one: gphoto2:{}</source>
        <translation>حدّد هذه الكاميرا: ⁨gphoto2:{}⁩</translation>
    </message>
</context>
<context>
    <name>device.no-capture-times</name>
    <message>
        <source>does not say when pictures were captured: some are dropped before each photograph</source>
        <translation>لا تذكر متى التُقطت الصور: يُهمَل بعضها قبل كل صورة</translation>
    </message>
</context>
<context>
    <name>device.no-contrast</name>
    <message>
        <source>the camera sees no difference between white and black</source>
        <translation>لا ترى الكاميرا فرقًا بين الأبيض والأسود</translation>
    </message>
</context>
<context>
    <name>device.no-focus</name>
    <message>
        <source>the camera could not focus and took no photograph ({})</source>
        <translation>لم تتمكن الكاميرا من ضبط التركيز فلم تلتقط أي لقطة (⁨{}⁩)</translation>
    </message>
</context>
<context>
    <name>device.no-genicam-camera-answers</name>
    <message>
        <source>no GenICam camera &apos;{}&apos; answers</source>
        <translation>لا تستجيب أي كاميرا GenICam باسم «⁨{}⁩»</translation>
    </message>
</context>
<context>
    <name>device.no-photograph-came</name>
    <message>
        <source>a photograph was asked for and none came</source>
        <translation>طُلبت لقطة ولم تصل</translation>
    </message>
</context>
<context>
    <name>device.no-raw-file-sent</name>
    <message>
        <source>the camera sent {} and no raw file</source>
        <translation>أرسلت الكاميرا ⁨{}⁩ ولم ترسل ملفًا خامًا</translation>
    </message>
</context>
<context>
    <name>device.no-raw-files</name>
    <message>
        <source>the camera does not deliver raw files</source>
        <translation>لا تعطي الكاميرا ملفات خام</translation>
    </message>
</context>
<context>
    <name>device.no-readable-pixel-format</name>
    <message>
        <source>none of the camera&apos;s pixel formats can be read</source>
        <translation>لا يمكن قراءة أي من تنسيقات البكسل في الكاميرا</translation>
    </message>
</context>
<context>
    <name>device.no-software-trigger</name>
    <message>
        <source>has no software trigger: each photograph may wait for one more exposure</source>
        <translation>ليس لها إطلاق برمجي: قد تنتظر كل صورة تعريضًا إضافيًا</translation>
    </message>
</context>
<context>
    <name>device.no-video-pictures</name>
    <message>
        <source>the video device sends no pictures</source>
        <translation>لا يرسل جهاز الفيديو أي صور</translation>
    </message>
</context>
<context>
    <name>device.only-other-camera-connected</name>
    <message>
        <source>no camera of this name is plugged in, but {} is</source>
        <translation>لا توجد كاميرا موصولة بهذا الاسم، بل ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.other-screen-seen</name>
    <message>
        <source>the camera sees {}, not {}</source>
        <translation>ترى الكاميرا ⁨{}⁩ وليس ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.part-of-sensor-lost</name>
    <message>
        <source>the camera does not go back to the part of the sensor that it had</source>
        <translation>لا تعود الكاميرا إلى جزء المستشعر الذي كان لها</translation>
    </message>
</context>
<context>
    <name>device.parts-lost-on-the-way</name>
    <message>
        <source>parts of the photograph were lost on the way</source>
        <translation>ضاعت أجزاء من اللقطة أثناء النقل</translation>
    </message>
</context>
<context>
    <name>device.photograph-attempts-failed</name>
    <message>
        <source>{} attempts at a photograph failed: {}</source>
        <translation>فشلت محاولات التقاط لقطة، وعددها ⁨{}⁩: {}</translation>
    </message>
</context>
<context>
    <name>device.photograph-exceeds-sensor</name>
    <message>
        <source>{} pixels are wanted and the camera has {}</source>
        <translation>المطلوب ⁨{}⁩ بكسل وفي الكاميرا ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.photograph-format-changed</name>
    <message>
        <source>the photograph has {} pixels as {} where {} as {} were agreed</source>
        <translation>حجم اللقطة ⁨{}⁩ بكسل بتنسيق ⁨{}⁩، والمتفق عليه ⁨{}⁩ بتنسيق ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.photograph-larger-than-announced</name>
    <message>
        <source>the photograph is larger than the camera announced</source>
        <translation>اللقطة أكبر مما أعلنته الكاميرا</translation>
    </message>
</context>
<context>
    <name>device.photograph-not-finished</name>
    <message>
        <source>the photograph was not finished</source>
        <translation>لم تكتمل اللقطة</translation>
    </message>
</context>
<context>
    <name>device.photograph-size-refused</name>
    <message>
        <source>{} pixels are wanted and the camera gives {}</source>
        <translation>المطلوب ⁨{}⁩ بكسل وتعطي الكاميرا ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.photograph-size-unexpected</name>
    <message>
        <source>the photograph has {} pixels where {} were announced</source>
        <translation>حجم اللقطة ⁨{}⁩ بكسل، والمعلن ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.photograph-timed-out</name>
    <message>
        <source>no photograph came within {} s</source>
        <translation>لم تصل أي لقطة خلال ⁨{}⁩ ث</translation>
    </message>
</context>
<context>
    <name>device.photograph-truncated</name>
    <message>
        <source>a photograph of {} pixels as {} came with {} of {} bytes</source>
        <translation>لقطة حجمها ⁨{}⁩ بكسل بتنسيق ⁨{}⁩ وصل منها ⁨{}⁩ من أصل ⁨{}⁩ بايت</translation>
    </message>
</context>
<context>
    <name>device.picture-not-settled</name>
    <message>
        <source>a new picture has not fully appeared after {} frames</source>
        <translation>لا تكتمل الصورة الجديدة حتى بعد هذا العدد من الإطارات: ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.pixel-format-lost</name>
    <message>
        <source>the camera has forgotten the pixel format that it was set to</source>
        <translation>نسيت الكاميرا تنسيق البكسل الذي ضُبطت عليه</translation>
    </message>
</context>
<context>
    <name>device.pixel-format-not-offered</name>
    <message>
        <source>the camera has no pixel format {} that can be read</source>
        <translation>ليس في الكاميرا تنسيق بكسل ⁨{}⁩ يمكن قراءته</translation>
    </message>
</context>
<context>
    <name>device.projector-command-empty</name>
    <message>
        <source>the projector&apos;s command is empty</source>
        <translation>أمر جهاز العرض فارغ</translation>
    </message>
</context>
<context>
    <name>device.projector-command-lacks</name>
    <message>
        <source>the projector&apos;s command does not contain {}</source>
        <translation>ينقص أمرَ جهاز العرض ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.projector-size-out-of-range</name>
    <message>
        <source>a projector of {} pixels is impossible: each side is {} to {}</source>
        <translation>لا وجود لجهاز عرض بحجم ⁨{}⁩ بكسل: كل ضلع من ⁨{}⁩ إلى ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.projector-unseen</name>
    <message>
        <source>no camera sees what is shown on {}</source>
        <translation>لا ترى أي كاميرا ما يُعرض على {}</translation>
    </message>
</context>
<context>
    <name>device.push-cable-in</name>
    <message>
        <source>push in the camera&apos;s cable at both ends</source>
        <translation>أحكم إدخال كابل الكاميرا من طرفيه</translation>
    </message>
</context>
<context>
    <name>device.raw-file-empty</name>
    <message>
        <source>it is empty</source>
        <translation>الملف فارغ</translation>
    </message>
</context>
<context>
    <name>device.raw-file-incomplete</name>
    <message>
        <source>parts of it are missing</source>
        <translation>أجزاء من الملف مفقودة</translation>
    </message>
</context>
<context>
    <name>device.raw-file-unreadable</name>
    <message>
        <source>the raw file cannot be read ({})</source>
        <translation>تتعذّر قراءة الملف الخام (⁨{}⁩)</translation>
    </message>
</context>
<context>
    <name>device.raw-file-without-sensor-values</name>
    <message>
        <source>the raw file does not hold the sensor&apos;s own values</source>
        <translation>لا يحوي الملف الخام قيم المستشعر نفسها</translation>
    </message>
</context>
<context>
    <name>device.reconnect-same-camera</name>
    <message>
        <source>connect the camera that the measurement was begun with</source>
        <translation>صِل الكاميرا التي بدأ بها القياس</translation>
    </message>
</context>
<context>
    <name>device.reconnected-camera-size-differs</name>
    <message>
        <source>the camera came back with {} pixels instead of {}</source>
        <translation>عادت الكاميرا بحجم ⁨{}⁩ بكسل بدلًا من ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.release-from-desktop</name>
    <message>
        <source>make the desktop release it with `gio mount -s gphoto2` (or eject it in the file manager) and close photo programs</source>
        <translation>حرّر الكاميرا من سطح المكتب بالأمر ⁨`gio mount -s gphoto2`⁩ (أو أخرجها من مدير الملفات) وأغلق برامج الصور</translation>
    </message>
</context>
<context>
    <name>device.remove-file-by-hand</name>
    <message>
        <source>remove it by hand, then try again</source>
        <translation>احذف الملف يدويًا، ثم حاول مجددًا</translation>
    </message>
</context>
<context>
    <name>device.request-refused</name>
    <message>
        <source>the camera refused what it was asked for ({})</source>
        <translation>رفضت الكاميرا ما طُلب منها (⁨{}⁩)</translation>
    </message>
</context>
<context>
    <name>device.restart-or-change-pixel-format</name>
    <message>
        <source>switch the camera off and on, or choose another of its pixel formats</source>
        <translation>أطفئ الكاميرا وشغّلها، أو اختر تنسيق بكسل آخر من تنسيقاتها</translation>
    </message>
</context>
<context>
    <name>device.restart-with-default-settings</name>
    <message>
        <source>switch it off and on, load its default settings with its maker&apos;s program, and try again</source>
        <translation>أطفئ الكاميرا وشغّلها، وحمّل إعداداتها الافتراضية ببرنامج الشركة المصنّعة، ثم حاول مجددًا</translation>
    </message>
</context>
<context>
    <name>device.run-command-in-terminal</name>
    <message>
        <source>run it in a terminal to find out why: {}</source>
        <translation>شغّل الأمر في الطرفية لمعرفة السبب: ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.screen-loses-picture</name>
    <message>
        <source>the projector&apos;s screen keeps losing its picture</source>
        <translation>تفقد شاشة جهاز العرض صورتها مرارًا</translation>
    </message>
</context>
<context>
    <name>device.screen-not-seen</name>
    <message>
        <source>the camera does not see what is shown on {}</source>
        <translation>لا ترى الكاميرا ما يُعرض على ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.screen-twice</name>
    <message>
        <source>screen {} is projector {} and projector {}: choose another screen</source>
        <translation>الشاشة {} هي جهاز العرض {} وجهاز العرض {}: اختر شاشة أخرى</translation>
    </message>
</context>
<context>
    <name>device.sees-no-colours</name>
    <message>
        <source>sees no colours: brightness can be compensated, colours cannot</source>
        <translation>لا ترى الألوان: يمكن تعويض السطوع دون الألوان</translation>
    </message>
</context>
<context>
    <name>device.set-iso-100</name>
    <message>
        <source>set it to ISO 100 by hand</source>
        <translation>اضبط الكاميرا على ISO 100 يدويًا</translation>
    </message>
</context>
<context>
    <name>device.set-manual-exposure-mode</name>
    <message>
        <source>set its exposure mode to timed and manual, or update its firmware</source>
        <translation>اضبط وضع التعريض في الكاميرا على المؤقّت واليدوي، أو حدّث برنامجها الثابت</translation>
    </message>
</context>
<context>
    <name>device.several-cameras-of-model</name>
    <message>
        <source>{} cameras of this model are plugged in</source>
        <translation>عدد الكاميرات الموصولة من هذا الطراز: ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.shortest-exposure-understated</name>
    <message>
        <source>claims exposures from {} s but does not go below {} s</source>
        <translation>تعلن تعريضًا يبدأ من {} ث لكنها تلتزم {} ث</translation>
    </message>
</context>
<context>
    <name>device.simulated-camera-unplugged</name>
    <message>
        <source>the camera&apos;s cable is out</source>
        <translation>كابل الكاميرا مفصول</translation>
    </message>
</context>
<context>
    <name>device.steady-view-and-expose-briefly</name>
    <message>
        <source>check that the camera&apos;s view is steady and its exposure short, and switch the projector&apos;s smoothing of motion off</source>
        <translation>تحقق من أن مشهد الكاميرا ثابت وأن تعريضها قصير، وأوقف تنعيم الحركة في جهاز العرض</translation>
    </message>
</context>
<context>
    <name>device.switch-off-automatic-exposure</name>
    <message>
        <source>switch its automatic exposure off; a camera without manual exposure cannot be used</source>
        <translation>أوقف التعريض التلقائي في الكاميرا؛ لا يمكن استخدام كاميرا بلا تعريض يدوي</translation>
    </message>
</context>
<context>
    <name>device.switch-off-with-makers-program</name>
    <message>
        <source>switch it off with the camera maker&apos;s program, or use another camera</source>
        <translation>أوقفه ببرنامج الشركة المصنّعة للكاميرا، أو استخدم كاميرا أخرى</translation>
    </message>
</context>
<context>
    <name>device.switch-off-with-v4l2-ctl</name>
    <message>
        <source>switch it off with v4l2-ctl (--list-ctrls names what it has), or use another camera</source>
        <translation>أوقفه باستخدام ⁨v4l2-ctl⁩ (يسرد الخيار ⁨--list-ctrls⁩ ما هو متاح)، أو استخدم كاميرا أخرى</translation>
    </message>
</context>
<context>
    <name>device.switch-on-and-keep-awake</name>
    <message>
        <source>check its cable, switch it on and disable its automatic power-off</source>
        <translation>افحص كابل الكاميرا، وشغّلها، وأوقف إطفاءها التلقائي</translation>
    </message>
</context>
<context>
    <name>device.switch-quality-to-raw</name>
    <message>
        <source>switch its picture quality to RAW by hand; a camera without RAW cannot be used</source>
        <translation>اضبط جودة الصور في الكاميرا على RAW يدويًا؛ لا يمكن استخدام كاميرا بلا RAW</translation>
    </message>
</context>
<context>
    <name>device.switch-to-full-size-raw</name>
    <message>
        <source>switch the camera to full-size RAW (no sRAW, mRAW, no linear DNG)</source>
        <translation>اضبط الكاميرا على RAW بالحجم الكامل (لا sRAW ولا mRAW ولا DNG خطي)</translation>
    </message>
</context>
<context>
    <name>device.switch-to-manual-focus</name>
    <message>
        <source>switch its lens to manual focus</source>
        <translation>اضبط عدسة الكاميرا على التركيز اليدوي</translation>
    </message>
</context>
<context>
    <name>device.switches-itself-off</name>
    <message>
        <source>switches itself off after a while: switch that off</source>
        <translation>تنطفئ تلقائيًا بعد مدة: عطّل ذلك</translation>
    </message>
</context>
<context>
    <name>device.take-photograph-by-hand</name>
    <message>
        <source>switch its lens to manual focus, close its menus, and take a photograph by hand to see what it complains of</source>
        <translation>اضبط عدسة الكاميرا على التركيز اليدوي، وأغلق قوائمها، والتقط لقطة يدويًا لترى المشكلة التي تبلّغ عنها</translation>
    </message>
</context>
<context>
    <name>device.then-go-on</name>
    <message>
        <source>{}, then go on: every photograph so far is kept</source>
        <translation>{}، ثم تابع: كل اللقطات حتى الآن محفوظة</translation>
    </message>
</context>
<context>
    <name>device.trial-photograph-failed</name>
    <message>
        <source>the camera was asked for a photograph and took none</source>
        <translation>طُلبت من الكاميرا لقطة فلم تلتقطها</translation>
    </message>
</context>
<context>
    <name>device.turn-dial-or-change-camera</name>
    <message>
        <source>turn its mode dial to M; a camera without manual exposure cannot be used</source>
        <translation>أدر قرص الأوضاع في الكاميرا إلى M؛ لا يمكن استخدام كاميرا بلا هذا الوضع</translation>
    </message>
</context>
<context>
    <name>device.turn-dial-to-m</name>
    <message>
        <source>turn it to M</source>
        <translation>أدر القرص إلى M</translation>
    </message>
</context>
<context>
    <name>device.use-manual-exposure-camera</name>
    <message>
        <source>use a camera with manual exposure</source>
        <translation>استخدم كاميرا ذات تعريض يدوي</translation>
    </message>
</context>
<context>
    <name>device.video-device</name>
    <message>
        <source>video device</source>
        <translation>جهاز فيديو</translation>
    </message>
</context>
<context>
    <name>device.video-device-in-use</name>
    <message>
        <source>the video device cannot be opened: another program may be using it</source>
        <translation>يتعذّر فتح جهاز الفيديو: قد يكون برنامج آخر يستخدمه</translation>
    </message>
</context>
<context>
    <name>device.video-device-missing</name>
    <message>
        <source>no such video device is plugged in</source>
        <translation>لا يوجد جهاز فيديو موصول بهذا الاسم</translation>
    </message>
</context>
<context>
    <name>device.video-device-unplugged</name>
    <message>
        <source>the video device has been unplugged</source>
        <translation>فُصل جهاز الفيديو</translation>
    </message>
</context>
<context>
    <name>device.video-exposure-not-settable</name>
    <message>
        <source>the video device has no exposure that can be set</source>
        <translation>ليس في جهاز الفيديو تعريض يمكن ضبطه</translation>
    </message>
</context>
<context>
    <name>device.video-size-refused</name>
    <message>
        <source>{} pixels are wanted and the video device gives {}</source>
        <translation>المطلوب ⁨{}⁩ بكسل ويعطي جهاز الفيديو ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>device.wake-camera</name>
    <message>
        <source>press its shutter button half way or switch it off and on, and disable its automatic power-off</source>
        <translation>اضغط زر الغالق في الكاميرا حتى منتصفه أو أطفئها وشغّلها، وأوقف إطفاءها التلقائي</translation>
    </message>
</context>
<context>
    <name>device.write-announced-size</name>
    <message>
        <source>let the command write that size, or begin again with the size that the camera delivers</source>
        <translation>اجعل الأمر يكتب بهذا الحجم، أو ابدأ من جديد بالحجم الذي تعطيه الكاميرا</translation>
    </message>
</context>
<context>
    <name>device.write-photograph-to-output</name>
    <message>
        <source>let it write the photograph to {output}: {}</source>
        <translation>اجعل الأمر يكتب اللقطة في ⁨{output}⁩: ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>disk.cannot-create-folder</name>
    <message>
        <source>cannot create the folder ({})</source>
        <translation>يتعذّر إنشاء المجلد (⁨{}⁩)</translation>
    </message>
</context>
<context>
    <name>disk.cannot-open</name>
    <message>
        <source>cannot open ({})</source>
        <translation>يتعذّر الفتح (⁨{}⁩)</translation>
    </message>
</context>
<context>
    <name>disk.cannot-read</name>
    <message>
        <source>cannot read ({})</source>
        <translation>تتعذّر القراءة (⁨{}⁩)</translation>
    </message>
</context>
<context>
    <name>disk.cannot-write</name>
    <message>
        <source>cannot write ({})</source>
        <translation>تتعذّر الكتابة (⁨{}⁩)</translation>
    </message>
</context>
<context>
    <name>disk.check-disk-and-cable</name>
    <message>
        <source>check the disk and its cable</source>
        <translation>افحص القرص وكابله</translation>
    </message>
</context>
<context>
    <name>disk.check-path</name>
    <message>
        <source>check the path</source>
        <translation>تحقق من المسار</translation>
    </message>
</context>
<context>
    <name>disk.check-path-and-disk</name>
    <message>
        <source>check the path and the disk</source>
        <translation>تحقق من المسار والقرص</translation>
    </message>
</context>
<context>
    <name>disk.choose-scratch-folder</name>
    <message>
        <source>let the environment variable TMPDIR name a folder on a disk that you may write to; what has been photographed is safe</source>
        <translation>اجعل متغيّر البيئة TMPDIR يسمّي مجلدًا على قرص يمكنك الكتابة عليه؛ ما صُوِّر محفوظ</translation>
    </message>
</context>
<context>
    <name>disk.choose-writable-folder</name>
    <message>
        <source>choose a folder that you may write to, or ask for the permission</source>
        <translation>اختر مجلدًا يمكنك الكتابة فيه، أو اطلب الإذن بذلك</translation>
    </message>
</context>
<context>
    <name>disk.free-scratch-room</name>
    <message>
        <source>free some space there; what has been photographed is safe</source>
        <translation>أفرغ بعض المساحة هناك؛ ما صُوِّر محفوظ</translation>
    </message>
</context>
<context>
    <name>disk.free-space-or-check-disk</name>
    <message>
        <source>free some space there or check the disk, then try again</source>
        <translation>أخلِ بعض المساحة هناك أو افحص القرص، ثم حاول مجددًا</translation>
    </message>
</context>
<context>
    <name>disk.free-space-or-choose-another</name>
    <message>
        <source>free some space there or choose another disk, then try again</source>
        <translation>أخلِ بعض المساحة هناك أو اختر قرصًا آخر، ثم حاول مجددًا</translation>
    </message>
</context>
<context>
    <name>disk.no-scratch-room</name>
    <message>
        <source>there is no room for intermediate results ({})</source>
        <translation>لا توجد مساحة للنتائج الوسيطة ({})</translation>
    </message>
</context>
<context>
    <name>duration.hours-minutes</name>
    <message>
        <source>{} h {} min</source>
        <translation>{} س {} د</translation>
    </message>
</context>
<context>
    <name>duration.minutes</name>
    <message>
        <source>{} min</source>
        <translation>{} د</translation>
    </message>
</context>
<context>
    <name>duration.seconds</name>
    <message>
        <source>{} s</source>
        <translation>{} ث</translation>
    </message>
</context>
<context>
    <name>duration.under-a-minute</name>
    <message>
        <source>under a minute</source>
        <translation>أقل من دقيقة</translation>
    </message>
</context>
<context>
    <name>engine.compute-on-processor</name>
    <message>
        <source>compute on the processor instead</source>
        <translation>دع المعالج المركزي يتولى العمل</translation>
    </message>
</context>
<context>
    <name>engine.graphics-buffer-too-large</name>
    <message>
        <source>the graphics card can hold {} MB in one piece, but {} MB are needed</source>
        <translation>تصل بطاقة الرسومات إلى ⁨{} MB⁩ دفعة واحدة، والمطلوب ⁨{} MB⁩</translation>
    </message>
</context>
<context>
    <name>engine.graphics-card-lost</name>
    <message>
        <source>the graphics card was lost</source>
        <translation>انقطع الاتصال ببطاقة الرسومات</translation>
    </message>
</context>
<context>
    <name>engine.graphics-card-unusable</name>
    <message>
        <source>the graphics card cannot be used</source>
        <translation>لا يمكن استخدام بطاقة الرسومات</translation>
    </message>
</context>
<context>
    <name>engine.graphics-memory-exhausted</name>
    <message>
        <source>the graphics card has no {} MB of memory left</source>
        <translation>لم يبقَ في بطاقة الرسومات ⁨{} MB⁩ من الذاكرة</translation>
    </message>
</context>
<context>
    <name>engine.install-driver</name>
    <message>
        <source>install the graphics card&apos;s driver, or compute on the processor</source>
        <translation>ثبّت برنامج تشغيل بطاقة الرسومات، أو دع المعالج المركزي يتولى العمل</translation>
    </message>
</context>
<context>
    <name>engine.no-graphics-card</name>
    <message>
        <source>there is no graphics card with OpenGL 4.3 and compute shaders</source>
        <translation>لا توجد بطاقة رسومات تدعم OpenGL 4.3 ومظلّلات الحوسبة (compute shaders)</translation>
    </message>
</context>
<context>
    <name>engine.no-libegl-or-libopengl</name>
    <message>
        <source>there is no libEGL or no libOpenGL, which open graphics cards without a display</source>
        <translation>المكتبة libEGL أو libOpenGL غير موجودة، وهما تفتحان بطاقات الرسومات دون شاشة</translation>
    </message>
</context>
<context>
    <name>engine.no-opengl</name>
    <message>
        <source>there is no OpenGL 4.3 with compute shaders</source>
        <translation>لا يتوفر OpenGL 4.3 مع مظلّلات الحوسبة (compute shaders)</translation>
    </message>
</context>
<context>
    <name>import.camera-taken-as-linear</name>
    <message>
        <source>The camera is taken to be linear, and one photograph counts as one second of exposure</source>
        <translation>تُفترض الكاميرا خطية، وتُحسب اللقطة الواحدة ثانيةَ تعريضٍ واحدة</translation>
    </message>
</context>
<context>
    <name>import.lit-share</name>
    <message>
        <source>The projector lights {} % of the camera&apos;s pixels</source>
        <translation>يضيء جهاز العرض ⁨{} %⁩ من بكسلات الكاميرا</translation>
    </message>
</context>
<context>
    <name>import.paired-by-time</name>
    <message>
        <source>The photographs were paired with the patterns in the order in which they were taken, from {} to {}, which is not that of their names</source>
        <translation>قُرنت اللقطات بالأنماط بترتيب التقاطها، من ⁨{}⁩ إلى ⁨{}⁩، وهو غير ترتيب أسمائها</translation>
    </message>
</context>
<context>
    <name>import.patterns-and-photographs-grey</name>
    <message>
        <source>Patterns and photographs are grey: colours are not told apart, and T&apos;s blocks are neutral</source>
        <translation>الأنماط واللقطات رمادية: لا تُميَّز الألوان، وكتل T محايدة</translation>
    </message>
</context>
<context>
    <name>import.patterns-black-and-white</name>
    <message>
        <source>The patterns hold black and white only: the projector&apos;s response is assumed to be a gamma of 2.2</source>
        <translation>لا تحوي الأنماط سوى الأسود والأبيض: تُفترض استجابة جهاز العرض أُسًّا قدره ⁨2.2⁩</translation>
    </message>
</context>
<context>
    <name>import.patterns-grey</name>
    <message>
        <source>The patterns are grey: how colours mix was not measured, and T&apos;s blocks are diagonal</source>
        <translation>الأنماط رمادية: لم يُقَس كيف تمتزج الألوان، وكتل T قطرية</translation>
    </message>
</context>
<context>
    <name>import.photographs-are-jpeg</name>
    <message>
        <source>The photographs are JPEG: they were made linear by the curve of sRGB, which cameras follow only roughly; develop them linearly, as TIFF or EXR, to measure more exactly</source>
        <translation>اللقطات بصيغة JPEG: جُعلت خطية بمنحنى sRGB الذي لا تتبعه الكاميرات إلا تقريبًا؛ حمّضها خطيًا بصيغة TIFF أو EXR لقياس أدق</translation>
    </message>
</context>
<context>
    <name>import.photographs-grey</name>
    <message>
        <source>The photographs are grey: what each of the projector&apos;s colours contributes is known in brightness only</source>
        <translation>اللقطات رمادية: ما يسهم به كل لون من ألوان جهاز العرض معروف سطوعًا فقط</translation>
    </message>
</context>
<context>
    <name>linearization.choose-overlapping-exposures</name>
    <message>
        <source>set them to ranges of exposure times that overlap</source>
        <translation>اضبط الكاميرات على نطاقات متداخلة من أزمنة التعريض</translation>
    </message>
</context>
<context>
    <name>linearization.halves-brighter-than-whole</name>
    <message>
        <source>{}: two halves of a picture are {} % brighter than the whole; switch off the dynamic iris, dynamic contrast and any picture mode that adapts to the content</source>
        <translation>⁨{}⁩: نصفا الصورة أسطع من الصورة كاملةً بمقدار ⁨{} %⁩؛ أوقف القزحية الديناميكية والتباين الديناميكي وكل وضع صورة يتكيّف مع المحتوى</translation>
    </message>
</context>
<context>
    <name>linearization.halves-darker-than-whole</name>
    <message>
        <source>{}: two halves of a picture are {} % darker than the whole; switch off the dynamic iris, dynamic contrast and any picture mode that adapts to the content</source>
        <translation>⁨{}⁩: نصفا الصورة أعتم من الصورة كاملةً بمقدار ⁨{} %⁩؛ أوقف القزحية الديناميكية والتباين الديناميكي وكل وضع صورة يتكيّف مع المحتوى</translation>
    </message>
</context>
<context>
    <name>linearization.highlights-overexposed</name>
    <message>
        <source>{}: some highlights are overexposed even at {} s, the shortest exposure, and will not be compensated; close the aperture or add a grey filter if they matter</source>
        <translation>⁨{}⁩: بعض اللمعات مفرطة التعريض حتى عند ⁨{}⁩ ث، وهو أقصر تعريض، ولن تُعوَّض؛ أغلق فتحة العدسة أو أضف مرشحًا رماديًا إن كانت مهمة</translation>
    </message>
</context>
<context>
    <name>linearization.light-flickers</name>
    <message>
        <source>{}: the light changes by {} % from one photograph to the next; switch off the projector&apos;s dynamic lamp modes and other lamps nearby, and choose exposure times that are multiples of the mains period</source>
        <translation>⁨{}⁩: يتغيّر الضوء بمقدار ⁨{} %⁩ من لقطة إلى التي تليها؛ أوقف أوضاع المصباح الديناميكية في جهاز العرض وأطفئ المصابيح القريبة، واختر أزمنة تعريض من مضاعفات دورة التيار الكهربائي</translation>
    </message>
</context>
<context>
    <name>linearization.no-common-exposure</name>
    <message>
        <source>the cameras have no exposure time in common</source>
        <translation>لا يوجد زمن تعريض مشترك بين الكاميرات</translation>
    </message>
</context>
<context>
    <name>linearization.overexposed</name>
    <message>
        <source>{}: the projection is overexposed even at {} s, the shortest exposure; close the aperture, lower the gain or add a grey filter</source>
        <translation>⁨{}⁩: الإسقاط مفرط التعريض حتى عند ⁨{}⁩ ث، وهو أقصر تعريض؛ أغلق فتحة العدسة أو اخفض الكسب أو أضف مرشحًا رماديًا</translation>
    </message>
</context>
<context>
    <name>linearization.response-uneven</name>
    <message>
        <source>{}: the brightness curves are not the same everywhere in its picture, by up to {} % of white; switch off uniformity correction, local dimming and edge blending in the projector</source>
        <translation>⁨{}⁩: منحنيات السطوع ليست واحدةً في كل أنحاء الصورة، والفرق يصل إلى ⁨{} %⁩ من الأبيض؛ أوقف في جهاز العرض تصحيح التجانس والتعتيم الموضعي ودمج الحواف</translation>
    </message>
</context>
<context>
    <name>linearization.underexposed</name>
    <message>
        <source>{}: the projection reaches only {} % of the camera&apos;s range at {} s, the longest exposure; open the aperture or raise the gain</source>
        <translation>⁨{}⁩: لا يبلغ الإسقاط سوى ⁨{} %⁩ من مدى الكاميرا عند ⁨{}⁩ ث، وهو أطول تعريض؛ افتح فتحة العدسة أو ارفع الكسب</translation>
    </message>
</context>
<context>
    <name>linearization.white-brighter-than-colours</name>
    <message>
        <source>{}: white is {} % brighter than red, green and blue together; switch off the white segment (often called brilliant colour or bright mode) and choose a picture mode for video or sRGB</source>
        <translation>⁨{}⁩: الأبيض أسطع من الأحمر والأخضر والأزرق مجتمعةً بمقدار ⁨{} %⁩؛ أوقف مقطع الأبيض (يسمى غالبًا «Brilliant Color» أو الوضع الساطع) واختر وضع صورة للفيديو أو لـ sRGB</translation>
    </message>
</context>
<context>
    <name>linearization.white-darker-than-colours</name>
    <message>
        <source>{}: white is {} % darker than red, green and blue together; switch off power saving, colour management and dynamic picture modes</source>
        <translation>⁨{}⁩: الأبيض أعتم من الأحمر والأخضر والأزرق مجتمعةً بمقدار ⁨{} %⁩؛ أوقف توفير الطاقة وإدارة الألوان وأوضاع الصورة الديناميكية</translation>
    </message>
</context>
<context>
    <name>masks.draw-again</name>
    <message>
        <source>draw it again, or correct the file</source>
        <translation>ارسمه من جديد أو صحّح الملف</translation>
    </message>
</context>
<context>
    <name>masks.unknown-key</name>
    <message>
        <source>mask {} has &quot;{}&quot;, which this version does not know</source>
        <translation>في القناع {} «{}»، وهذا الإصدار لا يعرفه</translation>
    </message>
</context>
<context>
    <name>masks.unreadable</name>
    <message>
        <source>mask {} cannot be read: it needs points as [[x, y], ...], and may have camera, outline and feather</source>
        <translation>تتعذّر قراءة القناع {}: يحتاج إلى points بالشكل [[x, y], ...]، ويجوز أن يكون له camera وoutline وfeather</translation>
    </message>
</context>
<context>
    <name>night.hours-began</name>
    <message>
        <source>the show&apos;s hours began before it was done</source>
        <translation>بدأت ساعات العرض قبل أن تنتهي</translation>
    </message>
</context>
<context>
    <name>night.missed</name>
    <message>
        <source>it could not begin within two hours of its time: the show did not run, or the computer slept</source>
        <translation>لم يمكن البدء خلال ساعتين من الموعد: لم يكن العرض يعمل، أو كان الحاسوب في وضع السكون</translation>
    </message>
</context>
<context>
    <name>night.not-as-predicted</name>
    <message>
        <source>the picture has a colour error of {} where {} was predicted, and no repair helped</source>
        <translation>خطأ ألوان الصورة {} بينما كان المتوقع {}، ولم يُفِد أي إصلاح</translation>
    </message>
</context>
<context>
    <name>night.part-not-as-predicted</name>
    <message>
        <source>a part of the surface looks otherwise than predicted, by a colour error of {}, and no repair helped</source>
        <translation>جزء من السطح يبدو على غير ما تُوقِّع، بخطأ لوني قدره {}، ولم يُجدِ أي إصلاح</translation>
    </message>
</context>
<context>
    <name>night.too-long</name>
    <message>
        <source>it was not done within six hours</source>
        <translation>لم تنتهِ خلال ست ساعات</translation>
    </message>
</context>
<context>
    <name>perfect.camera-blinded</name>
    <message>
        <source>something blinds the camera: {} of its view is overexposed</source>
        <translation>شيء يبهر الكاميرا: {} من صورتها زائد التعريض</translation>
    </message>
</context>
<context>
    <name>perfect.camera-moved</name>
    <message>
        <source>the view of camera {} has moved by {}, {} pixels since the venue was measured</source>
        <translation>تحرك مجال رؤية الكاميرا {} بمقدار {} و{} بكسل منذ القياس</translation>
    </message>
</context>
<context>
    <name>perfect.light-missing</name>
    <message>
        <source>light is missing: is the lens covered, or a projector asleep?</source>
        <translation>ينقص ضوء: هل العدسة مغطاة أم أن جهاز عرض في وضع السكون؟</translation>
    </message>
</context>
<context>
    <name>perfect.something-else</name>
    <message>
        <source>the camera sees something else than expected: did somebody stand in the light, or did the room&apos;s light change?</source>
        <translation>ترى الكاميرا شيئًا غير المتوقع: هل وقف أحد في الضوء أم تغيّر ضوء القاعة؟</translation>
    </message>
</context>
<context>
    <name>pjlink.address-twice</name>
    <message>
        <source>projectors {} and {} have the same address, {}</source>
        <translation>لجهازي العرض {} و{} العنوان نفسه، {}</translation>
    </message>
</context>
<context>
    <name>pjlink.cannot-search</name>
    <message>
        <source>projectors cannot be searched ({})</source>
        <translation>تعذّر البحث عن أجهزة العرض ({})</translation>
    </message>
</context>
<context>
    <name>pjlink.check-address-and-port</name>
    <message>
        <source>check the address and the port of the projector</source>
        <translation>تحقق من عنوان جهاز العرض ومنفذه</translation>
    </message>
</context>
<context>
    <name>pjlink.check-lens</name>
    <message>
        <source>check lens caps, shutter and input of the projector, and where the camera looks</source>
        <translation>تحقق من أغطية العدسات ومن مصراع جهاز العرض ومدخله، ومن اتجاه الكاميرا</translation>
    </message>
</context>
<context>
    <name>pjlink.check-network</name>
    <message>
        <source>check its address, its network cable, and that PJLink and the network in standby are switched on in its menu</source>
        <translation>تحقق من عنوانه ومن كابل شبكته، ومن أن PJLink والشبكة في وضع الاستعداد مفعّلان في قائمته</translation>
    </message>
</context>
<context>
    <name>pjlink.check-own-network</name>
    <message>
        <source>check this computer&apos;s network, or give the projector&apos;s address</source>
        <translation>تحقق من شبكة هذا الحاسوب، أو أعطِ عنوان جهاز العرض</translation>
    </message>
</context>
<context>
    <name>pjlink.choose-class-one-authentication</name>
    <message>
        <source>choose the authentication of PJLink class 1 in its menu, or none</source>
        <translation>اختر في قائمته مصادقة PJLink من الفئة 1، أو بلا مصادقة</translation>
    </message>
</context>
<context>
    <name>pjlink.closed</name>
    <message>
        <source>it closed the connection</source>
        <translation>أغلق الاتصال</translation>
    </message>
</context>
<context>
    <name>pjlink.end-dimming</name>
    <message>
        <source>switch off its dynamic contrast, lamp dimming and eco modes, and daylight in the room; or measure without waiting for its lamp</source>
        <translation>أوقف التباين الديناميكي وتعتيم المصباح وأوضاع التوفير، واحجب ضوء النهار عن الغرفة؛ أو قِس دون انتظار مصباحه</translation>
    </message>
</context>
<context>
    <name>pjlink.frozen</name>
    <message>
        <source>projector {} freezes its picture: end that in its menu</source>
        <translation>جهاز العرض {} يجمّد صورته: ألغِ ذلك في قائمته</translation>
    </message>
</context>
<context>
    <name>pjlink.give-password</name>
    <message>
        <source>give the PJLink password that is set in its menu</source>
        <translation>أعطِ كلمة مرور PJLink المضبوطة في قائمته</translation>
    </message>
</context>
<context>
    <name>pjlink.light-drifts</name>
    <message>
        <source>the light of projector {} still drifts by {} % within {} s after {} s</source>
        <translation>لا يزال ضوء جهاز العرض {0} يتغيّر بنسبة {1} % خلال {2} ث بعد {3} ث</translation>
    </message>
</context>
<context>
    <name>pjlink.light-unseen</name>
    <message>
        <source>no camera sees light of projector {}</source>
        <translation>لا ترى أي كاميرا ضوء جهاز العرض {}</translation>
    </message>
</context>
<context>
    <name>pjlink.look-at-projector</name>
    <message>
        <source>look at its lamps and its menu</source>
        <translation>انظر إلى مؤشراته وقائمته</translation>
    </message>
</context>
<context>
    <name>pjlink.more-than-projectors</name>
    <message>
        <source>projector {} on the network is none of the {} that there are</source>
        <translation>جهاز العرض {} على الشبكة ليس واحداً من الأجهزة الـ{} الموجودة</translation>
    </message>
</context>
<context>
    <name>pjlink.newer-authentication</name>
    <message>
        <source>the projector at {} asks for its password in a way that this version does not know</source>
        <translation>جهاز العرض في {} يطلب كلمة مروره بطريقة لا يعرفها هذا الإصدار</translation>
    </message>
</context>
<context>
    <name>pjlink.no-answer</name>
    <message>
        <source>the projector at {} does not answer ({})</source>
        <translation>جهاز العرض في {} لا يجيب ({})</translation>
    </message>
</context>
<context>
    <name>pjlink.no-signal</name>
    <message>
        <source>projector {} has no signal at its input {}: choose the input of this computer</source>
        <translation>جهاز العرض {} لا إشارة في مدخله {}: اختر مدخل هذا الحاسوب</translation>
    </message>
</context>
<context>
    <name>pjlink.not-native</name>
    <message>
        <source>projector {} receives {} pixels and has {}: it scales the picture, which blurs the compensation; send it its own size</source>
        <translation>جهاز العرض {} يستقبل {} بكسل ولديه {}: فهو يغيّر مقياس الصورة مما يطمس التعويض؛ أرسل إليه مقاسه الأصلي</translation>
    </message>
</context>
<context>
    <name>pjlink.not-on</name>
    <message>
        <source>projector {} was told to switch on and is not on after {} s</source>
        <translation>أُمر جهاز العرض {} بالتشغيل ولم يعمل بعد {} ث</translation>
    </message>
</context>
<context>
    <name>pjlink.not-pjlink</name>
    <message>
        <source>what answers at {} does not speak PJLink</source>
        <translation>ما يجيب في {} لا يتحدث PJLink</translation>
    </message>
</context>
<context>
    <name>pjlink.open-shutter-by-hand</name>
    <message>
        <source>open it at the projector, and start again</source>
        <translation>افتحه من جهاز العرض، ثم ابدأ من جديد</translation>
    </message>
</context>
<context>
    <name>pjlink.other-signal</name>
    <message>
        <source>projector {} receives {} pixels where {} are sent: something between scales the picture, or it shows another input</source>
        <translation>جهاز العرض {} يستقبل {} بكسل بينما يُرسَل {}: شيء بينهما يغيّر مقياس الصورة، أو أنه يعرض مدخلاً آخر</translation>
    </message>
</context>
<context>
    <name>pjlink.own-failure</name>
    <message>
        <source>the projector at {} reports a failure of its own</source>
        <translation>جهاز العرض في {} يبلّغ عن عطل فيه</translation>
    </message>
</context>
<context>
    <name>pjlink.part-cover</name>
    <message>
        <source>cover open</source>
        <translation>الغطاء مفتوح</translation>
    </message>
</context>
<context>
    <name>pjlink.part-fan</name>
    <message>
        <source>fan</source>
        <translation>المروحة</translation>
    </message>
</context>
<context>
    <name>pjlink.part-filter</name>
    <message>
        <source>filter</source>
        <translation>المرشّح</translation>
    </message>
</context>
<context>
    <name>pjlink.part-lamp</name>
    <message>
        <source>lamp</source>
        <translation>المصباح</translation>
    </message>
</context>
<context>
    <name>pjlink.part-other</name>
    <message>
        <source>something else</source>
        <translation>شيء آخر</translation>
    </message>
</context>
<context>
    <name>pjlink.part-temperature</name>
    <message>
        <source>temperature</source>
        <translation>الحرارة</translation>
    </message>
</context>
<context>
    <name>pjlink.reports-error</name>
    <message>
        <source>projector {} reports an error: {}</source>
        <translation>جهاز العرض {} يبلّغ عن خطأ: {}</translation>
    </message>
</context>
<context>
    <name>pjlink.reports-warning</name>
    <message>
        <source>projector {} warns: {}</source>
        <translation>جهاز العرض {} يحذّر: {}</translation>
    </message>
</context>
<context>
    <name>pjlink.shutter-stays-closed</name>
    <message>
        <source>the shutter of projector {} does not open</source>
        <translation>مصراع جهاز العرض {} لا ينفتح</translation>
    </message>
</context>
<context>
    <name>pjlink.still-warming</name>
    <message>
        <source>projector {} is still warming up or cooling down after {} s</source>
        <translation>لا يزال جهاز العرض {} يُحمّى أو يبرد بعد {} ث</translation>
    </message>
</context>
<context>
    <name>pjlink.switch-on-by-hand</name>
    <message>
        <source>look at its lamps and its menu, switch it on by hand, and start again</source>
        <translation>انظر إلى مؤشراته وقائمته، وشغّله يدوياً، ثم ابدأ من جديد</translation>
    </message>
</context>
<context>
    <name>pjlink.too-slow</name>
    <message>
        <source>nothing complete came in time</source>
        <translation>لم يصل شيء كامل في الوقت المناسب</translation>
    </message>
</context>
<context>
    <name>pjlink.wants-password</name>
    <message>
        <source>the projector at {} asks for a password</source>
        <translation>جهاز العرض في {} يطلب كلمة مرور</translation>
    </message>
</context>
<context>
    <name>pjlink.wrong-password</name>
    <message>
        <source>the projector at {} refuses the password</source>
        <translation>جهاز العرض في {} يرفض كلمة المرور</translation>
    </message>
</context>
<context>
    <name>reduction.binned</name>
    <message>
        <source>of the camera&apos;s {} pixels, {} are made: of the part around what is lit, every {} become one</source>
        <translation>من بكسلات الكاميرا وعددها ⁨{}⁩ تنتج ⁨{}⁩: في الجزء المضاء وما حوله يصير كل ⁨{}⁩ بكسلًا واحدًا</translation>
    </message>
</context>
<context>
    <name>reduction.binned-for-memory</name>
    <message>
        <source>of the camera&apos;s {} pixels, {} are made: every {} become one, as there is memory for no more</source>
        <translation>من بكسلات الكاميرا وعددها ⁨{}⁩ تنتج ⁨{}⁩: يصير كل ⁨{}⁩ بكسلًا واحدًا لأن الذاكرة لا تتسع لأكثر</translation>
    </message>
</context>
<context>
    <name>reduction.cropped</name>
    <message>
        <source>of the camera&apos;s {} pixels, the {} around what is lit are used</source>
        <translation>من بكسلات الكاميرا وعددها ⁨{}⁩ تُستخدم ⁨{}⁩ المحيطة بالجزء المضاء</translation>
    </message>
</context>
<context>
    <name>reduction.fewer-camera-pixels</name>
    <message>
        <source>choose fewer camera pixels: automatic ones are as many as fit</source>
        <translation>اختر بكسلات أقل للكاميرا: الاختيار التلقائي يأخذ ما تتسع له الذاكرة</translation>
    </message>
</context>
<context>
    <name>reduction.memory-too-little</name>
    <message>
        <source>measuring would take {} GB of memory, and {} GB may be taken</source>
        <translation>يحتاج القياس إلى ⁨{} GB⁩ من الذاكرة، والمتاح ⁨{} GB⁩</translation>
    </message>
</context>
<context>
    <name>reduction.more-memory-or-smaller-projector</name>
    <message>
        <source>use a computer or a limit with more memory, or a projector signal of fewer pixels</source>
        <translation>استخدم حاسوبًا أو حدًّا بذاكرة أكبر، أو إشارة للعارض ببكسلات أقل</translation>
    </message>
</context>
<context>
    <name>reduction.other-size</name>
    <message>
        <source>the camera delivers {} pixels where {} were calibrated</source>
        <translation>تعطي الكاميرا ⁨{}⁩ بكسل، بينما جرت المعايرة بعدد ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>reduction.restore-camera-size</name>
    <message>
        <source>set the camera to the size that it had, or calibrate again</source>
        <translation>اضبط الكاميرا على الحجم السابق، أو أعد المعايرة</translation>
    </message>
</context>
<context>
    <name>relucent::gui::AcquirePage</name>
    <message>
        <source>Paused, %1</source>
        <translation>متوقف مؤقتًا، %1</translation>
    </message>
    <message>
        <source>Measuring, %1</source>
        <translation>جارٍ القياس، %1</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s), %1</source>
        <translation>
            <numerusform>لا أنماط، %1</numerusform>
            <numerusform>نمط واحد، %1</numerusform>
            <numerusform>نمطان، %1</numerusform>
            <numerusform>%n أنماط، %1</numerusform>
            <numerusform>%n نمطًا، %1</numerusform>
            <numerusform>%n نمط، %1</numerusform>
        </translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>تم القياس</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>بحاجة إلى تحديث</translation>
    </message>
    <message>
        <source>Stopped by a failure</source>
        <translation>توقف بسبب عطل</translation>
    </message>
    <message>
        <source>Waiting for you. Nothing is being projected.</source>
        <translation>بانتظارك. لا يُعرض شيء.</translation>
    </message>
    <message>
        <source>Every photograph is saved. Threshold opens when the last is taken.</source>
        <translation>كل اللقطات محفوظة. تُفتح العتبة بعد التقاط الأخيرة.</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>الأجهزة مستخدمة في خطوة «%1».</translation>
    </message>
    <message>
        <source>Measured in %1</source>
        <translation>مدة القياس: %1</translation>
    </message>
    <message>
        <source>Leave the room dark and still, then start.</source>
        <translation>اترك القاعة مظلمة وساكنة، ثم ابدأ.</translation>
    </message>
    <message>
        <source>Show threshold</source>
        <translation>إظهار العتبة</translation>
    </message>
    <message>
        <source>Resume</source>
        <translation>استئناف</translation>
    </message>
    <message>
        <source>Start measuring</source>
        <translation>بدء القياس</translation>
    </message>
    <message>
        <source>Stop and keep</source>
        <translation>إيقاف مع الاحتفاظ</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>إيقاف مؤقت</translation>
    </message>
    <message>
        <source>This measurement belongs to earlier settings</source>
        <translation>هذا القياس يعود إلى إعدادات سابقة</translation>
    </message>
    <message>
        <source>It still works and stays until the new one is ready.</source>
        <translation>ما زال صالحًا، ويبقى حتى يجهز القياس الجديد.</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>إعادة القياس</translation>
    </message>
    <message>
        <source>The last session ended before it was finished</source>
        <translation>انتهت الجلسة الأخيرة قبل اكتمال القياس</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>لم يتغيّر شيء.</translation>
    </message>
    <message>
        <source>Fineness</source>
        <translation>الدقة</translation>
    </message>
    <message>
        <source>Acquire</source>
        <translation>القياس</translation>
    </message>
    <message>
        <source>Measure how every projector pixel lights every camera pixel. Leave the room dark and still.</source>
        <translation>قِس كيف يضيء كل بكسل في جهاز العرض كل بكسل في الكاميرا. اترك القاعة مظلمة وساكنة.</translation>
    </message>
    <message>
        <source>Sent to the projector</source>
        <translation>المرسل إلى جهاز العرض</translation>
    </message>
    <message>
        <source>Seen by the camera</source>
        <translation>ما تراه الكاميرا</translation>
    </message>
    <message>
        <source>Pattern that the projector shows</source>
        <translation>النمط الذي يعرضه جهاز العرض</translation>
    </message>
    <message>
        <source>Last photograph</source>
        <translation>اللقطة الأخيرة</translation>
    </message>
    <message>
        <source>Appears when measuring begins. Nothing is projected before you start.</source>
        <translation>تظهر عند بدء القياس. لا يُعرض شيء قبل أن تبدأ.</translation>
    </message>
    <message>
        <source>How finely</source>
        <translation>مستوى الدقة</translation>
    </message>
    <message>
        <source>Fast</source>
        <translation>سريع</translation>
    </message>
    <message>
        <source>a first look; misses weak bounces</source>
        <translation>نظرة أولى؛ تفوته الانعكاسات الضعيفة</translation>
    </message>
    <message>
        <source>Usual</source>
        <translation>معتاد</translation>
    </message>
    <message>
        <source>suits most surfaces</source>
        <translation>يناسب معظم الأسطح</translation>
    </message>
    <message>
        <source>Fine</source>
        <translation>دقيق</translation>
    </message>
    <message>
        <source>glass, gloss, deep corners</source>
        <translation>زجاج، لمعان، زوايا عميقة</translation>
    </message>
    <message>
        <source>Disk still needed</source>
        <translation>مساحة القرص اللازمة</translation>
    </message>
    <message>
        <source>Watching</source>
        <translation>المراقبة</translation>
    </message>
    <message>
        <source>Paused</source>
        <translation>متوقف مؤقتًا</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>جارٍ القياس</translation>
    </message>
    <message>
        <source>about %1</source>
        <translation>نحو %1</translation>
    </message>
    <message>
        <source>alarm beyond</source>
        <translation>إنذار بعد هذا الحد</translation>
    </message>
    <message>
        <source>taken again</source>
        <translation>أُعيد التقاطه</translation>
    </message>
    <message>
        <source>During the measurement</source>
        <translation>أثناء القياس</translation>
    </message>
    <message>
        <source>light that would spoil photographs</source>
        <translation>ضوء قد يفسد الصور</translation>
    </message>
    <message>
        <source>Minutes</source>
        <translation>الدقائق</translation>
    </message>
    <message>
        <source>Room light, % of full light</source>
        <translation>إضاءة القاعة، % من الإضاءة الكاملة</translation>
    </message>
    <message>
        <source>Room light during the measurement</source>
        <translation>إضاءة القاعة أثناء القياس</translation>
    </message>
    <message>
        <source>Taken again</source>
        <translation>أُعيد التقاطه</translation>
    </message>
    <message numerus="yes">
        <source>About %n pattern(s), %1. Leave the room dark and still.</source>
        <translation>
            <numerusform>لا أنماط، %1. اترك الغرفة معتمة وساكنة.</numerusform>
            <numerusform>نحو نمط واحد، %1. اترك الغرفة معتمة وساكنة.</numerusform>
            <numerusform>نحو نمطين، %1. اترك الغرفة معتمة وساكنة.</numerusform>
            <numerusform>نحو %n أنماط، %1. اترك الغرفة معتمة وساكنة.</numerusform>
            <numerusform>نحو %n نمطًا، %1. اترك الغرفة معتمة وساكنة.</numerusform>
            <numerusform>نحو %n نمط، %1. اترك الغرفة معتمة وساكنة.</numerusform>
        </translation>
    </message>
    <message>
        <source>What was measured</source>
        <translation>ما قيس</translation>
    </message>
    <message>
        <source>Patterns</source>
        <translation>الأنماط</translation>
    </message>
    <message>
        <source>Error of the test patterns</source>
        <translation>خطأ أنماط الاختبار</translation>
    </message>
    <message>
        <source>Continue anyway</source>
        <translation>المتابعة رغم ذلك</translation>
    </message>
    <message>
        <source>Found while measuring</source>
        <translation>ما وُجد أثناء القياس</translation>
    </message>
    <message numerus="yes">
        <source>Begins in %n second(s)</source>
        <translation>
            <numerusform>يبدأ الآن</numerusform>
            <numerusform>يبدأ بعد ثانية واحدة</numerusform>
            <numerusform>يبدأ بعد ثانيتين</numerusform>
            <numerusform>يبدأ بعد %n ثوانٍ</numerusform>
            <numerusform>يبدأ بعد %n ثانية</numerusform>
            <numerusform>يبدأ بعد %n ثانية</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Measuring begins in %n second(s). Leave the room dark and still.</source>
        <translation>
            <numerusform>يبدأ القياس الآن. اترك القاعة مظلمة وساكنة.</numerusform>
            <numerusform>يبدأ القياس بعد ثانية واحدة. اترك القاعة مظلمة وساكنة.</numerusform>
            <numerusform>يبدأ القياس بعد ثانيتين. اترك القاعة مظلمة وساكنة.</numerusform>
            <numerusform>يبدأ القياس بعد %n ثوانٍ. اترك القاعة مظلمة وساكنة.</numerusform>
            <numerusform>يبدأ القياس بعد %n ثانية. اترك القاعة مظلمة وساكنة.</numerusform>
            <numerusform>يبدأ القياس بعد %n ثانية. اترك القاعة مظلمة وساكنة.</numerusform>
        </translation>
    </message>
    <message>
        <source>Start now</source>
        <translation>ابدأ الآن</translation>
    </message>
    <message>
        <source>Not now</source>
        <translation>ليس الآن</translation>
    </message>
    <message numerus="yes">
        <source>Compared with the start every %n pattern(s). What changed is photographed again; if that does not help, the measurement pauses and asks.</source>
        <translation>
            <numerusform>لا تُجرى مقارنة بالبداية.</numerusform>
            <numerusform>يُقارَن بالبداية بعد كل نمط. يُعاد تصوير ما تغيّر؛ فإن لم ينفع ذلك يتوقف القياس مؤقتًا ويسألك.</numerusform>
            <numerusform>يُقارَن بالبداية كل نمطين. يُعاد تصوير ما تغيّر؛ فإن لم ينفع ذلك يتوقف القياس مؤقتًا ويسألك.</numerusform>
            <numerusform>يُقارَن بالبداية كل %n أنماط. يُعاد تصوير ما تغيّر؛ فإن لم ينفع ذلك يتوقف القياس مؤقتًا ويسألك.</numerusform>
            <numerusform>يُقارَن بالبداية كل %n نمطًا. يُعاد تصوير ما تغيّر؛ فإن لم ينفع ذلك يتوقف القياس مؤقتًا ويسألك.</numerusform>
            <numerusform>يُقارَن بالبداية كل %n نمط. يُعاد تصوير ما تغيّر؛ فإن لم ينفع ذلك يتوقف القياس مؤقتًا ويسألك.</numerusform>
        </translation>
    </message>
    <message>
        <source>Start</source>
        <translation>البدء</translation>
    </message>
    <message>
        <source>Leave the room first</source>
        <translation>مغادرة القاعة أولًا</translation>
    </message>
    <message>
        <source>Time to leave the room before measuring begins</source>
        <translation>الوقت المتاح لمغادرة القاعة قبل بدء القياس</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 ث</translation>
    </message>
    <message>
        <source>A sound when it ends or needs me</source>
        <translation>صوت عند الانتهاء أو عند الحاجة إليّ</translation>
    </message>
    <message>
        <source>Ready</source>
        <translation>الجاهزية</translation>
    </message>
    <message>
        <source>Dark enough</source>
        <translation>مظلم بما يكفي</translation>
    </message>
    <message>
        <source>Room light is %1 of full light, limit %2.</source>
        <translation>ضوء القاعة %1 من الضوء الكامل، والحد %2.</translation>
    </message>
    <message>
        <source>It is too bright here</source>
        <translation>المكان ساطع أكثر من اللازم</translation>
    </message>
    <message>
        <source>Room light is %1 of full light. Cover windows and lamps: less light, less noise.</source>
        <translation>ضوء القاعة %1 من الضوء الكامل. غطِّ النوافذ والمصابيح: كلما قل الضوء قلت الضوضاء.</translation>
    </message>
    <message>
        <source>Needs %1 of %2.</source>
        <translation>يحتاج إلى %1 من %2.</translation>
    </message>
    <message>
        <source>Room on the disk</source>
        <translation>مساحة القرص كافية</translation>
    </message>
    <message>
        <source>The disk is too full</source>
        <translation>القرص ممتلئ</translation>
    </message>
    <message>
        <source>Floodlight image</source>
        <translation>صورة الضوء الكامل</translation>
    </message>
    <message>
        <source>the projector fully white</source>
        <translation>جهاز العرض أبيض بالكامل</translation>
    </message>
    <message>
        <source>The surface in the projector&apos;s full light</source>
        <translation>السطح في الضوء الكامل لجهاز العرض</translation>
    </message>
    <message>
        <source>%1 px</source>
        <translation>%1 بكسل</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 من %2</translation>
    </message>
    <message>
        <source>Level %1 of %2, %3 of %4 patterns.</source>
        <translation>المستوى %1 من %2، %3 من %4 نمطًا.</translation>
    </message>
    <message>
        <source>Patterns for each block size</source>
        <translation>الأنماط لكل حجم كتلة</translation>
    </message>
    <message>
        <source>blocks are divided only where light needs it</source>
        <translation>لا تُقسَّم الكتل إلا حيث يقتضي الضوء</translation>
    </message>
    <message>
        <source>Stopped at %1 px</source>
        <translation>أُوقف عند ⁨%1 px⁩</translation>
    </message>
    <message>
        <source>Measuring was stopped at blocks of %1 px</source>
        <translation>أُوقف القياس عند كتل من ⁨%1 px⁩</translation>
    </message>
    <message>
        <source>Finer light is missing. Go on any time, if nothing has moved.</source>
        <translation>ينقص الضوء الأدق. تابع في أي وقت ما لم يتحرّك شيء.</translation>
    </message>
    <message numerus="yes">
        <source>%1 dB expected, about %2 dB with %n more photograph(s), %3. Go on any time, if nothing has moved.</source>
        <translation>
            <numerusform>المتوقع ⁨%1 dB⁩، ونحو ⁨%2 dB⁩ بلا لقطات أخرى، %3. تابع في أي وقت ما لم يتحرّك شيء.</numerusform>
            <numerusform>المتوقع ⁨%1 dB⁩، ونحو ⁨%2 dB⁩ مع لقطة واحدة أخرى، %3. تابع في أي وقت ما لم يتحرّك شيء.</numerusform>
            <numerusform>المتوقع ⁨%1 dB⁩، ونحو ⁨%2 dB⁩ مع لقطتين أخريين، %3. تابع في أي وقت ما لم يتحرّك شيء.</numerusform>
            <numerusform>المتوقع ⁨%1 dB⁩، ونحو ⁨%2 dB⁩ مع %n لقطات أخرى، %3. تابع في أي وقت ما لم يتحرّك شيء.</numerusform>
            <numerusform>المتوقع ⁨%1 dB⁩، ونحو ⁨%2 dB⁩ مع %n لقطة أخرى، %3. تابع في أي وقت ما لم يتحرّك شيء.</numerusform>
            <numerusform>المتوقع ⁨%1 dB⁩، ونحو ⁨%2 dB⁩ مع %n لقطة أخرى، %3. تابع في أي وقت ما لم يتحرّك شيء.</numerusform>
        </translation>
    </message>
    <message>
        <source>Pictures expected at</source>
        <translation>الصور متوقعة عند</translation>
    </message>
    <message>
        <source>rough</source>
        <translation>خشن</translation>
    </message>
    <message>
        <source>fair</source>
        <translation>مقبول</translation>
    </message>
    <message>
        <source>good</source>
        <translation>جيد</translation>
    </message>
    <message>
        <source>very good</source>
        <translation>جيد جدًا</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1، %2</translation>
    </message>
    <message>
        <source>%1 dB</source>
        <translation>⁨%1 dB⁩</translation>
    </message>
    <message>
        <source>dB says how close the picture comes to the one wanted, where it can be reached at all: 20 dB looks rough, 30 dB good, and every 6 dB halve what is off.</source>
        <translation>تبيّن dB مدى قرب الصورة من المطلوبة حيث يمكن بلوغها: تبدو 20 dB خشنة و30 dB جيدة، وكل 6 dB إضافية تنصّف الفرق.</translation>
    </message>
    <message>
        <source>Compensated so far</source>
        <translation>المعوَّض حتى الآن</translation>
    </message>
    <message>
        <source>A picture, compensated with what is measured so far</source>
        <translation>صورة معوَّضة بما قيس حتى الآن</translation>
    </message>
    <message>
        <source>Appears after the first patterns, and grows sharper.</source>
        <translation>تظهر بعد الأنماط الأولى وتزداد حدّة.</translation>
    </message>
    <message>
        <source>Expected now</source>
        <translation>المتوقع الآن</translation>
    </message>
    <message>
        <source>Blocks of %1 px. Expected now: %2. In the end: %3.</source>
        <translation>كتل من ⁨%1 px⁩. المتوقع الآن: %2. في النهاية: %3.</translation>
    </message>
    <message>
        <source>In the end</source>
        <translation>في النهاية</translation>
    </message>
    <message>
        <source>Waiting for room on the disk. Nothing is being projected.</source>
        <translation>بانتظار مساحة على القرص. لا يُعرض شيء.</translation>
    </message>
    <message>
        <source>Go on now</source>
        <translation>تابع الآن</translation>
    </message>
    <message>
        <source>Photographs to keep</source>
        <translation>اللقطات المحفوظة</translation>
    </message>
    <message>
        <source>Photographs to keep once all is measured</source>
        <translation>اللقطات التي تُحفظ بعد اكتمال القياس</translation>
    </message>
    <message>
        <source>All</source>
        <translation>الكل</translation>
    </message>
    <message>
        <source>Of the latest measurement</source>
        <translation>لقطات آخر قياس</translation>
    </message>
    <message>
        <source>None: results only</source>
        <translation>لا شيء: النتائج فقط</translation>
    </message>
    <message>
        <source>Those that were set aside by measuring again are removed once all is measured.</source>
        <translation>اللقطات التي نُحّيت عند إعادة القياس تُحذف بعد اكتمال القياس.</translation>
    </message>
    <message>
        <source>Removed once all is measured. Other settings then have to photograph everything again.</source>
        <translation>تُحذف بعد اكتمال القياس. وعندئذ يلزم تصوير كل شيء من جديد عند تغيير الإعدادات.</translation>
    </message>
    <message>
        <source>Measuring with other settings then needs fewer new photographs.</source>
        <translation>عندئذ يحتاج القياس بإعدادات أخرى إلى لقطات جديدة أقل.</translation>
    </message>
    <message>
        <source>Those of the last measurement were removed: all are taken again.</source>
        <translation>حُذفت لقطات القياس الأخير: ستُلتقط كلها من جديد.</translation>
    </message>
    <message>
        <source>Waiting for the projector&apos;s screen.</source>
        <translation>في انتظار شاشة جهاز العرض.</translation>
    </message>
    <message>
        <source>Every photograph is saved. The earlier measurement is used until the new one is ready.</source>
        <translation>كل اللقطات محفوظة. يُستخدم القياس السابق حتى يجهز الجديد.</translation>
    </message>
    <message>
        <source>To go on measuring, confirm that the room is clear.</source>
        <translation>لمتابعة القياس أكّد أن القاعة خالية.</translation>
    </message>
    <message>
        <source>Takes every photograph again. What is measured stays until then.</source>
        <translation>يعيد التقاط كل اللقطات. ويبقى ما قيس حتى ذلك الحين.</translation>
    </message>
    <message>
        <source>Measuring again has not ended</source>
        <translation>لم تنتهِ إعادة القياس</translation>
    </message>
    <message>
        <source>Measuring with these settings.</source>
        <translation>يجري القياس بهذه الإعدادات.</translation>
    </message>
    <message>
        <source>Waiting for the camera.</source>
        <translation>في انتظار الكاميرا.</translation>
    </message>
    <message>
        <source>Keep the earlier one</source>
        <translation>الاحتفاظ بالسابق</translation>
    </message>
    <message>
        <source>The earlier measurement is used again, with all that followed from it.</source>
        <translation>يُستخدم القياس السابق مجددًا مع كل ما ترتّب عليه.</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>كل ما تم قياسه آمن.</translation>
    </message>
    <message>
        <source>Paused, about %1 left</source>
        <translation>متوقف مؤقتًا، بقي نحو ⁨%1⁩</translation>
    </message>
    <message>
        <source>%1 of about %2</source>
        <translation>⁨%1⁩ من نحو ⁨%2⁩</translation>
    </message>
    <message>
        <source>About %1 left</source>
        <translation>بقي نحو ⁨%1⁩</translation>
    </message>
    <message>
        <source>Ends near %1. %2</source>
        <translation>ينتهي نحو ⁨%1⁩. ⁨%2⁩</translation>
    </message>
    <message>
        <source>Put the camera back</source>
        <translation>أعد الكاميرا إلى مكانها</translation>
    </message>
    <message>
        <source>Test patterns are predicted from the measurement, then photographed: this is how far the two differ, the photographs&apos; noise included.</source>
        <translation>تُتوقَّع أنماط الاختبار من القياس ثم تُصوَّر: هذا هو الفرق بينهما، بما فيه ضجيج اللقطات.</translation>
    </message>
    <message>
        <source>%1; light right within about %2</source>
        <translation>%1؛ الضوء صحيح في حدود %2 تقريبًا</translation>
    </message>
    <message>
        <source>Reading, %1</source>
        <translation>قراءة، ⁨%1⁩</translation>
    </message>
    <message>
        <source>Waiting for your answer. Every photograph is saved.</source>
        <translation>بانتظار جوابك. كل اللقطات محفوظة.</translation>
    </message>
    <message>
        <source>Go on measuring</source>
        <translation>متابعة القياس</translation>
    </message>
    <message>
        <source>Answer</source>
        <translation>الإجابة</translation>
    </message>
    <message>
        <source>Try again</source>
        <translation>إعادة المحاولة</translation>
    </message>
    <message>
        <source>The camera is back at its place</source>
        <translation>عادت الكاميرا إلى موضعها</translation>
    </message>
    <message>
        <source>It had moved while it measured, and looks again where it looked.</source>
        <translation>كانت قد تحرّكت أثناء القياس، وهي ترى الآن ما كانت تراه.</translation>
    </message>
    <message numerus="yes">
        <source>“%1” photographs %n pattern(s) again, from No. %2 on, and goes on from there.</source>
        <translation>
            <numerusform>«⁨%1⁩»: لا يُعاد تصوير أي نمط من رقم ⁨%2⁩، ويستمر القياس.</numerusform>
            <numerusform>«⁨%1⁩»: يُعاد تصوير نمط واحد بدءًا من رقم ⁨%2⁩، ويستمر القياس من هناك.</numerusform>
            <numerusform>«⁨%1⁩»: يُعاد تصوير نمطين بدءًا من رقم ⁨%2⁩، ويستمر القياس من هناك.</numerusform>
            <numerusform>«⁨%1⁩»: يُعاد تصوير %n أنماط بدءًا من رقم ⁨%2⁩، ويستمر القياس من هناك.</numerusform>
            <numerusform>«⁨%1⁩»: يُعاد تصوير %n نمطًا بدءًا من رقم ⁨%2⁩، ويستمر القياس من هناك.</numerusform>
            <numerusform>«⁨%1⁩»: يُعاد تصوير %n نمط بدءًا من رقم ⁨%2⁩، ويستمر القياس من هناك.</numerusform>
        </translation>
    </message>
    <message>
        <source>“%1” looks once more, and goes on.</source>
        <translation>«⁨%1⁩»: يُنظر مرة أخرى ثم يستمر القياس.</translation>
    </message>
    <message>
        <source>“%1” keeps all as it is: what changed will be wrong, and the report says so.</source>
        <translation>«⁨%1⁩»: يبقى كل شيء كما هو، وما تغيّر سيكون خاطئًا، ويذكره التقرير.</translation>
    </message>
    <message>
        <source>Measuring waits for your answer.</source>
        <translation>القياس بانتظار جوابك.</translation>
    </message>
    <message>
        <source>Kept photographs are read first.</source>
        <translation>تُقرأ اللقطات المحفوظة أولًا.</translation>
    </message>
    <message>
        <source>Nothing is being projected.</source>
        <translation>لا يُعرض شيء الآن.</translation>
    </message>
    <message>
        <source>Reading</source>
        <translation>قراءة</translation>
    </message>
    <message>
        <source>Reading, under a minute left</source>
        <translation>قراءة، بقي أقل من دقيقة</translation>
    </message>
    <message>
        <source>Reading, about %1 left</source>
        <translation>قراءة، بقي نحو ⁨%1⁩</translation>
    </message>
    <message>
        <source>Paused, under a minute left</source>
        <translation>متوقف مؤقتًا، بقي أقل من دقيقة</translation>
    </message>
    <message>
        <source>Under a minute left</source>
        <translation>بقي أقل من دقيقة</translation>
    </message>
    <message>
        <source>%1 expected</source>
        <translation>المتوقع ⁨%1⁩</translation>
    </message>
    <message>
        <source>To measure again, confirm that the room is clear.</source>
        <translation>للقياس من جديد أكّد أن القاعة خالية.</translation>
    </message>
    <message>
        <source>%1, %2 a minute</source>
        <translation>⁨%1⁩، ⁨%2⁩ في الدقيقة</translation>
    </message>
    <message>
        <source>all projectors fully white</source>
        <translation>جميع أجهزة العرض بيضاء بالكامل</translation>
    </message>
    <message>
        <source>Reading what was measured</source>
        <translation>قراءة ما قيس</translation>
    </message>
    <message>
        <source>The camera is at its place</source>
        <translation>الكاميرا في مكانها</translation>
    </message>
    <message>
        <source>It looks where it looked. Perhaps the light flickered.</source>
        <translation>تنظر إلى حيث كانت تنظر. ربما ارتعش الضوء.</translation>
    </message>
    <message>
        <source>Ended by a change</source>
        <translation>أنهاه تغيّر</translation>
    </message>
    <message>
        <source>Put right what changed, then go on measuring.</source>
        <translation>أصلح ما تغيّر، ثم تابع القياس.</translation>
    </message>
    <message>
        <source>Measure again as it stands now, or put it back and go on measuring.</source>
        <translation>أعد القياس على الوضع الحالي، أو أعده إلى مكانه وتابع القياس.</translation>
    </message>
    <message>
        <source>Measuring was stopped at blocks of %1 px: something had changed</source>
        <translation>أُوقف القياس عند كتل ⁨%1 px⁩: تغيّر شيء</translation>
    </message>
    <message>
        <source>Measuring ended, and something had changed</source>
        <translation>انتهى القياس وقد تغيّر شيء</translation>
    </message>
    <message>
        <source>What was photographed since the look before is left out, all before it is kept.</source>
        <translation>يُترك ما صُوّر منذ الفحص السابق، ويبقى كل ما قبله.</translation>
    </message>
    <message>
        <source>Working out, %1</source>
        <translation>جارٍ الحساب، %1</translation>
    </message>
    <message>
        <source>Working out the result</source>
        <translation>جارٍ حساب النتيجة</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s)</source>
        <translation>
            <numerusform>لا أنماط</numerusform>
            <numerusform>نمط واحد</numerusform>
            <numerusform>نمطان</numerusform>
            <numerusform>%n أنماط</numerusform>
            <numerusform>%n نمطًا</numerusform>
            <numerusform>%n نمط</numerusform>
        </translation>
    </message>
    <message>
        <source>Waits for an answer</source>
        <translation>بانتظار الجواب</translation>
    </message>
    <message>
        <source>%1 too bright</source>
        <translation>%1 ساطع جدًا</translation>
    </message>
    <message>
        <source>%1 left out</source>
        <translation>%1 مستبعَد</translation>
    </message>
    <message>
        <source>Waiting for your answer.</source>
        <translation>بانتظار جوابك.</translation>
    </message>
    <message>
        <source>Stop and keep this one</source>
        <translation>إيقاف مع الاحتفاظ بهذا</translation>
    </message>
    <message>
        <source>Going on has not ended</source>
        <translation>لم تنتهِ المتابعة</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s) expected, %1 of them checks; known exactly as each level begins</source>
        <translation>
            <numerusform>لا أنماط متوقعة، منها للفحص: %1؛ يُعرف بالضبط عند بدء كل مستوى</numerusform>
            <numerusform>نمط واحد متوقع، منها للفحص: %1؛ يُعرف بالضبط عند بدء كل مستوى</numerusform>
            <numerusform>نمطان متوقعان، منها للفحص: %1؛ يُعرف بالضبط عند بدء كل مستوى</numerusform>
            <numerusform>%n أنماط متوقعة، منها للفحص: %1؛ يُعرف بالضبط عند بدء كل مستوى</numerusform>
            <numerusform>%n نمطًا متوقعًا، منها للفحص: %1؛ يُعرف بالضبط عند بدء كل مستوى</numerusform>
            <numerusform>%n نمط متوقع، منها للفحص: %1؛ يُعرف بالضبط عند بدء كل مستوى</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s), %1 of them checks</source>
        <translation>
            <numerusform>لا أنماط، منها للفحص: %1</numerusform>
            <numerusform>نمط واحد، منها للفحص: %1</numerusform>
            <numerusform>نمطان، منها للفحص: %1</numerusform>
            <numerusform>%n أنماط، منها للفحص: %1</numerusform>
            <numerusform>%n نمطًا، منها للفحص: %1</numerusform>
            <numerusform>%n نمط، منها للفحص: %1</numerusform>
        </translation>
    </message>
    <message>
        <source>Ending</source>
        <translation>جارٍ الإنهاء</translation>
    </message>
    <message>
        <source>Measure with these settings</source>
        <translation>القياس بهذه الإعدادات</translation>
    </message>
    <message>
        <source>Use the earlier one</source>
        <translation>استخدام السابق</translation>
    </message>
    <message>
        <source>Waiting</source>
        <translation>في الانتظار</translation>
    </message>
    <message>
        <source>Waiting, under a minute left</source>
        <translation>في الانتظار، بقي أقل من دقيقة</translation>
    </message>
    <message>
        <source>Waiting, about %1 left</source>
        <translation>في الانتظار، بقي نحو ⁨%1⁩</translation>
    </message>
    <message>
        <source>Keep the new ones</source>
        <translation>الاحتفاظ بالجديدة</translation>
    </message>
    <message>
        <source>Keep the earlier measurement?</source>
        <translation>الاحتفاظ بالقياس السابق؟</translation>
    </message>
    <message>
        <source>The new photographs are set aside and not used again: measuring again then takes every photograph again.</source>
        <translation>تُنحّى اللقطات الجديدة جانبًا ولا تُستخدم مجددًا: وإعادة القياس تعيد عندئذ التقاط كل اللقطات.</translation>
    </message>
    <message>
        <source>The earlier measurement, and all that followed from it.</source>
        <translation>القياس السابق وكل ما ترتّب عليه.</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s) kept</source>
        <translation>
            <numerusform>لم يُحفظ أي نمط</numerusform>
            <numerusform>حُفظ نمط واحد</numerusform>
            <numerusform>حُفظ نمطان</numerusform>
            <numerusform>حُفظت %n أنماط</numerusform>
            <numerusform>حُفظ %n نمطًا</numerusform>
            <numerusform>حُفظ %n نمط</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The photographs of %n pattern(s) are read first. Then measuring goes on where it ended.</source>
        <translation>
            <numerusform>لا لقطات سابقة تُقرأ. يستمر القياس من حيث انتهى.</numerusform>
            <numerusform>تُقرأ أولًا لقطات نمط واحد، ثم يستمر القياس من حيث انتهى.</numerusform>
            <numerusform>تُقرأ أولًا لقطات نمطين، ثم يستمر القياس من حيث انتهى.</numerusform>
            <numerusform>تُقرأ أولًا لقطات %n أنماط، ثم يستمر القياس من حيث انتهى.</numerusform>
            <numerusform>تُقرأ أولًا لقطات %n نمطًا، ثم يستمر القياس من حيث انتهى.</numerusform>
            <numerusform>تُقرأ أولًا لقطات %n نمط، ثم يستمر القياس من حيث انتهى.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The photographs of %n pattern(s) are safe. Resuming gives the same result as if nothing had happened.</source>
        <translation>
            <numerusform>لا لقطات بعد. يعطي الاستئناف النتيجة نفسها كأن شيئًا لم يحدث.</numerusform>
            <numerusform>لقطات نمط واحد آمنة. يعطي الاستئناف النتيجة نفسها كأن شيئًا لم يحدث.</numerusform>
            <numerusform>لقطات نمطين آمنة. يعطي الاستئناف النتيجة نفسها كأن شيئًا لم يحدث.</numerusform>
            <numerusform>لقطات %n أنماط آمنة. يعطي الاستئناف النتيجة نفسها كأن شيئًا لم يحدث.</numerusform>
            <numerusform>لقطات %n نمطًا آمنة. يعطي الاستئناف النتيجة نفسها كأن شيئًا لم يحدث.</numerusform>
            <numerusform>لقطات %n نمط آمنة. يعطي الاستئناف النتيجة نفسها كأن شيئًا لم يحدث.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The new photographs of %n pattern(s) are safe: resume any time. Until then the earlier measurement is used.</source>
        <translation>
            <numerusform>لا لقطات جديدة بعد: استأنف في أي وقت. حتى ذلك الحين يُستخدم القياس السابق.</numerusform>
            <numerusform>اللقطات الجديدة لنمط واحد آمنة: استأنف في أي وقت. حتى ذلك الحين يُستخدم القياس السابق.</numerusform>
            <numerusform>اللقطات الجديدة لنمطين آمنة: استأنف في أي وقت. حتى ذلك الحين يُستخدم القياس السابق.</numerusform>
            <numerusform>اللقطات الجديدة لـ%n أنماط آمنة: استأنف في أي وقت. حتى ذلك الحين يُستخدم القياس السابق.</numerusform>
            <numerusform>اللقطات الجديدة لـ%n نمطًا آمنة: استأنف في أي وقت. حتى ذلك الحين يُستخدم القياس السابق.</numerusform>
            <numerusform>اللقطات الجديدة لـ%n نمط آمنة: استأنف في أي وقت. حتى ذلك الحين يُستخدم القياس السابق.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The photographs of %n pattern(s) are on the disk. The pattern under way is not counted.</source>
        <translation>
            <numerusform>لا لقطات على القرص بعد. النمط الجاري تصويره غير محسوب.</numerusform>
            <numerusform>لقطات نمط واحد على القرص. النمط الجاري تصويره غير محسوب.</numerusform>
            <numerusform>لقطات نمطين على القرص. النمط الجاري تصويره غير محسوب.</numerusform>
            <numerusform>لقطات %n أنماط على القرص. النمط الجاري تصويره غير محسوب.</numerusform>
            <numerusform>لقطات %n نمطًا على القرص. النمط الجاري تصويره غير محسوب.</numerusform>
            <numerusform>لقطات %n نمط على القرص. النمط الجاري تصويره غير محسوب.</numerusform>
        </translation>
    </message>
    <message>
        <source>Photographs</source>
        <translation>اللقطات</translation>
    </message>
    <message numerus="yes">
        <source>Reading the photographs of %n pattern(s): %1.</source>
        <translation>
            <numerusform>لا لقطات محفوظة للقراءة: ⁨%1⁩.</numerusform>
            <numerusform>قراءة لقطات نمط واحد: ⁨%1⁩.</numerusform>
            <numerusform>قراءة لقطات نمطين: ⁨%1⁩.</numerusform>
            <numerusform>قراءة لقطات %n أنماط: ⁨%1⁩.</numerusform>
            <numerusform>قراءة لقطات %n نمطًا: ⁨%1⁩.</numerusform>
            <numerusform>قراءة لقطات %n نمط: ⁨%1⁩.</numerusform>
        </translation>
    </message>
    <message>
        <source>Keep the new one</source>
        <translation>الاحتفاظ بالجديد</translation>
    </message>
    <message>
        <source>Use the earlier measurement?</source>
        <translation>استخدام القياس السابق؟</translation>
    </message>
    <message>
        <source>%1; lit, within the dashes: %2 of the view</source>
        <translation>⁨%1⁩؛ المُضاء، داخل الخط المتقطع: ⁨%2⁩ من المشهد</translation>
    </message>
    <message>
        <source>Stopped after %1</source>
        <translation>أُوقف بعد: %1</translation>
    </message>
    <message>
        <source>Stopped early: light finer than blocks of %1 px is missing.</source>
        <translation>أُوقف مبكرًا: ينقص الضوء الأدق من كتل بحجم ⁨%1 px⁩.</translation>
    </message>
    <message>
        <source>Again, not ended</source>
        <translation>إعادة لم تكتمل</translation>
    </message>
    <message>
        <source>What was measured cannot be read</source>
        <translation>تعذّرت قراءة ما قيس</translation>
    </message>
    <message>
        <source>Use the earlier measurement, or measure again.</source>
        <translation>استخدم القياس السابق، أو أعد القياس.</translation>
    </message>
    <message>
        <source>Measure again.</source>
        <translation>أعد القياس.</translation>
    </message>
    <message>
        <source>%1 dB expected: what was measured does not fit together, and pictures are no better than uncorrected.</source>
        <translation>المتوقع %1 dB: ما قيس غير متسق، والصور ليست أفضل من غير المصححة.</translation>
    </message>
    <message>
        <source>%1 dB expected. Go on any time, if nothing has moved.</source>
        <translation>المتوقع %1 dB. تابع في أي وقت إن لم يتحرك شيء.</translation>
    </message>
    <message>
        <source>What was measured cannot be read.</source>
        <translation>تعذّرت قراءة ما قيس.</translation>
    </message>
    <message>
        <source>%1: what was photographed since the check before is taken again.</source>
        <translation>%1: ما صُوّر منذ الفحص السابق يُعاد تصويره.</translation>
    </message>
    <message>
        <source>The light of the room was another one, too: see that it is as it was.</source>
        <translation>وكانت إضاءة الغرفة مختلفة أيضًا: تأكد من أنها كما كانت.</translation>
    </message>
    <message>
        <source>Ending: what is begun is photographed to its end, and test patterns. Then all of it is kept.</source>
        <translation>ينتهي: ما بُدئ يُصوَّر حتى آخره مع أنماط اختبار، ثم يُحفظ كله.</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the patterns flash.</source>
        <translation>أكّد أن القاعة خالية: الأنماط تومض.</translation>
    </message>
    <message>
        <source>%1: all patterns are taken again, from the first.</source>
        <translation>%1: تُلتقط كل الأنماط من جديد، من أولها.</translation>
    </message>
    <message>
        <source>Measured in %1, and repaired since</source>
        <translation>مدة القياس: %1، وأُصلح منذ ذلك</translation>
    </message>
    <message>
        <source>Photographs of the repair since</source>
        <translation>صور الإصلاح منذ ذلك</translation>
    </message>
    <message>
        <source>Stopped too early</source>
        <translation>أُوقف مبكرًا جدًا</translation>
    </message>
</context>
<context>
    <name>relucent::gui::AcquisitionTrace</name>
    <message>
        <source>the light flickered</source>
        <translation>ارتعش الضوء</translation>
    </message>
    <message>
        <source>the room light changed</source>
        <translation>تغيّرت إضاءة القاعة</translation>
    </message>
    <message>
        <source>the projector&apos;s light changed</source>
        <translation>تغيّر ضوء جهاز العرض</translation>
    </message>
    <message>
        <source>the camera or the projector moved</source>
        <translation>تحرّكت الكاميرا أو جهاز العرض</translation>
    </message>
    <message>
        <source>the picture was not the one sent</source>
        <translation>لم تكن الصورة المُرسَلة</translation>
    </message>
    <message>
        <source>the camera saw nothing</source>
        <translation>لم ترَ الكاميرا شيئًا</translation>
    </message>
    <message>
        <source>the projector showed nothing</source>
        <translation>لم يعرض جهاز العرض شيئًا</translation>
    </message>
    <message>
        <source>too bright, shorter exposure</source>
        <translation>ساطعة جدًا، تعريض أقصر</translation>
    </message>
    <message>
        <source>does not fit what was seen before</source>
        <translation>لا تطابق ما سبق</translation>
    </message>
    <message>
        <source>No. %1</source>
        <translation>رقم ⁨%1⁩</translation>
    </message>
    <message>
        <source>No. %1 to %2</source>
        <translation>من رقم ⁨%1⁩ إلى ⁨%2⁩</translation>
    </message>
    <message>
        <source>Room light</source>
        <translation>إضاءة القاعة</translation>
    </message>
    <message>
        <source>Camera and view</source>
        <translation>الكاميرا ومجال الرؤية</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>جهاز العرض</translation>
    </message>
    <message>
        <source>Flicker</source>
        <translation>الارتعاش</translation>
    </message>
    <message>
        <source>Room light steady</source>
        <translation>إضاءة القاعة ثابتة</translation>
    </message>
    <message>
        <source>Room light changed</source>
        <translation>تغيّرت إضاءة القاعة</translation>
    </message>
    <message>
        <source>%1 of full light, changed by %2 since the start.</source>
        <translation>⁨%1⁩ من الإضاءة الكاملة، تغيّرت بمقدار ⁨%2⁩ منذ البداية.</translation>
    </message>
    <message>
        <source>Camera still</source>
        <translation>الكاميرا ثابتة</translation>
    </message>
    <message>
        <source>The view changed</source>
        <translation>تغيّر مجال الرؤية</translation>
    </message>
    <message>
        <source>The view differs by %1 from the first.</source>
        <translation>يختلف مجال الرؤية عن الأول بمقدار ⁨%1⁩.</translation>
    </message>
    <message>
        <source>Projector steady</source>
        <translation>جهاز العرض ثابت</translation>
    </message>
    <message>
        <source>The projector&apos;s light changed</source>
        <translation>تغيّر ضوء جهاز العرض</translation>
    </message>
    <message>
        <source>Its light drifted by %1 and is corrected.</source>
        <translation>انحرف ضوؤه بمقدار ⁨%1⁩ ويجري تصحيحه.</translation>
    </message>
    <message>
        <source>No flicker</source>
        <translation>لا ارتعاش</translation>
    </message>
    <message>
        <source>Photographs of one pattern agree within %1.</source>
        <translation>تتطابق صور النمط الواحد في حدود ⁨%1⁩.</translation>
    </message>
    <message>
        <source>No difference between photographs of one pattern was found.</source>
        <translation>لم يوجد فرق بين صور النمط الواحد.</translation>
    </message>
    <message>
        <source>The camera or the projector moved</source>
        <translation>تحركت الكاميرا أو جهاز العرض</translation>
    </message>
    <message>
        <source>The picture is not the one sent</source>
        <translation>الصورة ليست التي أُرسلت</translation>
    </message>
    <message>
        <source>The camera sees nothing</source>
        <translation>الكاميرا لا ترى شيئًا</translation>
    </message>
    <message>
        <source>The projector shows nothing</source>
        <translation>جهاز العرض لا يعرض شيئًا</translation>
    </message>
    <message>
        <source>Put right</source>
        <translation>عولج</translation>
    </message>
    <message>
        <source>Looked at again at the next check.</source>
        <translation>يُنظر إليه ثانية عند الفحص التالي.</translation>
    </message>
    <message>
        <source>the light flickered, or something moved</source>
        <translation>ارتعش الضوء، أو تحرّك شيء</translation>
    </message>
    <message>
        <source>The light flickers, or something moves</source>
        <translation>الضوء يرتعش، أو شيء يتحرّك</translation>
    </message>
    <message>
        <source>Not known while the view has changed.</source>
        <translation>لا يُعرف ما دام المشهد مختلفًا.</translation>
    </message>
    <message>
        <source>The light flickers, or was switched</source>
        <translation>الضوء يرتعش أو شُغّل أو أُطفئ</translation>
    </message>
    <message>
        <source>Photographed again</source>
        <translation>أُعيد التصوير</translation>
    </message>
    <message>
        <source>dark: lens covered for a moment?</source>
        <translation>مظلمة: هل غُطيت العدسة للحظة؟</translation>
    </message>
    <message>
        <source>Found since the last check.</source>
        <translation>اكتُشف بعد آخر فحص.</translation>
    </message>
    <message>
        <source>something in the view changed</source>
        <translation>تغيّر شيء في المشهد</translation>
    </message>
    <message>
        <source>Something in the view changed</source>
        <translation>تغيّر شيء في المشهد</translation>
    </message>
    <message>
        <source>Not known while the camera sees nothing.</source>
        <translation>غير معروف ما دامت الكاميرا لا ترى شيئًا.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ActionBar</name>
    <message>
        <source>Progress of the measurement</source>
        <translation>تقدّم القياس</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>رجوع</translation>
    </message>
    <message>
        <source>Show where</source>
        <translation>أين؟</translation>
    </message>
</context>
<context>
    <name>relucent::gui::CameraPage</name>
    <message>
        <source>Choose</source>
        <translation>اختيار</translation>
    </message>
    <message>
        <source>Choose %1</source>
        <translation>اختيار ⁨%1⁩</translation>
    </message>
    <message>
        <source>Choose the one that looks at the surface.</source>
        <translation>اختر الكاميرا الموجّهة إلى السطح.</translation>
    </message>
    <message>
        <source>Looking for cameras</source>
        <translation>البحث عن كاميرات</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>لم يتغيّر شيء.</translation>
    </message>
    <message>
        <source>Checking</source>
        <translation>جارٍ الفحص</translation>
    </message>
    <message>
        <source>Checked %1</source>
        <translation>آخر فحص: %1</translation>
    </message>
    <message>
        <source>Choose the camera that looks at the surface.</source>
        <translation>اختر الكاميرا الموجّهة إلى السطح.</translation>
    </message>
    <message>
        <source>Opening the devices</source>
        <translation>فتح الأجهزة</translation>
    </message>
    <message>
        <source>%1 is too bright in every exposure.</source>
        <translation>%1 مفرط السطوع في كل التعريضات.</translation>
    </message>
    <message>
        <source>Look through the camera first.</source>
        <translation>شاهد صورة الكاميرا أولًا.</translation>
    </message>
    <message>
        <source>Next: test patterns for the projector&apos;s response</source>
        <translation>التالي: أنماط اختبار لاستجابة جهاز العرض</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>إيقاف مؤقت</translation>
    </message>
    <message>
        <source>Check again</source>
        <translation>إعادة الفحص</translation>
    </message>
    <message>
        <source>Choose another camera</source>
        <translation>اختيار كاميرا أخرى</translation>
    </message>
    <message>
        <source>Focus area</source>
        <translation>منطقة التركيز</translation>
    </message>
    <message>
        <source>Nothing is measured at this step, so nothing is lost.</source>
        <translation>لا يُقاس شيء في هذه الخطوة، فلا يضيع شيء.</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>الكاميرا</translation>
    </message>
    <message>
        <source>Frame the surface, focus, and let the exposures cover its brightest and darkest parts.</source>
        <translation>اجعل السطح داخل الإطار، واضبط التركيز، ودع التعريضات تغطي أسطع أجزائه وأعتمها.</translation>
    </message>
    <message>
        <source>Focus, %1 of best</source>
        <translation>التركيز، %1 من الأفضل</translation>
    </message>
    <message>
        <source>Camera view</source>
        <translation>مشهد الكاميرا</translation>
    </message>
    <message>
        <source>What the camera sees now</source>
        <translation>ما تراه الكاميرا الآن</translation>
    </message>
    <message>
        <source>The camera is not being looked through.</source>
        <translation>لا تُشاهَد صورة الكاميرا الآن.</translation>
    </message>
    <message>
        <source>Light in this exposure: red, green, blue</source>
        <translation>الضوء في هذا التعريض: أحمر، أخضر، أزرق</translation>
    </message>
    <message>
        <source>Signal</source>
        <translation>الإشارة</translation>
    </message>
    <message>
        <source>Focus</source>
        <translation>التركيز</translation>
    </message>
    <message>
        <source>Turn the lens until the bar stays at the mark: the best so far.</source>
        <translation>أدر العدسة حتى يثبت الشريط عند العلامة: الأفضل حتى الآن.</translation>
    </message>
    <message>
        <source>Exposures</source>
        <translation>التعريضات</translation>
    </message>
    <message>
        <source>Checks</source>
        <translation>الفحوص</translation>
    </message>
    <message>
        <source>Signal, share of full</source>
        <translation>الإشارة، نسبة من الكامل</translation>
    </message>
    <message>
        <source>Pixels</source>
        <translation>البكسلات</translation>
    </message>
    <message>
        <source>The camera sees the projector</source>
        <translation>الكاميرا ترى جهاز العرض</translation>
    </message>
    <message>
        <source>White and black differ as they should.</source>
        <translation>الفرق بين الأبيض والأسود كما ينبغي.</translation>
    </message>
    <message>
        <source>Bright parts are covered</source>
        <translation>الأجزاء الساطعة مغطاة</translation>
    </message>
    <message>
        <source>%1 is too bright in every exposure</source>
        <translation>%1 مفرط السطوع في كل التعريضات</translation>
    </message>
    <message>
        <source>Close the lens a little, or shade lamps in the view.</source>
        <translation>أغلق العدسة قليلًا، أو احجب المصابيح الظاهرة في المشهد.</translation>
    </message>
    <message>
        <source>Dark parts are covered</source>
        <translation>الأجزاء المعتمة مغطاة</translation>
    </message>
    <message>
        <source>%1 is too dark in every exposure</source>
        <translation>%1 مفرط العتمة في كل التعريضات</translation>
    </message>
    <message>
        <source>The projector may not reach there. Where it should, open the lens.</source>
        <translation>قد لا يصل جهاز العرض إلى هناك. افتح العدسة حيث ينبغي أن يصل.</translation>
    </message>
    <message>
        <source>Keep exposures</source>
        <translation>احتفظ بالتعريض</translation>
    </message>
    <message>
        <source>too bright to tell</source>
        <translation>أسطع من أن يُحكم عليه</translation>
    </message>
    <message>
        <source>Too bright %1</source>
        <translation>ساطع أكثر مما ينبغي %1</translation>
    </message>
    <message>
        <source>Too dark %1</source>
        <translation>معتم أكثر مما ينبغي %1</translation>
    </message>
    <message>
        <source>No camera is chosen yet</source>
        <translation>لم تُختر كاميرا بعد</translation>
    </message>
    <message>
        <source>Camera pixels</source>
        <translation>بكسلات الكاميرا</translation>
    </message>
    <message>
        <source>As many as needed: %1</source>
        <translation>بقدر الحاجة: ⁨%1⁩</translation>
    </message>
    <message>
        <source>All: %1</source>
        <translation>الكل: ⁨%1⁩</translation>
    </message>
    <message>
        <source>%1 become one: %2</source>
        <translation>⁨%1⁩ تصير واحدًا: ⁨%2⁩</translation>
    </message>
    <message>
        <source>Camera pixels that are used</source>
        <translation>بكسلات الكاميرا المستخدمة</translation>
    </message>
    <message>
        <source>Memory</source>
        <translation>الذاكرة</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>القرص</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>الوقت</translation>
    </message>
    <message>
        <source>More camera pixels than projector pixels show nothing more. The photographs that prove the result stay as large as they are.</source>
        <translation>زيادة بكسلات الكاميرا على بكسلات جهاز العرض لا تُظهر شيئًا إضافيًا. أما الصور التي تثبت النتيجة فتبقى بحجمها.</translation>
    </message>
    <message>
        <source>Mark what is sharp</source>
        <translation>علّم ما هو حاد</translation>
    </message>
    <message>
        <source>Checked before. Check again if camera or projector were moved.</source>
        <translation>فُحص من قبل. افحص مرة أخرى إذا حُرّكت الكاميرا أو جهاز العرض.</translation>
    </message>
    <message>
        <source>Continue</source>
        <translation>متابعة</translation>
    </message>
    <message>
        <source>Exposure times</source>
        <translation>أزمنة التعريض</translation>
    </message>
    <message>
        <source>The projector&apos;s picture: the camera sees %1 of it</source>
        <translation>صورة جهاز العرض: ترى الكاميرا %1 منها</translation>
    </message>
    <message>
        <source>at the left</source>
        <translation>إلى اليسار</translation>
    </message>
    <message>
        <source>at the right</source>
        <translation>إلى اليمين</translation>
    </message>
    <message>
        <source>at the top</source>
        <translation>في الأعلى</translation>
    </message>
    <message>
        <source>at the bottom</source>
        <translation>في الأسفل</translation>
    </message>
    <message>
        <source>Missing are places within it: in shadow, or too dark for the camera.</source>
        <translation>تنقص مواضع داخلها: في الظل، أو أعتم من أن تراها الكاميرا.</translation>
    </message>
    <message>
        <source>Missing: %1. Aim the camera there, or move it back.</source>
        <translation>الناقص: %1. وجّه الكاميرا إلى هناك، أو أبعدها.</translation>
    </message>
    <message>
        <source>%1 of the projector&apos;s picture is seen</source>
        <translation>تُرى %1 من صورة جهاز العرض</translation>
    </message>
    <message>
        <source>%1 of projector %2&apos;s picture is seen</source>
        <translation>تُرى %1 من صورة جهاز العرض %2</translation>
    </message>
    <message>
        <source>Every exposure is a multiple of %1</source>
        <translation>كل تعريض من مضاعفات %1</translation>
    </message>
    <message>
        <source>The projector&apos;s light changes as quickly as that: each photograph has all of it.</source>
        <translation>يتغيّر ضوء جهاز العرض بهذه السرعة: كل لقطة تضمّه كاملًا.</translation>
    </message>
    <message>
        <source>Allow any exposure</source>
        <translation>اسمح بأي تعريض</translation>
    </message>
    <message>
        <source>Exposures shorter than %1 flicker</source>
        <translation>التعريضات الأقصر من %1 ترتعش</translation>
    </message>
    <message>
        <source>The projector&apos;s light changes within that time.</source>
        <translation>يتغيّر ضوء جهاز العرض خلال هذا الزمن.</translation>
    </message>
    <message>
        <source>Use multiples of %1</source>
        <translation>استخدم مضاعفات %1</translation>
    </message>
    <message>
        <source>Checked before</source>
        <translation>فُحص من قبل</translation>
    </message>
    <message>
        <source>These exposures are kept. “Check again” looks through the camera.</source>
        <translation>هذه التعريضات محفوظة. «إعادة الفحص» ينظر عبر الكاميرا.</translation>
    </message>
    <message>
        <source>Not checked yet</source>
        <translation>لم يُفحص بعد</translation>
    </message>
    <message>
        <source>Missing: %1. A simulated camera stays where it stands: go on, what it does not see is left as it is.</source>
        <translation>الناقص: ⁨%1⁩. الكاميرا المحاكاة تبقى في موضعها: تابع، وما لا تراه يبقى كما هو.</translation>
    </message>
    <message>
        <source>Exposures as measured</source>
        <translation>تعريضات القياس</translation>
    </message>
    <message>
        <source>Camera %1: %2 is too bright in every exposure.</source>
        <translation>الكاميرا ⁨%1⁩: ⁨%2⁩ ساطع أكثر من اللازم في كل تعريض.</translation>
    </message>
    <message>
        <source>What %1 sees now</source>
        <translation>ما تراه ⁨%1⁩ الآن</translation>
    </message>
    <message>
        <source>Focus %1</source>
        <translation>التركيز ⁨%1⁩</translation>
    </message>
    <message numerus="yes">
        <source>%n projector(s): %1</source>
        <translation>
            <numerusform>لا أجهزة عرض: ⁨%1⁩</numerusform>
            <numerusform>جهاز عرض واحد: ⁨%1⁩</numerusform>
            <numerusform>جهازا عرض: ⁨%1⁩</numerusform>
            <numerusform>%n أجهزة عرض: ⁨%1⁩</numerusform>
            <numerusform>%n جهاز عرض: ⁨%1⁩</numerusform>
            <numerusform>%n جهاز عرض: ⁨%1⁩</numerusform>
        </translation>
    </message>
    <message>
        <source>Light</source>
        <translation>الضوء</translation>
    </message>
    <message>
        <source>Overlap</source>
        <translation>التراكب</translation>
    </message>
    <message>
        <source>how many projectors light each place</source>
        <translation>كم جهاز عرض يضيء كل موضع</translation>
    </message>
    <message>
        <source>Checks done</source>
        <translation>اكتمل الفحص</translation>
    </message>
    <message>
        <source>%1 of every picture is seen</source>
        <translation>يظهر %1 من كل صورة</translation>
    </message>
    <message>
        <source>Exposures, kept</source>
        <translation>التعريضات، محفوظة</translation>
    </message>
    <message>
        <source>Check again to look with another one.</source>
        <translation>افحص من جديد لتنظر بتعريض آخر.</translation>
    </message>
    <message>
        <source>Exposures, paused</source>
        <translation>التعريضات، متوقفة مؤقتًا</translation>
    </message>
    <message>
        <source>places within it</source>
        <translation>مواضع داخلها</translation>
    </message>
    <message>
        <source>All of the view, by one exposure or another.</source>
        <translation>المشهد كله، بهذا التعريض أو ذاك.</translation>
    </message>
    <message>
        <source>All but %1 of the view, by one exposure or another.</source>
        <translation>كل المشهد عدا %1، بهذا التعريض أو ذاك.</translation>
    </message>
    <message>
        <source>%1 too bright</source>
        <translation>%1 ساطع جدًا</translation>
    </message>
    <message>
        <source>Keep the former camera</source>
        <translation>الإبقاء على الكاميرا السابقة</translation>
    </message>
    <message>
        <source>exposure %1, click to judge focus</source>
        <translation>التعريض %1، انقر لتقييم التركيز</translation>
    </message>
    <message>
        <source>Checks under way</source>
        <translation>الفحوص جارية</translation>
    </message>
    <message>
        <source>Stop the checks</source>
        <translation>إيقاف الفحوص</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the checks begin with that.</source>
        <translation>أكّد أن القاعة خالية: عندها تبدأ الفحوص.</translation>
    </message>
    <message>
        <source>as it was seen last, exposure %1</source>
        <translation>كما شوهد آخر مرة، التعريض %1</translation>
    </message>
    <message>
        <source>%1 of full light was too bright in every exposure. “Check again” looks through the camera.</source>
        <translation>كان ⁨%1⁩ من الإضاءة الكاملة ساطعًا أكثر من اللازم في كل تعريض. «إعادة الفحص» ينظر عبر الكاميرا.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::CameraRows</name>
    <message>
        <source>Cameras</source>
        <translation>الكاميرات</translation>
    </message>
    <message>
        <source>Look again</source>
        <translation>بحث مجددًا</translation>
    </message>
    <message>
        <source>Looking for cameras</source>
        <translation>البحث عن كاميرات</translation>
    </message>
    <message>
        <source>Cannot be used: %1</source>
        <translation>لا يمكن استخدامها: ⁨%1⁩</translation>
    </message>
    <message numerus="yes">
        <source>%1 pixels, %n bit(s), exposures %2 to %3</source>
        <translation>
            <numerusform>⁨%1⁩ بكسل، %n بت، التعريضات من ⁨%2⁩ إلى ⁨%3⁩</numerusform>
            <numerusform>⁨%1⁩ بكسل، بت واحد، التعريضات من ⁨%2⁩ إلى ⁨%3⁩</numerusform>
            <numerusform>⁨%1⁩ بكسل، بتّان، التعريضات من ⁨%2⁩ إلى ⁨%3⁩</numerusform>
            <numerusform>⁨%1⁩ بكسل، %n بتات، التعريضات من ⁨%2⁩ إلى ⁨%3⁩</numerusform>
            <numerusform>⁨%1⁩ بكسل، %n بتًا، التعريضات من ⁨%2⁩ إلى ⁨%3⁩</numerusform>
            <numerusform>⁨%1⁩ بكسل، %n بت، التعريضات من ⁨%2⁩ إلى ⁨%3⁩</numerusform>
        </translation>
    </message>
    <message>
        <source>Recommended: it tells faint light apart best</source>
        <translation>موصى بها: أفضلها في تمييز الضوء الخافت</translation>
    </message>
    <message>
        <source>Fewer bits: faint light is told apart less well</source>
        <translation>بتات أقل: تمييز الضوء الخافت أضعف</translation>
    </message>
    <message>
        <source>Recommended: its exposures cover most, from bright to dark</source>
        <translation>موصى بها: تعريضاتها تغطي الأكثر من الساطع إلى المعتم</translation>
    </message>
    <message>
        <source>Fewer exposures: bright and dark are harder to cover</source>
        <translation>تعريضات أقل: تغطية الساطع والمعتم أصعب</translation>
    </message>
    <message>
        <source>Recommended: it has most pixels</source>
        <translation>موصى بها: لها أكثر البكسلات</translation>
    </message>
    <message>
        <source>Fewer pixels than the first</source>
        <translation>بكسلات أقل من الأولى</translation>
    </message>
    <message>
        <source>As suitable as the first</source>
        <translation>مناسبة كالأولى</translation>
    </message>
    <message>
        <source>No camera answers. Check its cable and its power, and close other programs that use it.</source>
        <translation>لا تستجيب أي كاميرا. افحص كابلها وتغذيتها، وأغلق البرامج الأخرى التي تستخدمها.</translation>
    </message>
    <message>
        <source>These are found here: webcams and other video devices, industrial cameras by GigE Vision or USB3 Vision, and still cameras on USB.</source>
        <translation>يُعثر هنا على: كاميرات الويب وأجهزة الفيديو الأخرى، والكاميرات الصناعية عبر GigE Vision أو USB3 Vision، وكاميرات التصوير الثابت عبر USB.</translation>
    </message>
    <message>
        <source>Any other is driven by a program of yours: go Back and choose “New venue by script”. The guide (F1) tells how cameras are set up.</source>
        <translation>أي كاميرا أخرى يقودها برنامج لديك: اضغط «رجوع» واختر «موقع جديد بنص برمجي». يشرح الدليل (F1) كيفية إعداد الكاميرات.</translation>
    </message>
    <message>
        <source>Any other is driven by a program of yours. The guide (F1) tells how cameras are set up.</source>
        <translation>أي كاميرا أخرى يقودها برنامج لديك. يشرح الدليل (F1) كيفية إعداد الكاميرات.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ClusterPage</name>
    <message>
        <source>What is measured is safe.</source>
        <translation>كل ما تم قياسه آمن.</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>بحاجة إلى تحديث</translation>
    </message>
    <message>
        <source>Grouping again</source>
        <translation>جارٍ التجميع مجددًا</translation>
    </message>
    <message>
        <source>Grouping</source>
        <translation>جارٍ التجميع</translation>
    </message>
    <message>
        <source>Reading the light transport</source>
        <translation>قراءة نقل الضوء</translation>
    </message>
    <message>
        <source>Preview content</source>
        <translation>معاينة المحتوى</translation>
    </message>
    <message>
        <source>The clusters that are kept belong to an earlier threshold</source>
        <translation>التجمّعات المحفوظة تعود إلى عتبة سابقة</translation>
    </message>
    <message>
        <source>What you see here has been grouped again. Going on keeps it.</source>
        <translation>ما تراه هنا جُمّع من جديد. المتابعة تحفظه.</translation>
    </message>
    <message>
        <source>Cluster</source>
        <translation>التجميع</translation>
    </message>
    <message>
        <source>Cluster map</source>
        <translation>خريطة التجمّعات</translation>
    </message>
    <message>
        <source>click a pixel</source>
        <translation>انقر بكسلًا</translation>
    </message>
    <message>
        <source>Error map</source>
        <translation>خريطة الخطأ</translation>
    </message>
    <message>
        <source>Flat</source>
        <translation>مسطّح</translation>
    </message>
    <message>
        <source>Relief</source>
        <translation>مجسّم</translation>
    </message>
    <message>
        <source>Cluster sizes</source>
        <translation>أحجام التجمّعات</translation>
    </message>
    <message>
        <source>Projector pixels in the cluster</source>
        <translation>بكسلات جهاز العرض في التجمّع</translation>
    </message>
    <message>
        <source>Clusters</source>
        <translation>التجمّعات</translation>
    </message>
    <message>
        <source>%1, %2: in no cluster</source>
        <translation>⁨%1, %2⁩: خارج التجمّعات</translation>
    </message>
    <message>
        <source>Error map, median %1</source>
        <translation>خريطة الخطأ، الوسيط %1</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>المسافة</translation>
    </message>
    <message>
        <source>small, sharp</source>
        <translation>صغيرة، حادّة</translation>
    </message>
    <message>
        <source>large, fast</source>
        <translation>كبيرة، سريعة</translation>
    </message>
    <message>
        <source>Share of the brightest</source>
        <translation>النسبة من الأسطع</translation>
    </message>
    <message>
        <source>more detail</source>
        <translation>تفاصيل أكثر</translation>
    </message>
    <message>
        <source>more speed</source>
        <translation>سرعة أكبر</translation>
    </message>
    <message>
        <source>Largest cluster</source>
        <translation>أكبر تجمّع</translation>
    </message>
    <message>
        <source>fast</source>
        <translation>سريع</translation>
    </message>
    <message>
        <source>exact</source>
        <translation>دقيق</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>النتيجة</translation>
    </message>
    <message>
        <source>Light kept in clusters</source>
        <translation>الضوء الباقي في التجمّعات</translation>
    </message>
    <message>
        <source>Median error</source>
        <translation>وسيط الخطأ</translation>
    </message>
    <message>
        <source>%1 px</source>
        <translation>%1 بكسل</translation>
    </message>
    <message>
        <source>%1 of light</source>
        <translation>%1 من الضوء</translation>
    </message>
    <message numerus="yes">
        <source>%n cluster(s)</source>
        <translation>
            <numerusform>لا تجمّعات</numerusform>
            <numerusform>تجمّع واحد</numerusform>
            <numerusform>تجمّعان</numerusform>
            <numerusform>%n تجمّعات</numerusform>
            <numerusform>%n تجمّعًا</numerusform>
            <numerusform>%n تجمّع</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n cluster(s), median %1 px</source>
        <translation>
            <numerusform>لا تجمّعات، الوسيط: ⁨%1 px⁩</numerusform>
            <numerusform>تجمّع واحد، الوسيط: ⁨%1 px⁩</numerusform>
            <numerusform>تجمّعان، الوسيط: ⁨%1 px⁩</numerusform>
            <numerusform>%n تجمّعات، الوسيط: ⁨%1 px⁩</numerusform>
            <numerusform>%n تجمّعًا، الوسيط: ⁨%1 px⁩</numerusform>
            <numerusform>%n تجمّع، الوسيط: ⁨%1 px⁩</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1, %2: %n projector pixel(s), error %3</source>
        <translation>
            <numerusform>⁨%1, %2⁩: لا بكسلات لجهاز العرض، الخطأ %3</numerusform>
            <numerusform>⁨%1, %2⁩: بكسل واحد لجهاز العرض، الخطأ %3</numerusform>
            <numerusform>⁨%1, %2⁩: بكسلان لجهاز العرض، الخطأ %3</numerusform>
            <numerusform>⁨%1, %2⁩: %n بكسلات لجهاز العرض، الخطأ %3</numerusform>
            <numerusform>⁨%1, %2⁩: %n بكسلًا لجهاز العرض، الخطأ %3</numerusform>
            <numerusform>⁨%1, %2⁩: %n بكسل لجهاز العرض، الخطأ %3</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Cluster map, %n cluster(s), largest %1</source>
        <translation>
            <numerusform>خريطة التجمّعات، لا تجمّعات، الأكبر %1</numerusform>
            <numerusform>خريطة التجمّعات، تجمّع واحد، الأكبر %1</numerusform>
            <numerusform>خريطة التجمّعات، تجمّعان، الأكبر %1</numerusform>
            <numerusform>خريطة التجمّعات، %n تجمّعات، الأكبر %1</numerusform>
            <numerusform>خريطة التجمّعات، %n تجمّعًا، الأكبر %1</numerusform>
            <numerusform>خريطة التجمّعات، %n تجمّع، الأكبر %1</numerusform>
        </translation>
    </message>
    <message>
        <source>95 % of pixels below</source>
        <translation>95 % من البكسلات دون</translation>
    </message>
    <message numerus="yes">
        <source>%1, %2: %n projector pixel(s)</source>
        <translation>
            <numerusform>⁨%1, %2⁩: لا بكسلات لجهاز العرض</numerusform>
            <numerusform>⁨%1, %2⁩: بكسل واحد لجهاز العرض</numerusform>
            <numerusform>⁨%1, %2⁩: بكسلان لجهاز العرض</numerusform>
            <numerusform>⁨%1, %2⁩: %n بكسلات لجهاز العرض</numerusform>
            <numerusform>⁨%1, %2⁩: %n بكسلًا لجهاز العرض</numerusform>
            <numerusform>⁨%1, %2⁩: %n بكسل لجهاز العرض</numerusform>
        </translation>
    </message>
    <message>
        <source>error</source>
        <translation>خطأ</translation>
    </message>
    <message>
        <source>limit %1</source>
        <translation>الحد %1</translation>
    </message>
    <message>
        <source>over %1</source>
        <translation>أكثر من %1</translation>
    </message>
    <message>
        <source>about %1</source>
        <translation>نحو %1</translation>
    </message>
    <message>
        <source>Cut off by the size limit</source>
        <translation>ما يقطعه حد الحجم</translation>
    </message>
    <message>
        <source>Films, frames a second</source>
        <translation>الأفلام، إطارات في الثانية</translation>
    </message>
    <message>
        <source>What this computer manages in Full HD with the light that Threshold keeps. The groups make no difference to it: films are solved in overlapping windows.</source>
        <translation>ما يبلغه هذا الحاسوب بدقة Full HD بالضوء الذي تبقيه العتبة. لا تغيّره المجموعات: تُحلّ الأفلام في نوافذ متداخلة.</translation>
    </message>
    <message>
        <source>Without a size limit, one cluster would cover %1 of the picture.</source>
        <translation>بلا حد للحجم لغطّى تجمّع واحد %1 من الصورة.</translation>
    </message>
    <message>
        <source>The surface is blurred across neighbouring pixels, so groups join up. The limit keeps them apart.</source>
        <translation>السطح ضبابي بين البكسلات المتجاورة فتتصل المجموعات. يبقيها الحد منفصلة.</translation>
    </message>
    <message>
        <source>The clusters that are kept belong to an earlier measurement</source>
        <translation>التجمّعات المحفوظة تعود إلى قياس سابق</translation>
    </message>
    <message>
        <source>Films are shown by “All bounces, for films”, whatever the clusters are. Clusters tell which places light each other, and can be compared at Preview.</source>
        <translation>تُعرض الأفلام بطريقة «كل الانعكاسات، للأفلام» مهما كانت التجمّعات. تبيّن التجمّعات أي الأماكن يضيء بعضها بعضًا، ويمكن مقارنتها في المعاينة.</translation>
    </message>
    <message>
        <source>See which parts of the surface light each other, and split them into groups that can be solved on their own.</source>
        <translation>اعرف أي أجزاء السطح يضيء بعضها بعضًا، وقسّمها إلى مجموعات تُحل كل منها على حدة.</translation>
    </message>
    <message>
        <source>Grouped anew</source>
        <translation>جُمّعت من جديد</translation>
    </message>
    <message>
        <source>Changed: it is applied as soon as you go on.</source>
        <translation>تم التغيير: يُطبَّق بمجرد المتابعة.</translation>
    </message>
    <message>
        <source>What was measured is too coarse to group. Go on measuring.</source>
        <translation>ما قيس أخشن من أن يُجمَّع. تابع القياس.</translation>
    </message>
    <message>
        <source>No light is strong enough to group.</source>
        <translation>لا ضوء قوي بما يكفي للتجميع.</translation>
    </message>
    <message>
        <source>Reliefs need OpenGL, which is not there.</source>
        <translation>يحتاج المجسّم إلى OpenGL، وهو غير موجود.</translation>
    </message>
    <message>
        <source>An error of %1 is normal here.</source>
        <translation>الخطأ البالغ ⁨%1⁩ طبيعي هنا.</translation>
    </message>
    <message>
        <source>Grouping drops the blur of the lens on purpose: little where it is sharp, 70 to 80 % where it is blurred. Look for patches that stand out from their surroundings.</source>
        <translation>يُسقط التجميع تمويه العدسة عمدًا: قليلًا حيث الصورة حادّة، ومن 70 إلى 80 % حيث هي مموّهة. ابحث عن بقع تختلف عمّا حولها.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::CornerView</name>
    <message>
        <source>Top left corner, %1, %2.</source>
        <translation>الزاوية العليا اليسرى، %1، %2.</translation>
    </message>
    <message>
        <source>Top right corner, %1, %2.</source>
        <translation>الزاوية العليا اليمنى، %1، %2.</translation>
    </message>
    <message>
        <source>Bottom right corner, %1, %2.</source>
        <translation>الزاوية السفلى اليمنى، %1، %2.</translation>
    </message>
    <message>
        <source>Bottom left corner, %1, %2.</source>
        <translation>الزاوية السفلى اليسرى، %1، %2.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::DevicePage</name>
    <message>
        <source>A show is playing</source>
        <translation>هناك عرض قيد التشغيل</translation>
    </message>
    <message>
        <source>What is begun here shines in its place. The show is seen again once it has ended.</source>
        <translation>ما يبدأ هنا يُسقَط بدلًا منه. ويُرى العرض من جديد عندما ينتهي ذلك.</translation>
    </message>
    <message>
        <source>Another program plays a show of this venue</source>
        <translation>يشغّل برنامج آخر عرضًا لهذا الموقع</translation>
    </message>
    <message>
        <source>The show plays on.</source>
        <translation>العرض مستمر.</translation>
    </message>
    <message>
        <source>End that show</source>
        <translation>إنهاء ذلك العرض</translation>
    </message>
    <message>
        <source>End the show</source>
        <translation>إنهاء العرض</translation>
    </message>
    <message>
        <source>Let it play</source>
        <translation>دعه يعمل</translation>
    </message>
    <message>
        <source>The show that another program plays of this venue: the projector&apos;s screen goes dark.</source>
        <translation>العرض الذي يشغّله برنامج آخر لهذا الموقع: تنطفئ شاشة جهاز العرض.</translation>
    </message>
    <message>
        <source>Venue and playlist stay. An installed show starts again at the next log-in.</source>
        <translation>يبقى الموقع وقائمة التشغيل. ويبدأ العرض المثبَّت من جديد عند تسجيل الدخول التالي.</translation>
    </message>
    <message>
        <source>Its pictures shine on the projector whatever is shown from here, and may come between patterns that are measured.</source>
        <translation>تظهر صوره على جهاز العرض مهما عُرض من هنا، وقد تأتي بين الأنماط التي تُقاس.</translation>
    </message>
    <message>
        <source>It is ending</source>
        <translation>ينتهي الآن</translation>
    </message>
    <message>
        <source>The show that another program plays of another venue: the projector&apos;s screen goes dark.</source>
        <translation>العرض الذي يشغّله برنامج آخر لموقع آخر: تُظلم شاشة جهاز العرض.</translation>
    </message>
    <message>
        <source>Another program plays a show of another venue on this projector</source>
        <translation>يشغّل برنامج آخر عرضًا لموقع آخر على جهاز العرض هذا</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged. Plug it in again: the show comes back by itself.</source>
        <translation>شاشة جهاز العرض غير موصولة. أعد توصيلها، فيعود العرض تلقائيًا.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::DeviceSelector</name>
    <message>
        <source>Projector that is shown</source>
        <translation>جهاز العرض المعروض</translation>
    </message>
    <message>
        <source>Camera that is shown</source>
        <translation>الكاميرا المعروضة</translation>
    </message>
</context>
<context>
    <name>relucent::gui::EndingDialog</name>
    <message>
        <source>Ending</source>
        <translation>جارٍ الإنهاء</translation>
    </message>
    <message>
        <source>Ending…</source>
        <translation>جارٍ الإنهاء…</translation>
    </message>
    <message>
        <source>Everything that was measured is safe. The devices finish what they are doing, which can take half a minute; then this window closes by itself.</source>
        <translation>كل ما قيس محفوظ. تُنهي الأجهزة ما تعمل عليه، وقد يستغرق ذلك نصف دقيقة، ثم تُغلق هذه النافذة من تلقاء نفسها.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::FailureDialog</name>
    <message>
        <source>The disk did not do what was asked</source>
        <translation>لم ينفّذ القرص ما طُلب منه</translation>
    </message>
    <message>
        <source>The memory is full</source>
        <translation>الذاكرة ممتلئة</translation>
    </message>
    <message>
        <source>A file cannot be read</source>
        <translation>تتعذّر قراءة ملف</translation>
    </message>
    <message>
        <source>This cannot be done as it is</source>
        <translation>لا يمكن تنفيذ هذا على حاله</translation>
    </message>
    <message>
        <source>The computation failed</source>
        <translation>فشل الحساب</translation>
    </message>
    <message>
        <source>What happened</source>
        <translation>ما حدث</translation>
    </message>
    <message>
        <source>What is safe</source>
        <translation>ما هو آمن</translation>
    </message>
    <message>
        <source>What to do</source>
        <translation>ما العمل</translation>
    </message>
    <message>
        <source>Copy details</source>
        <translation>نسخ التفاصيل</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>إغلاق</translation>
    </message>
    <message>
        <source>What it ends</source>
        <translation>ما الذي ينتهي</translation>
    </message>
    <message>
        <source>What happens</source>
        <translation>ما الذي يحدث</translation>
    </message>
    <message>
        <source>A device did not do what was asked</source>
        <translation>لم ينفّذ أحد الأجهزة ما طُلب منه</translation>
    </message>
</context>
<context>
    <name>relucent::gui::FlashConsent</name>
    <message>
        <source>The projector shows patterns that change as quickly as the devices can, perhaps more than 3 times a second.</source>
        <translation>يعرض جهاز العرض أنماطًا تتغيّر بأسرع ما تستطيعه الأجهزة، وربما أكثر من 3 مرات في الثانية.</translation>
    </message>
    <message>
        <source>The room is clear</source>
        <translation>القاعة خالية</translation>
    </message>
    <message>
        <source>Flashing light</source>
        <translation>ضوء وامض</translation>
    </message>
    <message>
        <source>The room is clear and everyone here knows</source>
        <translation>القاعة خالية وكل من هنا على علم</translation>
    </message>
    <message>
        <source>Flashing light can cause seizures. Clear the room and cover the entrance.</source>
        <translation>قد يسبب الضوء الوامض نوبات صرع. أخلِ القاعة وغطِّ المدخل.</translation>
    </message>
    <message numerus="yes">
        <source>The projector shows patterns that change about %n time(s) a second, and at times more often.</source>
        <translation>
            <numerusform>يعرض جهاز العرض أنماطًا تتغيّر أقل من مرة في الثانية، وأحيانًا أكثر.</numerusform>
            <numerusform>يعرض جهاز العرض أنماطًا تتغيّر نحو مرة واحدة في الثانية، وأحيانًا أكثر.</numerusform>
            <numerusform>يعرض جهاز العرض أنماطًا تتغيّر نحو مرتين في الثانية، وأحيانًا أكثر.</numerusform>
            <numerusform>يعرض جهاز العرض أنماطًا تتغيّر نحو %n مرات في الثانية، وأحيانًا أكثر.</numerusform>
            <numerusform>يعرض جهاز العرض أنماطًا تتغيّر نحو %n مرة في الثانية، وأحيانًا أكثر.</numerusform>
            <numerusform>يعرض جهاز العرض أنماطًا تتغيّر نحو %n مرة في الثانية، وأحيانًا أكثر.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::gui::HelpWindow</name>
    <message>
        <source>Help</source>
        <translation>مساعدة</translation>
    </message>
    <message>
        <source>Search the guide</source>
        <translation>البحث في الدليل</translation>
    </message>
    <message>
        <source>Pages of the guide</source>
        <translation>صفحات الدليل</translation>
    </message>
    <message>
        <source>The page</source>
        <translation>الصفحة</translation>
    </message>
    <message>
        <source>No page holds these words.</source>
        <translation>لا توجد صفحة فيها هذه الكلمات.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::IdentifyOverlay</name>
    <message>
        <source>%1, %2 × %3, %4 Hz</source>
        <translation>⁨%1⁩، ⁨%2 × %3⁩، ⁨%4 Hz⁩</translation>
    </message>
    <message>
        <source>Lines sharp? Then this is the projector&apos;s own resolution.</source>
        <translation>هل الخطوط حادّة؟ إذن هذه دقة جهاز العرض الأصلية.</translation>
    </message>
    <message>
        <source>Screen %1</source>
        <translation>الشاشة %1</translation>
    </message>
</context>
<context>
    <name>relucent::gui::LinearizePage</name>
    <message>
        <source>The photographs of this step are still in the folder.</source>
        <translation>لقطات هذه الخطوة ما زالت في المجلد.</translation>
    </message>
    <message>
        <source>Measuring, %1</source>
        <translation>جارٍ القياس، %1</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>تم القياس</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>بحاجة إلى تحديث</translation>
    </message>
    <message>
        <source>Stopped by a failure</source>
        <translation>توقف بسبب عطل</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>الأجهزة مستخدمة في خطوة «%1».</translation>
    </message>
    <message>
        <source>The colours do not add up. Continuing is recorded in the report.</source>
        <translation>مجموع الألوان لا يساوي الأبيض. تُسجّل المتابعة في التقرير.</translation>
    </message>
    <message>
        <source>Measured in %1</source>
        <translation>مدة القياس: %1</translation>
    </message>
    <message>
        <source>Plan acquisition</source>
        <translation>تخطيط القياس</translation>
    </message>
    <message>
        <source>Continue anyway</source>
        <translation>المتابعة رغم ذلك</translation>
    </message>
    <message>
        <source>Measure response</source>
        <translation>قياس الاستجابة</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>إيقاف</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>إعادة القياس</translation>
    </message>
    <message>
        <source>These curves belong to earlier settings</source>
        <translation>هذه المنحنيات تعود إلى إعدادات سابقة</translation>
    </message>
    <message>
        <source>They still work and stay until the new ones are measured.</source>
        <translation>ما زالت صالحة، وتبقى حتى تُقاس الجديدة.</translation>
    </message>
    <message>
        <source>Levels</source>
        <translation>المستويات</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>لم يتغيّر شيء.</translation>
    </message>
    <message>
        <source>Try again</source>
        <translation>إعادة المحاولة</translation>
    </message>
    <message>
        <source>Every photograph that was taken is on the disk. Trying again goes on from there.</source>
        <translation>كل لقطة التُقطت موجودة على القرص. تتابع إعادة المحاولة من هناك.</translation>
    </message>
    <message>
        <source>Linearize</source>
        <translation>الخطية</translation>
    </message>
    <message>
        <source>Measure how much light each step of the projector&apos;s three colours really gives.</source>
        <translation>قِس مقدار الضوء الذي يعطيه فعلًا كل مستوى من ألوان جهاز العرض الثلاثة.</translation>
    </message>
    <message>
        <source>Red</source>
        <translation>أحمر</translation>
    </message>
    <message>
        <source>Green</source>
        <translation>أخضر</translation>
    </message>
    <message>
        <source>Blue</source>
        <translation>أزرق</translation>
    </message>
    <message>
        <source>Sent to the projector</source>
        <translation>المرسل إلى جهاز العرض</translation>
    </message>
    <message>
        <source>Seen by the camera</source>
        <translation>ما تراه الكاميرا</translation>
    </message>
    <message>
        <source>Pattern that the projector shows</source>
        <translation>النمط الذي يعرضه جهاز العرض</translation>
    </message>
    <message>
        <source>Last photograph</source>
        <translation>اللقطة الأخيرة</translation>
    </message>
    <message>
        <source>Appears when measuring begins.</source>
        <translation>تظهر عند بدء القياس.</translation>
    </message>
    <message>
        <source>%1, photograph %2</source>
        <translation>⁨%1⁩، اللقطة %2</translation>
    </message>
    <message>
        <source>Response of the projector</source>
        <translation>استجابة جهاز العرض</translation>
    </message>
    <message>
        <source>Level sent to the projector</source>
        <translation>المستوى المرسل إلى جهاز العرض</translation>
    </message>
    <message>
        <source>Light, % of full</source>
        <translation>الضوء، % من الكامل</translation>
    </message>
    <message>
        <source>Light of every level, three colours</source>
        <translation>ضوء كل مستوى، ثلاثة ألوان</translation>
    </message>
    <message>
        <source>as it is measured</source>
        <translation>أثناء القياس</translation>
    </message>
    <message numerus="yes">
        <source>%n level(s) a colour, drift removed</source>
        <translation>
            <numerusform>لا مستويات، أُزيل الانحراف</numerusform>
            <numerusform>مستوى واحد لكل لون، أُزيل الانحراف</numerusform>
            <numerusform>مستويان لكل لون، أُزيل الانحراف</numerusform>
            <numerusform>%n مستويات لكل لون، أُزيل الانحراف</numerusform>
            <numerusform>%n مستوى لكل لون، أُزيل الانحراف</numerusform>
            <numerusform>%n مستوى لكل لون، أُزيل الانحراف</numerusform>
        </translation>
    </message>
    <message>
        <source>not measured yet</source>
        <translation>لم تُقَس بعد</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>النتيجة</translation>
    </message>
    <message>
        <source>Exposures</source>
        <translation>التعريضات</translation>
    </message>
    <message>
        <source>Chosen for this venue</source>
        <translation>المختار لهذا الموقع</translation>
    </message>
    <message>
        <source>Measure with</source>
        <translation>القياس باستخدام</translation>
    </message>
    <message>
        <source>Levels a colour</source>
        <translation>المستويات لكل لون</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>جارٍ القياس</translation>
    </message>
    <message>
        <source>Not measured yet</source>
        <translation>لم يُقَس بعد</translation>
    </message>
    <message>
        <source>Whether the colours add up, the camera is linear and every level is brighter than the one below is told when all levels are measured.</source>
        <translation>عند اكتمال قياس كل المستويات يُعرف هل مجموع الألوان يساوي الأبيض، وهل الكاميرا خطية، وهل كل مستوى أسطع مما دونه.</translation>
    </message>
    <message>
        <source>The colours add up</source>
        <translation>مجموع الألوان يساوي الأبيض</translation>
    </message>
    <message>
        <source>Red, green and blue together give white within %1.</source>
        <translation>الأحمر والأخضر والأزرق معًا تعطي الأبيض بفارق لا يتجاوز %1.</translation>
    </message>
    <message>
        <source>The colours do not add up</source>
        <translation>مجموع الألوان لا يساوي الأبيض</translation>
    </message>
    <message>
        <source>White differs by %1 from its colours. Turn off “brilliant” or “dynamic” in the projector&apos;s menu, then measure again.</source>
        <translation>يختلف الأبيض عن مجموع ألوانه بمقدار %1. أوقف «brilliant» أو «dynamic» في قائمة جهاز العرض، ثم أعد القياس.</translation>
    </message>
    <message>
        <source>The camera is linear</source>
        <translation>الكاميرا خطية</translation>
    </message>
    <message>
        <source>The camera&apos;s curve is known</source>
        <translation>منحنى الكاميرا معروف</translation>
    </message>
    <message>
        <source>Doubling the exposure doubles the signal.</source>
        <translation>مضاعفة التعريض تضاعف الإشارة.</translation>
    </message>
    <message>
        <source>Its photographs are brought back to linear light.</source>
        <translation>تُعاد لقطاتها إلى ضوء خطي.</translation>
    </message>
    <message>
        <source>Curves rise everywhere</source>
        <translation>المنحنيات صاعدة في كل موضع</translation>
    </message>
    <message>
        <source>No level is darker than the one below it.</source>
        <translation>لا مستوى أعتم مما دونه.</translation>
    </message>
    <message>
        <source>Found while measuring</source>
        <translation>ما وُجد أثناء القياس</translation>
    </message>
    <message numerus="yes">
        <source>About %n test pattern(s)</source>
        <translation>
            <numerusform>لا أنماط اختبار</numerusform>
            <numerusform>نحو نمط اختبار واحد</numerusform>
            <numerusform>نحو نمطَي اختبار</numerusform>
            <numerusform>نحو %n أنماط اختبار</numerusform>
            <numerusform>نحو %n نمط اختبار</numerusform>
            <numerusform>نحو %n نمط اختبار</numerusform>
        </translation>
    </message>
    <message>
        <source>Go on now</source>
        <translation>تابع الآن</translation>
    </message>
    <message>
        <source>Measuring with these settings. Stop to change them.</source>
        <translation>يجري القياس بهذه الإعدادات. أوقفه لتغييرها.</translation>
    </message>
    <message>
        <source>Keep the earlier one</source>
        <translation>الاحتفاظ بالسابق</translation>
    </message>
    <message>
        <source>The earlier curves are used again, with all that followed from them.</source>
        <translation>تُستخدم المنحنيات السابقة مجددًا مع كل ما ترتّب عليها.</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>كل ما تم قياسه آمن.</translation>
    </message>
    <message>
        <source>Black level</source>
        <translation>مستوى الأسود</translation>
    </message>
    <message>
        <source>Contrast</source>
        <translation>التباين</translation>
    </message>
    <message>
        <source>%1 of full light</source>
        <translation>⁨%1⁩ من الضوء الكامل</translation>
    </message>
    <message>
        <source>Colours within %1</source>
        <translation>الألوان في حدود %1</translation>
    </message>
    <message>
        <source>How far each level&apos;s light is from the fitted curve</source>
        <translation>بُعد ضوء كل مستوى عن المنحنى</translation>
    </message>
    <message>
        <source>within ±%1</source>
        <translation>في حدود ⁨±%1⁩</translation>
    </message>
    <message>
        <source>One test pattern shows many levels side by side, so few patterns are enough.</source>
        <translation>يعرض نمط الاختبار الواحد درجات كثيرة جنبًا إلى جنب، فتكفي أنماط قليلة.</translation>
    </message>
    <message>
        <source>Off the curve</source>
        <translation>البعد عن المنحنى</translation>
    </message>
    <message>
        <source>Residuals: what was photographed, less the curve that was fitted to it.</source>
        <translation>البواقي: ما صُوِّر مطروحًا منه المنحنى المطابق له.</translation>
    </message>
    <message>
        <source>Off the curve, % of full</source>
        <translation>البعد عن المنحنى، % من الكامل</translation>
    </message>
    <message>
        <source>Stopping after the photograph under way.</source>
        <translation>يتوقف بعد اللقطة الجارية.</translation>
    </message>
    <message>
        <source>To measure again, confirm that the room is clear.</source>
        <translation>للقياس من جديد أكّد أن القاعة خالية.</translation>
    </message>
    <message>
        <source>Colours off by %1</source>
        <translation>الألوان منحرفة بمقدار %1</translation>
    </message>
    <message>
        <source>The photographs contradict each other. See that nothing covers the lens, then measure again.</source>
        <translation>الصور يناقض بعضها بعضًا. تأكد من أن لا شيء يغطي العدسة، ثم أعد القياس.</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the patterns flash.</source>
        <translation>أكّد أن القاعة خالية: الأنماط تومض.</translation>
    </message>
    <message>
        <source>The photographs contradict each other</source>
        <translation>الصور يناقض بعضها بعضًا</translation>
    </message>
    <message>
        <source>White differs by %1 from its colours, and levels by up to %2 from their curve: no picture mode does that. Something covered the lens or the picture, or the light changed. Nothing else is told from these photographs; measure again.</source>
        <translation>يختلف الأبيض بمقدار %1 عن ألوانه، وتختلف المستويات بما يصل إلى %2 عن منحناها: لا يُحدث ذلك أي وضع صورة. غطّى شيء العدسة أو الصورة، أو تغيّر الضوء. لا يُستنتج من هذه الصور شيء آخر؛ أعد القياس.</translation>
    </message>
    <message>
        <source>The camera sees hardly any light of the projector</source>
        <translation>لا تكاد الكاميرا ترى ضوءًا من جهاز العرض</translation>
    </message>
    <message>
        <source>See that nothing covers the lens or the picture. What is photographed meanwhile is lost: stop, and measure again.</source>
        <translation>تأكد من أن لا شيء يغطي العدسة أو الصورة. ما يُصوَّر في هذه الأثناء ضائع: أوقف القياس ثم أعده.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MainWindow</name>
    <message>
        <source>Dim pictures</source>
        <translation>تعتيم الصور</translation>
    </message>
    <message>
        <source>Pictures dimmed</source>
        <translation>الصور معتّمة</translation>
    </message>
    <message>
        <source>Settings</source>
        <translation>الإعدادات</translation>
    </message>
    <message>
        <source>Help</source>
        <translation>مساعدة</translation>
    </message>
    <message>
        <source>F1</source>
        <translation>F1</translation>
    </message>
    <message>
        <source>Less light from this screen falls into the room (F9)</source>
        <translation>يقل ما يقع في القاعة من ضوء هذه الشاشة (F9)</translation>
    </message>
    <message>
        <source>Undone: %1</source>
        <translation>تم التراجع: %1</translation>
    </message>
    <message>
        <source>Nothing to undo here</source>
        <translation>لا شيء للتراجع عنه هنا</translation>
    </message>
    <message>
        <source>Done again: %1</source>
        <translation>أُعيد: %1</translation>
    </message>
    <message>
        <source>Nothing to do again</source>
        <translation>لا شيء لإعادته</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MaskEditing</name>
    <message>
        <source>This is no mask: %1.</source>
        <translation>هذا ليس قناعًا: %1.</translation>
    </message>
    <message>
        <source>New mask</source>
        <translation>قناع جديد</translation>
    </message>
    <message>
        <source>Outline of a mask</source>
        <translation>محيط قناع</translation>
    </message>
    <message>
        <source>Feather of a mask</source>
        <translation>تدرّج حافة قناع</translation>
    </message>
    <message>
        <source>Removed mask</source>
        <translation>قناع مُزال</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MaskView</name>
    <message numerus="yes">
        <source>Drawing a mask: %n point(s). Space sets one at %1, %2. Return closes it, Escape leaves it.</source>
        <translation>
            <numerusform>رسم قناع: %n نقطة. المسافة تضع نقطة عند %1، %2. الإدخال يغلقه، وEscape يلغيه.</numerusform>
            <numerusform>رسم قناع: نقطة واحدة (%n). المسافة تضع نقطة عند %1، %2. الإدخال يغلقه، وEscape يلغيه.</numerusform>
            <numerusform>رسم قناع: نقطتان (%n). المسافة تضع نقطة عند %1، %2. الإدخال يغلقه، وEscape يلغيه.</numerusform>
            <numerusform>رسم قناع: %n نقاط. المسافة تضع نقطة عند %1، %2. الإدخال يغلقه، وEscape يلغيه.</numerusform>
            <numerusform>رسم قناع: %n نقطة. المسافة تضع نقطة عند %1، %2. الإدخال يغلقه، وEscape يلغيه.</numerusform>
            <numerusform>رسم قناع: %n نقطة. المسافة تضع نقطة عند %1، %2. الإدخال يغلقه، وEscape يلغيه.</numerusform>
        </translation>
    </message>
    <message>
        <source>Point %1 of %2, %3, %4.</source>
        <translation>النقطة %1 من %2، %3، %4.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MatrixView</name>
    <message>
        <source>camera %1
projector %2</source>
        <translation>الكاميرا %1
جهاز العرض %2</translation>
    </message>
    <message>
        <source>%1
%2</source>
        <translation>%1
%2</translation>
    </message>
    <message>
        <source>transport</source>
        <translation>النقل</translation>
    </message>
    <message>
        <source>projector x, y</source>
        <translation>جهاز العرض x, y</translation>
    </message>
    <message>
        <source>projector line</source>
        <translation>سطر جهاز العرض</translation>
    </message>
    <message>
        <source>camera x, y</source>
        <translation>الكاميرا x, y</translation>
    </message>
    <message>
        <source>camera line</source>
        <translation>سطر الكاميرا</translation>
    </message>
    <message>
        <source>%1 across, %2 down</source>
        <translation>أفقيًا %1، رأسيًا %2</translation>
    </message>
</context>
<context>
    <name>relucent::gui::NameDialog</name>
    <message>
        <source>Name</source>
        <translation>الاسم</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>إلغاء</translation>
    </message>
    <message>
        <source>Type a name.</source>
        <translation>اكتب اسمًا.</translation>
    </message>
    <message>
        <source>It has this name.</source>
        <translation>هذا اسمه الحالي.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Nights</name>
    <message>
        <source>The venue was as it was measured.</source>
        <translation>كان الموقع كما كان عند القياس.</translation>
    </message>
    <message>
        <source>Repaired.</source>
        <translation>أُصلِحت.</translation>
    </message>
    <message>
        <source>Something has changed, and no better picture came of a repair.</source>
        <translation>تغيّر شيء ما، ولم ينتج عن الإصلاح صورة أفضل.</translation>
    </message>
    <message>
        <source>%1 dB</source>
        <translation>%1 dB</translation>
    </message>
    <message>
        <source>Photographed</source>
        <translation>مُصوَّرة</translation>
    </message>
    <message>
        <source>Predicted</source>
        <translation>متوقَّعة</translation>
    </message>
    <message>
        <source>Repaired</source>
        <translation>أُصلِحت</translation>
    </message>
    <message>
        <source>Alarm</source>
        <translation>إنذار</translation>
    </message>
    <message>
        <source>Days before the last night</source>
        <translation>أيام قبل الليلة الأخيرة</translation>
    </message>
    <message>
        <source>Colour error ΔE</source>
        <translation>خطأ اللون ΔE</translation>
    </message>
    <message numerus="yes">
        <source>%n night(s).</source>
        <translation>
            <numerusform>لا ليالٍ.</numerusform>
            <numerusform>ليلة واحدة.</numerusform>
            <numerusform>ليلتان.</numerusform>
            <numerusform>%n ليالٍ.</numerusform>
            <numerusform>%n ليلة.</numerusform>
            <numerusform>%n ليلة.</numerusform>
        </translation>
    </message>
    <message>
        <source>Photographed: %1 to %2, last %3.</source>
        <translation>مُصوَّرة: ⁨%1⁩ إلى ⁨%2⁩، والأخيرة ⁨%3⁩.</translation>
    </message>
    <message>
        <source>Repairs: %1. Alarms: %2.</source>
        <translation>الإصلاحات: ⁨%1⁩. الإنذارات: ⁨%2⁩.</translation>
    </message>
    <message>
        <source>Left out: %1</source>
        <translation>لم تُنفَّذ: ⁨%1⁩</translation>
    </message>
    <message>
        <source>Alarm: %1</source>
        <translation>إنذار: ⁨%1⁩</translation>
    </message>
    <message numerus="yes">
        <source>%n picture(s) perfected.</source>
        <translation>
            <numerusform>لم تُحسَّن أي صورة.</numerusform>
            <numerusform>حُسِّنت صورة واحدة.</numerusform>
            <numerusform>حُسِّنت صورتان.</numerusform>
            <numerusform>حُسِّنت %n صور.</numerusform>
            <numerusform>حُسِّنت %n صورة.</numerusform>
            <numerusform>حُسِّنت %n صورة.</numerusform>
        </translation>
    </message>
    <message>
        <source>Photographed: %1, predicted: %2.</source>
        <translation>مُصوَّرة: ⁨%1⁩، متوقَّعة: ⁨%2⁩.</translation>
    </message>
    <message>
        <source>Nobody was told: %1</source>
        <translation>لم يُبلَّغ أحد: ⁨%1⁩</translation>
    </message>
    <message>
        <source>Quality, dB</source>
        <translation>الجودة، dB</translation>
    </message>
</context>
<context>
    <name>relucent::gui::NightsDialog</name>
    <message>
        <source>Quality over weeks</source>
        <translation>الجودة عبر الأسابيع</translation>
    </message>
    <message>
        <source>Colour error</source>
        <translation>خطأ اللون</translation>
    </message>
    <message>
        <source>What the photograph of each night&apos;s proof came to, beside what was predicted.</source>
        <translation>ما أسفرت عنه لقطة التحقق في كل ليلة، إلى جانب ما كان متوقَّعًا.</translation>
    </message>
    <message>
        <source>Quality of the picture, night by night</source>
        <translation>جودة الصورة، ليلةً بعد ليلة</translation>
    </message>
    <message>
        <source>What came of each night, the last one first</source>
        <translation>نتيجة كل ليلة، الأخيرة أولًا</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>إغلاق</translation>
    </message>
    <message>
        <source>Quality</source>
        <translation>الجودة</translation>
    </message>
    <message>
        <source>Colour error: CIEDE2000, less is better. Quality: peak signal-to-noise ratio, PSNR, in dB; more is better.</source>
        <translation>خطأ اللون: CIEDE2000، الأقل أفضل. الجودة: نسبة ذروة الإشارة إلى الضوضاء PSNR بوحدة dB؛ الأكثر أفضل.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::NightsPart</name>
    <message>
        <source>Every night</source>
        <translation>كل ليلة</translation>
    </message>
    <message>
        <source>Quality over weeks</source>
        <translation>الجودة عبر الأسابيع</translation>
    </message>
    <message>
        <source>A chart of all nights, and what came of each.</source>
        <translation>مخطط لجميع الليالي، ونتيجة كل منها.</translation>
    </message>
    <message>
        <source>There was no night yet</source>
        <translation>لم تمرّ أي ليلة بعد</translation>
    </message>
    <message>
        <source>Somebody has to look, %1</source>
        <translation>لا بدّ من أن ينظر أحد، ⁨%1⁩</translation>
    </message>
    <message>
        <source>Left out, %1</source>
        <translation>لم تُنفَّذ، ⁨%1⁩</translation>
    </message>
    <message>
        <source>All is well, %1</source>
        <translation>كل شيء على ما يرام، ⁨%1⁩</translation>
    </message>
    <message>
        <source>Look after the picture</source>
        <translation>اعتنِ بالصورة</translation>
    </message>
    <message>
        <source>never</source>
        <translation>أبدًا</translation>
    </message>
    <message>
        <source>at %1</source>
        <translation>عند %1</translation>
    </message>
    <message>
        <source>A show can look after the picture by itself at night: it checks, repairs, perfects and proves, and tells here what came of it. Its camera has to stay where it is.</source>
        <translation>يمكن للعرض أن يعتني بالصورة بنفسه ليلًا: يفحص ويُصلح ويحسّن ويتحقق، ويذكر هنا النتيجة. على كاميرته أن تبقى في مكانها.</translation>
    </message>
    <message>
        <source>No show of a rehearsal is looked after.</source>
        <translation>لا يُعتنى بعرض التدريب.</translation>
    </message>
    <message>
        <source>The installed show has its first one at %1, if it plays by then. Its camera has to stay where it is.</source>
        <translation>للعرض المثبَّت أول ليلة عند ⁨%1⁩، إن كان يعمل حينها. يجب أن تبقى كاميرته في مكانها.</translation>
    </message>
    <message>
        <source>A night is under way</source>
        <translation>الليلة جارية الآن</translation>
    </message>
    <message>
        <source>The show makes way while its picture is looked after. What comes of it is told here.</source>
        <translation>يفسح العرض المجال بينما يُعتنى بصورته. وتُذكر النتيجة هنا.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::NudgeDialog</name>
    <message>
        <source>fits</source>
        <translation>مطابق</translation>
    </message>
    <message>
        <source>Turn the camera to the right and down.</source>
        <translation>أدر الكاميرا إلى اليمين وإلى الأسفل.</translation>
    </message>
    <message>
        <source>Turn the camera to the right and up.</source>
        <translation>أدر الكاميرا إلى اليمين وإلى الأعلى.</translation>
    </message>
    <message>
        <source>Turn the camera to the left and down.</source>
        <translation>أدر الكاميرا إلى اليسار وإلى الأسفل.</translation>
    </message>
    <message>
        <source>Turn the camera to the left and up.</source>
        <translation>أدر الكاميرا إلى اليسار وإلى الأعلى.</translation>
    </message>
    <message>
        <source>Turn the camera to the right.</source>
        <translation>أدر الكاميرا إلى اليمين.</translation>
    </message>
    <message>
        <source>Turn the camera to the left.</source>
        <translation>أدر الكاميرا إلى اليسار.</translation>
    </message>
    <message>
        <source>Turn the camera down.</source>
        <translation>أدر الكاميرا إلى الأسفل.</translation>
    </message>
    <message>
        <source>Turn the camera up.</source>
        <translation>أدر الكاميرا إلى الأعلى.</translation>
    </message>
    <message>
        <source>Tilt the camera clockwise.</source>
        <translation>أمِل الكاميرا باتجاه عقارب الساعة.</translation>
    </message>
    <message>
        <source>Tilt the camera anticlockwise.</source>
        <translation>أمِل الكاميرا عكس عقارب الساعة.</translation>
    </message>
    <message>
        <source>What the camera saw, and what it sees now</source>
        <translation>ما رأته الكاميرا وما تراه الآن</translation>
    </message>
    <message>
        <source>The projector shows full light. Left of the line stands what the camera saw when the venue was measured, right of it what it sees now.</source>
        <translation>يعرض جهاز العرض الضوء الكامل. على يسار الخط ما رأته الكاميرا عند قياس الموقع، وعلى يمينه ما تراه الآن.</translation>
    </message>
    <message>
        <source>Sideways</source>
        <translation>جانبيًا</translation>
    </message>
    <message>
        <source>Up and down</source>
        <translation>أعلى وأسفل</translation>
    </message>
    <message>
        <source>Tilt</source>
        <translation>الميل</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>إغلاق</translation>
    </message>
    <message>
        <source>Opening the devices</source>
        <translation>فتح الأجهزة</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>تم القياس</translation>
    </message>
    <message>
        <source>Now</source>
        <translation>الآن</translation>
    </message>
    <message>
        <source>%1 px to the right</source>
        <translation>⁨%1 px⁩ إلى اليمين</translation>
    </message>
    <message>
        <source>%1 px to the left</source>
        <translation>⁨%1 px⁩ إلى اليسار</translation>
    </message>
    <message>
        <source>%1 px down</source>
        <translation>⁨%1 px⁩ إلى الأسفل</translation>
    </message>
    <message>
        <source>%1 px up</source>
        <translation>⁨%1 px⁩ إلى الأعلى</translation>
    </message>
    <message>
        <source>%1°</source>
        <translation>⁨%1°⁩</translation>
    </message>
    <message>
        <source>Looking through the camera</source>
        <translation>مشاهدة صورة الكاميرا</translation>
    </message>
    <message>
        <source>The camera looks where it looked.</source>
        <translation>تنظر الكاميرا إلى حيث كانت تنظر.</translation>
    </message>
    <message>
        <source>Fasten it, look once more, and close this window.</source>
        <translation>ثبّتها وانظر مرة أخرى ثم أغلق هذه النافذة.</translation>
    </message>
    <message>
        <source>The arrow shows where. If the projector was bumped instead, move its picture the other way.</source>
        <translation>يبيّن السهم الاتجاه. إن كان جهاز العرض هو الذي تحرك فحرّك صورته في الاتجاه المعاكس.</translation>
    </message>
    <message>
        <source>What is seen is not the view that was measured.</source>
        <translation>ما يُرى ليس المنظر الذي جرى قياسه.</translation>
    </message>
    <message>
        <source>Turn the camera until both halves look alike. If they do, the light or the surface has changed.</source>
        <translation>أدر الكاميرا حتى يتشابه النصفان. إن كانا متشابهين فقد تغيّر الضوء أو السطح.</translation>
    </message>
    <message>
        <source>Put the camera back</source>
        <translation>أعد الكاميرا إلى مكانها</translation>
    </message>
    <message>
        <source>In a rehearsal it comes back by itself while you look.</source>
        <translation>في التدريب تعود من تلقاء نفسها بينما تنظر.</translation>
    </message>
    <message>
        <source>%1° clockwise</source>
        <translation>⁨%1°⁩ باتجاه عقارب الساعة</translation>
    </message>
    <message>
        <source>%1° anticlockwise</source>
        <translation>⁨%1°⁩ عكس عقارب الساعة</translation>
    </message>
    <message>
        <source>If the projector was bumped instead, move its picture the other way.</source>
        <translation>إن كان جهاز العرض هو الذي صُدم، فحرّك صورته في الاتجاه المعاكس.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputPage</name>
    <message>
        <source>Projector&apos;s screen</source>
        <translation>شاشة جهاز العرض</translation>
    </message>
    <message>
        <source>This screen</source>
        <translation>هذه الشاشة</translation>
    </message>
    <message>
        <source>%1: measured ΔE %2, predicted %3</source>
        <translation>%1: قيمة ΔE المقيسة %2، المتوقّعة %3</translation>
    </message>
    <message>
        <source>Not photographed yet</source>
        <translation>لم تُلتقط لقطة بعد</translation>
    </message>
    <message>
        <source>One photograph shows whether the surface looks as predicted.</source>
        <translation>تبيّن لقطة واحدة هل يبدو السطح كما هو متوقّع.</translation>
    </message>
    <message>
        <source>Corrected</source>
        <translation>مصحّح</translation>
    </message>
    <message>
        <source>Original</source>
        <translation>أصلي</translation>
    </message>
    <message>
        <source>%1 of the picture can be reached.</source>
        <translation>%1 من الصورة ضمن المدى.</translation>
    </message>
    <message>
        <source>The surface looks as predicted</source>
        <translation>السطح يبدو كما هو متوقّع</translation>
    </message>
    <message>
        <source>The camera or projector may have moved.</source>
        <translation>ربما تحرّكت الكاميرا أو جهاز العرض.</translation>
    </message>
    <message>
        <source>Error of the test patterns: %1, when measured %2. %3 of the view changed.</source>
        <translation>خطأ أنماط الاختبار: %1، وعند القياس %2. تغيّر %3 من المشهد.</translation>
    </message>
    <message>
        <source>The measurement still holds</source>
        <translation>القياس ما زال صالحًا</translation>
    </message>
    <message>
        <source>Verification</source>
        <translation>التحقق</translation>
    </message>
    <message>
        <source>Take verification photograph</source>
        <translation>التقاط لقطة التحقق</translation>
    </message>
    <message>
        <source>Ctrl+Shift+V</source>
        <translation>Ctrl+Shift+V</translation>
    </message>
    <message>
        <source>Check for drift</source>
        <translation>فحص الانحراف</translation>
    </message>
    <message>
        <source>Photographs the test patterns of the measurement again, ten or so.</source>
        <translation>يعيد تصوير أنماط اختبار القياس، نحو عشرة.</translation>
    </message>
    <message>
        <source>Hand over</source>
        <translation>التسليم</translation>
    </message>
    <message>
        <source>Save report</source>
        <translation>حفظ التقرير</translation>
    </message>
    <message>
        <source>Installed. The show starts at the next log-in, without camera or wizard.</source>
        <translation>تم التثبيت. يبدأ العرض عند تسجيل الدخول التالي، دون كاميرا أو معالج.</translation>
    </message>
    <message>
        <source>Playlist</source>
        <translation>قائمة التشغيل</translation>
    </message>
    <message>
        <source>The picture stands in its middle, pixel for pixel.</source>
        <translation>تقع الصورة في وسطها، بكسلًا ببكسل.</translation>
    </message>
    <message>
        <source>Still pictures: %1</source>
        <translation>الصور الثابتة: %1</translation>
    </message>
    <message>
        <source>Films and cross-fades use windows and steps, which are quick enough.</source>
        <translation>الأفلام والتلاشي المتداخل تستخدم «النوافذ والخطوات»، وهي سريعة بما يكفي.</translation>
    </message>
    <message>
        <source>Make the list again.</source>
        <translation>أنشئ القائمة من جديد.</translation>
    </message>
    <message>
        <source>Black</source>
        <translation>أسود</translation>
    </message>
    <message>
        <source>Frozen</source>
        <translation>مجمّد</translation>
    </message>
    <message>
        <source>Playing</source>
        <translation>قيد التشغيل</translation>
    </message>
    <message>
        <source>Add a picture or a film to the playlist.</source>
        <translation>أضف صورة أو فيلمًا إلى قائمة التشغيل.</translation>
    </message>
    <message>
        <source>Choose the projector&apos;s screen.</source>
        <translation>اختر شاشة جهاز العرض.</translation>
    </message>
    <message>
        <source>Playing. Hold A to compare.</source>
        <translation>قيد التشغيل. استمر في ضغط A للمقارنة.</translation>
    </message>
    <message>
        <source>Take a verification photograph, or install without proof.</source>
        <translation>التقط لقطة التحقق، أو ثبّت دون إثبات.</translation>
    </message>
    <message>
        <source>Nothing is projected before you open the output.</source>
        <translation>لا يُعرض شيء قبل أن تفتح الخرج.</translation>
    </message>
    <message>
        <source>Install show</source>
        <translation>تثبيت العرض</translation>
    </message>
    <message>
        <source>Install without proof</source>
        <translation>تثبيت دون إثبات</translation>
    </message>
    <message>
        <source>Open output</source>
        <translation>فتح الخرج</translation>
    </message>
    <message>
        <source>Play</source>
        <translation>تشغيل</translation>
    </message>
    <message>
        <source>Freeze</source>
        <translation>تجميد</translation>
    </message>
    <message>
        <source>Show again</source>
        <translation>إظهار مجددًا</translation>
    </message>
    <message>
        <source>Close output</source>
        <translation>إغلاق الخرج</translation>
    </message>
    <message>
        <source>Add to the playlist</source>
        <translation>الإضافة إلى قائمة التشغيل</translation>
    </message>
    <message>
        <source>Remove from the playlist</source>
        <translation>الإزالة من قائمة التشغيل</translation>
    </message>
    <message>
        <source>Order of the playlist</source>
        <translation>ترتيب قائمة التشغيل</translation>
    </message>
    <message>
        <source>Repeat</source>
        <translation>تكرار</translation>
    </message>
    <message>
        <source>Cross-fade</source>
        <translation>التلاشي المتداخل</translation>
    </message>
    <message>
        <source>The calibration is as it was.</source>
        <translation>المعايرة كما كانت.</translation>
    </message>
    <message>
        <source>Output</source>
        <translation>الخرج</translation>
    </message>
    <message>
        <source>Play corrected content, prove that it works with one photograph, and hand the venue over.</source>
        <translation>شغّل المحتوى المصحّح، وأثبت نجاحه بلقطة واحدة، وسلّم الموقع.</translation>
    </message>
    <message>
        <source>Playback</source>
        <translation>التشغيل</translation>
    </message>
    <message>
        <source>frames a second</source>
        <translation>إطار في الثانية</translation>
    </message>
    <message>
        <source>frame time</source>
        <translation>زمن الإطار</translation>
    </message>
    <message>
        <source>frames late</source>
        <translation>إطارات متأخرة</translation>
    </message>
    <message>
        <source>Seconds</source>
        <translation>الثواني</translation>
    </message>
    <message>
        <source>Frame time, ms</source>
        <translation>زمن الإطار، ms</translation>
    </message>
    <message>
        <source>Frame times of the last minute</source>
        <translation>أزمنة الإطارات في الدقيقة الأخيرة</translation>
    </message>
    <message>
        <source>%1 ms</source>
        <translation>⁨%1 ms⁩</translation>
    </message>
    <message>
        <source>closed</source>
        <translation>مغلق</translation>
    </message>
    <message>
        <source>on %1</source>
        <translation>على ⁨%1⁩</translation>
    </message>
    <message>
        <source>still picture, on %1</source>
        <translation>صورة ثابتة، على ⁨%1⁩</translation>
    </message>
    <message>
        <source>On the projector now</source>
        <translation>على جهاز العرض الآن</translation>
    </message>
    <message>
        <source>What the projector shows</source>
        <translation>ما يعرضه جهاز العرض</translation>
    </message>
    <message>
        <source>Photograph of the surface</source>
        <translation>لقطة السطح</translation>
    </message>
    <message>
        <source>What was wanted at the left of the divider, the photograph at the right</source>
        <translation>المطلوب على يسار الفاصل، واللقطة على يمينه</translation>
    </message>
    <message>
        <source>No verification photograph has been taken.</source>
        <translation>لم تُلتقط لقطة تحقق بعد.</translation>
    </message>
    <message>
        <source>Photograph against wanted</source>
        <translation>اللقطة مقابل المطلوب</translation>
    </message>
    <message>
        <source>colour difference</source>
        <translation>فرق اللون</translation>
    </message>
    <message>
        <source>Colour difference between the photograph and what was wanted</source>
        <translation>فرق اللون بين اللقطة والمطلوب</translation>
    </message>
    <message>
        <source>A verification photograph shows here what is left to see.</source>
        <translation>تبيّن لقطة التحقق هنا ما بقي من فروق.</translation>
    </message>
    <message>
        <source>taken %1</source>
        <translation>التُقطت في %1</translation>
    </message>
    <message>
        <source>Wanted</source>
        <translation>المطلوب</translation>
    </message>
    <message>
        <source>Photograph</source>
        <translation>اللقطة</translation>
    </message>
    <message>
        <source>Delete removes an item, Ctrl+Up and Ctrl+Down move it. Files can be dropped here.</source>
        <translation>يزيل Delete عنصرًا، وينقله Ctrl+Up أو Ctrl+Down. يمكن إفلات الملفات هنا.</translation>
    </message>
    <message>
        <source>%1, playing</source>
        <translation>⁨%1⁩، قيد التشغيل</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>إضافة</translation>
    </message>
    <message>
        <source>Add files to the playlist</source>
        <translation>إضافة ملفات إلى قائمة التشغيل</translation>
    </message>
    <message>
        <source>Move up</source>
        <translation>نقل لأعلى</translation>
    </message>
    <message>
        <source>Move down</source>
        <translation>نقل لأسفل</translation>
    </message>
    <message>
        <source>Cross-fade, tenths of a second</source>
        <translation>التلاشي المتداخل، بأعشار الثانية</translation>
    </message>
    <message>
        <source>Add pictures or films</source>
        <translation>إضافة صور أو أفلام</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 ث</translation>
    </message>
    <message>
        <source>Skipped: %1</source>
        <translation>تم تخطي: ⁨%1⁩</translation>
    </message>
    <message>
        <source>This screen&apos;s resolution is not that of the projector that was measured.</source>
        <translation>دقّة هذه الشاشة ليست دقّة جهاز العرض الذي تم قياسه.</translation>
    </message>
    <message>
        <source>Written to %1, and for paper to report.pdf beside it.</source>
        <translation>كُتب في %1، وللورق في report.pdf بجانبه.</translation>
    </message>
    <message>
        <source>The projector is another screen now</source>
        <translation>جهاز العرض الآن شاشة أخرى</translation>
    </message>
    <message>
        <source>Show installed</source>
        <translation>العرض مثبَّت</translation>
    </message>
    <message>
        <source>Installed at %1: the show starts at the next log-in. Hold A to compare.</source>
        <translation>ثُبّت في %1: يبدأ العرض عند تسجيل الدخول التالي. اضغط A مطوّلاً للمقارنة.</translation>
    </message>
    <message>
        <source>The output will cover this window. Esc closes the output.</source>
        <translation>سيغطي الخرج هذه النافذة. يغلقه Esc.</translation>
    </message>
    <message>
        <source>Install again</source>
        <translation>ثبّت من جديد</translation>
    </message>
    <message>
        <source>The projector&apos;s screen %1 is not there. Plug it in, or choose another.</source>
        <translation>شاشة جهاز العرض %1 غير موجودة. صِلها أو اختر غيرها.</translation>
    </message>
    <message>
        <source>Choose a screen for projector %1.</source>
        <translation>اختر شاشة لجهاز العرض %1.</translation>
    </message>
    <message numerus="yes">
        <source>Each of the %n projector(s) needs a screen of its own. Plug in another one.</source>
        <translation>
            <numerusform>لا أجهزة عرض.</numerusform>
            <numerusform>يحتاج جهاز العرض إلى شاشة خاصة به. صِل واحدة.</numerusform>
            <numerusform>يحتاج كل من جهازي العرض إلى شاشة خاصة به. صِل أخرى.</numerusform>
            <numerusform>يحتاج كل من أجهزة العرض الـ%n إلى شاشة خاصة به. صِل أخرى.</numerusform>
            <numerusform>يحتاج كل من أجهزة العرض الـ%n إلى شاشة خاصة به. صِل أخرى.</numerusform>
            <numerusform>يحتاج كل من أجهزة العرض الـ%n إلى شاشة خاصة به. صِل أخرى.</numerusform>
        </translation>
    </message>
    <message>
        <source>There is one screen only. Plug the projector in and extend the desktop to it, or choose this screen.</source>
        <translation>توجد شاشة واحدة فقط. صِل جهاز العرض ومدّ سطح المكتب إليه، أو اختر هذه الشاشة.</translation>
    </message>
    <message>
        <source>still picture, %1 of the pixels at their limit</source>
        <translation>صورة ثابتة، %1 من البكسلات عند حدها</translation>
    </message>
    <message>
        <source>%1 fps, %2 ms, %3 of the pixels at their limit</source>
        <translation>⁨%1 fps⁩، ‏⁨%2 ms⁩، ‏%3 من البكسلات عند حدها</translation>
    </message>
    <message>
        <source>Screen unplugged</source>
        <translation>الشاشة مفصولة</translation>
    </message>
    <message>
        <source>The surface does not look as predicted. Find out whether something moved.</source>
        <translation>لا يبدو السطح كما كان متوقعًا. تحقّق هل تحرّك شيء.</translation>
    </message>
    <message>
        <source>Something has changed since it was measured. Measure again, then install.</source>
        <translation>تغيّر شيء منذ القياس. أعد القياس ثم ثبّت.</translation>
    </message>
    <message>
        <source>Install anyway</source>
        <translation>التثبيت رغم ذلك</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>إعادة القياس</translation>
    </message>
    <message>
        <source>Aim again</source>
        <translation>إعادة التصويب</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged</source>
        <translation>شاشة جهاز العرض غير موصولة</translation>
    </message>
    <message>
        <source>Nothing is lost. Plug it in again: the show comes back by itself.</source>
        <translation>لم يُفقد شيء. أعد توصيلها، فيعود العرض تلقائيًا.</translation>
    </message>
    <message>
        <source>The camera&apos;s view has moved by %1 px sideways and %2 px up or down.</source>
        <translation>تحرك منظر الكاميرا ⁨%1 px⁩ جانبيًا و⁨%2 px⁩ رأسيًا.</translation>
    </message>
    <message>
        <source>Shows full light, and where the camera has to be turned to look where it looked.</source>
        <translation>يعرض الضوء الكامل ويبيّن إلى أين تُدار الكاميرا لتنظر إلى حيث كانت تنظر.</translation>
    </message>
    <message>
        <source>Limit for %1 frames a second: %2 ms</source>
        <translation>الحد لـ⁨%1⁩ إطارًا في الثانية: ⁨%2 ms⁩</translation>
    </message>
    <message>
        <source>the processor</source>
        <translation>المعالج</translation>
    </message>
    <message>
        <source>Next test chart (T)</source>
        <translation>لوحة الاختبار التالية (T)</translation>
    </message>
    <message>
        <source>Figures over the picture (O)</source>
        <translation>أرقام فوق الصورة (O)</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>الأجهزة مستخدمة في خطوة «%1».</translation>
    </message>
    <message>
        <source>Put the camera back</source>
        <translation>أعد الكاميرا إلى مكانها</translation>
    </message>
    <message>
        <source>On this page only</source>
        <translation>في هذه الصفحة فقط</translation>
    </message>
    <message>
        <source>The photograph is out of date</source>
        <translation>اللقطة بحاجة إلى تحديث</translation>
    </message>
    <message>
        <source>Another venue&apos;s show starts at log-in. Installing this one replaces it.</source>
        <translation>يبدأ عرض موقع آخر عند تسجيل الدخول. تثبيت هذا العرض يحل محله.</translation>
    </message>
    <message>
        <source>Another venue&apos;s show starts at log-in. This is a rehearsal, which is not installed.</source>
        <translation>يبدأ عرض موقع آخر عند تسجيل الدخول. هذا تدريب، ولا يُثبَّت.</translation>
    </message>
    <message>
        <source>Once installed, the show starts at every log-in, without camera or wizard.</source>
        <translation>بعد التثبيت يبدأ العرض عند كل تسجيل دخول، دون كاميرا أو معالج.</translation>
    </message>
    <message>
        <source>This is a rehearsal with simulated devices: its show is not installed. That of a real venue starts at every log-in.</source>
        <translation>هذا تدريب بأجهزة محاكاة: لا يُثبَّت عرضه. أما عرض الموقع الحقيقي فيبدأ عند كل تسجيل دخول.</translation>
    </message>
    <message>
        <source>Remove installed show</source>
        <translation>إزالة العرض المثبّت</translation>
    </message>
    <message>
        <source>It does not start at log-in any more. Venue and playlist stay.</source>
        <translation>لا يعود يبدأ عند تسجيل الدخول. يبقى الموقع وقائمة التشغيل.</translation>
    </message>
    <message>
        <source>Proof out of date</source>
        <translation>الإثبات بحاجة إلى تحديث</translation>
    </message>
    <message>
        <source>Take a verification photograph: it proves that the venue is measured well.</source>
        <translation>التقط لقطة التحقق: فهي تثبت أن الموقع قيس جيدًا.</translation>
    </message>
    <message>
        <source>This rehearsal plays on this page only: nothing is projected.</source>
        <translation>يعمل هذا التدريب في هذه الصفحة فقط: لا يُعرض شيء بجهاز العرض.</translation>
    </message>
    <message>
        <source>Black: the show goes on unseen until you show it again.</source>
        <translation>أسود: يستمر العرض دون أن يُرى حتى تُظهره من جديد.</translation>
    </message>
    <message>
        <source>Frozen: this picture stands until you press Play.</source>
        <translation>مجمّد: تبقى هذه الصورة حتى تضغط «تشغيل».</translation>
    </message>
    <message>
        <source>Rehearsed to the end. A simulated venue is not installed. Hold A to compare.</source>
        <translation>اكتمل التدريب. لا يُثبَّت موقع محاكى. استمر في ضغط A للمقارنة.</translation>
    </message>
    <message>
        <source>The verification photograph is out of date</source>
        <translation>لقطة التحقق بحاجة إلى تحديث</translation>
    </message>
    <message>
        <source>taken %1, out of date</source>
        <translation>التُقطت في ⁨%1⁩، بحاجة إلى تحديث</translation>
    </message>
    <message>
        <source>No screen chosen</source>
        <translation>لم تُختر شاشة</translation>
    </message>
    <message>
        <source>%1, unplugged</source>
        <translation>%1، مفصولة</translation>
    </message>
    <message>
        <source>Not to be proved yet</source>
        <translation>لا يمكن التحقق بعد</translation>
    </message>
    <message>
        <source>What it was taken of has been measured or chosen anew since, or is another set. Take it again to prove what is shown now.</source>
        <translation>قيس ما تُظهره أو اختير من جديد منذ ذلك الحين، أو هو مجموعة أخرى. التقطها مرة أخرى للتحقق مما يُعرض الآن.</translation>
    </message>
    <message>
        <source>As predicted, but errors are plain to see</source>
        <translation>كما هو متوقّع، لكن الأخطاء واضحة للعين</translation>
    </message>
    <message>
        <source>Nothing has moved: the prediction itself is coarse. Measuring finer or darker content helps.</source>
        <translation>لم يتحرّك شيء: التوقّع نفسه تقريبي. يفيد قياس أدق أو محتوى أعتم.</translation>
    </message>
    <message>
        <source>Waiting for the projector&apos;s screen to come back.</source>
        <translation>في انتظار عودة شاشة جهاز العرض.</translation>
    </message>
    <message>
        <source>What plays is not what was measured or chosen last. Show that first.</source>
        <translation>ما يُعرض ليس آخر ما قيس أو اختير. أظهره أولًا.</translation>
    </message>
    <message>
        <source>Look at it first</source>
        <translation>ألقِ نظرة أولًا</translation>
    </message>
    <message>
        <source>What was measured or chosen since is not on the projector yet.</source>
        <translation>ما قيس أو اختير منذ ذلك الحين لم يصل إلى جهاز العرض بعد.</translation>
    </message>
    <message>
        <source>What was measured or chosen since is not on the projector yet. Steps that are out of date count with what was chosen there before.</source>
        <translation>ما قيس أو اختير منذ ذلك الحين لم يصل إلى جهاز العرض بعد. الخطوات التي تحتاج إلى تحديث تسري كما اختيرت من قبل.</translation>
    </message>
    <message>
        <source>The screen %1 is unplugged. Nothing is projected.</source>
        <translation>الشاشة %1 مفصولة. لا يُعرض شيء.</translation>
    </message>
    <message>
        <source>Camera %1: %2, as predicted</source>
        <translation>الكاميرا ⁨%1⁩: ⁨%2⁩، كما هو متوقع</translation>
    </message>
    <message>
        <source>Camera %1: %2, not as predicted</source>
        <translation>الكاميرا ⁨%1⁩: ⁨%2⁩، خلافًا للمتوقع</translation>
    </message>
    <message>
        <source>The view of camera %3 has moved by %1 px sideways and %2 px up or down.</source>
        <translation>تحرك مشهد الكاميرا ⁨%3⁩ بمقدار ⁨%1⁩ بكسل جانبيًا و⁨%2⁩ بكسل عموديًا.</translation>
    </message>
    <message>
        <source>Camera %1 or a projector may have moved.</source>
        <translation>ربما تحركت الكاميرا ⁨%1⁩ أو أحد أجهزة العرض.</translation>
    </message>
    <message>
        <source>Something has changed. Repair the calibration.</source>
        <translation>تغيّر شيء ما. أصلِح المعايرة.</translation>
    </message>
    <message>
        <source>Something has changed since it was measured. Repair the calibration: only that is measured again.</source>
        <translation>تغيّر شيء ما منذ القياس. أصلِح المعايرة: لا يُعاد إلا قياس ما تغيّر.</translation>
    </message>
    <message>
        <source>Repair the calibration</source>
        <translation>إصلاح المعايرة</translation>
    </message>
    <message>
        <source>Nothing to repair</source>
        <translation>لا شيء يحتاج إلى إصلاح</translation>
    </message>
    <message>
        <source>The venue is as it was measured.</source>
        <translation>الموقع كما كان عند القياس.</translation>
    </message>
    <message>
        <source>Not repaired</source>
        <translation>لم تُصلَح</translation>
    </message>
    <message>
        <source>No better picture came of it: the measurement is used as before.</source>
        <translation>لم تصبح الصورة أفضل: يُستخدم القياس كما كان.</translation>
    </message>
    <message>
        <source>Repaired, %1</source>
        <translation>أُصلِحت، %1</translation>
    </message>
    <message>
        <source>Colour error of a photographed picture: %1 before, %2 now.</source>
        <translation>خطأ ألوان صورة مُصوَّرة: %1 من قبل، و%2 الآن.</translation>
    </message>
    <message>
        <source>Finds what has changed, measures only that again, and keeps it if a photograph of the picture is better by it.</source>
        <translation>يعثر على ما تغيّر، ولا يعيد إلا قياسه، ويحتفظ به إذا تحسّنت به صورة فوتوغرافية للعرض.</translation>
    </message>
    <message>
        <source>Use the measurement before</source>
        <translation>استخدام القياس السابق</translation>
    </message>
    <message>
        <source>Takes the repair back.</source>
        <translation>يتراجع عن الإصلاح.</translation>
    </message>
    <message>
        <source>arrival to light</source>
        <translation>من الوصول إلى الضوء</translation>
    </message>
    <message>
        <source>From a live picture&apos;s arrival at this computer until the projectors have it: the longest of the last five seconds. The way there is not in it.</source>
        <translation>من وصول الصورة الحية إلى هذا الحاسوب حتى تكون لدى أجهزة العرض: أطول مدة في الثواني الخمس الأخيرة. الطريق إلى هنا غير محسوب.</translation>
    </message>
    <message>
        <source>Connecting to %1</source>
        <translation>جارٍ الاتصال بـ %1</translation>
    </message>
    <message>
        <source>Lost: %1. %2</source>
        <translation>فُقد: %1. %2</translation>
    </message>
    <message>
        <source>Add a stream</source>
        <translation>إضافة بث</translation>
    </message>
    <message>
        <source>A live picture from the network, as cameras and encoders send it.</source>
        <translation>صورة حية من الشبكة، كما ترسلها الكاميرات وأجهزة الترميز.</translation>
    </message>
    <message>
        <source>Nothing has moved: of the light only %1 is kept at Threshold, so that bounces are missing, in the prediction too. Keep more of it.</source>
        <translation>لم يتحرك شيء: لا يبقى عند «العتبة» سوى %1 من الضوء، فتنقص الانعكاسات، في التوقع أيضًا. احتفظ بالمزيد منه.</translation>
    </message>
    <message>
        <source>The show of another venue will no longer start at log-in.</source>
        <translation>لن يبدأ عرض موقع آخر عند تسجيل الدخول بعد الآن.</translation>
    </message>
    <message>
        <source>The show of this venue will no longer start at log-in.</source>
        <translation>لن يبدأ عرض هذا الموقع عند تسجيل الدخول بعد الآن.</translation>
    </message>
    <message>
        <source>Venue and playlist stay. It can be installed again from its venue&apos;s Output.</source>
        <translation>يبقى الموقع وقائمة التشغيل. يمكن تثبيته من جديد من «الخرج» في موقعه.</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>إزالة</translation>
    </message>
    <message>
        <source>Keep</source>
        <translation>إبقاء</translation>
    </message>
    <message>
        <source>To end it, hold Esc for two seconds at the projector&apos;s screen.</source>
        <translation>لإنهائه استمر في ضغط Esc مدة ثانيتين على شاشة جهاز العرض.</translation>
    </message>
    <message>
        <source>Test chart</source>
        <translation>لوحة اختبار</translation>
    </message>
    <message>
        <source>A test chart is on the surface. T shows the next one, then the playlist.</source>
        <translation>لوحة اختبار على السطح. يعرض المفتاح T التالية ثم قائمة التشغيل.</translation>
    </message>
    <message>
        <source>Show the playlist</source>
        <translation>إظهار قائمة التشغيل</translation>
    </message>
    <message>
        <source>A test chart is on the surface</source>
        <translation>لوحة اختبار على السطح</translation>
    </message>
    <message>
        <source>The playlist runs on unseen until you show it again.</source>
        <translation>تستمر قائمة التشغيل دون أن تُرى حتى تُظهرها من جديد.</translation>
    </message>
    <message>
        <source>Times of sets</source>
        <translation>أوقات المجموعات</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>المجموعة</translation>
    </message>
    <message>
        <source>Times of the day…</source>
        <translation>أوقات اليوم…</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1: %2</translation>
    </message>
    <message>
        <source>The installed show plays this one all day.</source>
        <translation>يستخدم العرض المثبّت هذه المجموعة طوال اليوم.</translation>
    </message>
    <message>
        <source>The picture is being perfected.</source>
        <translation>يجري تحسين الصورة.</translation>
    </message>
    <message>
        <source>The output is being opened.</source>
        <translation>يُفتح الخرج الآن.</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged.</source>
        <translation>شاشة جهاز العرض مفصولة.</translation>
    </message>
    <message>
        <source>There is nothing else on the list.</source>
        <translation>لا شيء آخر في القائمة.</translation>
    </message>
    <message>
        <source>The playlist is empty.</source>
        <translation>قائمة التشغيل فارغة.</translation>
    </message>
    <message>
        <source>There is no other set.</source>
        <translation>لا توجد مجموعة أخرى.</translation>
    </message>
    <message>
        <source>The show changes by itself, here too: %1</source>
        <translation>يتبدّل العرض تلقائيًا، هنا أيضًا: %1</translation>
    </message>
    <message>
        <source>Choose in the desktop&apos;s dialog what to show as %1</source>
        <translation>اختر في مربع حوار سطح المكتب ما يعرضه %1</translation>
    </message>
    <message>
        <source>Add a screen or window</source>
        <translation>إضافة شاشة أو نافذة</translation>
    </message>
    <message>
        <source>The live picture of a screen of this computer, or of a window on it.</source>
        <translation>الصورة الحية لشاشة من شاشات هذا الحاسوب، أو لنافذة عليها.</translation>
    </message>
    <message>
        <source>A screen, chosen in the desktop&apos;s dialog</source>
        <translation>شاشة تُختار في مربع حوار سطح المكتب</translation>
    </message>
    <message>
        <source>A window, chosen in the desktop&apos;s dialog</source>
        <translation>نافذة تُختار في مربع حوار سطح المكتب</translation>
    </message>
    <message>
        <source>Screen %1</source>
        <translation>الشاشة %1</translation>
    </message>
    <message>
        <source>Window %1</source>
        <translation>النافذة %1</translation>
    </message>
    <message>
        <source>There is no desktop whose screens could be shown.</source>
        <translation>لا يوجد سطح مكتب يمكن عرض شاشاته.</translation>
    </message>
    <message>
        <source>The camera is back at its place</source>
        <translation>عادت الكاميرا إلى موضعها</translation>
    </message>
    <message>
        <source>Put the camera back, or repair the calibration.</source>
        <translation>أعد الكاميرا إلى مكانها، أو أصلِح المعايرة.</translation>
    </message>
    <message>
        <source>Perfecting</source>
        <translation>جارٍ الإتقان</translation>
    </message>
    <message>
        <source>Photographing</source>
        <translation>جارٍ التصوير</translation>
    </message>
    <message>
        <source>Checking for drift</source>
        <translation>جارٍ فحص الانحراف</translation>
    </message>
    <message>
        <source>Repairing</source>
        <translation>جارٍ الإصلاح</translation>
    </message>
    <message>
        <source>The output is closed. Patterns to be photographed are projected.</source>
        <translation>الخرج مغلق. تُعرض أنماط لتصويرها.</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>إيقاف</translation>
    </message>
    <message>
        <source>Not as predicted</source>
        <translation>ليس كما هو متوقع</translation>
    </message>
    <message>
        <source>The output is closed. The devices are in use at %1.</source>
        <translation>الخرج مغلق. الأجهزة مستخدمة في خطوة «%1».</translation>
    </message>
    <message>
        <source>Show the current correction</source>
        <translation>إظهار التصحيح الحالي</translation>
    </message>
    <message>
        <source>The projector still shows another correction. Show the current one, then take the photograph.</source>
        <translation>ما زال جهاز العرض يعرض تصحيحًا آخر. أظهر الحالي ثم التقط اللقطة.</translation>
    </message>
    <message>
        <source>Another correction</source>
        <translation>تصحيح آخر</translation>
    </message>
    <message>
        <source>The camera&apos;s view has moved. Put it back, then photograph again.</source>
        <translation>تحرك منظر الكاميرا. أعدها إلى مكانها ثم صوّر مرة أخرى.</translation>
    </message>
    <message>
        <source>The show still plays another correction</source>
        <translation>العرض ما زال يستخدم تصحيحًا آخر</translation>
    </message>
    <message>
        <source>Another correction plays. Show the current one first.</source>
        <translation>يُعرض تصحيح آخر. أظهر الحالي أولًا.</translation>
    </message>
    <message>
        <source>Another correction still plays.</source>
        <translation>ما زال تصحيح آخر معروضًا.</translation>
    </message>
    <message>
        <source>Covered by %1</source>
        <translation>تغطّيه خطوة ⁨%1⁩</translation>
    </message>
    <message>
        <source>The projector shows the light of another step: %1</source>
        <translation>يعرض جهاز العرض ضوء خطوة أخرى: %1</translation>
    </message>
    <message>
        <source>The show goes on behind it, and is seen again when that has ended.</source>
        <translation>يستمر العرض خلفه ويظهر من جديد عند انتهائه.</translation>
    </message>
    <message>
        <source>The light of another step is before the show.</source>
        <translation>ضوء خطوة أخرى أمام العرض.</translation>
    </message>
    <message>
        <source>Time of a picture</source>
        <translation>مدة صورة</translation>
    </message>
    <message>
        <source>%1, skipped</source>
        <translation>⁨%1⁩، جرى تخطّيه</translation>
    </message>
    <message>
        <source>Seconds that the chosen picture stands</source>
        <translation>عدد ثواني بقاء الصورة المختارة</translation>
    </message>
    <message>
        <source> s</source>
        <translation> ث</translation>
    </message>
    <message>
        <source>Picture stands for</source>
        <translation>مدة بقاء الصورة</translation>
    </message>
    <message>
        <source>Photographed %1.</source>
        <translation>التُقطت في ⁨%1⁩.</translation>
    </message>
    <message>
        <source>Photographed %1, before the last check for drift.</source>
        <translation>التُقطت في ⁨%1⁩، قبل آخر فحص للانحراف.</translation>
    </message>
    <message>
        <source>The surface looked as predicted then</source>
        <translation>كان السطح يبدو حينها كما هو متوقّع</translation>
    </message>
    <message>
        <source>Checked %1.</source>
        <translation>فُحص في ⁨%1⁩.</translation>
    </message>
    <message>
        <source>Hold A for the original, Ctrl+P freezes, B makes it black, T shows test charts, O figures.</source>
        <translation>أبقِ A مضغوطًا للأصل، Ctrl+P يجمّد، B يسوّد، T يعرض لوحات الاختبار، O الأرقام.</translation>
    </message>
    <message>
        <source>No program here opens it: open it by hand, or take it to another computer.</source>
        <translation>لا يوجد هنا برنامج يفتحه: افتحه يدويًا، أو انقله إلى حاسوب آخر.</translation>
    </message>
    <message>
        <source>Picture: %1</source>
        <translation>الصورة: %1</translation>
    </message>
    <message>
        <source>The check was ended: the room is not said to be clear</source>
        <translation>أُنهي الفحص: لم يعد مؤكدًا أن القاعة خالية</translation>
    </message>
    <message>
        <source>It came to no result. Check again when the room is clear.</source>
        <translation>لم يُفضِ إلى نتيجة. أعد الفحص عندما تكون القاعة خالية.</translation>
    </message>
    <message>
        <source>The repair was ended: the room is not said to be clear</source>
        <translation>أُنهي الإصلاح: لم يعد مؤكدًا أن القاعة خالية</translation>
    </message>
    <message>
        <source>The measurement is used as before. Repair again when the room is clear.</source>
        <translation>يُستخدم القياس كما كان. أعد الإصلاح عندما تكون القاعة خالية.</translation>
    </message>
    <message>
        <source>The output is closed. A picture to be photographed is projected.</source>
        <translation>الخرج مغلق. تُعرض صورة لتصويرها.</translation>
    </message>
    <message>
        <source>The room is brighter by %1 of full light.</source>
        <translation>القاعة أسطع بمقدار ⁨%1⁩ من كامل الضوء.</translation>
    </message>
    <message>
        <source>The room is darker by %1 of full light.</source>
        <translation>القاعة أعتم بمقدار ⁨%1⁩ من كامل الضوء.</translation>
    </message>
    <message>
        <source>The projector gives %1 of the light that it gave.</source>
        <translation>يعطي جهاز العرض ⁨%1⁩ من الضوء الذي كان يعطيه.</translation>
    </message>
    <message>
        <source>The output is closed. Nothing is projected from here.</source>
        <translation>الخرج مغلق. لا يُعرض شيء من هنا.</translation>
    </message>
    <message>
        <source>A photograph is being taken.</source>
        <translation>تُلتقط صورة.</translation>
    </message>
    <message>
        <source>Slowly, as the room is not said to be clear: nothing flashes.</source>
        <translation>ببطء، إذ لم يؤكَّد أن القاعة خالية: لا شيء يومض.</translation>
    </message>
    <message>
        <source>It plays this playlist with the measurement that is in use by then.</source>
        <translation>يشغّل قائمة التشغيل هذه بالقياس المستخدم حينها.</translation>
    </message>
    <message>
        <source>The output is closed here. Another program plays a show of this venue.</source>
        <translation>الخرج مغلق هنا. يشغّل برنامج آخر عرضًا لهذا الموقع.</translation>
    </message>
    <message>
        <source>Hardly anything fits. Put the camera back or repair the calibration; if neither helps, aim and measure again.</source>
        <translation>لا يكاد شيء يتطابق. أعد الكاميرا إلى مكانها أو أصلح المعايرة؛ وإن لم ينفع ذلك فوجّه وقِس من جديد.</translation>
    </message>
    <message>
        <source>Almost nothing of the projector&apos;s light is seen. Look at the lens and at the projector, then check again.</source>
        <translation>لا يُرى من ضوء جهاز العرض شيء تقريبًا. افحص العدسة وجهاز العرض، ثم أعد الفحص.</translation>
    </message>
    <message>
        <source>Installed. The show starts at the next log-in, without wizard. The camera stays: at night it looks after the picture.</source>
        <translation>مثبَّت. يبدأ العرض عند تسجيل الدخول التالي من دون المعالج. تبقى الكاميرا في مكانها: فهي تعتني بالصورة ليلًا.</translation>
    </message>
    <message>
        <source>Another program plays</source>
        <translation>برنامج آخر يعرض</translation>
    </message>
    <message>
        <source>Hardly anything fits. Put the camera back, repair the calibration, or aim and measure again.</source>
        <translation>لا يكاد شيء يتطابق. أعد الكاميرا إلى مكانها، أو أصلح المعايرة، أو وجّه وقِس من جديد.</translation>
    </message>
    <message>
        <source>Another program plays a show of this venue.</source>
        <translation>يشغّل برنامج آخر عرضًا لهذا الموقع.</translation>
    </message>
    <message>
        <source>The room&apos;s light has changed. Restore it and check again, or repair the calibration.</source>
        <translation>تغيّرت إضاءة القاعة. أعِدها كما كانت وافحص من جديد، أو أصلح المعايرة.</translation>
    </message>
    <message>
        <source>The camera looks elsewhere</source>
        <translation>الكاميرا موجَّهة إلى مكان آخر</translation>
    </message>
    <message>
        <source>It was left %1 px from where it looked when it was measured. Put it back, or repair the calibration.</source>
        <translation>تُركت على بُعد ⁨%1⁩ بكسل من حيث كانت موجَّهة عند القياس. أعِدها إلى مكانها، أو أصلح المعايرة.</translation>
    </message>
    <message>
        <source>Put the camera back, or measure again.</source>
        <translation>أعد الكاميرا إلى مكانها، أو قِس من جديد.</translation>
    </message>
    <message>
        <source>Something has changed. Measure again.</source>
        <translation>تغيّر شيء ما. قِس من جديد.</translation>
    </message>
    <message>
        <source>Hardly anything fits. Put the camera back, or aim and measure again.</source>
        <translation>لا يكاد شيء يتطابق. أعد الكاميرا إلى مكانها، أو وجّه وقِس من جديد.</translation>
    </message>
    <message>
        <source>Keep the repaired one</source>
        <translation>الاحتفاظ بالمُصلَح</translation>
    </message>
    <message>
        <source>Use the measurement before?</source>
        <translation>استخدام القياس السابق؟</translation>
    </message>
    <message>
        <source>What was repaired is measured again if you repair once more.</source>
        <translation>ما أُصلح يُقاس من جديد إذا أصلحت مرة أخرى.</translation>
    </message>
    <message>
        <source>The measurement from before the repair is used as it was, with all that followed from it.</source>
        <translation>يُستخدم القياس السابق للإصلاح كما كان، مع كل ما نتج عنه.</translation>
    </message>
    <message>
        <source>Screen %1, which this plays on</source>
        <translation>الشاشة %1، وهي التي يُعرض عليها</translation>
    </message>
    <message>
        <source>They are larger than predicted. A check for drift tells whether something has moved.</source>
        <translation>هي أكبر من المتوقع. يبيّن فحص الانحراف ما إذا كان شيء قد تحرك.</translation>
    </message>
    <message>
        <source>Once installed, the show starts at every log-in, without wizard. The camera stays: at night it looks after the picture.</source>
        <translation>بعد التثبيت يبدأ العرض عند كل تسجيل دخول، دون المعالج. وتبقى الكاميرا: فهي تعتني بالصورة ليلًا.</translation>
    </message>
    <message>
        <source>Take a verification photograph. What was found before is not settled.</source>
        <translation>التقط لقطة التحقق. ما وُجد من قبل لم يُحسم بعد.</translation>
    </message>
    <message>
        <source>The surface did not look as predicted. Open the output: it leads to what helps.</source>
        <translation>لم يبدُ السطح كما هو متوقع. افتح الخرج: فهو يقود إلى ما يساعد.</translation>
    </message>
    <message>
        <source>Black: the frozen picture stands unseen until you show it again.</source>
        <translation>أسود: تبقى الصورة المجمّدة غير مرئية حتى تُظهرها من جديد.</translation>
    </message>
    <message>
        <source>still picture, perfected by photographs</source>
        <translation>صورة ثابتة، حُسِّنت بالصور</translation>
    </message>
    <message>
        <source>Nothing has moved: part of the picture is out of the projector&apos;s reach, in a shadow, darker than its black or brighter than its white there. Another picture, or another place for it, helps.</source>
        <translation>لم يتحرك شيء: جزء من الصورة خارج متناول جهاز العرض، في ظلّ، أو أغمق من أسوده هناك أو أسطع من أبيضه. تفيد صورة أخرى أو موضع آخر لها.</translation>
    </message>
    <message>
        <source>Errors are plain to see</source>
        <translation>الأخطاء واضحة للعين</translation>
    </message>
    <message>
        <source>The frozen picture stands unseen until you show it again.</source>
        <translation>الصورة المجمّدة قائمة دون أن تُرى حتى تُظهرها من جديد.</translation>
    </message>
    <message>
        <source>The output is closed here. Another program plays a show of another venue on this projector.</source>
        <translation>الخرج مغلق هنا. يشغّل برنامج آخر عرضًا لموقع آخر على جهاز العرض هذا.</translation>
    </message>
    <message>
        <source>Another program plays a show of another venue on this projector.</source>
        <translation>يشغّل برنامج آخر عرضًا لموقع آخر على جهاز العرض هذا.</translation>
    </message>
    <message>
        <source>Two shows at once</source>
        <translation>عرضان في آن واحد</translation>
    </message>
    <message>
        <source>The output is open here and in another program: whose picture is seen is not known. End one.</source>
        <translation>الخرج مفتوح هنا وفي برنامج آخر: لا يُعرف أي صورة تُرى. أنهِ أحدهما.</translation>
    </message>
    <message>
        <source>Perhaps under another program&apos;s picture</source>
        <translation>ربما تحت صورة برنامج آخر</translation>
    </message>
    <message>
        <source>Black: the test chart stands unseen. T shows the next one, then the playlist.</source>
        <translation>أسود: لوحة الاختبار قائمة دون أن تُرى. T يعرض التالية ثم قائمة التشغيل.</translation>
    </message>
    <message>
        <source>Hide the figures</source>
        <translation>إخفاء الأرقام</translation>
    </message>
    <message>
        <source>Figures are on the surface</source>
        <translation>الأرقام معروضة على السطح</translation>
    </message>
    <message>
        <source>Whoever is in the room reads them over the picture.</source>
        <translation>يقرؤها من في القاعة فوق الصورة.</translation>
    </message>
    <message>
        <source>Installed as it is. %1</source>
        <translation>ثُبّت العرض كما هو. %1</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the patterns flash.</source>
        <translation>أكّد أن القاعة خالية: الأنماط تومض.</translation>
    </message>
    <message>
        <source>No picture has come yet: black</source>
        <translation>لم تصل أي صورة بعد: أسود</translation>
    </message>
    <message>
        <source>The live picture is lost: black</source>
        <translation>انقطعت الصورة المباشرة: أسود</translation>
    </message>
    <message>
        <source>The live picture is lost: its last one stands</source>
        <translation>انقطعت الصورة المباشرة: تبقى آخر صورة</translation>
    </message>
    <message>
        <source>A film plays to its end.</source>
        <translation>يُعرض الفيلم حتى نهايته.</translation>
    </message>
    <message>
        <source>A part of the surface looks otherwise than predicted, by ΔE %1.</source>
        <translation>جزء من السطح يبدو على غير ما تُوقِّع، بفارق ΔE %1.</translation>
    </message>
    <message>
        <source>Installed, but the show cannot start with what was measured last.</source>
        <translation>مُثبَّت، لكن العرض لا يمكن أن يبدأ بما قيس آخرًا.</translation>
    </message>
    <message>
        <source>Go on measuring, or use the earlier one, at Acquire.</source>
        <translation>تابع القياس أو استعمل السابق، في «القياس».</translation>
    </message>
    <message>
        <source>Go on measuring at Acquire.</source>
        <translation>تابع القياس في «القياس».</translation>
    </message>
    <message>
        <source>What was measured is too coarse to place content. Go on measuring.</source>
        <translation>ما قيس أخشن من أن يُوضع عليه محتوى. تابع القياس.</translation>
    </message>
    <message>
        <source>Not all was decided on what is measured now</source>
        <translation>لم يُقرَّر كل شيء على ما قيس الآن</translation>
    </message>
    <message>
        <source>Steps that are out of date count with what was chosen there before.</source>
        <translation>الخطوات القديمة تُحتسب بما اختير فيها من قبل.</translation>
    </message>
    <message>
        <source>The test patterns fit, the photograph does not</source>
        <translation>أنماط الاختبار متطابقة، والصورة لا</translation>
    </message>
    <message>
        <source>Few patterns can miss a small part. Where another photograph differs, too, a repair looks closer.</source>
        <translation>قد تفوّت الأنماط القليلة جزءًا صغيرًا. إذا اختلفت صورة أخرى أيضًا، فإن الإصلاح يتفحص عن قرب.</translation>
    </message>
    <message>
        <source>This picture was perfected after the photograph.</source>
        <translation>حُسِّنت هذه الصورة بعد التقاط الصورة الفوتوغرافية.</translation>
    </message>
    <message>
        <source>In the camera&apos;s picture it is %1 from the left and %2 from the top.</source>
        <translation>يقع في صورة الكاميرا على بُعد %1 من اليسار و%2 من الأعلى.</translation>
    </message>
    <message>
        <source>What was found before may have come of that: a photograph shows what is left of it.</source>
        <translation>ما وُجد قبل ذلك ربما نتج عنه: تُظهر لقطة التحقق ما بقي منه.</translation>
    </message>
    <message>
        <source>Black. %1</source>
        <translation>أسود. %1</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputPlaylist</name>
    <message>
        <source>Demonstration picture</source>
        <translation>صورة توضيحية</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputProjection</name>
    <message>
        <source>Open the output again.</source>
        <translation>افتح الخرج مجددًا.</translation>
    </message>
    <message>
        <source>Relucent is projecting</source>
        <translation>يعرض Relucent الآن</translation>
    </message>
    <message>
        <source>%1, shown without OpenGL</source>
        <translation>%1، يُعرض من دون OpenGL</translation>
    </message>
    <message>
        <source>The output goes on as before.</source>
        <translation>يستمر الإخراج كما كان.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputProof</name>
    <message>
        <source>No venue is open.</source>
        <translation>لا يوجد مكان مفتوح.</translation>
    </message>
    <message>
        <source>A photograph is being taken.</source>
        <translation>تُلتقط صورة الآن.</translation>
    </message>
    <message>
        <source>Drift is being checked.</source>
        <translation>يُفحص الانحراف الآن.</translation>
    </message>
    <message>
        <source>It is being repaired.</source>
        <translation>يجري الإصلاح.</translation>
    </message>
    <message>
        <source>The report is being written.</source>
        <translation>يُكتب التقرير الآن.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Perfecting</name>
    <message>
        <source>%1 The picture is shown as before. Try again.</source>
        <translation>%1 تُعرض الصورة كما كانت. حاول مرة أخرى.</translation>
    </message>
    <message>
        <source>The photographs found nothing better. The picture is shown as before.</source>
        <translation>لم تجد الصور ما هو أفضل. تُعرض الصورة كما كانت.</translation>
    </message>
    <message>
        <source>The picture is being perfected</source>
        <translation>يجري تحسين الصورة</translation>
    </message>
    <message numerus="yes">
        <source>%n photograph(s) by now. Keep the room as it is.</source>
        <translation>
            <numerusform>لا صور حتى الآن. أبقِ القاعة كما هي.</numerusform>
            <numerusform>صورة واحدة حتى الآن. أبقِ القاعة كما هي.</numerusform>
            <numerusform>صورتان حتى الآن. أبقِ القاعة كما هي.</numerusform>
            <numerusform>%n صور حتى الآن. أبقِ القاعة كما هي.</numerusform>
            <numerusform>%n صورة حتى الآن. أبقِ القاعة كما هي.</numerusform>
            <numerusform>%n صورة حتى الآن. أبقِ القاعة كما هي.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1: %2 before, %3 now, by %n photograph(s).</source>
        <translation>
            <numerusform>%1: ‏%2 قبلًا، %3 الآن، دون صور.</numerusform>
            <numerusform>%1: ‏%2 قبلًا، %3 الآن، بصورة واحدة.</numerusform>
            <numerusform>%1: ‏%2 قبلًا، %3 الآن، بصورتين.</numerusform>
            <numerusform>%1: ‏%2 قبلًا، %3 الآن، بـ%n صور.</numerusform>
            <numerusform>%1: ‏%2 قبلًا، %3 الآن، بـ%n صورة.</numerusform>
            <numerusform>%1: ‏%2 قبلًا، %3 الآن، بـ%n صورة.</numerusform>
        </translation>
    </message>
    <message>
        <source>This picture is perfected</source>
        <translation>هذه الصورة محسَّنة</translation>
    </message>
    <message>
        <source>The picture is as it was</source>
        <translation>الصورة كما كانت</translation>
    </message>
    <message>
        <source>Not perfected</source>
        <translation>غير محسَّنة</translation>
    </message>
    <message>
        <source>A picture that stands can be corrected by photographs of itself, some eight of them. It is kept for this venue, placed as it is now.</source>
        <translation>يمكن تصحيح صورة ثابتة بصور لها، نحو ثمانٍ. وتُحفظ لهذا المكان بموضعها الحالي.</translation>
    </message>
    <message>
        <source>Perfect a picture</source>
        <translation>تحسين صورة</translation>
    </message>
    <message>
        <source>Perfect this picture</source>
        <translation>تحسين هذه الصورة</translation>
    </message>
    <message>
        <source>Stop and keep the best</source>
        <translation>إيقاف وحفظ الأفضل</translation>
    </message>
    <message>
        <source>Show it as before</source>
        <translation>عرضها كما كانت</translation>
    </message>
    <message>
        <source>What the photographs corrected is dropped.</source>
        <translation>يُهمل ما صححته الصور.</translation>
    </message>
    <message>
        <source>Perfect it again</source>
        <translation>تحسينها مجددًا</translation>
    </message>
    <message>
        <source>No venue is open.</source>
        <translation>لا يوجد مكان مفتوح.</translation>
    </message>
    <message>
        <source>The picture is being perfected.</source>
        <translation>يجري تحسين الصورة.</translation>
    </message>
    <message>
        <source>perfected, %1 before, %2 now.</source>
        <translation>محسَّنة، ‏%1 قبلًا، %2 الآن.</translation>
    </message>
    <message>
        <source>Tried last, %1: %2</source>
        <translation>آخر محاولة، %1: ‏%2</translation>
    </message>
    <message>
        <source>Slowly, as the room is not said to be clear: nothing flashes.</source>
        <translation>ببطء، إذ لم يؤكَّد أن القاعة خالية: لا شيء يومض.</translation>
    </message>
    <message>
        <source>Picture: %1</source>
        <translation>الصورة: %1</translation>
    </message>
    <message>
        <source>Not perfected since it changed</source>
        <translation>غير محسَّنة منذ التغيير</translation>
    </message>
    <message>
        <source>It was perfected for an earlier measurement, for another set, with other light or masks, or placed otherwise. That is kept, and is of no use now: perfect it once more.</source>
        <translation>حُسِّنت لقياس سابق أو لمجموعة أخرى أو بضوء أو أقنعة أخرى أو لموضع آخر. ذلك محفوظ، لكنه لا يفيد الآن: حسِّنها مرة أخرى.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::PlaneView</name>
    <message>
        <source>%1 px</source>
        <translation>%1 بكسل</translation>
    </message>
    <message>
        <source>Esc goes back</source>
        <translation>للرجوع: Esc</translation>
    </message>
</context>
<context>
    <name>relucent::gui::PreviewPage</name>
    <message>
        <source>Demonstration picture</source>
        <translation>صورة توضيحية</translation>
    </message>
    <message>
        <source>Content</source>
        <translation>المحتوى</translation>
    </message>
    <message>
        <source>Change</source>
        <translation>تغيير</translation>
    </message>
    <message>
        <source>Whole</source>
        <translation>كاملة</translation>
    </message>
    <message>
        <source>Fill</source>
        <translation>ملء</translation>
    </message>
    <message>
        <source>Stretch</source>
        <translation>تمديد</translation>
    </message>
    <message>
        <source>Place automatically</source>
        <translation>تحديد الموضع تلقائيًا</translation>
    </message>
    <message>
        <source>In the largest upright rectangle that can be reached</source>
        <translation>في أكبر مستطيل قائم ضمن المدى</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>الضوء</translation>
    </message>
    <message>
        <source>May stay too dark</source>
        <translation>قد يبقى شديد العتمة</translation>
    </message>
    <message>
        <source>Share of the content that may stay too dark, percent</source>
        <translation>نسبة المحتوى الذي قد يبقى شديد العتمة، بالمئة</translation>
    </message>
    <message>
        <source>Lift of the blacks</source>
        <translation>رفع الأسود</translation>
    </message>
    <message>
        <source>Lift of the blacks, percent</source>
        <translation>رفع الأسود، بالمئة</translation>
    </message>
    <message>
        <source>Reach</source>
        <translation>المدى</translation>
    </message>
    <message>
        <source>Can be reached</source>
        <translation>ضمن المدى</translation>
    </message>
    <message>
        <source>Too dark to reach</source>
        <translation>أعتم من المطلوب</translation>
    </message>
    <message>
        <source>Never black enough</source>
        <translation>أقل سوادًا من المطلوب</translation>
    </message>
    <message>
        <source>Colour error</source>
        <translation>خطأ اللون</translation>
    </message>
    <message>
        <source>Part of the picture gets no light from this projector.</source>
        <translation>جزء من الصورة لا يصله ضوء من جهاز العرض هذا.</translation>
    </message>
    <message>
        <source>A second could fill it.</source>
        <translation>قد يغطيه جهاز ثانٍ.</translation>
    </message>
    <message>
        <source>Choose a picture</source>
        <translation>اختيار صورة</translation>
    </message>
    <message>
        <source>Fit</source>
        <translation>الملاءمة</translation>
    </message>
    <message>
        <source>Brightness</source>
        <translation>السطوع</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>كل ما تم قياسه آمن.</translation>
    </message>
    <message>
        <source>Picture</source>
        <translation>الصورة</translation>
    </message>
    <message>
        <source>The picture of before stays.</source>
        <translation>تبقى الصورة السابقة.</translation>
    </message>
    <message>
        <source>Preparing the preview</source>
        <translation>تحضير المعاينة</translation>
    </message>
    <message>
        <source>The corners cross over. Drag them apart.</source>
        <translation>الزوايا متقاطعة. اسحبها لتتباعد.</translation>
    </message>
    <message>
        <source>Corners</source>
        <translation>الزوايا</translation>
    </message>
    <message>
        <source>Automatic place</source>
        <translation>الموضع التلقائي</translation>
    </message>
    <message>
        <source>Preparing</source>
        <translation>جارٍ التحضير</translation>
    </message>
    <message>
        <source>%1 in reach</source>
        <translation>%1 ضمن المدى</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>بحاجة إلى تحديث</translation>
    </message>
    <message>
        <source>The preview is not prepared.</source>
        <translation>المعاينة غير محضّرة.</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>الأجهزة مستخدمة في خطوة «%1».</translation>
    </message>
    <message>
        <source>Predicting</source>
        <translation>جارٍ التوقّع</translation>
    </message>
    <message>
        <source>Predicted from the measurement. Nothing is projected now.</source>
        <translation>متوقّع من القياس. لا يُعرض شيء الآن.</translation>
    </message>
    <message>
        <source>Preview</source>
        <translation>المعاينة</translation>
    </message>
    <message>
        <source>Place the content in the camera&apos;s view and see what the audience will see before you project it.</source>
        <translation>ضع المحتوى في مشهد الكاميرا، وشاهد ما سيراه الجمهور قبل عرضه.</translation>
    </message>
    <message>
        <source>Audience view</source>
        <translation>مشهد الجمهور</translation>
    </message>
    <message>
        <source>Reachable light</source>
        <translation>الضوء ضمن المدى</translation>
    </message>
    <message>
        <source>Difference</source>
        <translation>الفرق</translation>
    </message>
    <message>
        <source>What the audience will see, uncorrected at the left of the divider and corrected at the right</source>
        <translation>ما سيراه الجمهور، دون تصحيح على يسار الفاصل ومصحّحًا على يمينه</translation>
    </message>
    <message>
        <source>Colour difference between what is wanted and what is predicted</source>
        <translation>فرق اللون بين المطلوب والمتوقّع</translation>
    </message>
    <message>
        <source>Methods</source>
        <translation>الطرق</translation>
    </message>
    <message>
        <source>predicted for this content; click one to use it</source>
        <translation>متوقّعة لهذا المحتوى؛ انقر طريقة لاستخدامها</translation>
    </message>
    <message>
        <source>Comparison of methods</source>
        <translation>مقارنة الطرق</translation>
    </message>
    <message>
        <source>Method</source>
        <translation>الطريقة</translation>
    </message>
    <message>
        <source>Notes</source>
        <translation>ملاحظات</translation>
    </message>
    <message>
        <source>blind to bounces</source>
        <translation>لا ترى الانعكاسات</translation>
    </message>
    <message>
        <source>limit of this venue</source>
        <translation>حدّ هذا الموقع</translation>
    </message>
    <message>
        <source>%1 dB</source>
        <translation>⁨%1 dB⁩</translation>
    </message>
    <message>
        <source>%1 ms</source>
        <translation>⁨%1 ms⁩</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 ث</translation>
    </message>
    <message>
        <source>Uncorrected</source>
        <translation>دون تصحيح</translation>
    </message>
    <message>
        <source>Corrected, predicted</source>
        <translation>مصحّح، متوقّع</translation>
    </message>
    <message>
        <source>of white</source>
        <translation>من الأبيض</translation>
    </message>
    <message>
        <source>The larger this share, the brighter the picture, and the more of it stays too dark.</source>
        <translation>كلما زادت هذه النسبة ازدادت الصورة سطوعًا، واتسع الجزء الذي يبقى شديد العتمة منها.</translation>
    </message>
    <message>
        <source>Part of the picture gets no light from any projector.</source>
        <translation>جزء من الصورة لا يصله ضوء من أي جهاز عرض.</translation>
    </message>
    <message>
        <source>Another one could fill it.</source>
        <translation>يمكن لجهاز آخر أن يملأه.</translation>
    </message>
    <message>
        <source>Go to output</source>
        <translation>إلى الخرج</translation>
    </message>
    <message>
        <source>under 1 ms</source>
        <translation>أقل من ⁨1 ms⁩</translation>
    </message>
    <message>
        <source>Uncorrected, too</source>
        <translation>غير مصحَّح أيضًا</translation>
    </message>
    <message>
        <source>What was measured is too coarse to place content. Go on measuring.</source>
        <translation>ما قيس أخشن من أن يُوضع عليه محتوى. تابع القياس.</translation>
    </message>
    <message>
        <source>All of it can be reached</source>
        <translation>كل شيء يمكن بلوغه</translation>
    </message>
    <message>
        <source>no note</source>
        <translation>لا ملاحظة</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged.</source>
        <translation>شاشة جهاز العرض مفصولة.</translation>
    </message>
    <message>
        <source>On the surface now: the corrected picture.</source>
        <translation>على السطح الآن: الصورة المصحّحة.</translation>
    </message>
    <message>
        <source>On the surface now: the uncorrected picture.</source>
        <translation>على السطح الآن: الصورة دون تصحيح.</translation>
    </message>
    <message>
        <source>Stop shining</source>
        <translation>أوقف العرض</translation>
    </message>
    <message>
        <source>Shine on surface</source>
        <translation>اعرض على السطح</translation>
    </message>
    <message>
        <source>Shows this picture on the surface until you stop it or leave.</source>
        <translation>يعرض هذه الصورة على السطح حتى توقفه أو تغادر.</translation>
    </message>
    <message>
        <source>Show uncorrected</source>
        <translation>أظهر دون تصحيح</translation>
    </message>
    <message>
        <source>Show corrected</source>
        <translation>أظهر مع التصحيح</translation>
    </message>
    <message>
        <source>There is no preview yet.</source>
        <translation>لا معاينة بعد.</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is not there. Plug it in and extend the desktop to it.</source>
        <translation>شاشة جهاز العرض غير موجودة. صِلها ووسّع سطح المكتب إليها.</translation>
    </message>
    <message>
        <source>The brightest light that can be reached; hatched where the content is out of reach</source>
        <translation>أسطع ضوء يمكن بلوغه؛ مخطّط حيث يتعذّر بلوغ المحتوى</translation>
    </message>
    <message>
        <source>Hatched: %1 cannot be reached</source>
        <translation>المخطّط: %1 لا يمكن بلوغه</translation>
    </message>
    <message>
        <source>It has been measured again since the content was placed</source>
        <translation>أُعيد القياس بعد وضع المحتوى</translation>
    </message>
    <message>
        <source>The threshold has been changed since the content was placed</source>
        <translation>تغيّرت العتبة بعد وضع المحتوى</translation>
    </message>
    <message>
        <source>What you see here is predicted anew. Going to the output keeps it.</source>
        <translation>ما تراه هنا متوقّع من جديد. يُحفظ عند الانتقال إلى الخرج.</translation>
    </message>
    <message>
        <source>Still picture</source>
        <translation>صورة ثابتة</translation>
    </message>
    <message>
        <source>How long a still picture takes to be solved, once. Films always play by “All bounces, for films” in the quicker show engine: how fast is said at Cluster.</source>
        <translation>الزمن اللازم لحساب صورة ثابتة مرة واحدة. تُعرض الأفلام دائمًا بطريقة «كل الانعكاسات، للأفلام» في محرك العرض الأسرع: وتُذكر سرعتها في «التجميع».</translation>
    </message>
    <message>
        <source>Of this content, where it can be reached. What Acquire expects is a mean of other pictures: the two may differ by some dB.</source>
        <translation>لهذا المحتوى حيث يمكن بلوغه. ما يتوقّعه القياس متوسط صور أخرى: وقد يختلف الرقمان ببضعة dB.</translation>
    </message>
    <message>
        <source>blind to light between clusters</source>
        <translation>لا ترى الضوء بين التجمّعات</translation>
    </message>
    <message>
        <source>recommended</source>
        <translation>موصى بها</translation>
    </message>
    <message>
        <source>Compare</source>
        <translation>مقارنة</translation>
    </message>
    <message>
        <source>Hide</source>
        <translation>إخفاء</translation>
    </message>
    <message>
        <source>This content comes to %1. Acquire expected %2 on average of three other pictures, by the recommended method.</source>
        <translation>يبلغ هذا المحتوى ⁨%1⁩. وكان «القياس» يتوقّع ⁨%2⁩ في متوسط ثلاث صور أخرى بالطريقة الموصى بها.</translation>
    </message>
    <message>
        <source>Place of a camera</source>
        <translation>موضع كاميرا</translation>
    </message>
    <message>
        <source>no content</source>
        <translation>لا محتوى</translation>
    </message>
    <message>
        <source>%1 dB, ΔE %2</source>
        <translation>⁨%1⁩ dB، ‏ΔE ⁨%2⁩</translation>
    </message>
    <message>
        <source>%1, counts %2</source>
        <translation>⁨%1⁩، وزنه ⁨%2⁩</translation>
    </message>
    <message>
        <source>Views</source>
        <translation>المشاهد</translation>
    </message>
    <message>
        <source>On the surface</source>
        <translation>على السطح</translation>
    </message>
    <message>
        <source>Upright from here</source>
        <translation>قائمة من هنا</translation>
    </message>
    <message>
        <source>Weight of this view</source>
        <translation>وزن هذا المشهد</translation>
    </message>
    <message>
        <source>Weight of the shown view, percent</source>
        <translation>وزن المشهد المعروض، بالمئة</translation>
    </message>
    <message>
        <source>For one viewer who moves</source>
        <translation>لمشاهد واحد يتحرك</translation>
    </message>
    <message>
        <source>Where the viewer stands, from the first camera to the last</source>
        <translation>أين يقف المشاهد، من الكاميرا الأولى إلى الأخيرة</translation>
    </message>
    <message>
        <source>Place in this view</source>
        <translation>الموضع في هذا المشهد</translation>
    </message>
    <message>
        <source>Weight of a view</source>
        <translation>وزن مشهد</translation>
    </message>
    <message>
        <source>Drag the cameras to where they stand, then move the viewer.</source>
        <translation>اسحب الكاميرات إلى حيث تقف، ثم حرّك المشاهد.</translation>
    </message>
    <message>
        <source>As little as hides where projectors end</source>
        <translation>أقل ما يخفي حواف أجهزة العرض</translation>
    </message>
    <message>
        <source>Place of the viewer</source>
        <translation>مكان المشاهد</translation>
    </message>
    <message>
        <source>Contradiction</source>
        <translation>التعارض</translation>
    </message>
    <message>
        <source>How much worse a view is because of what the other views ask for</source>
        <translation>مقدار تراجع مشهد بسبب ما تطلبه المشاهد الأخرى</translation>
    </message>
    <message>
        <source>Comparing the views</source>
        <translation>تجري مقارنة المشاهد</translation>
    </message>
    <message>
        <source>Visibly worse because of other views: %1</source>
        <translation>أسوأ بوضوح بسبب المشاهد الأخرى: %1</translation>
    </message>
    <message>
        <source>Visibly worse because of other views</source>
        <translation>أسوأ بوضوح بسبب المشاهد الأخرى</translation>
    </message>
    <message>
        <source>Even</source>
        <translation>موحّد</translation>
    </message>
    <message>
        <source>One white for all pictures, as bright as most of the surface can show it.</source>
        <translation>أبيض واحد لكل الصور، بأعلى سطوع يستطيع معظم السطح عرضه.</translation>
    </message>
    <message>
        <source>By picture</source>
        <translation>لكل صورة</translation>
    </message>
    <message>
        <source>Each picture has the white at which the least of it is lost: dark ones become brighter, bright ones dimmer.</source>
        <translation>لكل صورة الأبيض الذي يضيع عنده أقل قدر منها: تزداد الصور المعتمة سطوعًا، وتقل الساطعة.</translation>
    </message>
    <message>
        <source>By region</source>
        <translation>لكل منطقة</translation>
    </message>
    <message>
        <source>The same for each part of the picture, smoothly from one to the next: the least is lost of all.</source>
        <translation>الأمر نفسه لكل جزء من الصورة، بانتقال سلس بين الأجزاء: هكذا يضيع أقل قدر.</translation>
    </message>
    <message>
        <source>How bright white is</source>
        <translation>مقدار سطوع الأبيض</translation>
    </message>
    <message>
        <source>The picture is shown as before.</source>
        <translation>تُعرض الصورة كما كانت.</translation>
    </message>
    <message>
        <source>Bright</source>
        <translation>ساطع</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show are as bright as can be: white on a yellow wall turns yellow.</source>
        <translation>الألوان التي لا يستطيع السطح إظهارها تكون ساطعة قدر الإمكان: الأبيض على جدار أصفر يصير أصفر.</translation>
    </message>
    <message>
        <source>Between</source>
        <translation>بينهما</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show become somewhat dimmer and shift less.</source>
        <translation>الألوان التي لا يستطيع السطح إظهارها تعتم قليلًا وتنحرف أقل.</translation>
    </message>
    <message>
        <source>True</source>
        <translation>أمين</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show are dimmed until their hue is right: for faces and logos.</source>
        <translation>الألوان التي لا يستطيع السطح إظهارها تعتم حتى تصح درجة لونها: للوجوه والشعارات.</translation>
    </message>
    <message>
        <source>Colours out of reach</source>
        <translation>ألوان بعيدة المنال</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show</source>
        <translation>الألوان التي لا يستطيع السطح إظهارها</translation>
    </message>
    <message>
        <source>Uncertainty</source>
        <translation>عدم اليقين</translation>
    </message>
    <message>
        <source>95 of 100 pixels come within this of what is predicted, in percent of white. More photographs or longer exposures make it smaller.</source>
        <translation>‏95 من كل 100 بكسل تبتعد عن المتوقّع بهذا القدر على الأكثر، بالنسبة المئوية من الأبيض. تقلّله صور أكثر أو تعريضات أطول.</translation>
    </message>
    <message>
        <source>How far the light may be from what is predicted, by the measurement&apos;s noise</source>
        <translation>مقدار ما قد يبتعد به الضوء عن المتوقّع بسبب ضجيج القياس</translation>
    </message>
    <message>
        <source>95 of 100 pixels come within the value shown, on average %1 of white</source>
        <translation>‏95 من كل 100 بكسل تبقى ضمن القيمة المعروضة، وفي المتوسط %1 من الأبيض</translation>
    </message>
    <message>
        <source>Quality</source>
        <translation>الجودة</translation>
    </message>
    <message>
        <source>Detail kept</source>
        <translation>التفاصيل المحفوظة</translation>
    </message>
    <message>
        <source>Peak signal-to-noise ratio, PSNR: 20 dB looks rough, 30 dB good.</source>
        <translation>نسبة ذروة الإشارة إلى الضوضاء PSNR: تبدو 20 dB خشنة و30 dB جيدة.</translation>
    </message>
    <message>
        <source>Structural similarity, SSIM: 1 is all of it.</source>
        <translation>التشابه البنيوي SSIM: القيمة 1 تعني كلها.</translation>
    </message>
    <message>
        <source>What of it is shown</source>
        <translation>ما يُعرض منها</translation>
    </message>
    <message>
        <source>Mask %1</source>
        <translation>القناع %1</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1، %2</translation>
    </message>
    <message>
        <source>Masks</source>
        <translation>الأقنعة</translation>
    </message>
    <message>
        <source>No light falls on these parts: doors, windows, where visitors sit.</source>
        <translation>لا يقع ضوء على هذه الأجزاء: الأبواب والنوافذ ومقاعد الزوار.</translation>
    </message>
    <message>
        <source>Draw a mask</source>
        <translation>ارسم قناعًا</translation>
    </message>
    <message>
        <source>Click points in the picture, and the first one again to close. With the keyboard: arrow keys, Space, Return; Escape leaves it.</source>
        <translation>انقر نقاطًا في الصورة، ثم الأولى مرة أخرى للإغلاق. بلوحة المفاتيح: الأسهم والمسافة والإدخال؛ وEscape للإلغاء.</translation>
    </message>
    <message>
        <source>Straight</source>
        <translation>مستقيم</translation>
    </message>
    <message>
        <source>Curved</source>
        <translation>منحنٍ</translation>
    </message>
    <message>
        <source>How the points of the mask are joined</source>
        <translation>كيفية وصل نقاط القناع</translation>
    </message>
    <message>
        <source>Feather</source>
        <translation>تدرّج الحافة</translation>
    </message>
    <message>
        <source>How far beyond the mask the light comes back, thousandths of the view</source>
        <translation>مدى عودة الضوء خارج القناع، بأجزاء الألف من المشهد</translation>
    </message>
    <message>
        <source>Remove the mask</source>
        <translation>أزل القناع</translation>
    </message>
    <message>
        <source>Stop drawing</source>
        <translation>أوقف الرسم</translation>
    </message>
    <message>
        <source>errors weighed as an eye does</source>
        <translation>أخطاء موزونة كما تراها العين</translation>
    </message>
    <message>
        <source>No venue is open.</source>
        <translation>لا يوجد مكان مفتوح.</translation>
    </message>
    <message>
        <source>The sets are as they were.</source>
        <translation>بقيت المجموعات كما كانت.</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>المجموعة</translation>
    </message>
    <message>
        <source>Without a name</source>
        <translation>بلا اسم</translation>
    </message>
    <message>
        <source>More</source>
        <translation>المزيد</translation>
    </message>
    <message>
        <source>More for the set</source>
        <translation>المزيد للمجموعة</translation>
    </message>
    <message>
        <source>Save as…</source>
        <translation>حفظ باسم…</translation>
    </message>
    <message>
        <source>Rename…</source>
        <translation>إعادة تسمية…</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>إزالة</translation>
    </message>
    <message>
        <source>It is placed automatically.</source>
        <translation>موضعها محدَّد تلقائيًا.</translation>
    </message>
    <message>
        <source>A picture is on the surface.</source>
        <translation>على السطح صورة.</translation>
    </message>
    <message>
        <source>The output is open. Close it first.</source>
        <translation>الخرج مفتوح. أغلقه أولًا.</translation>
    </message>
    <message>
        <source>Shine on %1</source>
        <translation>اعرض على %1</translation>
    </message>
    <message>
        <source>A rehearsal has no surface: this lights the screen %1 until you stop it or leave.</source>
        <translation>لا سطح للتدريب: يضيء هذا الشاشة %1 حتى توقفه أو تغادر.</translation>
    </message>
    <message>
        <source>Part of the picture lies where the view is left out.</source>
        <translation>جزء من الصورة يقع حيث استُبعد المشهد.</translation>
    </message>
    <message>
        <source>It stays uncorrected. Acquire says why.</source>
        <translation>يبقى دون تصحيح. السبب مذكور في خطوة القياس.</translation>
    </message>
    <message>
        <source>Predicted from the measurement. The output stays as it is.</source>
        <translation>متوقّع من القياس. يبقى الإخراج كما هو.</translation>
    </message>
    <message>
        <source>The content was placed on another measurement or threshold</source>
        <translation>وُضع المحتوى وفق قياس آخر أو عتبة أخرى</translation>
    </message>
    <message>
        <source>To shine on the surface, close the output first.</source>
        <translation>للعرض على السطح، أغلق الخرج أولًا.</translation>
    </message>
    <message>
        <source>Uncorrected, in blocks of %1 px</source>
        <translation>بلا تصحيح، في كتل من ⁨%1⁩ px</translation>
    </message>
    <message>
        <source>Predicted from the measurement. Another program&apos;s show is projected.</source>
        <translation>متوقّع من القياس. يُعرض عرض برنامج آخر.</translation>
    </message>
    <message>
        <source>The preview is being prepared.</source>
        <translation>يجري تحضير المعاينة.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::RenameDialog</name>
    <message>
        <source>Rename a venue</source>
        <translation>إعادة تسمية موقع</translation>
    </message>
    <message>
        <source>Its folder has the same name and is renamed with it. A show that starts at log-in follows.</source>
        <translation>لمجلده الاسم نفسه ويُعاد تسميته معه. والعرض الذي يبدأ عند تسجيل الدخول يتبعه.</translation>
    </message>
    <message>
        <source>Rename</source>
        <translation>إعادة تسمية</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Session</name>
    <message>
        <source>%1 is at work. What is chosen here can be kept when that has ended.</source>
        <translation>⁨%1⁩ قيد العمل. يمكن حفظ ما تختاره هنا بعد انتهائه.</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>الأجهزة مستخدمة في «%1».</translation>
    </message>
    <message>
        <source>Confirm that the room is clear.</source>
        <translation>أكّد أن القاعة خالية.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::SetNameDialog</name>
    <message>
        <source>Save as a set</source>
        <translation>حفظ كمجموعة</translation>
    </message>
    <message>
        <source>Rename a set</source>
        <translation>إعادة تسمية مجموعة</translation>
    </message>
    <message>
        <source>Day, night, school class</source>
        <translation>نهار، ليل، صف مدرسي</translation>
    </message>
    <message>
        <source>What you see becomes this set, and is changed in it from now on.</source>
        <translation>يصبح ما تراه هذه المجموعة، وتجري التغييرات فيها من الآن فصاعدًا.</translation>
    </message>
    <message>
        <source>Playlists and controllers that call it by its present name have to be changed, too.</source>
        <translation>يجب أيضًا تغيير قوائم التشغيل وأجهزة التحكم التي تستدعيها باسمها الحالي.</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>حفظ</translation>
    </message>
    <message>
        <source>Rename</source>
        <translation>إعادة تسمية</translation>
    </message>
    <message>
        <source>There is a set of this name already.</source>
        <translation>توجد مجموعة بهذا الاسم بالفعل.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::SetTimesDialog</name>
    <message>
        <source>Sets by the time of the day</source>
        <translation>المجموعات حسب وقت اليوم</translation>
    </message>
    <message>
        <source>From each time on the installed show plays that set, every day, until the next time.</source>
        <translation>من كل وقت يستخدم العرض المثبّت تلك المجموعة، يوميًا، حتى الوقت التالي.</translation>
    </message>
    <message>
        <source>From this time on</source>
        <translation>من هذا الوقت</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>المجموعة</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>إضافة</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>إزالة</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>إلغاء</translation>
    </message>
    <message>
        <source>Apply</source>
        <translation>تطبيق</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1: %2</translation>
    </message>
    <message>
        <source>There are no times yet.</source>
        <translation>لا توجد أوقات بعد.</translation>
    </message>
    <message>
        <source>Type a time of the day, such as %1.</source>
        <translation>اكتب وقتًا من اليوم، مثل %1.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::SettingsDialog</name>
    <message>
        <source>Settings</source>
        <translation>الإعدادات</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>إغلاق</translation>
    </message>
    <message>
        <source>Look</source>
        <translation>المظهر</translation>
    </message>
    <message>
        <source>Dark</source>
        <translation>داكن</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>فاتح</translation>
    </message>
    <message>
        <source>Theme. The dark one is for the dark room.</source>
        <translation>السمة. الداكنة للقاعة المظلمة.</translation>
    </message>
    <message>
        <source>Dim pictures: the laptop is room light</source>
        <translation>تعتيم الصور: الحاسوب المحمول ضوء في القاعة</translation>
    </message>
    <message>
        <source>As the computer</source>
        <translation>كما في الحاسوب</translation>
    </message>
    <message>
        <source>Language</source>
        <translation>اللغة</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>القياس</translation>
    </message>
    <message>
        <source>As quickly as the devices can, after a consent</source>
        <translation>بأسرع ما تستطيعه الأجهزة، بعد الموافقة</translation>
    </message>
    <message numerus="yes">
        <source>At most %n change(s) a second</source>
        <translation>
            <numerusform>لا تغيّر في الثانية</numerusform>
            <numerusform>تغيّر واحد في الثانية على الأكثر</numerusform>
            <numerusform>تغيّران في الثانية على الأكثر</numerusform>
            <numerusform>%n تغيّرات في الثانية على الأكثر</numerusform>
            <numerusform>%n تغيّرًا في الثانية على الأكثر</numerusform>
            <numerusform>%n تغيّر في الثانية على الأكثر</numerusform>
        </translation>
    </message>
    <message>
        <source>Flashing light of the projector</source>
        <translation>ضوء جهاز العرض الوامض</translation>
    </message>
    <message>
        <source>More than three changes a second can cause seizures. Slower measuring needs no consent.</source>
        <translation>أكثر من ثلاثة تغيّرات في الثانية قد يسبب نوبات صرع. القياس الأبطأ لا يحتاج إلى موافقة.</translation>
    </message>
    <message>
        <source>A sound when a measurement ends</source>
        <translation>صوت عند انتهاء القياس</translation>
    </message>
    <message>
        <source>New venues</source>
        <translation>المواقع الجديدة</translation>
    </message>
    <message>
        <source>Folder for new venues</source>
        <translation>مجلد المواقع الجديدة</translation>
    </message>
    <message>
        <source>Choose a folder</source>
        <translation>اختيار مجلد</translation>
    </message>
    <message>
        <source>Folder</source>
        <translation>المجلد</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Show</name>
    <message>
        <source>A show is playing.</source>
        <translation>هناك عرض قيد التشغيل.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StatusPage</name>
    <message>
        <source>State</source>
        <translation>الحالة</translation>
    </message>
    <message>
        <source>Updated</source>
        <translation>آخر تحديث</translation>
    </message>
    <message>
        <source>Computed on</source>
        <translation>يُحسب على</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>الإطارات</translation>
    </message>
    <message>
        <source>Late frames</source>
        <translation>إطارات متأخرة</translation>
    </message>
    <message>
        <source>Frames per second</source>
        <translation>إطارات في الثانية</translation>
    </message>
    <message>
        <source>Time per frame (ms)</source>
        <translation>الزمن لكل إطار (م‌ث)</translation>
    </message>
    <message>
        <source>Delay behind the viewer (ms)</source>
        <translation>التأخر عن المشاهد (م‌ث)</translation>
    </message>
    <message>
        <source>Clipped share</source>
        <translation>الحصة المقصوصة</translation>
    </message>
    <message>
        <source>Steps</source>
        <translation>الخطوات</translation>
    </message>
    <message>
        <source>Perfected</source>
        <translation>محسَّنة</translation>
    </message>
    <message>
        <source>Item</source>
        <translation>العنصر</translation>
    </message>
    <message>
        <source>Items skipped</source>
        <translation>عناصر متجاوَزة</translation>
    </message>
    <message>
        <source>Failures</source>
        <translation>الإخفاقات</translation>
    </message>
    <message>
        <source>Most memory used (bytes)</source>
        <translation>أقصى ذاكرة مستخدمة (بايت)</translation>
    </message>
    <message>
        <source>Displays</source>
        <translation>الشاشات</translation>
    </message>
    <message>
        <source>Connector</source>
        <translation>الموصّل</translation>
    </message>
    <message>
        <source>Shining</source>
        <translation>مضيء</translation>
    </message>
    <message>
        <source>Drawn by</source>
        <translation>يرسمه</translation>
    </message>
    <message>
        <source>Projectors</source>
        <translation>أجهزة العرض</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>جهاز العرض</translation>
    </message>
    <message>
        <source>Address</source>
        <translation>العنوان</translation>
    </message>
    <message>
        <source>Answers</source>
        <translation>يجيب</translation>
    </message>
    <message>
        <source>Problem</source>
        <translation>المشكلة</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>الاسم</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>الطراز</translation>
    </message>
    <message>
        <source>Power</source>
        <translation>الطاقة</translation>
    </message>
    <message>
        <source>Shutter</source>
        <translation>المصراع</translation>
    </message>
    <message>
        <source>Lamp hours</source>
        <translation>ساعات المصباح</translation>
    </message>
    <message>
        <source>Filter hours</source>
        <translation>ساعات المرشّح</translation>
    </message>
    <message>
        <source>Input</source>
        <translation>المدخل</translation>
    </message>
    <message>
        <source>Signal</source>
        <translation>الإشارة</translation>
    </message>
    <message>
        <source>Own pixels</source>
        <translation>بكسلاته</translation>
    </message>
    <message>
        <source>Remarks</source>
        <translation>ملاحظات</translation>
    </message>
    <message>
        <source>yes</source>
        <translation>نعم</translation>
    </message>
    <message>
        <source>no</source>
        <translation>لا</translation>
    </message>
    <message>
        <source>Relucent: %1</source>
        <translation>Relucent: %1</translation>
    </message>
    <message>
        <source>Alarm</source>
        <translation>إنذار</translation>
    </message>
    <message>
        <source>Last night</source>
        <translation>الليلة الأخيرة</translation>
    </message>
    <message>
        <source>When</source>
        <translation>متى</translation>
    </message>
    <message>
        <source>Outcome</source>
        <translation>النتيجة</translation>
    </message>
    <message>
        <source>Pictures perfected</source>
        <translation>الصور المحسَّنة</translation>
    </message>
    <message>
        <source>Colour error (ΔE)</source>
        <translation>خطأ اللون (ΔE)</translation>
    </message>
    <message>
        <source>Predicted colour error (ΔE)</source>
        <translation>خطأ اللون المتوقَّع (ΔE)</translation>
    </message>
    <message>
        <source>Nobody was told</source>
        <translation>لم يُبلَّغ أحد</translation>
    </message>
    <message>
        <source>Next night</source>
        <translation>الليلة التالية</translation>
    </message>
    <message>
        <source>Somebody has to look</source>
        <translation>لا بدّ من أن ينظر أحد</translation>
    </message>
    <message>
        <source>Watched by camera</source>
        <translation>مراقَب بالكاميرا</translation>
    </message>
    <message>
        <source>Photographs</source>
        <translation>الصور</translation>
    </message>
    <message>
        <source>Photographs used</source>
        <translation>الصور المستخدمة</translation>
    </message>
    <message>
        <source>Share that can be told</source>
        <translation>النسبة القابلة للحكم</translation>
    </message>
    <message>
        <source>Time per photograph (ms)</source>
        <translation>الوقت لكل صورة (م.ث)</translation>
    </message>
    <message>
        <source>What has changed</source>
        <translation>ما الذي تغيّر</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>النوع</translation>
    </message>
    <message>
        <source>How much</source>
        <translation>المقدار</translation>
    </message>
    <message>
        <source>What happened</source>
        <translation>ماذا حدث</translation>
    </message>
    <message>
        <source>What to do</source>
        <translation>ما العمل</translation>
    </message>
    <message>
        <source>Delay of the live picture (ms)</source>
        <translation>تأخر الصورة الحية (م‌ث)</translation>
    </message>
    <message>
        <source>Streams</source>
        <translation>عمليات البث</translation>
    </message>
    <message>
        <source>Losses</source>
        <translation>مرات الانقطاع</translation>
    </message>
    <message>
        <source>Pixels</source>
        <translation>بكسلات</translation>
    </message>
    <message>
        <source>Time from the sender, by its clock (ms)</source>
        <translation>الزمن من المرسل بحسب ساعته (م‌ث)</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>المجموعة</translation>
    </message>
    <message>
        <source>Black</source>
        <translation>أسود</translation>
    </message>
    <message>
        <source>Frozen</source>
        <translation>مجمّد</translation>
    </message>
    <message>
        <source>Corrected</source>
        <translation>مصحّح</translation>
    </message>
    <message>
        <source>Brightness</source>
        <translation>السطوع</translation>
    </message>
    <message>
        <source>Test chart</source>
        <translation>لوحة اختبار</translation>
    </message>
    <message>
        <source>starting</source>
        <translation>يبدأ</translation>
    </message>
    <message>
        <source>playing</source>
        <translation>يعمل</translation>
    </message>
    <message>
        <source>resting until its hours</source>
        <translation>يستريح حتى ساعاته</translation>
    </message>
    <message>
        <source>photographing</source>
        <translation>يصوّر</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>فشلت</translation>
    </message>
    <message>
        <source>stopped</source>
        <translation>متوقف</translation>
    </message>
    <message>
        <source>connecting</source>
        <translation>يتصل</translation>
    </message>
    <message>
        <source>asking whether it may</source>
        <translation>يطلب الإذن</translation>
    </message>
    <message>
        <source>lost</source>
        <translation>مفقود</translation>
    </message>
    <message>
        <source>opening</source>
        <translation>يفتح</translation>
    </message>
    <message>
        <source>watching</source>
        <translation>يراقب</translation>
    </message>
    <message>
        <source>paused</source>
        <translation>متوقف مؤقتًا</translation>
    </message>
    <message>
        <source>no camera</source>
        <translation>لا كاميرا</translation>
    </message>
    <message>
        <source>no calibration</source>
        <translation>لا معايرة</translation>
    </message>
    <message>
        <source>black, until somebody ends it</source>
        <translation>أسود حتى ينهيه أحد</translation>
    </message>
    <message>
        <source>test chart</source>
        <translation>لوحة اختبار</translation>
    </message>
    <message>
        <source>frozen, until somebody ends it</source>
        <translation>مجمَّد حتى ينهيه أحد</translation>
    </message>
    <message>
        <source>playing, but no display shows it</source>
        <translation>يعمل، لكن لا شاشة تعرضه</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StatusStrip</name>
    <message>
        <source>Projector</source>
        <translation>جهاز العرض</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>الكاميرا</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>القرص</translation>
    </message>
    <message>
        <source>none chosen</source>
        <translation>غير مختار</translation>
    </message>
    <message>
        <source>%1 free</source>
        <translation>المتاح %1</translation>
    </message>
    <message>
        <source>simulated</source>
        <translation>محاكاة</translation>
    </message>
    <message>
        <source>by script</source>
        <translation>بنص برمجي</translation>
    </message>
    <message>
        <source>%1, in use</source>
        <translation>⁨%1⁩، قيد الاستخدام</translation>
    </message>
    <message>
        <source>Saved %1</source>
        <translation>آخر حفظ: %1</translation>
    </message>
    <message>
        <source>Room light</source>
        <translation>ضوء الغرفة</translation>
    </message>
    <message>
        <source>%1, unplugged</source>
        <translation>%1، مفصول</translation>
    </message>
    <message>
        <source>%1 of full light, steady</source>
        <translation>%1 من الضوء الكامل، ثابت</translation>
    </message>
    <message>
        <source>%1 of full light, changed</source>
        <translation>%1 من الضوء الكامل، تغيّر</translation>
    </message>
    <message>
        <source>%1, silent</source>
        <translation>⁨%1⁩، صامتة</translation>
    </message>
    <message numerus="yes">
        <source>%n screen(s)</source>
        <translation>
            <numerusform>لا شاشات</numerusform>
            <numerusform>شاشة واحدة</numerusform>
            <numerusform>شاشتان</numerusform>
            <numerusform>%n شاشات</numerusform>
            <numerusform>%n شاشة</numerusform>
            <numerusform>%n شاشة</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n with %1, %2</source>
        <comment>projectors and their pixels</comment>
        <translation>
            <numerusform>لا شيء، ⁨%1⁩، ⁨%2⁩</numerusform>
            <numerusform>واحد، ⁨%1⁩، ⁨%2⁩</numerusform>
            <numerusform>اثنان، ⁨%1⁩، ⁨%2⁩</numerusform>
            <numerusform>%n، ⁨%1⁩، ⁨%2⁩</numerusform>
            <numerusform>%n، ⁨%1⁩، ⁨%2⁩</numerusform>
            <numerusform>%n، ⁨%1⁩، ⁨%2⁩</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n, simulated</source>
        <comment>cameras</comment>
        <translation>
            <numerusform>لا شيء</numerusform>
            <numerusform>واحدة، محاكاة</numerusform>
            <numerusform>اثنتان، محاكاة</numerusform>
            <numerusform>%n، محاكاة</numerusform>
            <numerusform>%n، محاكاة</numerusform>
            <numerusform>%n، محاكاة</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n camera(s)</source>
        <translation>
            <numerusform>لا كاميرات</numerusform>
            <numerusform>كاميرا واحدة</numerusform>
            <numerusform>كاميرتان</numerusform>
            <numerusform>%n كاميرات</numerusform>
            <numerusform>%n كاميرا</numerusform>
            <numerusform>%n كاميرا</numerusform>
        </translation>
    </message>
    <message>
        <source>none in use</source>
        <translation>غير مستخدم</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StepRail</name>
    <message>
        <source>locked</source>
        <translation>مقفلة</translation>
    </message>
    <message>
        <source>done</source>
        <translation>منجزة</translation>
    </message>
    <message>
        <source>out of date</source>
        <translation>بحاجة إلى تحديث</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>فشلت</translation>
    </message>
    <message>
        <source>current</source>
        <translation>الحالية</translation>
    </message>
    <message>
        <source>open</source>
        <translation>متاحة</translation>
    </message>
    <message>
        <source>Step %1, %2, %3</source>
        <translation>الخطوة %1، %2، %3</translation>
    </message>
    <message>
        <source>No venue open</source>
        <translation>لا يوجد موقع مفتوح</translation>
    </message>
    <message>
        <source>stopped early</source>
        <translation>أُوقف مبكرًا</translation>
    </message>
    <message>
        <source>under way</source>
        <translation>قيد التنفيذ</translation>
    </message>
    <message>
        <source>doubtful</source>
        <translation>مشكوك فيه</translation>
    </message>
    <message>
        <source>Opens once %1 is done.</source>
        <translation>تُفتح عند إتمام «%1».</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StreamDialog</name>
    <message>
        <source>Add a stream</source>
        <translation>إضافة بث</translation>
    </message>
    <message>
        <source>A live picture from the network, without its sound: RTSP, SRT, RTP, UDP, HTTP or RTMP. While it plays, this computer is connected to that address.</source>
        <translation>صورة حية من الشبكة دون صوتها: RTSP أو SRT أو RTP أو UDP أو HTTP أو RTMP. أثناء تشغيلها يكون هذا الحاسوب متصلًا بذلك العنوان.</translation>
    </message>
    <message>
        <source>Address</source>
        <translation>العنوان</translation>
    </message>
    <message>
        <source>User name and password stand before the host, as in rtsp://user:password@host. They are kept in the playlist, and shown nowhere.</source>
        <translation>يُكتب اسم المستخدم وكلمة المرور قبل المضيف، كما في ⁨rtsp://user:password@host⁩. يُحفظان في قائمة التشغيل ولا يُعرضان في أي مكان.</translation>
    </message>
    <message>
        <source>While it is lost</source>
        <translation>أثناء انقطاعه</translation>
    </message>
    <message>
        <source>Its last picture</source>
        <translation>صورته الأخيرة</translation>
    </message>
    <message>
        <source>Black</source>
        <translation>أسود</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>إلغاء</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>إضافة</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ThresholdPage</name>
    <message>
        <source>%1 of light kept</source>
        <translation>بقي %1 من الضوء</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>بحاجة إلى تحديث</translation>
    </message>
    <message>
        <source>Reading the light transport</source>
        <translation>قراءة نقل الضوء</translation>
    </message>
    <message>
        <source>Below 95 % of the light, bounces are lost.</source>
        <translation>إذا بقي أقل من 95 % من الضوء تضيع انعكاسات.</translation>
    </message>
    <message>
        <source>Next: groups of pixels that can be solved on their own</source>
        <translation>التالي: مجموعات بكسلات تُحل كل منها وحدها</translation>
    </message>
    <message>
        <source>Group into clusters</source>
        <translation>التقسيم إلى تجمّعات</translation>
    </message>
    <message>
        <source>The threshold was chosen for an earlier measurement</source>
        <translation>اختيرت العتبة لقياس سابق</translation>
    </message>
    <message>
        <source>Look at it again, then go on.</source>
        <translation>راجعها ثم تابع.</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>كل ما تم قياسه آمن.</translation>
    </message>
    <message>
        <source>Threshold</source>
        <translation>العتبة</translation>
    </message>
    <message>
        <source>Choose the faintest light worth keeping. Less is faster and smaller; too little loses the bounces.</source>
        <translation>اختر أضعف ضوء يستحق الاحتفاظ به. القليل أسرع وأصغر؛ والقليل جدًا يُضيع الانعكاسات.</translation>
    </message>
    <message>
        <source>Camera view</source>
        <translation>مشهد الكاميرا</translation>
    </message>
    <message>
        <source>The surface in full light</source>
        <translation>السطح في الإضاءة الكاملة</translation>
    </message>
    <message>
        <source>Pixel %1, %2</source>
        <translation>البكسل %1، %2</translation>
    </message>
    <message>
        <source>Projector pixels that light the picked camera pixel</source>
        <translation>بكسلات جهاز العرض التي تضيء بكسل الكاميرا المختار</translation>
    </message>
    <message>
        <source>Pick a pixel in the camera view.</source>
        <translation>اختر بكسلًا في مشهد الكاميرا.</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>الكاميرا</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>جهاز العرض</translation>
    </message>
    <message>
        <source>transport</source>
        <translation>النقل</translation>
    </message>
    <message>
        <source>Transport matrix</source>
        <translation>مصفوفة النقل</translation>
    </message>
    <message>
        <source>click an entry</source>
        <translation>انقر خانة</translation>
    </message>
    <message>
        <source>Light transport matrix, camera pixels down, projector pixels across</source>
        <translation>مصفوفة نقل الضوء، بكسلات الكاميرا رأسيًا، وبكسلات جهاز العرض أفقيًا</translation>
    </message>
    <message>
        <source>Transport value, camera signal a second</source>
        <translation>قيمة النقل، إشارة الكاميرا في الثانية</translation>
    </message>
    <message>
        <source>How much light flows through each connection</source>
        <translation>مقدار الضوء المار في كل ارتباط</translation>
    </message>
    <message>
        <source>drag the cut, or use the arrow keys</source>
        <translation>اسحب حد القطع، أو استخدم مفاتيح الأسهم</translation>
    </message>
    <message>
        <source>Connections</source>
        <translation>الارتباطات</translation>
    </message>
    <message>
        <source>Cut</source>
        <translation>حد القطع</translation>
    </message>
    <message>
        <source>Cut at %1, keeps %2</source>
        <translation>حد القطع ⁨%1⁩، يُبقي %2</translation>
    </message>
    <message>
        <source>Everything is kept</source>
        <translation>يبقى كل شيء</translation>
    </message>
    <message>
        <source>Leave out light below</source>
        <translation>استبعاد الضوء الأقل من</translation>
    </message>
    <message>
        <source>One value</source>
        <translation>قيمة واحدة</translation>
    </message>
    <message>
        <source>What stays</source>
        <translation>ما يبقى</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>الضوء</translation>
    </message>
    <message>
        <source>Memory</source>
        <translation>الذاكرة</translation>
    </message>
    <message>
        <source>What is left out is put back in proportion, so that the surface keeps its brightness.</source>
        <translation>ما يُستبعد يُعاد توزيعه بالتناسب، ليحتفظ السطح بسطوعه.</translation>
    </message>
    <message>
        <source>Picked pixel</source>
        <translation>البكسل المختار</translation>
    </message>
    <message>
        <source>Lit by</source>
        <translation>يضيئه</translation>
    </message>
    <message>
        <source>Strongest</source>
        <translation>الأقوى</translation>
    </message>
    <message>
        <source>From around it</source>
        <translation>مما حوله</translation>
    </message>
    <message>
        <source>Light from elsewhere</source>
        <translation>ضوء من مواضع أخرى</translation>
    </message>
    <message>
        <source>Use suggested, %1</source>
        <translation>استخدام المقترح، ⁨%1⁩</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>⁨%1⁩ من ⁨%2⁩</translation>
    </message>
    <message>
        <source>Picked pixel %1, %2</source>
        <translation>البكسل المختار %1، %2</translation>
    </message>
    <message numerus="yes">
        <source>%n pixel(s)</source>
        <translation>
            <numerusform>لا بكسلات</numerusform>
            <numerusform>بكسل واحد</numerusform>
            <numerusform>بكسلان</numerusform>
            <numerusform>%n بكسلات</numerusform>
            <numerusform>%n بكسلًا</numerusform>
            <numerusform>%n بكسل</numerusform>
        </translation>
    </message>
    <message>
        <source>Cut, camera signal a second</source>
        <translation>حد القطع، إشارة الكاميرا في الثانية</translation>
    </message>
    <message>
        <source>Use picked pixel</source>
        <translation>استخدم البكسل المختار</translation>
    </message>
    <message>
        <source>For each camera pixel</source>
        <translation>لكل بكسل كاميرا</translation>
    </message>
    <message>
        <source>Suggested: three times the noise of the measurement.</source>
        <translation>المقترح: ثلاثة أمثال ضجيج القياس.</translation>
    </message>
    <message>
        <source>Suggested: keeps nearly all of the light.</source>
        <translation>المقترح: يُبقي الضوء كله تقريبًا.</translation>
    </message>
    <message>
        <source>%1 on average</source>
        <translation>⁨%1⁩ في المتوسط</translation>
    </message>
    <message>
        <source>Kind of cut</source>
        <translation>نوع القطع</translation>
    </message>
    <message>
        <source>Share of each pixel</source>
        <translation>نسبة من كل بكسل</translation>
    </message>
    <message>
        <source>Share of the strongest light of each camera pixel, in tenths of a percent</source>
        <translation>نسبة من أقوى ضوء لكل بكسل في الكاميرا، بأعشار المئة</translation>
    </message>
    <message>
        <source>Below %1 of the strongest light that each camera pixel gets</source>
        <translation>أقل من %1 من أقوى ضوء يصل كل بكسل في الكاميرا</translation>
    </message>
    <message>
        <source>Of each camera pixel the strongest connection always stays, however high the cut.</source>
        <translation>يبقى دائمًا أقوى اتصال لكل بكسل في الكاميرا مهما ارتفع حد القطع.</translation>
    </message>
    <message>
        <source>“%1” is not a cut: type a number, 0 or more. The cut is still %2.</source>
        <translation>«⁨%1⁩» ليس حد قطع: اكتب عددًا لا يقل عن 0. ما زال حد القطع ⁨%2⁩.</translation>
    </message>
    <message>
        <source>At three times the noise, %1, only %2 of the light would stay: much faint light adds up. Suggested: keep everything.</source>
        <translation>عند ثلاثة أمثال الضجيج، ⁨%1⁩، لن يبقى إلا ⁨%2⁩ من الضوء: فالضوء الضعيف الكثير يتراكم. المقترح: الاحتفاظ بكل شيء.</translation>
    </message>
    <message>
        <source>Keep everything</source>
        <translation>الاحتفاظ بكل شيء</translation>
    </message>
    <message>
        <source>Changed: it is applied as soon as you go on.</source>
        <translation>تم التغيير: يُطبَّق بمجرد المتابعة.</translation>
    </message>
    <message>
        <source>What was measured is being read.</source>
        <translation>تُقرأ نتائج القياس.</translation>
    </message>
    <message>
        <source>Pick a pixel in a picture.</source>
        <translation>اختر بكسلًا في صورة.</translation>
    </message>
    <message>
        <source>It is in use.</source>
        <translation>هو المستخدم الآن.</translation>
    </message>
    <message>
        <source>No light of the picked pixel was kept.</source>
        <translation>لم يبقَ ضوء من البكسل المختار.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::TidyDialog</name>
    <message>
        <source>All</source>
        <translation>كلها</translation>
    </message>
    <message>
        <source>Of the latest measurement</source>
        <translation>لقطات أحدث قياس</translation>
    </message>
    <message>
        <source>None: results only</source>
        <translation>لا شيء: النتائج فقط</translation>
    </message>
    <message>
        <source>Only what nothing reads goes, and old files are compressed without loss.</source>
        <translation>يُحذف ما لا يقرؤه شيء فقط، وتُضغط الملفات القديمة دون فقد.</translation>
    </message>
    <message>
        <source>Those that were set aside by measuring again go too. Nothing reads them.</source>
        <translation>تُحذف أيضًا اللقطات التي نُحّيت عند إعادة القياس. لا يقرؤها شيء.</translation>
    </message>
    <message>
        <source>All that was measured and computed stays. The photographs go.</source>
        <translation>يبقى كل ما قيس وحُسب، وتُحذف اللقطات.</translation>
    </message>
    <message>
        <source>Showing, checking and reports need results only. Other settings, and better methods of later versions, then have to photograph everything again.</source>
        <translation>العرض والفحص والتقارير تحتاج إلى النتائج فقط. أما الإعدادات الأخرى والطرق الأفضل في الإصدارات القادمة فتتطلب تصوير كل شيء من جديد.</translation>
    </message>
    <message numerus="yes">
        <source>%n photograph(s)</source>
        <translation>
            <numerusform>لا لقطات</numerusform>
            <numerusform>لقطة واحدة</numerusform>
            <numerusform>لقطتان</numerusform>
            <numerusform>%n لقطات</numerusform>
            <numerusform>%n لقطة</numerusform>
            <numerusform>%n لقطة</numerusform>
        </translation>
    </message>
    <message>
        <source>What was freed until then is free. Nothing that is needed is lost.</source>
        <translation>ما أُخلي حتى ذلك الحين صار متاحًا. لم يُفقد شيء لازم.</translation>
    </message>
    <message>
        <source>Photographs to keep</source>
        <translation>اللقطات المحفوظة</translation>
    </message>
    <message>
        <source>This venue is not measured to the end.</source>
        <translation>لم يكتمل قياس هذا الموقع.</translation>
    </message>
    <message>
        <source>All its photographs stay: going on needs them.</source>
        <translation>تبقى كل لقطاته: يحتاج إليها إكمال القياس.</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>رجوع</translation>
    </message>
    <message>
        <source>Freeing the disk</source>
        <translation>يجري إخلاء القرص</translation>
    </message>
    <message>
        <source>%1 will be removed for good.</source>
        <translation>ستُحذف نهائيًا: %1.</translation>
    </message>
    <message>
        <source>%1 will be freed.</source>
        <translation>سيُخلى %1.</translation>
    </message>
    <message>
        <source>%1 freed, %2 removed</source>
        <translation>أُخلي %1، وحُذف: %2</translation>
    </message>
    <message>
        <source>%1 Nothing that is needed is lost.</source>
        <translation>⁨%1⁩ لم يُفقد شيء لازم.</translation>
    </message>
    <message>
        <source>frees %1</source>
        <translation>يُخلي %1</translation>
    </message>
    <message>
        <source>nothing to free</source>
        <translation>لا شيء لإخلائه</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>إلغاء</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>إيقاف</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>إغلاق</translation>
    </message>
    <message>
        <source>Free %1…</source>
        <translation>إخلاء %1…</translation>
    </message>
    <message>
        <source>Free %1</source>
        <translation>إخلاء %1</translation>
    </message>
    <message>
        <source>No photograph goes: everything stays possible.</source>
        <translation>لا تُحذف أي لقطة: يبقى كل شيء ممكنًا.</translation>
    </message>
    <message>
        <source>The latest measurement keeps its photographs: everything stays possible.</source>
        <translation>يحتفظ أحدث قياس بلقطاته: يبقى كل شيء ممكنًا.</translation>
    </message>
    <message>
        <source>Looking up what could be freed. Nothing is removed yet.</source>
        <translation>يجري البحث عما يمكن إخلاؤه. لا يُحذف شيء بعد.</translation>
    </message>
    <message>
        <source>Free disk space</source>
        <translation>إخلاء مساحة القرص</translation>
    </message>
    <message>
        <source>Disk space of %1</source>
        <translation>مساحة القرص لـ%1</translation>
    </message>
    <message>
        <source>Freeing space was stopped.</source>
        <translation>أُوقف إخلاء المساحة.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VenueNetwork</name>
    <message>
        <source>“%1” is no network address of a projector. Write its number or name, as 192.168.1.50.</source>
        <translation>“%1” ليس عنوان شبكة لجهاز عرض. اكتب رقمه أو اسمه، مثل 192.168.1.50.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VenuePage</name>
    <message>
        <source>Unplugged. Plug it in or choose another.</source>
        <translation>غير موصولة. صِلها أو اختر غيرها.</translation>
    </message>
    <message>
        <source>%1, %2 by %3, chosen</source>
        <translation>⁨%1⁩، %2 في %3، مختارة</translation>
    </message>
    <message>
        <source>%1, %2 by %3</source>
        <translation>⁨%1⁩، %2 في %3</translation>
    </message>
    <message>
        <source>Screens</source>
        <translation>الشاشات</translation>
    </message>
    <message>
        <source>Choose the one that shines on the surface. Its pixels are the projector&apos;s.</source>
        <translation>اختر الشاشة التي تضيء السطح. بكسلاتها هي بكسلات جهاز العرض.</translation>
    </message>
    <message>
        <source>Identify screens</source>
        <translation>تمييز الشاشات</translation>
    </message>
    <message>
        <source>I</source>
        <translation>I</translation>
    </message>
    <message>
        <source>The projector shares your screen</source>
        <translation>جهاز العرض يشارك شاشتك</translation>
    </message>
    <message>
        <source>Real devices</source>
        <translation>أجهزة حقيقية</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>جهاز العرض</translation>
    </message>
    <message>
        <source>Glossy corner</source>
        <translation>زاوية لامعة</translation>
    </message>
    <message>
        <source>Light bounces between two cards</source>
        <translation>ينعكس الضوء بين بطاقتين</translation>
    </message>
    <message>
        <source>Bust before a brick wall</source>
        <translation>تمثال نصفي أمام جدار طوب</translation>
    </message>
    <message>
        <source>Texture, shadow and light between surfaces</source>
        <translation>ملمس وظل وضوء بين الأسطح</translation>
    </message>
    <message>
        <source>Many depths</source>
        <translation>أعماق متعددة</translation>
    </message>
    <message>
        <source>Some surfaces are out of focus</source>
        <translation>بعض الأسطح خارج البؤرة</translation>
    </message>
    <message>
        <source>Dome</source>
        <translation>قبة</translation>
    </message>
    <message>
        <source>Every part lights every other part</source>
        <translation>كل جزء يضيء كل جزء آخر</translation>
    </message>
    <message>
        <source>Wine glass</source>
        <translation>كأس زجاجية</translation>
    </message>
    <message>
        <source>Light is refracted both ways</source>
        <translation>ينكسر الضوء في الاتجاهين</translation>
    </message>
    <message>
        <source>Painted wall</source>
        <translation>جدار مدهون</translation>
    </message>
    <message>
        <source>Flat, with diamonds; the easiest</source>
        <translation>مسطّح، عليه معيّنات؛ الأسهل</translation>
    </message>
    <message>
        <source>%1, a first look</source>
        <translation>⁨%1⁩، نظرة أولى</translation>
    </message>
    <message>
        <source>%1, quick</source>
        <translation>⁨%1⁩، سريع</translation>
    </message>
    <message>
        <source>%1, usual</source>
        <translation>⁨%1⁩، معتاد</translation>
    </message>
    <message>
        <source>%1, fine</source>
        <translation>⁨%1⁩، دقيق</translation>
    </message>
    <message>
        <source>Venue</source>
        <translation>الموقع</translation>
    </message>
    <message>
        <source>Rehearse in a simulated venue</source>
        <translation>التدريب في موقع محاكى</translation>
    </message>
    <message>
        <source>New venue by script</source>
        <translation>موقع جديد بنص برمجي</translation>
    </message>
    <message>
        <source>New venue</source>
        <translation>موقع جديد</translation>
    </message>
    <message>
        <source>Say which screen shines, which programs show and photograph, and where the work is kept.</source>
        <translation>حدّد الشاشة التي تضيء، والبرامج التي تعرض وتصوّر، ومكان حفظ العمل.</translation>
    </message>
    <message>
        <source>Setting up</source>
        <translation>قيد الإعداد</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>⁨%1⁩، ⁨%2⁩</translation>
    </message>
    <message>
        <source>simulated, %1</source>
        <translation>محاكاة، ⁨%1⁩</translation>
    </message>
    <message>
        <source>by script, %1</source>
        <translation>بنص برمجي، ⁨%1⁩</translation>
    </message>
    <message>
        <source>%1 is open</source>
        <translation>الموقع ⁨%1⁩ مفتوح</translation>
    </message>
    <message>
        <source>Enter opens the highlighted choice</source>
        <translation>يفتح Enter الخيار المميّز</translation>
    </message>
    <message>
        <source>Check camera</source>
        <translation>فحص الكاميرا</translation>
    </message>
    <message>
        <source>Start rehearsal</source>
        <translation>بدء التدريب</translation>
    </message>
    <message>
        <source>Nothing was changed in that folder.</source>
        <translation>لم يتغيّر شيء في ذلك المجلد.</translation>
    </message>
    <message>
        <source>Give the venue a name.</source>
        <translation>أعطِ الموقع اسمًا.</translation>
    </message>
    <message>
        <source>A name cannot hold a slash.</source>
        <translation>لا يجوز في الاسم شرطة مائلة.</translation>
    </message>
    <message>
        <source>There is a folder of that name. Choose another name.</source>
        <translation>يوجد مجلد بهذا الاسم. اختر اسمًا آخر.</translation>
    </message>
    <message>
        <source>Choose the screen that shines on the surface.</source>
        <translation>اختر الشاشة التي تضيء السطح.</translation>
    </message>
    <message>
        <source>Free %1 or choose another folder.</source>
        <translation>أخلِ %1 أو اختر مجلدًا آخر.</translation>
    </message>
    <message>
        <source>Confirm that the room is clear.</source>
        <translation>أكّد أن القاعة خالية.</translation>
    </message>
    <message>
        <source>Nothing was measured yet.</source>
        <translation>لم يُقَس شيء بعد.</translation>
    </message>
    <message>
        <source>Programs</source>
        <translation>البرامج</translation>
    </message>
    <message>
        <source>Any projector and any camera that a command can drive</source>
        <translation>أي جهاز عرض وأي كاميرا يمكن تشغيلهما بأمر</translation>
    </message>
    <message>
        <source>Photographs {exposure} seconds into the file {output}: float EXR, 16-bit PNG or TIFF</source>
        <translation>يصوّر لمدة {exposure} ثانية إلى الملف {output}: ملف EXR عائم، أو PNG أو TIFF بعمق 16 بت</translation>
    </message>
    <message>
        <source>Projector&apos;s pixels</source>
        <translation>بكسلات جهاز العرض</translation>
    </message>
    <message>
        <source>Width</source>
        <translation>العرض</translation>
    </message>
    <message>
        <source>Height</source>
        <translation>الارتفاع</translation>
    </message>
    <message>
        <source>Rehearsal. Opened %1</source>
        <translation>تدريب. آخر فتح: %1</translation>
    </message>
    <message>
        <source>Opened %1</source>
        <translation>آخر فتح: %1</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>فتح</translation>
    </message>
    <message>
        <source>Open %1</source>
        <translation>فتح ⁨%1⁩</translation>
    </message>
    <message>
        <source>Open a venue</source>
        <translation>فتح موقع</translation>
    </message>
    <message>
        <source>Rehearse</source>
        <translation>تدريب</translation>
    </message>
    <message>
        <source>Learn every step in a simulated venue. No devices needed.</source>
        <translation>تعلّم كل خطوة في موقع محاكى. لا حاجة إلى أجهزة.</translation>
    </message>
    <message>
        <source>Continue where you stopped, or change the content.</source>
        <translation>تابع من حيث توقفت، أو غيّر المحتوى.</translation>
    </message>
    <message>
        <source>Measure a surface with a projector and a camera at this computer.</source>
        <translation>قِس سطحًا بجهاز عرض وكاميرا على هذا الحاسوب.</translation>
    </message>
    <message>
        <source>Projector and camera are driven by programs of yours.</source>
        <translation>برامجك هي التي تشغّل جهاز العرض والكاميرا.</translation>
    </message>
    <message>
        <source>Recent</source>
        <translation>الأخيرة</translation>
    </message>
    <message>
        <source>No venues yet</source>
        <translation>لا مواقع بعد</translation>
    </message>
    <message>
        <source>The venues that you measure are listed here, newest first.</source>
        <translation>تُدرج هنا المواقع التي تقيسها، الأحدث أولًا.</translation>
    </message>
    <message>
        <source>A first rehearsal takes a few minutes.</source>
        <translation>يستغرق التدريب الأول بضع دقائق.</translation>
    </message>
    <message>
        <source>This venue</source>
        <translation>هذا الموقع</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>الاسم</translation>
    </message>
    <message>
        <source>Name of the venue</source>
        <translation>اسم الموقع</translation>
    </message>
    <message>
        <source>Folder</source>
        <translation>المجلد</translation>
    </message>
    <message>
        <source>Folder that holds the venue</source>
        <translation>المجلد الذي يحوي الموقع</translation>
    </message>
    <message>
        <source>Choose a folder</source>
        <translation>اختيار مجلد</translation>
    </message>
    <message>
        <source>Expected</source>
        <translation>التقدير</translation>
    </message>
    <message>
        <source>Patterns</source>
        <translation>الأنماط</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>القرص</translation>
    </message>
    <message>
        <source>about %1</source>
        <translation>نحو %1</translation>
    </message>
    <message>
        <source>Simulated devices</source>
        <translation>أجهزة محاكاة</translation>
    </message>
    <message>
        <source>Pixels of the simulated projector</source>
        <translation>بكسلات جهاز العرض المحاكى</translation>
    </message>
    <message>
        <source>More pixels show finer detail and take longer. The first time, the light of the venue is traced; later it is remembered.</source>
        <translation>المزيد من البكسلات يُظهر تفاصيل أدق ويستغرق وقتًا أطول. في المرة الأولى يُتتبّع ضوء الموقع؛ ثم يُحفظ لما بعد.</translation>
    </message>
    <message numerus="yes">
        <source>About %n pattern(s), %1</source>
        <translation>
            <numerusform>لا أنماط، ⁨%1⁩</numerusform>
            <numerusform>نحو نمط واحد، ⁨%1⁩</numerusform>
            <numerusform>نحو نمطين، ⁨%1⁩</numerusform>
            <numerusform>نحو %n أنماط، ⁨%1⁩</numerusform>
            <numerusform>نحو %n نمطًا، ⁨%1⁩</numerusform>
            <numerusform>نحو %n نمط، ⁨%1⁩</numerusform>
        </translation>
    </message>
    <message>
        <source>Shows the file {image} and ends as soon as the projector shines it</source>
        <translation>يعرض الملف {image} وينتهي فور أن يبثّه جهاز العرض</translation>
    </message>
    <message>
        <source>Relief, two projectors</source>
        <translation>نقش بارز، جهازا عرض</translation>
    </message>
    <message>
        <source>Each shines into the other&apos;s shadows</source>
        <translation>كل منهما يضيء ظلال الآخر</translation>
    </message>
    <message>
        <source>The projector&apos;s screen</source>
        <translation>شاشة جهاز العرض</translation>
    </message>
    <message>
        <source>Say which screen the projector is now. What was measured stays.</source>
        <translation>حدّد أي شاشة هي جهاز العرض الآن. ما قيس يبقى.</translation>
    </message>
    <message>
        <source>Nothing is measured again.</source>
        <translation>لا يُعاد قياس شيء.</translation>
    </message>
    <message>
        <source>Use this screen</source>
        <translation>استخدم هذه الشاشة</translation>
    </message>
    <message>
        <source>Change the screen</source>
        <translation>غيّر الشاشة</translation>
    </message>
    <message>
        <source>The projector&apos;s screen %1 is not there</source>
        <translation>شاشة جهاز العرض %1 غير موجودة</translation>
    </message>
    <message>
        <source>Plug it in, or say which screen the projector is now.</source>
        <translation>صِلها أو حدّد أي شاشة هي جهاز العرض الآن.</translation>
    </message>
    <message>
        <source>%1 is not the folder of a venue: it has no %2 in it.</source>
        <translation>%1 ليس مجلد موقع: لا يوجد فيه %2.</translation>
    </message>
    <message numerus="yes">
        <source>There are %n venue(s) within it: open one of them.</source>
        <translation>
            <numerusform>لا مواقع فيه.</numerusform>
            <numerusform>فيه موقع واحد: افتحه.</numerusform>
            <numerusform>فيه موقعان: افتح أحدهما.</numerusform>
            <numerusform>فيه %n مواقع: افتح أحدها.</numerusform>
            <numerusform>فيه %n موقعًا: افتح أحدها.</numerusform>
            <numerusform>فيه %n موقع: افتح أحدها.</numerusform>
        </translation>
    </message>
    <message>
        <source>Choose a venue&apos;s own folder. It has the venue&apos;s name.</source>
        <translation>اختر مجلد الموقع نفسه، فهو يحمل اسمه.</translation>
    </message>
    <message>
        <source>This folder is not a venue</source>
        <translation>هذا المجلد ليس موقعًا</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>لم يتغير شيء.</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>الأجهزة مستخدمة الآن في %1.</translation>
    </message>
    <message>
        <source>Choose another screen.</source>
        <translation>اختر شاشة أخرى.</translation>
    </message>
    <message>
        <source>Only your own screen is there. Plug the projector in, and extend the desktop to it.</source>
        <translation>لا توجد إلا شاشتك. صِل جهاز العرض ومدّ سطح المكتب إليه.</translation>
    </message>
    <message>
        <source>Nothing is measured again</source>
        <translation>لا يُعاد قياس شيء</translation>
    </message>
    <message>
        <source>Measured at</source>
        <translation>قيس على</translation>
    </message>
    <message>
        <source>Used at</source>
        <translation>يُستخدم على</translation>
    </message>
    <message>
        <source>Pixels</source>
        <translation>البكسلات</translation>
    </message>
    <message>
        <source>A screen is known again by its maker&apos;s names and serial number. Where it tells none, it is known by its connector: then a cable that is plugged in elsewhere has to be said here.</source>
        <translation>تُعرف الشاشة من صانعها ورقمها التسلسلي. فإن لم تذكرهما عُرفت من منفذها: وعندئذ يجب أن يُذكر هنا الكابل الموصول في منفذ آخر.</translation>
    </message>
    <message>
        <source>Is open</source>
        <translation>مفتوح</translation>
    </message>
    <message>
        <source>Time, by camera</source>
        <translation>المدة بحسب الكاميرا</translation>
    </message>
    <message>
        <source>Industrial cameras and video devices are fast, still cameras slow.</source>
        <translation>كاميرات الصناعة وأجهزة الفيديو سريعة، وكاميرات التصوير الثابت بطيئة.</translation>
    </message>
    <message>
        <source>%1 to %2</source>
        <translation>من %1 إلى %2</translation>
    </message>
    <message>
        <source>%1 free</source>
        <translation>المتاح %1</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 من %2</translation>
    </message>
    <message>
        <source>Free the disk of what %1 does not need</source>
        <translation>إخلاء القرص مما لا يحتاج إليه ⁨%1⁩</translation>
    </message>
    <message>
        <source>Resume</source>
        <translation>استئناف</translation>
    </message>
    <message>
        <source>Resume %1</source>
        <translation>استئناف ⁨%1⁩</translation>
    </message>
    <message>
        <source>Free space…</source>
        <translation>إخلاء مساحة…</translation>
    </message>
    <message>
        <source>Somebody bumps the camera</source>
        <translation>يصطدم أحدهم بالكاميرا</translation>
    </message>
    <message>
        <source>A light is switched on</source>
        <translation>يُشعَل ضوء</translation>
    </message>
    <message>
        <source>The camera&apos;s cable comes out</source>
        <translation>ينفصل كابل الكاميرا</translation>
    </message>
    <message>
        <source>Surprises</source>
        <translation>مفاجآت</translation>
    </message>
    <message>
        <source>Each comes once while Acquire measures, at a moment that nobody knows. Practise what the wizard says, before it happens in front of a client.</source>
        <translation>تأتي كل منها مرة واحدة أثناء «القياس»، في لحظة لا يعرفها أحد. تدرّب على ما يقوله المعالج قبل أن يحدث ذلك أمام عميل.</translation>
    </message>
    <message>
        <source>Measures how a surface changes what is projected on it, and corrects pictures and films until they look right there.</source>
        <translation>يقيس كيف يغيّر السطح ما يُعرض عليه، ويصحّح الصور والأفلام حتى تبدو صحيحة هناك.</translation>
    </message>
    <message>
        <source>Easy. Measuring takes %1</source>
        <translation>سهل. مدة القياس: ⁨%1⁩</translation>
    </message>
    <message>
        <source>Medium. Measuring takes %1</source>
        <translation>متوسط. مدة القياس: ⁨%1⁩</translation>
    </message>
    <message>
        <source>Hard. Measuring takes %1</source>
        <translation>صعب. مدة القياس: ⁨%1⁩</translation>
    </message>
    <message>
        <source>Name of %1</source>
        <translation>اسم ⁨%1⁩</translation>
    </message>
    <message>
        <source>Projectors</source>
        <translation>أجهزة العرض</translation>
    </message>
    <message>
        <source>None chosen yet.</source>
        <translation>لم يُختر شيء بعد.</translation>
    </message>
    <message>
        <source>Add a projector</source>
        <translation>إضافة جهاز عرض</translation>
    </message>
    <message>
        <source>Projector %1</source>
        <translation>جهاز العرض %1</translation>
    </message>
    <message>
        <source>Remove projector %1</source>
        <translation>إزالة جهاز العرض ⁨%1⁩</translation>
    </message>
    <message>
        <source>%1: choose its screen</source>
        <translation>⁨%1⁩: اختر شاشته</translation>
    </message>
    <message>
        <source>Cameras</source>
        <translation>الكاميرات</translation>
    </message>
    <message>
        <source>Camera %1</source>
        <translation>الكاميرا %1</translation>
    </message>
    <message>
        <source>Remove camera %1</source>
        <translation>إزالة الكاميرا ⁨%1⁩</translation>
    </message>
    <message>
        <source>Add one from the list, or choose it at the next step.</source>
        <translation>أضف واحدة من القائمة، أو اخترها في الخطوة التالية.</translation>
    </message>
    <message>
        <source>Content is placed in the view of the first one.</source>
        <translation>يوضع المحتوى في مشهد الأولى.</translation>
    </message>
    <message>
        <source>Add those that look at the surface.</source>
        <translation>أضف تلك التي تنظر إلى السطح.</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>إزالة</translation>
    </message>
    <message>
        <source>Remove %1</source>
        <translation>إزالة ⁨%1⁩</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>إضافة</translation>
    </message>
    <message>
        <source>Add %1</source>
        <translation>إضافة ⁨%1⁩</translation>
    </message>
    <message>
        <source>Say which screens shine on the surface, which cameras watch, and where the work is kept.</source>
        <translation>حدد أي الشاشات تضيء السطح، وأي الكاميرات تراقب، وأين يُحفظ العمل.</translation>
    </message>
    <message numerus="yes">
        <source>%n projector(s)</source>
        <translation>
            <numerusform>لا أجهزة عرض</numerusform>
            <numerusform>جهاز عرض واحد</numerusform>
            <numerusform>جهازا عرض</numerusform>
            <numerusform>%n أجهزة عرض</numerusform>
            <numerusform>%n جهاز عرض</numerusform>
            <numerusform>%n جهاز عرض</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n camera(s)</source>
        <translation>
            <numerusform>لا كاميرات</numerusform>
            <numerusform>كاميرا واحدة</numerusform>
            <numerusform>كاميرتان</numerusform>
            <numerusform>%n كاميرات</numerusform>
            <numerusform>%n كاميرا</numerusform>
            <numerusform>%n كاميرا</numerusform>
        </translation>
    </message>
    <message>
        <source>This screen is projector %1 already.</source>
        <translation>هذه الشاشة هي جهاز العرض ⁨%1⁩ بالفعل.</translation>
    </message>
    <message>
        <source>That screen is projector %1. Choose another screen.</source>
        <translation>تلك الشاشة هي جهاز العرض ⁨%1⁩. اختر شاشة أخرى.</translation>
    </message>
    <message>
        <source>Dome, four projectors</source>
        <translation>قبة، أربعة أجهزة عرض</translation>
    </message>
    <message>
        <source>They overlap; two cameras watch</source>
        <translation>تتراكب؛ وتراقبها كاميرتان</translation>
    </message>
    <message>
        <source>Bust from three sides</source>
        <translation>تمثال نصفي من ثلاث جهات</translation>
    </message>
    <message>
        <source>Two projectors, three cameras: for an audience that walks</source>
        <translation>جهازا عرض وثلاث كاميرات: لجمهور يمشي</translation>
    </message>
    <message>
        <source>Projector whose screen is changed</source>
        <translation>جهاز العرض الذي تُغيَّر شاشته</translation>
    </message>
    <message>
        <source>Network address (PJLink)</source>
        <translation>عنوان الشبكة (PJLink)</translation>
    </message>
    <message>
        <source>Password, if it has one</source>
        <translation>كلمة المرور، إن وُجدت</translation>
    </message>
    <message>
        <source>On the network</source>
        <translation>على الشبكة</translation>
    </message>
    <message>
        <source>Optional: a projector with a network address is switched on, and its lamp waited for until it is steady, before anything is measured.</source>
        <translation>اختياري: جهاز العرض الذي له عنوان شبكة يُشغَّل، ويُنتظر حتى يستقر مصباحه، قبل قياس أي شيء.</translation>
    </message>
    <message>
        <source>Find projectors</source>
        <translation>ابحث عن أجهزة العرض</translation>
    </message>
    <message>
        <source>Looking for projectors…</source>
        <translation>جارٍ البحث عن أجهزة العرض…</translation>
    </message>
    <message>
        <source>None answers. Only PJLink class 2 can be searched: type the address.</source>
        <translation>لا يجيب أي منها. لا يمكن البحث إلا عن PJLink من الفئة 2: اكتب العنوان.</translation>
    </message>
    <message numerus="yes">
        <source>%n answer. Choose from the list of each.</source>
        <translation>
            <numerusform>لا يجيب أي جهاز.</numerusform>
            <numerusform>يجيب جهاز واحد. اختره من القائمة.</numerusform>
            <numerusform>يجيب جهازان. اختر من قائمة كل منهما.</numerusform>
            <numerusform>تجيب %n أجهزة. اختر من قائمة كل منها.</numerusform>
            <numerusform>يجيب %n جهازاً. اختر من قائمة كل منها.</numerusform>
            <numerusform>يجيب %n جهاز. اختر من قائمة كل منها.</numerusform>
        </translation>
    </message>
    <message>
        <source>Move to the trash</source>
        <translation>نقل إلى سلة المهملات</translation>
    </message>
    <message>
        <source>Keep it</source>
        <translation>الإبقاء عليه</translation>
    </message>
    <message>
        <source>Try again then.</source>
        <translation>حاول بعد ذلك مرة أخرى.</translation>
    </message>
    <message>
        <source>Nothing of the venue is lost.</source>
        <translation>لم يُفقد شيء من الموقع.</translation>
    </message>
    <message>
        <source>Remove a venue</source>
        <translation>إزالة موقع</translation>
    </message>
    <message>
        <source>“%1” goes to the trash, with its photographs, results and playlist.</source>
        <translation>ينتقل «%1» إلى سلة المهملات مع لقطاته ونتائجه وقائمة تشغيله.</translation>
    </message>
    <message>
        <source>Until the trash is emptied it can be taken back from there.</source>
        <translation>يمكن استرجاعه من هناك حتى تُفرَّغ سلة المهملات.</translation>
    </message>
    <message>
        <source>More</source>
        <translation>المزيد</translation>
    </message>
    <message>
        <source>More for %1</source>
        <translation>المزيد لـ %1</translation>
    </message>
    <message>
        <source>Rename…</source>
        <translation>إعادة تسمية…</translation>
    </message>
    <message>
        <source>Remove…</source>
        <translation>إزالة…</translation>
    </message>
    <message>
        <source>Setting up another</source>
        <translation>إعداد موقع آخر</translation>
    </message>
    <message>
        <source>Allow them</source>
        <translation>السماح بها</translation>
    </message>
    <message>
        <source>Open without them</source>
        <translation>الفتح من دونها</translation>
    </message>
    <message>
        <source>Programs of a venue</source>
        <translation>برامج الموقع</translation>
    </message>
    <message>
        <source>“%1” names programs of its own as projector or camera. They would run on this computer as you, and nobody here has agreed to that yet:</source>
        <translation>يسمّي «%1» برامج خاصة به جهازَ عرض أو كاميرا. ستعمل على هذا الحاسوب باسمك، ولم يوافق أحد هنا على ذلك بعد:</translation>
    </message>
    <message>
        <source>None of them was run. Without them everything that was measured can be looked at and shown.</source>
        <translation>لم يُشغَّل أي منها. ومن دونها يمكن النظر في كل ما قيس وعرضه.</translation>
    </message>
    <message>
        <source>Allow them if you know what they do, or know who made this venue.</source>
        <translation>اسمح بها إن كنت تعرف ما تفعله أو تعرف من أعدّ هذا الموقع.</translation>
    </message>
    <message>
        <source>No other screen is plugged in.</source>
        <translation>لا شاشة أخرى موصولة.</translation>
    </message>
    <message>
        <source>The same steps, with a simulated projector and camera. Nothing is projected unless you choose a screen.</source>
        <translation>الخطوات نفسها، مع محاكاة جهاز العرض والكاميرا. لا يُعرض شيء ما لم تختر شاشة.</translation>
    </message>
    <message>
        <source>Programs of this venue</source>
        <translation>برامج هذا الموقع</translation>
    </message>
    <message>
        <source>Say which commands drive these devices from now on. What was measured stays.</source>
        <translation>حدّد الأوامر التي تشغّل هذه الأجهزة من الآن. ما قيس يبقى.</translation>
    </message>
    <message>
        <source>Use these commands</source>
        <translation>استخدم هذه الأوامر</translation>
    </message>
    <message>
        <source>Change the programs</source>
        <translation>غيّر البرامج</translation>
    </message>
    <message>
        <source>Type another command.</source>
        <translation>اكتب أمرًا آخر.</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>الكاميرا</translation>
    </message>
    <message>
        <source>A program that fails ends with another status than 0. What it says last is told with it. Try it in a terminal, with a file in place of {image} or {output} and seconds in place of {exposure}.</source>
        <translation>البرنامج الذي يخفق ينتهي بحالة غير 0، وتُعرض معها آخر رسالة له. جرّبه في الطرفية، بملف مكان {image} أو {output} وثوانٍ مكان {exposure}.</translation>
    </message>
    <message>
        <source>Relucent shows the pictures on it, unless a program of yours does.</source>
        <translation>يعرض Relucent الصور عليها، ما لم يعرضها برنامج لك.</translation>
    </message>
    <message>
        <source>Not needed with a screen. %1</source>
        <translation>غير لازم مع شاشة. %1</translation>
    </message>
    <message>
        <source>Choose the projector&apos;s screen, or type the command that shows.</source>
        <translation>اختر شاشة جهاز العرض، أو اكتب الأمر الذي يعرض.</translation>
    </message>
    <message>
        <source>%1, %2, unplugged</source>
        <translation>%1، %2، مفصول</translation>
    </message>
    <message>
        <source>As many as the chosen screen has.</source>
        <translation>بقدر ما للشاشة المختارة.</translation>
    </message>
    <message>
        <source>Continue</source>
        <translation>متابعة</translation>
    </message>
    <message>
        <source>A show plays on %1</source>
        <translation>عرض قيد التشغيل على %1</translation>
    </message>
    <message>
        <source>Another program shows it. End it before anything is measured there: Camera has the button.</source>
        <translation>يعرضه برنامج آخر. أنهِه قبل أي قياس هناك: الزر في «الكاميرا».</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VenueTidy</name>
    <message>
        <source>Try again then.</source>
        <translation>حاول بعد ذلك مرة أخرى.</translation>
    </message>
    <message>
        <source>%1 is at work. Space can be freed when it has ended.</source>
        <translation>%1 قيد العمل. يمكن إخلاء المساحة بعد انتهائه.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ViewerPlan</name>
    <message>
        <source>Plan of the cameras and of the viewer, seen from above</source>
        <translation>مخطط الكاميرات والمشاهد من الأعلى</translation>
    </message>
    <message>
        <source>Camera %1</source>
        <translation>الكاميرا %1</translation>
    </message>
    <message>
        <source>Viewer</source>
        <translation>المشاهد</translation>
    </message>
    <message>
        <source>%1: %2 m to the left, %3 m from the surface</source>
        <translation>⁨%1⁩: ⁨%2⁩ م إلى اليسار، ⁨%3⁩ م من السطح</translation>
    </message>
    <message>
        <source>%1: %2 m to the right, %3 m from the surface</source>
        <translation>⁨%1⁩: ⁨%2⁩ م إلى اليمين، ⁨%3⁩ م من السطح</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VtkView</name>
    <message>
        <source>This view needs OpenGL 3.2, and this computer draws without it. Everything else works: pictures and maps are shown without depth.</source>
        <translation>يحتاج هذا المشهد إلى OpenGL 3.2، وهذا الحاسوب يرسم من دونه. كل ما عداه يعمل: تُعرض الصور والخرائط بلا عمق.</translation>
    </message>
    <message>
        <source>For this view, install the graphics card&apos;s driver and start Relucent again.</source>
        <translation>لهذا العرض، ثبّت برنامج تشغيل بطاقة الرسوم وأعد تشغيل Relucent.</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Wizard</name>
    <message>
        <source>Not applied yet</source>
        <translation>لم يُطبَّق بعد</translation>
    </message>
</context>
<context>
    <name>repair.camera-moved</name>
    <message>
        <source>the view of camera {} has moved by {} and {} pixels and turned by {} degrees</source>
        <translation>تحرّك مجال رؤية الكاميرا {} بمقدار {} و{} بكسل ودار بمقدار {} درجة</translation>
    </message>
</context>
<context>
    <name>repair.light-changed</name>
    <message>
        <source>projector {} gives {} % of the red, {} % of the green and {} % of the blue light that it gave</source>
        <translation>يعطي جهاز العرض {} نسبة {} % من الضوء الأحمر و{} % من الأخضر و{} % من الأزرق مما كان يعطيه</translation>
    </message>
</context>
<context>
    <name>repair.light-elsewhere</name>
    <message>
        <source>in {} % of the cameras&apos; pixels light arrives otherwise than it did</source>
        <translation>في {} % من بكسلات الكاميرات يصل الضوء على غير ما كان</translation>
    </message>
</context>
<context>
    <name>repair.picture-moved</name>
    <message>
        <source>the projected picture has moved by {} and {} pixels as camera {} sees it</source>
        <translation>تحرّكت الصورة المعروضة بمقدار {} و{} بكسل كما تراها الكاميرا {}</translation>
    </message>
</context>
<context>
    <name>repair.room-brighter</name>
    <message>
        <source>the room is brighter by {} % of the projectors&apos; full light</source>
        <translation>الغرفة أسطع بنسبة {} % من الضوء الكامل لأجهزة العرض</translation>
    </message>
</context>
<context>
    <name>repair.room-darker</name>
    <message>
        <source>the room is darker by {} % of the projectors&apos; full light</source>
        <translation>الغرفة أعتم بنسبة {} % من الضوء الكامل لأجهزة العرض</translation>
    </message>
</context>
<context>
    <name>repair.surface-changed</name>
    <message>
        <source>{} % of what the cameras see is brighter, darker or of another colour than it was</source>
        <translation>{} % مما تراه الكاميرات أسطع أو أعتم أو بلون غير ما كان</translation>
    </message>
</context>
<context>
    <name>report.cannot-write</name>
    <message>
        <source>the report cannot be written</source>
        <translation>تتعذّر كتابة التقرير</translation>
    </message>
</context>
<context>
    <name>report.free-some-space</name>
    <message>
        <source>free some space</source>
        <translation>أخلِ بعض المساحة</translation>
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
        <translation>{} (⁨{}⁩)</translation>
    </message>
</context>
<context>
    <name>sentence.of-place</name>
    <message>
        <source>{}: {}</source>
        <translation>⁨{}⁩: {}</translation>
    </message>
</context>
<context>
    <name>sentence.with-advice</name>
    <message>
        <source>{}; {}</source>
        <translation>{}؛ {}</translation>
    </message>
</context>
<context>
    <name>session.cannot-end-show</name>
    <message>
        <source>the other program may not be ended from here</source>
        <translation>لا يجوز إنهاء البرنامج الآخر من هنا</translation>
    </message>
</context>
<context>
    <name>session.close-other-window</name>
    <message>
        <source>go on there, or close it there first</source>
        <translation>تابع هناك، أو أغلقه هناك أولًا</translation>
    </message>
</context>
<context>
    <name>session.end-show-itself</name>
    <message>
        <source>hold Esc on the projector&apos;s picture for two seconds</source>
        <translation>اضغط Esc مطوّلًا ثانيتين على صورة جهاز العرض</translation>
    </message>
</context>
<context>
    <name>session.open-in-another-window</name>
    <message>
        <source>this venue is open in another window of Relucent</source>
        <translation>هذا الموقع مفتوح في نافذة أخرى من Relucent</translation>
    </message>
</context>
<context>
    <name>sets.choose-name</name>
    <message>
        <source>choose another name, as day or school class</source>
        <translation>اختر اسمًا آخر، مثل نهار أو صف مدرسي</translation>
    </message>
</context>
<context>
    <name>sets.choose-one</name>
    <message>
        <source>choose one of {}</source>
        <translation>اختر واحدة من {}</translation>
    </message>
</context>
<context>
    <name>sets.damaged</name>
    <message>
        <source>the sets of this calibration cannot be read</source>
        <translation>تتعذر قراءة مجموعات هذه المعايرة</translation>
    </message>
</context>
<context>
    <name>sets.in-use</name>
    <message>
        <source>the set &apos;{}&apos; is in use</source>
        <translation>المجموعة «{}» مستخدمة</translation>
    </message>
</context>
<context>
    <name>sets.name-empty</name>
    <message>
        <source>a set needs a name</source>
        <translation>تحتاج المجموعة إلى اسم</translation>
    </message>
</context>
<context>
    <name>sets.name-odd</name>
    <message>
        <source>the name of a set is plain text that neither begins nor ends with a space</source>
        <translation>اسم المجموعة نص عادي لا يبدأ بمسافة ولا ينتهي بها</translation>
    </message>
</context>
<context>
    <name>sets.name-taken</name>
    <message>
        <source>there is a set &apos;{}&apos; already</source>
        <translation>توجد مجموعة «{}» بالفعل</translation>
    </message>
</context>
<context>
    <name>sets.name-too-long</name>
    <message>
        <source>the name of a set has at most {} bytes</source>
        <translation>لا يزيد اسم المجموعة على {} بايت</translation>
    </message>
</context>
<context>
    <name>sets.of-newer-version</name>
    <message>
        <source>a newer Relucent wrote the sets of this calibration</source>
        <translation>كتب إصدار أحدث من Relucent مجموعات هذه المعايرة</translation>
    </message>
</context>
<context>
    <name>sets.remove-section</name>
    <message>
        <source>take &quot;sets&quot; out of the settings in {}, or copy the calibration again from where it was made</source>
        <translation>احذف «sets» من الإعدادات في {}، أو انسخ المعايرة مجددًا من حيث أُنشئت</translation>
    </message>
</context>
<context>
    <name>sets.save-first</name>
    <message>
        <source>this calibration has no sets yet: save one first</source>
        <translation>ليس لهذه المعايرة مجموعات بعد: احفظ واحدة أولًا</translation>
    </message>
</context>
<context>
    <name>sets.unknown</name>
    <message>
        <source>there is no set &apos;{}&apos;</source>
        <translation>لا توجد مجموعة «{}»</translation>
    </message>
</context>
<context>
    <name>sets.use-another-first</name>
    <message>
        <source>use another one first</source>
        <translation>استخدم غيرها أولًا</translation>
    </message>
</context>
<context>
    <name>show.allow-commands</name>
    <message>
        <source>look at what it does, then open the venue in the wizard and allow its programs</source>
        <translation>انظر ما الذي يفعله، ثم افتح الموقع في المعالج واسمح ببرامجه</translation>
    </message>
</context>
<context>
    <name>show.cannot-enable-service</name>
    <message>
        <source>the service cannot be switched on ({})</source>
        <translation>يتعذّر تفعيل الخدمة (⁨{}⁩)</translation>
    </message>
</context>
<context>
    <name>show.cannot-remove-entry</name>
    <message>
        <source>it cannot be removed ({})</source>
        <translation>تتعذّر الإزالة (⁨{}⁩)</translation>
    </message>
</context>
<context>
    <name>show.cannot-write-log</name>
    <message>
        <source>the log cannot be written ({})</source>
        <translation>تتعذّر كتابة السجل (⁨{}⁩)</translation>
    </message>
</context>
<context>
    <name>show.check-folder-permissions</name>
    <message>
        <source>check the folder&apos;s permissions</source>
        <translation>تحقق من أذونات المجلد</translation>
    </message>
</context>
<context>
    <name>show.choose-another-log-folder</name>
    <message>
        <source>choose another folder with --log</source>
        <translation>اختر مجلدًا آخر باستخدام ⁨--log⁩</translation>
    </message>
</context>
<context>
    <name>show.engine-lost-device</name>
    <message>
        <source>the engine lost its graphics card</source>
        <translation>فقد المحرك جهازه</translation>
    </message>
</context>
<context>
    <name>show.no-camera</name>
    <message>
        <source>this show has no camera: its calibration names none</source>
        <translation>ليس لهذا العرض كاميرا: معايرته لا تذكر أي كاميرا</translation>
    </message>
</context>
<context>
    <name>show.no-xwayland</name>
    <message>
        <source>in a Wayland session, take QT_QPA_PLATFORM=xcb out of the environment; else take away the desktop&apos;s rules for windows of Relucent, then try again</source>
        <translation>في جلسة Wayland أزل QT_QPA_PLATFORM=xcb من البيئة؛ وإلا فأزل قواعد سطح المكتب لنوافذ Relucent، ثم حاول مجددًا</translation>
    </message>
</context>
<context>
    <name>show.projector-by-command</name>
    <message>
        <source>this calibration shows pictures by a command of its own, which does not know of the show: stop the show and use relucent-cli verify and perfect</source>
        <translation>هذه المعايرة تعرض الصور بأمر خاص بها لا يعرف بأمر العرض: أوقف العرض واستخدم relucent-cli verify و perfect</translation>
    </message>
</context>
<context>
    <name>show.restore-resolution</name>
    <message>
        <source>set its resolution back in the desktop&apos;s settings, then try again</source>
        <translation>أعد دقة الشاشة إلى ما كانت عليه في إعدادات سطح المكتب، ثم حاول مجددًا</translation>
    </message>
</context>
<context>
    <name>show.screen-asleep</name>
    <message>
        <source>the projector&apos;s screen is asleep and does not wake</source>
        <translation>شاشة جهاز العرض في وضع السكون ولا تستيقظ</translation>
    </message>
</context>
<context>
    <name>show.screen-size-changed</name>
    <message>
        <source>the projector&apos;s screen has {} pixels now and {} were calibrated</source>
        <translation>حجم شاشة جهاز العرض الآن ⁨{}⁩ بكسل، وكان عند المعايرة ⁨{}⁩</translation>
    </message>
</context>
<context>
    <name>show.start-show-again</name>
    <message>
        <source>start the show again</source>
        <translation>ابدأ العرض من جديد</translation>
    </message>
</context>
<context>
    <name>show.switch-off-power-saving</name>
    <message>
        <source>switch off its power saving and the screen saver in the desktop&apos;s settings, then try again</source>
        <translation>أوقف توفير الطاقة للشاشة وشاشة التوقف في إعدادات سطح المكتب، ثم حاول مجددًا</translation>
    </message>
</context>
<context>
    <name>show.window-elsewhere</name>
    <message>
        <source>the desktop puts the projector&apos;s picture on the screen {} instead</source>
        <translation>يضع سطح المكتب صورة جهاز العرض على الشاشة {} بدلاً من ذلك</translation>
    </message>
</context>
<context>
    <name>stage.adapting-light-transport</name>
    <message>
        <source>fitting the light transport to what is seen</source>
        <translation>مواءمة نقل الضوء مع ما يُرى</translation>
    </message>
</context>
<context>
    <name>stage.algorithm-1</name>
    <message>
        <source>Algorithm 1</source>
        <translation>الخوارزمية 1</translation>
    </message>
</context>
<context>
    <name>stage.assembling-light-transport</name>
    <message>
        <source>Assembling the light transport</source>
        <translation>تركيب نقل الضوء</translation>
    </message>
</context>
<context>
    <name>stage.awaiting-steady-light</name>
    <message>
        <source>Waiting until the lamps are steady</source>
        <translation>انتظار استقرار المصابيح</translation>
    </message>
</context>
<context>
    <name>stage.black-and-full-light</name>
    <message>
        <source>black and full light</source>
        <translation>الأسود والإضاءة الكاملة</translation>
    </message>
</context>
<context>
    <name>stage.calibrating</name>
    <message>
        <source>Calibrating</source>
        <translation>المعايرة</translation>
    </message>
</context>
<context>
    <name>stage.capped-clusters</name>
    <message>
        <source>Clusters held to a size</source>
        <translation>تجمّعات مقيّدة الحجم</translation>
    </message>
</context>
<context>
    <name>stage.capping-clusters</name>
    <message>
        <source>Holding clusters to a size</source>
        <translation>تقييد حجم التجمّعات</translation>
    </message>
</context>
<context>
    <name>stage.checking-additivity</name>
    <message>
        <source>Checking that the colours of {} add up</source>
        <translation>التحقق من جمعية ألوان {}</translation>
    </message>
</context>
<context>
    <name>stage.checking-drift</name>
    <message>
        <source>Checking for drift</source>
        <translation>فحص الانحراف</translation>
    </message>
</context>
<context>
    <name>stage.checking-projector-and-camera</name>
    <message>
        <source>Checking projector and camera</source>
        <translation>فحص جهاز العرض والكاميرا</translation>
    </message>
</context>
<context>
    <name>stage.choosing-camera-pixels</name>
    <message>
        <source>Finding the camera pixels that are needed</source>
        <translation>البحث عن بكسلات الكاميرا اللازمة</translation>
    </message>
</context>
<context>
    <name>stage.clustering-light-transport</name>
    <message>
        <source>Clustering the light transport</source>
        <translation>تقسيم نقل الضوء إلى تجمّعات</translation>
    </message>
</context>
<context>
    <name>stage.comparing-cluster-inverses-in-venue</name>
    <message>
        <source>Comparing the inverses of clusters in {}</source>
        <translation>مقارنة معكوسات التجمّعات في {}</translation>
    </message>
</context>
<context>
    <name>stage.comparing-methods</name>
    <message>
        <source>Comparing the methods</source>
        <translation>مقارنة الطرق</translation>
    </message>
</context>
<context>
    <name>stage.comparing-methods-in-venue</name>
    <message>
        <source>Comparing the methods in {}</source>
        <translation>مقارنة الطرق في {}</translation>
    </message>
</context>
<context>
    <name>stage.comparing-views</name>
    <message>
        <source>Comparing what the views want</source>
        <translation>مقارنة ما تطلبه المشاهد</translation>
    </message>
</context>
<context>
    <name>stage.compensating</name>
    <message>
        <source>Compensating</source>
        <translation>التعويض</translation>
    </message>
</context>
<context>
    <name>stage.concluding-measurement</name>
    <message>
        <source>what may be expected of the result</source>
        <translation>ما يُتوقّع من النتيجة</translation>
    </message>
</context>
<context>
    <name>stage.decoding</name>
    <message>
        <source>Decoding</source>
        <translation>فك الترميز</translation>
    </message>
</context>
<context>
    <name>stage.dense-patterns</name>
    <message>
        <source>patterns in blocks of {} px</source>
        <translation>أنماط في كتل من ⁨{}⁩ بكسل</translation>
    </message>
</context>
<context>
    <name>stage.estimating-light-transport</name>
    <message>
        <source>Estimating the light transport</source>
        <translation>تقدير نقل الضوء</translation>
    </message>
</context>
<context>
    <name>stage.estimating-response-and-colours</name>
    <message>
        <source>Estimating response and colours</source>
        <translation>تقدير الاستجابة والألوان</translation>
    </message>
</context>
<context>
    <name>stage.evaluating</name>
    <message>
        <source>Evaluating</source>
        <translation>التقييم</translation>
    </message>
</context>
<context>
    <name>stage.finding-defocus</name>
    <message>
        <source>Finding the defocus</source>
        <translation>تقدير الخروج عن البؤرة</translation>
    </message>
</context>
<context>
    <name>stage.finding-exposure</name>
    <message>
        <source>Finding the exposure</source>
        <translation>تحديد التعريض</translation>
    </message>
</context>
<context>
    <name>stage.finding-exposures</name>
    <message>
        <source>Finding the exposures</source>
        <translation>تحديد التعريضات</translation>
    </message>
</context>
<context>
    <name>stage.finding-projector-picture</name>
    <message>
        <source>Looking for the projector&apos;s picture</source>
        <translation>البحث عن صورة جهاز العرض</translation>
    </message>
</context>
<context>
    <name>stage.finding-shadows</name>
    <message>
        <source>Looking for shadows</source>
        <translation>البحث عن الظلال</translation>
    </message>
</context>
<context>
    <name>stage.finding-uncorrectable-pixels</name>
    <message>
        <source>Looking for what cannot be corrected</source>
        <translation>البحث عمّا يتعذّر تصحيحه</translation>
    </message>
</context>
<context>
    <name>stage.finding-what-is-seen</name>
    <message>
        <source>Finding which part of the picture is seen</source>
        <translation>تحديد الجزء المرئي من الصورة</translation>
    </message>
</context>
<context>
    <name>stage.fitting-light-spread</name>
    <message>
        <source>Fitting the spread of light</source>
        <translation>نمذجة انتشار الضوء</translation>
    </message>
</context>
<context>
    <name>stage.forming-patches</name>
    <message>
        <source>Forming patches</source>
        <translation>تكوين الرقع</translation>
    </message>
</context>
<context>
    <name>stage.inverting-clusters</name>
    <message>
        <source>Inverting the clusters</source>
        <translation>حساب معكوسات التجمّعات</translation>
    </message>
</context>
<context>
    <name>stage.inverting-light-transport</name>
    <message>
        <source>Inverting the light transport</source>
        <translation>حساب معكوس نقل الضوء</translation>
    </message>
</context>
<context>
    <name>stage.inverting-venue</name>
    <message>
        <source>Inverting {}</source>
        <translation>حساب معكوس {}</translation>
    </message>
</context>
<context>
    <name>stage.joining-clusters</name>
    <message>
        <source>Joining clusters</source>
        <translation>ضم التجمّعات</translation>
    </message>
</context>
<context>
    <name>stage.judging-light</name>
    <message>
        <source>Judging the light</source>
        <translation>تقييم الإضاءة</translation>
    </message>
</context>
<context>
    <name>stage.level-of-tree</name>
    <message numerus="yes">
        <source>level {} of {}: {} patterns</source>
        <comment>level {} of {}: {} pattern</comment>
        <translation>
            <numerusform>المستوى {0} من {1}: لا أنماط</numerusform>
            <numerusform>المستوى {0} من {1}: نمط واحد</numerusform>
            <numerusform>المستوى {0} من {1}: نمطان</numerusform>
            <numerusform>المستوى {} من {}: {} أنماط</numerusform>
            <numerusform>المستوى {} من {}: {} نمطًا</numerusform>
            <numerusform>المستوى {} من {}: {} نمط</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>stage.light-transport</name>
    <message>
        <source>light transport</source>
        <translation>نقل الضوء</translation>
    </message>
</context>
<context>
    <name>stage.linearizing</name>
    <message>
        <source>Linearizing</source>
        <translation>جعل الاستجابة خطية</translation>
    </message>
</context>
<context>
    <name>stage.looking-for-changes</name>
    <message>
        <source>Looking for what has changed</source>
        <translation>البحث عمّا تغيّر</translation>
    </message>
</context>
<context>
    <name>stage.looking-for-hot-pixels</name>
    <message>
        <source>Looking for hot pixels of the camera</source>
        <translation>البحث عن البكسلات الساخنة في الكاميرا</translation>
    </message>
</context>
<context>
    <name>stage.looking-through-camera</name>
    <message>
        <source>Looking through the camera</source>
        <translation>مشاهدة صورة الكاميرا</translation>
    </message>
</context>
<context>
    <name>stage.measuring-brightness-curves</name>
    <message>
        <source>Measuring the brightness curves of {}</source>
        <translation>قياس منحنيات سطوع {}</translation>
    </message>
</context>
<context>
    <name>stage.measuring-camera</name>
    <message>
        <source>Measuring the camera</source>
        <translation>قياس الكاميرا</translation>
    </message>
</context>
<context>
    <name>stage.measuring-latency</name>
    <message>
        <source>Measuring the latency</source>
        <translation>قياس زمن التأخير</translation>
    </message>
</context>
<context>
    <name>stage.measuring-light-transport</name>
    <message>
        <source>Measuring the light transport</source>
        <translation>قياس نقل الضوء</translation>
    </message>
</context>
<context>
    <name>stage.measuring-response</name>
    <message>
        <source>Measuring the response</source>
        <translation>قياس الاستجابة</translation>
    </message>
</context>
<context>
    <name>stage.measuring-venue</name>
    <message>
        <source>Measuring {}</source>
        <translation>قياس {}</translation>
    </message>
</context>
<context>
    <name>stage.measuring-what-changed</name>
    <message>
        <source>measuring what is no longer as it was</source>
        <translation>قياس ما لم يعد كما كان</translation>
    </message>
</context>
<context>
    <name>stage.opening-devices</name>
    <message>
        <source>Opening the devices</source>
        <translation>فتح الأجهزة</translation>
    </message>
</context>
<context>
    <name>stage.perfecting</name>
    <message>
        <source>Correcting the picture by photographs of itself</source>
        <translation>تصحيح الصورة بصور لها</translation>
    </message>
</context>
<context>
    <name>stage.photographing-projections</name>
    <message>
        <source>Photographing the projections</source>
        <translation>تصوير الصور المعروضة</translation>
    </message>
</context>
<context>
    <name>stage.photographing-test-patterns</name>
    <message>
        <source>Photographing test patterns</source>
        <translation>تصوير أنماط الاختبار</translation>
    </message>
</context>
<context>
    <name>stage.predicting-held-out-patterns</name>
    <message>
        <source>Predicting held-out patterns</source>
        <translation>توقّع الأنماط المحجوزة للاختبار</translation>
    </message>
</context>
<context>
    <name>stage.preparing-benchmarks</name>
    <message>
        <source>Preparing the benchmarks</source>
        <translation>تحضير اختبارات الأداء</translation>
    </message>
</context>
<context>
    <name>stage.preparing-devices</name>
    <message>
        <source>Preparing the devices</source>
        <translation>تحضير الأجهزة</translation>
    </message>
</context>
<context>
    <name>stage.preparing-engine</name>
    <message>
        <source>Preparing the engine</source>
        <translation>تحضير المحرك</translation>
    </message>
</context>
<context>
    <name>stage.preparing-preview</name>
    <message>
        <source>Preparing the preview</source>
        <translation>تحضير المعاينة</translation>
    </message>
</context>
<context>
    <name>stage.preparing-venue</name>
    <message>
        <source>Preparing the venue</source>
        <translation>تحضير الموقع</translation>
    </message>
</context>
<context>
    <name>stage.reading-calibration</name>
    <message>
        <source>Reading the calibration</source>
        <translation>قراءة المعايرة</translation>
    </message>
</context>
<context>
    <name>stage.reading-light-transport</name>
    <message>
        <source>Reading the light transport</source>
        <translation>قراءة نقل الضوء</translation>
    </message>
</context>
<context>
    <name>stage.reading-patterns</name>
    <message>
        <source>Reading the patterns</source>
        <translation>قراءة الأنماط</translation>
    </message>
</context>
<context>
    <name>stage.reading-photographs</name>
    <message>
        <source>Reading the photographs</source>
        <translation>قراءة اللقطات</translation>
    </message>
</context>
<context>
    <name>stage.reading-pictures</name>
    <message>
        <source>Reading the pictures</source>
        <translation>قراءة الصور</translation>
    </message>
</context>
<context>
    <name>stage.reading-response</name>
    <message>
        <source>Reading the response</source>
        <translation>قراءة الاستجابة</translation>
    </message>
</context>
<context>
    <name>stage.reading-venue</name>
    <message>
        <source>Reading {}</source>
        <translation>قراءة {}</translation>
    </message>
</context>
<context>
    <name>stage.remeasuring-flagged-pixels</name>
    <message numerus="yes">
        <source>measuring {} flagged pixels again</source>
        <comment>measuring {} flagged pixel again</comment>
        <translation>
            <numerusform>إعادة قياس: لا بكسلات معلّمة</numerusform>
            <numerusform>إعادة قياس بكسل معلّم واحد</numerusform>
            <numerusform>إعادة قياس بكسلين معلّمين</numerusform>
            <numerusform>إعادة قياس {} بكسلات معلّمة</numerusform>
            <numerusform>إعادة قياس {} بكسلًا معلّمًا</numerusform>
            <numerusform>إعادة قياس {} بكسل معلّم</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>stage.scaling-to-flood-image</name>
    <message>
        <source>Scaling to the flood image</source>
        <translation>الضبط على صورة الإضاءة الكاملة</translation>
    </message>
</context>
<context>
    <name>stage.separating-direct-and-indirect-light</name>
    <message>
        <source>Separating direct and indirect light</source>
        <translation>فصل الضوء المباشر عن غير المباشر</translation>
    </message>
</context>
<context>
    <name>stage.sharing-leaves</name>
    <message>
        <source>light that neighbouring pixels share</source>
        <translation>الضوء المشترك بين البكسلات المتجاورة</translation>
    </message>
</context>
<context>
    <name>stage.sharpening</name>
    <message>
        <source>Sharpening</source>
        <translation>زيادة الحدّة</translation>
    </message>
</context>
<context>
    <name>stage.solving</name>
    <message>
        <source>Solving</source>
        <translation>إيجاد الحل</translation>
    </message>
</context>
<context>
    <name>stage.storing-light-transport</name>
    <message>
        <source>storing the light transport</source>
        <translation>حفظ نقل الضوء</translation>
    </message>
</context>
<context>
    <name>stage.switching-projectors-on</name>
    <message>
        <source>Switching the projectors on</source>
        <translation>تشغيل أجهزة العرض</translation>
    </message>
</context>
<context>
    <name>stage.taking-verification-photograph</name>
    <message>
        <source>Taking the verification photograph</source>
        <translation>التقاط لقطة التحقق</translation>
    </message>
</context>
<context>
    <name>stage.test-patterns</name>
    <message>
        <source>test patterns</source>
        <translation>أنماط الاختبار</translation>
    </message>
</context>
<context>
    <name>stage.timing-engine</name>
    <message>
        <source>Timing the engine</source>
        <translation>قياس سرعة المحرك</translation>
    </message>
</context>
<context>
    <name>stage.tracing-simulated-venue</name>
    <message>
        <source>tracing the simulated venue</source>
        <translation>تتبّع ضوء الموقع المحاكى</translation>
    </message>
</context>
<context>
    <name>stage.windows</name>
    <message>
        <source>Computing the windows of the inverse</source>
        <translation>النوافذ</translation>
    </message>
</context>
<context>
    <name>stage.working-out-finest-blocks</name>
    <message>
        <source>working out the finest blocks</source>
        <translation>حساب أدقّ الكتل</translation>
    </message>
</context>
<context>
    <name>stage.writing</name>
    <message>
        <source>Writing</source>
        <translation>الكتابة</translation>
    </message>
</context>
<context>
    <name>stage.writing-out-light-transport</name>
    <message>
        <source>Writing out the light transport</source>
        <translation>كتابة نقل الضوء كاملًا</translation>
    </message>
</context>
<context>
    <name>stage.writing-report</name>
    <message>
        <source>Writing the report</source>
        <translation>كتابة التقرير</translation>
    </message>
</context>
<context>
    <name>stage.writing-results</name>
    <message>
        <source>Writing the results</source>
        <translation>كتابة النتائج</translation>
    </message>
</context>
<context>
    <name>stream.address-incomplete</name>
    <message>
        <source>in a stream&apos;s address the host or its port is missing or wrong</source>
        <translation>في عنوان البث ينقص المضيف أو المنفذ أو أحدهما خاطئ</translation>
    </message>
</context>
<context>
    <name>stream.check-host</name>
    <message>
        <source>check the name in the address, or write the number</source>
        <translation>تحقق من الاسم في العنوان، أو اكتب الرقم</translation>
    </message>
</context>
<context>
    <name>stream.check-network</name>
    <message>
        <source>check the network and the address</source>
        <translation>تحقق من الشبكة والعنوان</translation>
    </message>
</context>
<context>
    <name>stream.check-path</name>
    <message>
        <source>check what stands behind the host in the address</source>
        <translation>تحقق مما يلي المضيف في العنوان</translation>
    </message>
</context>
<context>
    <name>stream.check-sender</name>
    <message>
        <source>check the sender, the network, and the address</source>
        <translation>تحقق من المرسل والشبكة والعنوان</translation>
    </message>
</context>
<context>
    <name>stream.end-other</name>
    <message>
        <source>end that program, or send to another port</source>
        <translation>أنهِ ذلك البرنامج، أو أرسل إلى منفذ آخر</translation>
    </message>
</context>
<context>
    <name>stream.ended</name>
    <message>
        <source>it has ended</source>
        <translation>لقد انتهى</translation>
    </message>
</context>
<context>
    <name>stream.host-unknown</name>
    <message>
        <source>its host is not found</source>
        <translation>لم يُعثر على مضيفه</translation>
    </message>
</context>
<context>
    <name>stream.list-once</name>
    <message>
        <source>put it into the playlist once</source>
        <translation>ضعه في قائمة التشغيل مرة واحدة</translation>
    </message>
</context>
<context>
    <name>stream.no-memory</name>
    <message>
        <source>there is not enough memory for its pictures</source>
        <translation>لا توجد ذاكرة كافية لصوره</translation>
    </message>
</context>
<context>
    <name>stream.no-such-path</name>
    <message>
        <source>there is nothing at its path</source>
        <translation>لا يوجد شيء في مساره</translation>
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
        <translation>لم يعطِ أي صورة بعد</translation>
    </message>
</context>
<context>
    <name>stream.open-already</name>
    <message>
        <source>this program plays it already</source>
        <translation>هذا البرنامج يعرضه بالفعل</translation>
    </message>
</context>
<context>
    <name>stream.port-in-use</name>
    <message>
        <source>another program receives at its port</source>
        <translation>برنامج آخر يستقبل على منفذه</translation>
    </message>
</context>
<context>
    <name>stream.refused</name>
    <message>
        <source>the connection was refused</source>
        <translation>رُفض الاتصال</translation>
    </message>
</context>
<context>
    <name>stream.send-h264</name>
    <message>
        <source>let it be sent as H.264 or Motion JPEG</source>
        <translation>اجعله يُرسل بصيغة H.264 أو Motion JPEG</translation>
    </message>
</context>
<context>
    <name>stream.silent</name>
    <message>
        <source>no picture came within {} s</source>
        <translation>لم تصل أي صورة خلال {} ث</translation>
    </message>
</context>
<context>
    <name>stream.stalled</name>
    <message>
        <source>no picture has come for {} s</source>
        <translation>لم تصل أي صورة منذ {} ث</translation>
    </message>
</context>
<context>
    <name>stream.start-sender</name>
    <message>
        <source>start the sender, and check the port</source>
        <translation>شغّل المرسل وتحقق من المنفذ</translation>
    </message>
</context>
<context>
    <name>stream.start-sender-again</name>
    <message>
        <source>start the sender again</source>
        <translation>شغّل المرسل من جديد</translation>
    </message>
</context>
<context>
    <name>stream.unknown-hold</name>
    <message>
        <source>the stream&apos;s address ends in an unknown choice</source>
        <translation>ينتهي عنوان البث بخيار غير معروف</translation>
    </message>
</context>
<context>
    <name>stream.unknown-scheme</name>
    <message>
        <source>this is no address of a stream</source>
        <translation>هذا ليس عنوان بث</translation>
    </message>
</context>
<context>
    <name>stream.unreachable</name>
    <message>
        <source>its host cannot be reached</source>
        <translation>لا يمكن الوصول إلى مضيفه</translation>
    </message>
</context>
<context>
    <name>stream.unreadable</name>
    <message>
        <source>it cannot be read ({})</source>
        <translation>تتعذر قراءته ({})</translation>
    </message>
</context>
<context>
    <name>stream.unusable</name>
    <message>
        <source>what comes is no video that can be shown</source>
        <translation>ما يصل ليس فيديو يمكن عرضه</translation>
    </message>
</context>
<context>
    <name>stream.wants-password</name>
    <message>
        <source>it wants another user name and password</source>
        <translation>يطلب اسم مستخدم وكلمة مرور آخرين</translation>
    </message>
</context>
<context>
    <name>stream.write-address</name>
    <message>
        <source>write it like {}, and in user names and passwords % and two digits for signs like @, : and /</source>
        <translation>اكتبه مثل {}، وفي أسماء المستخدمين وكلمات المرور اكتب % ورقمين بدل علامات مثل @ و : و /</translation>
    </message>
</context>
<context>
    <name>stream.write-hold</name>
    <message>
        <source>write #hold=last or #hold=black</source>
        <translation>اكتب #hold=last أو #hold=black</translation>
    </message>
</context>
<context>
    <name>stream.write-password</name>
    <message>
        <source>write them into the address before the host: {}</source>
        <translation>اكتبهما في العنوان قبل المضيف: {}</translation>
    </message>
</context>
<context>
    <name>stream.write-scheme</name>
    <message>
        <source>let it begin with one of {}</source>
        <translation>اجعله يبدأ بأحد هذه: {}</translation>
    </message>
</context>
<context>
    <name>venue.cannot-open-folder</name>
    <message>
        <source>the folder cannot be opened ({})</source>
        <translation>لا يمكن فتح المجلد ({})</translation>
    </message>
</context>
<context>
    <name>venue.cannot-rename</name>
    <message>
        <source>the folder cannot be renamed ({})</source>
        <translation>لا يمكن إعادة تسمية المجلد ({})</translation>
    </message>
</context>
<context>
    <name>venue.no-trash</name>
    <message>
        <source>it cannot be moved to the trash</source>
        <translation>لا يمكن نقله إلى سلة المهملات</translation>
    </message>
</context>
<context>
    <name>venue.remove-folder-yourself</name>
    <message>
        <source>this disk may have none: remove the folder with the file manager</source>
        <translation>قد لا توجد سلة مهملات لهذا القرص: أزل المجلد بمدير الملفات</translation>
    </message>
</context>
<context>
    <name>venue.used-by-another</name>
    <message>
        <source>another program is working on this venue</source>
        <translation>يعمل برنامج آخر على هذا الموقع</translation>
    </message>
</context>
<context>
    <name>venue.wait-for-another</name>
    <message>
        <source>wait until it has finished, or close it, then try again</source>
        <translation>انتظر حتى ينتهي أو أغلقه، ثم أعد المحاولة</translation>
    </message>
</context>
<context>
    <name>view.cannot-write-picture</name>
    <message>
        <source>the picture could not be written</source>
        <translation>تعذّرت كتابة الصورة</translation>
    </message>
</context>
<context>
    <name>view.choose-writable-folder</name>
    <message>
        <source>choose a folder that you may write to, with free space</source>
        <translation>اختر مجلدًا يمكنك الكتابة فيه، وفيه مساحة كافية</translation>
    </message>
</context>
<context>
    <name>wizard.allow-commands</name>
    <message>
        <source>open the venue anew and allow its programs</source>
        <translation>افتح الموقع من جديد واسمح ببرامجه</translation>
    </message>
</context>
</TS>
