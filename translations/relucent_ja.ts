<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="ja">
<context>
    <name>About</name>
    <message>
        <source>About Relucent</source>
        <translation>Relucent について</translation>
    </message>
    <message>
        <source>Version %1, with these libraries: %2.</source>
        <translation>バージョン %1。使用ライブラリ：%2。</translation>
    </message>
</context>
<context>
    <name>ContentFiles</name>
    <message>
        <source>Pictures and films</source>
        <translation>画像と動画</translation>
    </message>
    <message>
        <source>Pictures</source>
        <translation>画像</translation>
    </message>
    <message>
        <source>All files</source>
        <translation>すべてのファイル</translation>
    </message>
</context>
<context>
    <name>DeviceLabel</name>
    <message>
        <source>Projector %1</source>
        <translation>プロジェクター %1</translation>
    </message>
    <message>
        <source>Camera %1</source>
        <translation>カメラ %1</translation>
    </message>
</context>
<context>
    <name>EndQuestion</name>
    <message>
        <source>A measurement is under way</source>
        <translation>測定中です</translation>
    </message>
    <message>
        <source>%1 in the venue “%2”.</source>
        <translation>会場「%2」の%1。</translation>
    </message>
    <message>
        <source>Every photograph is on the disk. Opened again, the venue goes on from there.</source>
        <translation>写真はすべてディスクにあります。会場を開き直すと、続きから再開できます。</translation>
    </message>
    <message>
        <source>End it for now</source>
        <translation>ひとまず終了</translation>
    </message>
    <message>
        <source>Go on measuring</source>
        <translation>測定を続ける</translation>
    </message>
    <message>
        <source>The show of the venue “%1”: the projector&apos;s screen goes dark.</source>
        <translation>会場「%1」のショー：プロジェクターの画面が暗くなります。</translation>
    </message>
    <message>
        <source>Playlist and results are on the disk. Open the output again to play the show again.</source>
        <translation>再生リストと結果はディスクにあります。出力を開き直すと、ショーをまた再生できます。</translation>
    </message>
    <message>
        <source>A measurement and a show are under way</source>
        <translation>測定とショーが進行中です</translation>
    </message>
    <message>
        <source>End both</source>
        <translation>両方を終了</translation>
    </message>
    <message>
        <source>Let both go on</source>
        <translation>両方を続ける</translation>
    </message>
    <message>
        <source>A show is playing</source>
        <translation>ショーを再生中です</translation>
    </message>
    <message>
        <source>End the show</source>
        <translation>ショーを終了</translation>
    </message>
    <message>
        <source>Go on playing</source>
        <translation>再生を続ける</translation>
    </message>
    <message>
        <source>The show of the venue “%1”.</source>
        <translation>会場「%1」の上映。</translation>
    </message>
</context>
<context>
    <name>Failure</name>
    <message>
        <source>The computer has no memory left.</source>
        <translation>コンピューターのメモリが不足しています。</translation>
    </message>
    <message>
        <source>Close other programs, or choose fewer pixels.</source>
        <translation>ほかのプログラムを終了するか、画素数を減らしてください。</translation>
    </message>
    <message>
        <source>Relucent made a mistake.</source>
        <translation>Relucent の内部エラーです。</translation>
    </message>
    <message>
        <source>What is saved is safe. Copy the details for whoever looks after the program, then try again.</source>
        <translation>保存済みのデータは無事です。詳細をコピーしてプログラムの管理担当者に渡し、もう一度試してください。</translation>
    </message>
    <message>
        <source>What is saved is safe. Try again.</source>
        <translation>保存済みのデータは無事です。再試行してください。</translation>
    </message>
    <message>
        <source>The camera does not see this projector</source>
        <translation>カメラにこのプロジェクターが見えません</translation>
    </message>
    <message>
        <source>A program of this venue failed</source>
        <translation>この会場のプログラムが失敗しました</translation>
    </message>
    <message>
        <source>Another command is typed at the step Venue, by “Change the programs”.</source>
        <translation>別のコマンドは、手順「会場」の「プログラムを変更」で入力します。</translation>
    </message>
</context>
<context>
    <name>FullDisk</name>
    <message>
        <source>The disk is full. Measuring has paused.</source>
        <translation>ディスクがいっぱいです。測定を一時停止しました。</translation>
    </message>
    <message>
        <source>Every photograph is safe. %1 are free, %2 are needed: then measuring goes on by itself.</source>
        <translation>写真はすべて無事です。空きは %1、必要なのは %2 です。空きができると、測定は自動的に再開します。</translation>
    </message>
</context>
<context>
    <name>LostDevice</name>
    <message>
        <source>The projector&apos;s screen is unplugged</source>
        <translation>プロジェクターの画面が外れています</translation>
    </message>
    <message>
        <source>Everything so far is safe. Plug it in again: it goes on by itself.</source>
        <translation>これまでのものはすべて無事です。接続し直すと、自動的に再開します。</translation>
    </message>
    <message>
        <source>Everything so far is safe. Push in its cable at both ends, and do not move the tripod: it goes on by itself.</source>
        <translation>これまでのものはすべて無事です。ケーブルを両端で押し込み、三脚は動かさないでください。自動的に再開します。</translation>
    </message>
    <message>
        <source>The camera does not answer</source>
        <translation>カメラが応答しません</translation>
    </message>
    <message>
        <source>Screen unplugged</source>
        <translation>画面が未接続</translation>
    </message>
    <message>
        <source>Camera silent</source>
        <translation>カメラ応答なし</translation>
    </message>
    <message>
        <source>%1: its screen is unplugged</source>
        <extracomment>%1 is a projector: its name, or &quot;Projector 2&quot;</extracomment>
        <translation>%1：画面が外れています</translation>
    </message>
    <message>
        <source>%1 does not answer</source>
        <extracomment>%1 is a camera: its name, or &quot;Camera 2&quot;</extracomment>
        <translation>%1が応答しません</translation>
    </message>
    <message>
        <source>Everything so far is safe. Plug it in again, then resume.</source>
        <translation>これまでのものはすべて無事です。接続し直してから再開してください。</translation>
    </message>
    <message>
        <source>Everything so far is safe. Push in its cable at both ends, and do not move the tripod, then resume.</source>
        <translation>これまでのものはすべて無事です。ケーブルを両端で押し込み、三脚は動かさずに、再開してください。</translation>
    </message>
</context>
<context>
    <name>Method</name>
    <message>
        <source>Each pixel&apos;s brightness</source>
        <translation>画素ごとの明るさ</translation>
    </message>
    <message>
        <source>Each pixel on its own</source>
        <translation>画素ごとに独立</translation>
    </message>
    <message>
        <source>Each pixel, sharpened</source>
        <translation>画素ごと＋鮮鋭化</translation>
    </message>
    <message>
        <source>Clusters</source>
        <translation>クラスター</translation>
    </message>
    <message>
        <source>Windows</source>
        <translation>局所窓</translation>
    </message>
    <message>
        <source>All bounces, for films</source>
        <translation>相互反射すべて、動画用</translation>
    </message>
    <message>
        <source>Uncorrected</source>
        <translation>補正なし</translation>
    </message>
    <message>
        <source>All bounces, solved, for stills</source>
        <translation>相互反射を完全計算、静止画</translation>
    </message>
</context>
<context>
    <name>NumberText</name>
    <message>
        <source>%1 million</source>
        <translation>%1 百万</translation>
    </message>
    <message>
        <source>%1 billion</source>
        <translation>%1 十億</translation>
    </message>
</context>
<context>
    <name>Overlay</name>
    <message>
        <source>%1 frames a second, %2 ms a frame, %3 of %4 late</source>
        <translation>毎秒 %1 フレーム、%2 ms/フレーム、遅延 %3/%4</translation>
    </message>
    <message>
        <source>not compensated</source>
        <translation>補正なし</translation>
    </message>
    <message>
        <source>frozen</source>
        <translation>静止中</translation>
    </message>
    <message>
        <source>test chart: %1</source>
        <translation>テストチャート：%1</translation>
    </message>
    <message numerus="yes">
        <source>compensated, %n step(s), %1 % out of reach</source>
        <translation>
            <numerusform>補正あり、反復 %n 回、再現不可 %1 %</numerusform>
        </translation>
    </message>
    <message>
        <source>still picture</source>
        <translation>静止画</translation>
    </message>
    <message>
        <source>follows a viewer within %1 ms</source>
        <translation>観客に %1 ms 以内で追従</translation>
    </message>
    <message>
        <source>perfected by photographs</source>
        <translation>写真により仕上げ済み</translation>
    </message>
    <message>
        <source>live picture within %1 ms of its arrival</source>
        <translation>ライブ映像は到着から %1 ms 以内</translation>
    </message>
</context>
<context>
    <name>RecentVenues</name>
    <message>
        <source>Nothing measured yet</source>
        <translation>未測定</translation>
    </message>
    <message>
        <source>Acquire is next</source>
        <translation>次は光輸送測定</translation>
    </message>
    <message>
        <source>Ready to play</source>
        <translation>再生できます</translation>
    </message>
    <message>
        <source>Preview out of date</source>
        <translation>プレビューは要更新</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>測定済み</translation>
    </message>
    <message numerus="yes">
        <source>Interrupted: %n pattern(s) are safe</source>
        <translation>
            <numerusform>中断：%n パターンは保存済み</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Measured; %n newer pattern(s) are safe</source>
        <translation>
            <numerusform>測定済み、新しい %n パターンは保存済み</numerusform>
        </translation>
    </message>
    <message>
        <source>Ended by a change</source>
        <translation>変化により終了</translation>
    </message>
    <message>
        <source>Stopped at blocks of %1 px</source>
        <translation>%1 px のブロックで停止</translation>
    </message>
    <message>
        <source>Stopped at %1 px; newer patterns: %2</source>
        <translation>%1 px で停止、新しいパターン：%2</translation>
    </message>
    <message>
        <source>A show plays</source>
        <translation>ショーを再生中</translation>
    </message>
</context>
<context>
    <name>ScreenChoice</name>
    <message>
        <source>This computer</source>
        <translation>このコンピューター</translation>
    </message>
    <message>
        <source>%1, %2 × %3, %4 Hz</source>
        <translation>%1、%2 × %3、%4 Hz</translation>
    </message>
    <message>
        <source>There is no other screen: the patterns cover this window while they are shown. Plug the projector in, and switch the desktop to extended screens, to keep both apart.</source>
        <translation>ほかの画面がないため、パターンの表示中はこのウィンドウが隠れます。別々に表示するには、プロジェクターを接続し、デスクトップを拡張表示に切り替えてください。</translation>
    </message>
    <message>
        <source>This is the screen that you work on. Choose the projector&apos;s.</source>
        <translation>これは作業に使っている画面です。プロジェクターの画面を選んでください。</translation>
    </message>
    <message>
        <source>The projector was measured with %1 pixels. Set this screen to that size.</source>
        <translation>プロジェクターは %1 ピクセルで測定されました。この画面をその大きさに設定してください。</translation>
    </message>
    <message>
        <source>This is another projector than the one that was measured. Its light and its place differ: take a verification photograph, and measure again where that does not look as predicted.</source>
        <translation>測定したものとは別のプロジェクターです。光も位置も違います。検証写真を撮り、予測どおりでなければ測定し直してください。</translation>
    </message>
    <message>
        <source>Measured at %1, used at %2. If it is the same projector in the same place, everything that was measured holds; a verification photograph tells.</source>
        <translation>%1 で測定し、%2 で使用します。同じ場所の同じプロジェクターなら測定結果はすべて有効です。検証写真で確かめられます。</translation>
    </message>
</context>
<context>
    <name>StoppedEarly</name>
    <message>
        <source>Measuring was stopped at blocks of %1 px</source>
        <translation>測定は %1 px のブロックで終了しました</translation>
    </message>
    <message>
        <source>All that follows is as coarse. Go on measuring any time.</source>
        <translation>以降の結果も同じだけ粗くなります。測定はいつでも続けられます。</translation>
    </message>
    <message>
        <source>Go on at Acquire</source>
        <translation>「光輸送測定」で続ける</translation>
    </message>
    <message>
        <source>What was measured does not fit together</source>
        <translation>測定結果がかみ合っていません</translation>
    </message>
    <message>
        <source>Corrected pictures are expected at %1: that is no better than uncorrected. Measure again.</source>
        <translation>補正した映像の見込みは %1 で、補正しない場合と変わりません。測定し直してください。</translation>
    </message>
    <message>
        <source>%1 dB</source>
        <translation>%1 dB</translation>
    </message>
    <message>
        <source>Go to Acquire</source>
        <translation>「光輸送測定」へ</translation>
    </message>
    <message>
        <source>Measuring ended because something had changed</source>
        <translation>何かが変わったため、測定は終わりました</translation>
    </message>
    <message>
        <source>What follows is of before. See at Acquire what helps.</source>
        <translation>以降の結果は変化前のものです。対処は「光輸送測定」で確認できます。</translation>
    </message>
    <message>
        <source>%1 of the view is too bright for the camera</source>
        <translation>視野の %1 がカメラには明るすぎます</translation>
    </message>
    <message>
        <source>Nothing is corrected there. Close the lens a little, check the camera, then measure again.</source>
        <translation>そこでは何も補正されません。レンズを少し絞り、カメラを確認してから、もう一度測定してください。</translation>
    </message>
    <message>
        <source>%1 of the view is left out</source>
        <translation>視野の %1 が除外されています</translation>
    </message>
    <message>
        <source>Test patterns looked different there from what was measured, and nothing is corrected. See that all stands still, then measure again.</source>
        <translation>そこではテストパターンが測定と異なって見え、何も補正されません。すべてが静止していることを確かめてから、もう一度測定してください。</translation>
    </message>
    <message>
        <source>Measuring was stopped before anything was told apart</source>
        <translation>何も区別できないうちに測定が停止されました</translation>
    </message>
    <message>
        <source>No picture can be corrected by it. Go on measuring, or use the earlier one, at Acquire.</source>
        <translation>これでは映像を補正できません。「光輸送測定」で、測定を続けるか以前の測定を使ってください。</translation>
    </message>
    <message>
        <source>No picture can be corrected by it. Go on measuring any time.</source>
        <translation>これでは映像を補正できません。いつでも測定を続けられます。</translation>
    </message>
    <message>
        <source>Measuring again has not ended</source>
        <translation>再測定が終わっていません</translation>
    </message>
    <message>
        <source>What was measured is out of date: it belongs to earlier settings</source>
        <translation>測定結果は古くなっています。以前の設定のものです</translation>
    </message>
    <message>
        <source>It still works, and what you see follows from the earlier measurement, until the new one is ready.</source>
        <translation>新しい測定ができるまでは以前の測定が引き続き使え、表示もそれに基づきます。</translation>
    </message>
</context>
<context>
    <name>VenueKeeping</name>
    <message>
        <source>It is being measured.</source>
        <translation>測定中です。</translation>
    </message>
    <message>
        <source>It is open. Open another venue, then come back.</source>
        <translation>開いています。別の会場を開いてから戻ってください。</translation>
    </message>
    <message>
        <source>Give the venue a name.</source>
        <translation>会場の名前を入力してください。</translation>
    </message>
    <message>
        <source>A name cannot hold a slash.</source>
        <translation>名前にスラッシュは使えません。</translation>
    </message>
    <message>
        <source>A name cannot begin with a full stop: its folder would be hidden.</source>
        <translation>名前をピリオドで始めることはできません。フォルダーが隠れてしまいます。</translation>
    </message>
    <message>
        <source>There is a folder of that name. Choose another name.</source>
        <translation>同じ名前のフォルダーがあります。別の名前にしてください。</translation>
    </message>
    <message>
        <source>Its show starts at log-in. Open it, and remove the installed show at Output first.</source>
        <translation>この会場のショーはログイン時に始まります。会場を開き、先に「出力」で登録したショーを解除してください。</translation>
    </message>
</context>
<context>
    <name>ViewActions</name>
    <message>
        <source>Show everything</source>
        <translation>全体を表示</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>保存</translation>
    </message>
    <message>
        <source>Picture as seen</source>
        <translation>表示どおりの画像</translation>
    </message>
    <message>
        <source>Save the picture</source>
        <translation>画像を保存</translation>
    </message>
    <message>
        <source>Pictures (*.png)</source>
        <translation>画像 (*.png)</translation>
    </message>
    <message>
        <source>Values</source>
        <translation>数値</translation>
    </message>
    <message>
        <source>Save the values</source>
        <translation>数値を保存</translation>
    </message>
    <message>
        <source>OpenEXR (*.exr)</source>
        <translation>OpenEXR (*.exr)</translation>
    </message>
    <message>
        <source>Whole screen, save</source>
        <translation>全画面、保存</translation>
    </message>
    <message>
        <source>Whole screen (F11 in the picture)</source>
        <translation>全画面（画像内で F11）</translation>
    </message>
</context>
<context>
    <name>WindowProjector</name>
    <message>
        <source>The desktop scales this screen by %1, which blurs every pixel. Set its scale to 100 %.</source>
        <translation>デスクトップがこの画面を %1 に拡大縮小しているため、全画素がぼやけます。倍率を 100 % にしてください。</translation>
    </message>
    <message>
        <source>A venue is being measured</source>
        <translation>会場を測定中です</translation>
    </message>
</context>
<context>
    <name>acquisition.alarm-skipped</name>
    <message>
        <source>accepted before pattern {}: {}</source>
        <translation>パターン {} の前に許容：{}</translation>
    </message>
</context>
<context>
    <name>acquisition.ended-by-change</name>
    <message>
        <source>measuring ended with a change: {}; photographs from No. {} on are left out</source>
        <translation>測定は変化があった状態で終わりました：{}。{} 番以降の写真は使いません</translation>
    </message>
</context>
<context>
    <name>acquisition.light-drifted</name>
    <message>
        <source>The light changed by {} % between the first and the last photograph; this was compensated for, but let the projector warm up before the next time</source>
        <translation>最初と最後の写真の間に光が {} % 変化しました。補正済みですが、次回は測定前にプロジェクターを十分に温めてください</translation>
    </message>
</context>
<context>
    <name>acquisition.overexposed</name>
    <message>
        <source>{} % of the camera pixels are overexposed even at the shortest exposure: close the camera&apos;s aperture a little, then measure again</source>
        <translation>カメラ画素の {} % が最短の露出でも露出オーバーです：カメラの絞りを少し絞って、測定し直してください</translation>
    </message>
</context>
<context>
    <name>acquisition.pixels-flagged</name>
    <message>
        <source>{} % of the camera pixels do not see what was predicted for the test patterns: check that nothing moved or flickered; these pixels are left out of the compensation</source>
        <translation>カメラ画素の {} % がテストパターンで予測と異なるものを見ています：何も動いたりちらついたりしていないか確認してください。これらの画素は補償の対象外です</translation>
    </message>
</context>
<context>
    <name>acquisition.poor-quality</name>
    <message>
        <source>What was measured does not fit together: corrected pictures are expected at {} dB, no better than uncorrected; see that projector, camera and surface stand still and that no other light changes, then measure again</source>
        <translation>測定結果がかみ合っていません。補正した映像の見込みは {} dB で、補正しない場合と変わりません。プロジェクター、カメラ、投影面が動かず、ほかの光も変わらないことを確かめてから、測定し直してください</translation>
    </message>
</context>
<context>
    <name>acquisition.stopped-early</name>
    <message>
        <source>Measuring was stopped at blocks of {} px: what is finer is missing, and pictures are compensated less sharply; go on measuring any time as long as nothing has moved</source>
        <translation>測定は {} px のブロックで終了しました：それより細かい部分がなく、映像の補正は粗くなります。何も動いていなければ、いつでも測定を続けられます</translation>
    </message>
</context>
<context>
    <name>acquisition.stopped-with-forecast</name>
    <message numerus="yes">
        <source>Stopped at {} px blocks; {} dB expected, about {} dB with {} more photographs, {}; go on measuring any time as long as nothing has moved</source>
        <comment>Stopped at {} px blocks; {} dB expected, about {} dB with {} more photograph, {}; go on measuring any time as long as nothing has moved</comment>
        <translation>
            <numerusform>{} px のブロックで停止しました。見込みは {} dB、約 {} dB まではあと {} 枚の写真、{}。何も動いていない限り、いつでも測定を続けられます</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>acquisition.taken-again</name>
    <message numerus="yes">
        <source>{}: {} patterns from No. {} on were photographed again</source>
        <comment>{}: {} pattern from No. {} on was photographed again</comment>
        <translation>
            <numerusform>{0}：No. {2} からパターン {1} 枚を撮り直しました</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>alarm.by-resuming</name>
    <message>
        <source>{} by resuming the calibration; {}</source>
        <translation>{}。再試行するときは校正を再開してください。{}</translation>
    </message>
</context>
<context>
    <name>alarm.camera-sees-nothing</name>
    <message>
        <source>the camera sees nothing at all</source>
        <translation>カメラに何も見えていません</translation>
    </message>
</context>
<context>
    <name>alarm.check-screen</name>
    <message>
        <source>check that the right screen is chosen and nothing covers the picture, then try again</source>
        <translation>正しい画面が選ばれ、画像を隠すものがないことを確認してから、再試行してください</translation>
    </message>
</context>
<context>
    <name>alarm.clear-the-view</name>
    <message>
        <source>take away what is in the light or in the view, then try again</source>
        <translation>光路や視野にあるものを取り除いてから、再試行してください</translation>
    </message>
</context>
<context>
    <name>alarm.lamp-changed</name>
    <message>
        <source>the projector&apos;s light changed by {} % within a few photographs</source>
        <translation>プロジェクターの光が、数枚の写真の間に {} % 変化しました</translation>
    </message>
</context>
<context>
    <name>alarm.leave-it-as-it-is</name>
    <message>
        <source>leave it as it is now, then try again: measuring begins again</source>
        <translation>今のままにしてもう一度試してください：測定は最初から始まります</translation>
    </message>
</context>
<context>
    <name>alarm.light-flickers</name>
    <message>
        <source>the light flickers or was switched: photographs of one pattern differ by {} %</source>
        <translation>光がちらついているか、点灯・消灯されました：同じパターンの写真が {} % 異なります</translation>
    </message>
</context>
<context>
    <name>alarm.light-room-or-measure-again</name>
    <message>
        <source>switch on again what shone when measuring began, then try again; or stop, and measure again in the light as it is now</source>
        <translation>測定を始めたときの照明を再び点けてもう一度試すか、停止して、今の明るさで測定し直してください</translation>
    </message>
</context>
<context>
    <name>alarm.moved</name>
    <message>
        <source>a camera or projector has moved: the view of camera {} is shifted by {}, {} pixels and turned by {} degrees</source>
        <translation>カメラかプロジェクターが動きました：カメラ {} の視野が {}、{} 画素ずれ、{} 度回転しています</translation>
    </message>
</context>
<context>
    <name>alarm.moved-besides</name>
    <message>
        <source>{}; besides, {}</source>
        <translation>{}。さらに、{}</translation>
    </message>
</context>
<context>
    <name>alarm.photograph-dark</name>
    <message>
        <source>one of two photographs of a pattern is dark: the lens was covered, or the projector&apos;s picture gone</source>
        <translation>1 つのパターンの 2 枚の写真のうち 1 枚が暗くなっています：レンズが覆われていたか、プロジェクターの画像が消えていました</translation>
    </message>
</context>
<context>
    <name>alarm.photographs-differ</name>
    <message>
        <source>photographs of one pattern differ by {} %: the light flickers, or something moved between them</source>
        <translation>同じパターンの写真に {} % の差があります：光がちらついているか、撮影の間に何かが動きました</translation>
    </message>
</context>
<context>
    <name>alarm.picture-mirrored</name>
    <message>
        <source>the picture of projector {} appears mirrored</source>
        <translation>プロジェクター {} の画像が反転しています</translation>
    </message>
</context>
<context>
    <name>alarm.projector-shows-nothing</name>
    <message>
        <source>the projector shows nothing, though the room&apos;s own light is still seen</source>
        <translation>プロジェクターに何も映っていませんが、室内光は見えています</translation>
    </message>
</context>
<context>
    <name>alarm.put-back-or-measure-again</name>
    <message>
        <source>put it back, then try again; or stop, and measure again without it</source>
        <translation>元に戻してからもう一度試すか、停止して、それがない状態で測定し直してください</translation>
    </message>
</context>
<context>
    <name>alarm.put-it-back</name>
    <message>
        <source>put it back to within half a pixel, then try again</source>
        <translation>ずれが半画素以内になるように元の位置に戻してから、再試行してください</translation>
    </message>
</context>
<context>
    <name>alarm.put-it-back-and-restore-light</name>
    <message>
        <source>put it back to within half a pixel and restore the light of the room, then try again</source>
        <translation>ずれが半画素以内になるように元の位置に戻し、部屋の照明を元に戻してから、再試行してください</translation>
    </message>
</context>
<context>
    <name>alarm.restore-room-light</name>
    <message>
        <source>restore the light of the room, keep doors and curtains closed, then try again</source>
        <translation>照明を元に戻し、ドアとカーテンを閉めたままにして、再試行してください</translation>
    </message>
</context>
<context>
    <name>alarm.room-brighter</name>
    <message>
        <source>the light of the room became brighter</source>
        <translation>室内光が明るくなりました</translation>
    </message>
</context>
<context>
    <name>alarm.room-darker</name>
    <message>
        <source>the light of the room became darker</source>
        <translation>室内光が暗くなりました</translation>
    </message>
</context>
<context>
    <name>alarm.safe-before-check</name>
    <message>
        <source>every photograph up to the previous check is safe</source>
        <translation>前回の確認までの写真はすべて無事です</translation>
    </message>
</context>
<context>
    <name>alarm.safe-before-light-transport</name>
    <message>
        <source>every photograph before the light transport is safe</source>
        <translation>光輸送測定より前の写真はすべて無事です</translation>
    </message>
</context>
<context>
    <name>alarm.something-gone</name>
    <message>
        <source>{} % of the view of camera {} are brighter than before: what stood there is gone</source>
        <translation>視野の {} %（カメラ {}）が前より明るくなりました：そこにあったものがなくなっています</translation>
    </message>
</context>
<context>
    <name>alarm.steady-all</name>
    <message>
        <source>see that camera, projector and surface stand still, switch off dimmed and fluorescent lamps and the projector&apos;s power saving, then try again</source>
        <translation>カメラ、プロジェクター、面が動かないことを確かめ、調光した照明と蛍光灯、プロジェクターの省電力機能をオフにしてから、再試行してください</translation>
    </message>
</context>
<context>
    <name>alarm.switch-off-dimmed-lamps</name>
    <message>
        <source>switch off dimmed and fluorescent lamps and the projector&apos;s power saving, then try again</source>
        <translation>調光した照明と蛍光灯、プロジェクターの省電力機能をオフにしてから、再試行してください</translation>
    </message>
</context>
<context>
    <name>alarm.switch-off-eco-modes</name>
    <message>
        <source>switch off its automatic brightness and eco modes, let it warm up, then try again</source>
        <translation>プロジェクターの自動輝度調整とエコモードをオフにし、暖機してから、再試行してください</translation>
    </message>
</context>
<context>
    <name>alarm.switch-off-rear-projection</name>
    <message>
        <source>switch off the projector&apos;s rear or ceiling mode, or allow a mirrored picture, then try again</source>
        <translation>プロジェクターの背面投写や天吊りのモードをオフにするか、反転した画像を許可してから、再試行してください</translation>
    </message>
</context>
<context>
    <name>alarm.uncover-lens</name>
    <message>
        <source>uncover the lens, check that the projector is on, then try again</source>
        <translation>レンズの覆いを外し、プロジェクターの電源が入っていることを確認してから、再試行してください</translation>
    </message>
</context>
<context>
    <name>alarm.view-changed</name>
    <message>
        <source>{} % of the view of camera {} look different from before</source>
        <translation>カメラ {1} の視野の {0} % が以前と違って見えます</translation>
    </message>
</context>
<context>
    <name>alarm.wake-projector</name>
    <message>
        <source>wake the projector, switch off its and the screen&apos;s power saving, then try again</source>
        <translation>プロジェクターをスリープから復帰させ、プロジェクターと画面の省電力機能をオフにしてから、再試行してください</translation>
    </message>
</context>
<context>
    <name>alarm.wrong-picture</name>
    <message>
        <source>projector {} does not show the picture that it is given</source>
        <translation>プロジェクター {} が、送られた画像を表示していません</translation>
    </message>
</context>
<context>
    <name>calibration.allow-writing-then-resume</name>
    <message>
        <source>check that the folder may be written to, then go on</source>
        <translation>フォルダーに書き込めることを確認してから、続行してください</translation>
    </message>
</context>
<context>
    <name>calibration.allow-writing-then-retry</name>
    <message>
        <source>check that the folder may be written to, then try again</source>
        <translation>フォルダーに書き込めることを確認してから、再試行してください</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-list-folder</name>
    <message>
        <source>cannot look into the folder ({})</source>
        <translation>フォルダーの内容を確認できません（{}）</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-move-photograph</name>
    <message>
        <source>a photograph cannot be moved ({})</source>
        <translation>写真を移動できません（{}）</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-open-folder</name>
    <message>
        <source>cannot open the folder ({})</source>
        <translation>フォルダーを開けません（{}）</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-remove-photograph</name>
    <message>
        <source>a photograph cannot be removed ({})</source>
        <translation>写真を削除できません（{}）</translation>
    </message>
</context>
<context>
    <name>calibration.check-path-and-permission</name>
    <message>
        <source>check the path and that you may read it</source>
        <translation>パスと読み取り権限を確認してください</translation>
    </message>
</context>
<context>
    <name>calibration.check-permission-or-name</name>
    <message>
        <source>check that you may read it, or choose another name</source>
        <translation>読み取り権限があることを確認するか、別の名前にしてください</translation>
    </message>
</context>
<context>
    <name>calibration.choose-another-or-copy-again</name>
    <message>
        <source>choose another calibration, or copy it again from where it was measured</source>
        <translation>別の校正データを選ぶか、測定した場所からコピーし直してください</translation>
    </message>
</context>
<context>
    <name>calibration.disk-full</name>
    <message>
        <source>the disk is full</source>
        <translation>ディスクがいっぱいです</translation>
    </message>
</context>
<context>
    <name>calibration.give-addresses-again</name>
    <message>
        <source>give the projectors&apos; addresses again</source>
        <translation>プロジェクターのアドレスをもう一度指定してください</translation>
    </message>
</context>
<context>
    <name>calibration.make-room-then-resume</name>
    <message>
        <source>every photograph so far is safe: free at least {} MB there, then resume</source>
        <translation>これまでの写真はすべて無事です。保存先に {} MB 以上の空きを作ってから再開してください</translation>
    </message>
</context>
<context>
    <name>calibration.manifest-damaged</name>
    <message>
        <source>the file that describes the venue is damaged</source>
        <translation>会場を記述するファイルが壊れています</translation>
    </message>
</context>
<context>
    <name>calibration.network-unreadable</name>
    <message>
        <source>the addresses of the projectors on the network cannot be read ({})</source>
        <translation>ネットワーク上のプロジェクターのアドレスを読み取れません（{}）</translation>
    </message>
</context>
<context>
    <name>calibration.not-a-calibration</name>
    <message>
        <source>this is not a calibration of Relucent</source>
        <translation>Relucent の校正データではありません</translation>
    </message>
</context>
<context>
    <name>calibration.result-file-missing</name>
    <message>
        <source>a file of the calibration&apos;s {} is missing</source>
        <translation>校正データの {} のファイルがありません</translation>
    </message>
</context>
<context>
    <name>calibration.result-file-size-wrong</name>
    <message>
        <source>a file of the calibration&apos;s {} has {} bytes instead of {}</source>
        <translation>校正データの {0} のファイルが {2} バイトではなく {1} バイトです</translation>
    </message>
</context>
<context>
    <name>cast.check-screen</name>
    <message>
        <source>see whether the screen is on, or the window open</source>
        <translation>画面がオンになっているか、ウィンドウが開いているかを確認してください</translation>
    </message>
</context>
<context>
    <name>cast.choice-refused</name>
    <message>
        <source>the desktop no longer gives what was chosen for it</source>
        <translation>デスクトップは、以前に選ばれたものをもう提供しません</translation>
    </message>
</context>
<context>
    <name>cast.choose-again</name>
    <message>
        <source>play it again, and choose there what is shown</source>
        <translation>もう一度再生し、そこで表示するものを選んでください</translation>
    </message>
</context>
<context>
    <name>cast.choose-in-wizard</name>
    <message>
        <source>play it once in the wizard, on Output, and choose there; a show then takes the same</source>
        <translation>ウィザードの「出力」で一度再生して選んでください。その後のショーは同じものを使います</translation>
    </message>
</context>
<context>
    <name>cast.ended</name>
    <message>
        <source>the desktop has ended it</source>
        <translation>デスクトップが終了させました</translation>
    </message>
</context>
<context>
    <name>cast.install-pipewire</name>
    <message>
        <source>install pipewire and wireplumber, and log in again</source>
        <translation>pipewire と wireplumber をインストールし、ログインし直してください</translation>
    </message>
</context>
<context>
    <name>cast.install-portal</name>
    <message>
        <source>install xdg-desktop-portal and its part for this desktop, and log in again</source>
        <translation>xdg-desktop-portal とこのデスクトップ用の部分をインストールし、ログインし直してください</translation>
    </message>
</context>
<context>
    <name>cast.log-in-again</name>
    <message>
        <source>log in again</source>
        <translation>ログインし直してください</translation>
    </message>
</context>
<context>
    <name>cast.no-pipewire</name>
    <message>
        <source>PipeWire, which brings the picture, does not answer</source>
        <translation>映像を届ける PipeWire が応答しません</translation>
    </message>
</context>
<context>
    <name>cast.no-portal</name>
    <message>
        <source>this desktop has no portal that gives the picture of a screen</source>
        <translation>このデスクトップには、画面の映像を提供するポータルがありません</translation>
    </message>
</context>
<context>
    <name>cast.no-windows</name>
    <message>
        <source>this desktop gives pictures of screens, not of windows</source>
        <translation>このデスクトップが提供するのは画面の映像で、ウィンドウの映像ではありません</translation>
    </message>
</context>
<context>
    <name>cast.not-chosen</name>
    <message>
        <source>nobody has chosen in the desktop&apos;s dialog what is shown</source>
        <translation>デスクトップのダイアログで、表示するものが選ばれませんでした</translation>
    </message>
</context>
<context>
    <name>cast.play-screen</name>
    <message>
        <source>play the screen on which the window is</source>
        <translation>そのウィンドウがある画面を再生してください</translation>
    </message>
</context>
<context>
    <name>cast.portal-failed</name>
    <message>
        <source>the desktop&apos;s portal gives no picture ({})</source>
        <translation>デスクトップのポータルが映像を提供しません（{}）</translation>
    </message>
</context>
<context>
    <name>cast.portal-silent</name>
    <message>
        <source>the desktop&apos;s portal has not answered for {} s</source>
        <translation>デスクトップのポータルが {} s の間応答していません</translation>
    </message>
</context>
<context>
    <name>cast.refused</name>
    <message>
        <source>it was refused in the desktop&apos;s dialog</source>
        <translation>デスクトップのダイアログで拒否されました</translation>
    </message>
</context>
<context>
    <name>cast.unusable</name>
    <message>
        <source>what the desktop sends is no picture that can be shown</source>
        <translation>デスクトップから届くのは、表示できる映像ではありません</translation>
    </message>
</context>
<context>
    <name>cast.update-desktop</name>
    <message>
        <source>update the desktop&apos;s portal and PipeWire</source>
        <translation>デスクトップのポータルと PipeWire を更新してください</translation>
    </message>
</context>
<context>
    <name>check.colour-wheel</name>
    <message>
        <source>The colours come one after the other, as through a colour wheel ({} % in {} ms): expose whole frames, multiples of {} ms.</source>
        <translation>カラーホイールのように色が順に現れます（{1} ms で {0} %）：整数フレーム（{2} ms の倍数）で露光してください。</translation>
    </message>
</context>
<context>
    <name>check.dithering</name>
    <message>
        <source>The projector mixes greys in time, pixel by pixel ({} %): expose several whole frames, and switch its smoothing and 3D modes off.</source>
        <translation>プロジェクターは画素ごとに灰色を時間的に混ぜています（{} %）：複数の整数フレームで露光し、スムージングと 3D モードをオフにしてください。</translation>
    </message>
</context>
<context>
    <name>check.lamp-flickers</name>
    <message>
        <source>The lamp flickers within a frame, by {} % in {} ms: expose whole frames, multiples of {} ms.</source>
        <translation>ランプがフレーム内でちらつきます（{1} ms で {0} %）：整数フレーム（{2} ms の倍数）で露光してください。</translation>
    </message>
</context>
<context>
    <name>check.light-even</name>
    <message>
        <source>The light is even: no flicker, colour wheel, bands or dithering is seen.</source>
        <translation>光は均一です：ちらつき、カラーホイール、縞、ディザリングは見られません。</translation>
    </message>
</context>
<context>
    <name>check.light-unsteady</name>
    <message>
        <source>The light changes by {} % between exposures of whole frames: let the lamp warm up, and switch off dynamic brightness and the lamps in the room.</source>
        <translation>整数フレームの露光の間に光が {} % 変化します：ランプを暖機し、動的輝度と室内の照明をオフにしてください。</translation>
    </message>
</context>
<context>
    <name>check.no-brief-exposure</name>
    <message>
        <source>The camera cannot expose for a part of a frame, or sees too little then: flicker within a frame cannot be detected.</source>
        <translation>カメラは 1 フレーム未満の露光ができないか、その場合は暗すぎます：フレーム内のちらつきは判定できません。</translation>
    </message>
</context>
<context>
    <name>check.other-screen-seen</name>
    <message>
        <source>The camera sees {} and not {}.</source>
        <translation>カメラに見えているのは {1} ではなく {0} です。</translation>
    </message>
</context>
<context>
    <name>check.picture-takes</name>
    <message>
        <source>A picture takes {} ms to appear: each one is waited for that long.</source>
        <translation>映像が現れるまで {} ms かかります。毎回その時間だけ待ちます。</translation>
    </message>
</context>
<context>
    <name>check.pictures-late</name>
    <message numerus="yes">
        <source>Pictures arrive {} photographs late: measure the latency, so that it is waited for.</source>
        <comment>Pictures arrive {} photograph late: measure the latency, so that it is waited for.</comment>
        <translation>
            <numerusform>画像が写真 {} 枚分遅れて届きます：遅延を測定して待つ必要があります。</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>check.rolling-shutter</name>
    <message>
        <source>The camera exposes its rows one after the other (rolling shutter): brief exposures have bands of {} %. Expose whole frames, multiples of {} ms.</source>
        <translation>カメラは行を順に露光します（ローリングシャッター）：短い露光には {} % の縞が出ます。整数フレーム（{} ms の倍数）で露光してください。</translation>
    </message>
</context>
<context>
    <name>check.screen-mirrored</name>
    <message>
        <source>The picture appears mirrored. If it is not meant to (rear projection, a mirror), switch that off in the projector&apos;s menu.</source>
        <translation>画像が反転しています。意図したもの（背面投写、鏡）でなければ、プロジェクターのメニューで反転をオフにしてください。</translation>
    </message>
</context>
<context>
    <name>check.screen-not-seen</name>
    <message>
        <source>The camera does not see {}.</source>
        <translation>カメラに {} が見えていません。</translation>
    </message>
</context>
<context>
    <name>check.screen-seen</name>
    <message>
        <source>The camera sees {}: {} % of its view follow the test pattern.</source>
        <translation>カメラに {} が見えています：視野の {} % がテストパターンに追従しています。</translation>
    </message>
</context>
<context>
    <name>check.white-changes</name>
    <message>
        <source>White changes by {} % from photograph to photograph: expose whole frames of the projector, multiples of {} ms, and switch its dynamic brightness off.</source>
        <translation>白が写真ごとに {} % 変化します：プロジェクターの整数フレーム（{} ms の倍数）で露光し、動的輝度をオフにしてください。</translation>
    </message>
</context>
<context>
    <name>compensation.draw-masks-of-cameras</name>
    <message>
        <source>draw masks in the views of the cameras that measured this calibration</source>
        <translation>この校正を測定したカメラの視点にマスクを描いてください</translation>
    </message>
</context>
<context>
    <name>compensation.mask-crosses-itself</name>
    <message>
        <source>its outline crosses itself</source>
        <translation>輪郭が自分自身と交差しています</translation>
    </message>
</context>
<context>
    <name>compensation.mask-encloses-nothing</name>
    <message>
        <source>its outline encloses nothing</source>
        <translation>輪郭が何も囲んでいません</translation>
    </message>
</context>
<context>
    <name>compensation.mask-feather-out-of-range</name>
    <message>
        <source>its feather must lie between 0 and half of the view&apos;s larger side</source>
        <translation>ぼかしは 0 から視野の長辺の半分までです</translation>
    </message>
</context>
<context>
    <name>compensation.mask-not-finite</name>
    <message>
        <source>its points must be finite numbers</source>
        <translation>点は有限の数でなければなりません</translation>
    </message>
</context>
<context>
    <name>compensation.mask-of-no-camera</name>
    <message>
        <source>a mask was drawn in the view of camera {}, but there are {} cameras</source>
        <translation>カメラ {} の視点にマスクが描かれていますが、カメラは {} 台です</translation>
    </message>
</context>
<context>
    <name>compensation.mask-outside-view</name>
    <message>
        <source>its points must lie within the view, from 0 to 1 along both sides</source>
        <translation>点は視野内、両辺とも 0 から 1 の間でなければなりません</translation>
    </message>
</context>
<context>
    <name>compensation.mask-point-twice</name>
    <message>
        <source>two points of its outline are the same</source>
        <translation>輪郭の二つの点が同じです</translation>
    </message>
</context>
<context>
    <name>compensation.mask-too-few-points</name>
    <message>
        <source>its outline needs three points at least</source>
        <translation>輪郭には少なくとも三つの点が必要です</translation>
    </message>
</context>
<context>
    <name>compensation.mask-too-many-points</name>
    <message>
        <source>its outline may have {} points at most</source>
        <translation>輪郭の点は最大 {} 個です</translation>
    </message>
</context>
<context>
    <name>compensation.masks-cover-everything</name>
    <message>
        <source>the masks cover the whole picture</source>
        <translation>マスクが画像全体を覆っています</translation>
    </message>
</context>
<context>
    <name>compensation.of-mask</name>
    <message>
        <source>mask {}: {}</source>
        <translation>マスク {}：{}</translation>
    </message>
</context>
<context>
    <name>compensation.shrink-masks</name>
    <message>
        <source>make a mask smaller, or remove one</source>
        <translation>マスクを小さくするか、一つ削除してください</translation>
    </message>
</context>
<context>
    <name>content.choose-picture-folder</name>
    <message>
        <source>choose a folder with PNG, JPEG, TIFF or EXR files</source>
        <translation>PNG、JPEG、TIFF、EXR ファイルのあるフォルダーを選んでください</translation>
    </message>
</context>
<context>
    <name>content.choose-supported-picture</name>
    <message>
        <source>choose a PNG, JPEG, TIFF or EXR picture</source>
        <translation>PNG、JPEG、TIFF、EXR の画像を選んでください</translation>
    </message>
</context>
<context>
    <name>content.connect-capture-device</name>
    <message>
        <source>plug it in, close other programs that use it, and try again</source>
        <translation>接続し、それを使用しているほかのプログラムを終了して、再試行してください</translation>
    </message>
</context>
<context>
    <name>content.log-in-to-xorg</name>
    <message>
        <source>log in to a desktop, or play files</source>
        <translation>デスクトップにログインするか、ファイルを再生してください</translation>
    </message>
</context>
<context>
    <name>content.no-pictures</name>
    <message>
        <source>no pictures in this folder</source>
        <translation>このフォルダーに画像がありません</translation>
    </message>
</context>
<context>
    <name>content.no-x-server</name>
    <message>
        <source>the live picture of a screen needs an X server, and none answers</source>
        <translation>画面のライブ映像には X サーバーが必要ですが、応答がありません</translation>
    </message>
</context>
<context>
    <name>content.nothing-captured</name>
    <message>
        <source>the capture device gives no picture</source>
        <translation>キャプチャーデバイスから画像が届きません</translation>
    </message>
</context>
<context>
    <name>content.open-first</name>
    <message>
        <source>open it first</source>
        <translation>先に開いてください</translation>
    </message>
</context>
<context>
    <name>content.open-first-or-choose</name>
    <message>
        <source>open it first; there are: {}</source>
        <translation>先に開いてください。現在あるもの：{}</translation>
    </message>
</context>
<context>
    <name>content.picture-unreadable</name>
    <message>
        <source>not a picture that can be read</source>
        <translation>読み取れる画像ではありません</translation>
    </message>
</context>
<context>
    <name>content.sequence-empty</name>
    <message>
        <source>the sequence has no pictures</source>
        <translation>連番画像に画像がありません</translation>
    </message>
</context>
<context>
    <name>content.unknown-window</name>
    <message>
        <source>there is no window &apos;{}&apos;</source>
        <translation>「{}」というウィンドウがありません</translation>
    </message>
</context>
<context>
    <name>device.aim-uncover-and-expose-longer</name>
    <message>
        <source>aim it at the projection, take off its lens cap, and expose longer</source>
        <translation>カメラを投影に向け、レンズキャップを外し、露出を長くしてください</translation>
    </message>
</context>
<context>
    <name>device.allow-command-more-time</name>
    <message>
        <source>check the device, or allow the command more time: {}</source>
        <translation>機器を確認するか、コマンドの制限時間を延ばしてください：{}</translation>
    </message>
</context>
<context>
    <name>device.another-program-holds-camera</name>
    <message>
        <source>another program holds the camera</source>
        <translation>ほかのプログラムがカメラを使用しています</translation>
    </message>
</context>
<context>
    <name>device.ask-for-fewer-pixels</name>
    <message>
        <source>ask for that or less</source>
        <translation>それ以下のサイズを指定してください</translation>
    </message>
</context>
<context>
    <name>device.ask-for-given-size</name>
    <message>
        <source>ask for the size that it gives</source>
        <translation>カメラが出力するサイズを指定してください</translation>
    </message>
</context>
<context>
    <name>device.ask-for-listed-size</name>
    <message>
        <source>ask for a size that it has: v4l2-ctl --list-formats-ext names them</source>
        <translation>対応しているサイズを指定してください：v4l2-ctl --list-formats-ext で一覧できます</translation>
    </message>
</context>
<context>
    <name>device.automatic-exposure-stays</name>
    <message>
        <source>the video device&apos;s automatic exposure cannot be switched off</source>
        <translation>ビデオデバイスの自動露出をオフにできません</translation>
    </message>
</context>
<context>
    <name>device.automatic-focus-stays</name>
    <message>
        <source>the video device&apos;s automatic focus cannot be switched off</source>
        <translation>ビデオデバイスのオートフォーカスをオフにできません</translation>
    </message>
</context>
<context>
    <name>device.automatic-function-stays</name>
    <message>
        <source>{} cannot be switched off</source>
        <translation>{} をオフにできません</translation>
    </message>
</context>
<context>
    <name>device.automatic-iso</name>
    <message>
        <source>the camera chooses its sensitivity itself (automatic ISO)</source>
        <translation>カメラが感度を自動で決めています（ISO オート）</translation>
    </message>
</context>
<context>
    <name>device.automatic-white-balance-stays</name>
    <message>
        <source>the video device&apos;s automatic white balance cannot be switched off</source>
        <translation>ビデオデバイスの自動ホワイトバランスをオフにできません</translation>
    </message>
</context>
<context>
    <name>device.battery-empty</name>
    <message>
        <source>the camera&apos;s battery seems to be empty ({} % when it was last asked)</source>
        <translation>カメラのバッテリーが切れているようです（前回の確認時は {} %）</translation>
    </message>
</context>
<context>
    <name>device.battery-low</name>
    <message>
        <source>has {} % left in its battery: a measurement needs a full one or a mains adapter</source>
        <translation>バッテリー残量は {} % です: 測定には満充電または AC アダプターが必要です</translation>
    </message>
</context>
<context>
    <name>device.built-without-genicam</name>
    <message>
        <source>this build of Relucent does not know GenICam cameras</source>
        <translation>このビルドの Relucent は、GenICam カメラに対応していません</translation>
    </message>
</context>
<context>
    <name>device.built-without-gphoto</name>
    <message>
        <source>this build of Relucent does not know DSLR and mirrorless cameras</source>
        <translation>このビルドの Relucent は、一眼レフカメラとミラーレスカメラに対応していません</translation>
    </message>
</context>
<context>
    <name>device.camera-asleep</name>
    <message>
        <source>the camera is there but does not answer, it may be asleep</source>
        <translation>カメラは接続されていますが応答しません。スリープ状態かもしれません</translation>
    </message>
</context>
<context>
    <name>device.camera-command-empty</name>
    <message>
        <source>the camera&apos;s command is empty</source>
        <translation>カメラのコマンドが空です</translation>
    </message>
</context>
<context>
    <name>device.camera-command-lacks</name>
    <message>
        <source>the camera&apos;s command does not contain {}</source>
        <translation>カメラのコマンドに {} がありません</translation>
    </message>
</context>
<context>
    <name>device.camera-given-up</name>
    <message>
        <source>the camera does not answer</source>
        <translation>カメラが応答しません</translation>
    </message>
</context>
<context>
    <name>device.camera-given-up-advice</name>
    <message>
        <source>push in its cable at both ends and switch it on, then go on: every photograph so far is kept</source>
        <translation>ケーブルを両端とも差し込み、電源を入れてから続けてください。これまでの写真はすべて保持されています</translation>
    </message>
</context>
<context>
    <name>device.camera-gone</name>
    <message>
        <source>the camera has been unplugged or switched off, or has fallen asleep</source>
        <translation>カメラの接続が外れたか、電源が切れたか、スリープ状態になりました</translation>
    </message>
</context>
<context>
    <name>device.camera-no-longer-answers</name>
    <message>
        <source>the camera no longer answers ({}: {})</source>
        <translation>カメラが応答しなくなりました（{}：{}）</translation>
    </message>
</context>
<context>
    <name>device.camera-not-back</name>
    <message>
        <source>the camera has been gone for {} s: {}</source>
        <translation>カメラとの接続が {} 秒間途切れています：{}</translation>
    </message>
</context>
<context>
    <name>device.camera-refuses</name>
    <message>
        <source>the camera refuses ({}: {})</source>
        <translation>カメラが拒否しています（{}：{}）</translation>
    </message>
</context>
<context>
    <name>device.camera-sends-no-stream</name>
    <message>
        <source>the camera sends no stream</source>
        <translation>カメラからストリームが届きません</translation>
    </message>
</context>
<context>
    <name>device.camera-size-out-of-range</name>
    <message>
        <source>a camera of {} pixels is impossible: each side is {} to {}</source>
        <translation>{} 画素のカメラはありえません：各辺は {}～{} です</translation>
    </message>
</context>
<context>
    <name>device.camera-stays-busy</name>
    <message>
        <source>the camera stays busy</source>
        <translation>カメラがビジー状態のままです</translation>
    </message>
</context>
<context>
    <name>device.camera-twice</name>
    <message>
        <source>{} is camera {} and camera {}: choose another camera, or one with a serial number of its own</source>
        <translation>{} はカメラ {} とカメラ {} の両方になっています: 別のカメラ、または固有のシリアル番号を持つカメラを選んでください</translation>
    </message>
</context>
<context>
    <name>device.cannot-create-temporary-folder</name>
    <message>
        <source>cannot create a temporary folder ({})</source>
        <translation>一時フォルダーを作成できません（{}）</translation>
    </message>
</context>
<context>
    <name>device.cannot-remove-file</name>
    <message>
        <source>cannot remove the file ({})</source>
        <translation>ファイルを削除できません（{}）</translation>
    </message>
</context>
<context>
    <name>device.cannot-reopen-video-device</name>
    <message>
        <source>the video device cannot be opened again</source>
        <translation>ビデオデバイスをもう一度開くことができません</translation>
    </message>
</context>
<context>
    <name>device.cannot-start-command</name>
    <message>
        <source>the command cannot be started ({})</source>
        <translation>コマンドを開始できません（{}）</translation>
    </message>
</context>
<context>
    <name>device.cannot-write-recording</name>
    <message>
        <source>the recording cannot be written ({})</source>
        <translation>記録を書き込めません（{}）</translation>
    </message>
</context>
<context>
    <name>device.card-full</name>
    <message>
        <source>the camera has no room left for a photograph: its memory card is full</source>
        <translation>カメラに写真を保存する空きがありません：メモリカードがいっぱいです</translation>
    </message>
</context>
<context>
    <name>device.change-or-empty-card</name>
    <message>
        <source>change or empty the memory card</source>
        <translation>メモリカードを交換するか、空にしてください</translation>
    </message>
</context>
<context>
    <name>device.charge-or-change-battery</name>
    <message>
        <source>charge or change the battery, or better, use a mains adapter, and switch the camera on again</source>
        <translation>バッテリーを充電するか交換し（AC アダプターの使用を推奨）、カメラの電源を入れ直してください</translation>
    </message>
</context>
<context>
    <name>device.check-cable-and-power</name>
    <message>
        <source>check its cable and its power</source>
        <translation>ケーブルと電源を確認してください</translation>
    </message>
</context>
<context>
    <name>device.check-cable-and-power-saving</name>
    <message>
        <source>check its cable, and switch off its power saving</source>
        <translation>ケーブルを確認し、省電力機能をオフにしてください</translation>
    </message>
</context>
<context>
    <name>device.check-cable-network-and-programs</name>
    <message>
        <source>check the camera&apos;s cable and network card, and that no other program uses it</source>
        <translation>カメラのケーブルとネットワークカードを確認し、ほかのプログラムがカメラを使っていないことを確認してください</translation>
    </message>
</context>
<context>
    <name>device.check-cable-power-address</name>
    <message>
        <source>check its cable, its power and its address; `relucent-cli devices` lists what is there</source>
        <translation>ケーブル、電源、アドレスを確認してください。`relucent-cli devices` で接続中の機器を一覧できます</translation>
    </message>
</context>
<context>
    <name>device.check-projector-and-aim</name>
    <message>
        <source>check that the projector is on and shows that output, aim the camera at it, and take its cap off; or choose another screen</source>
        <translation>プロジェクターの電源が入り、その出力を表示していることを確認し、カメラをそこに向けてレンズキャップを外すか、別の画面を選んでください</translation>
    </message>
</context>
<context>
    <name>device.check-projector-or-aim-another</name>
    <message>
        <source>check that this projector is on and shows that output, and aim a camera at it; or remove it from the venue</source>
        <translation>このプロジェクターの電源が入り、その出力を表示しているか確かめ、カメラを向けてください。または会場から削除してください</translation>
    </message>
</context>
<context>
    <name>device.choose-gain-in-range</name>
    <message>
        <source>choose a gain from {} to {}</source>
        <translation>カメラの対応範囲は {}～{} です</translation>
    </message>
</context>
<context>
    <name>device.choose-offered-iso</name>
    <message>
        <source>choose one of those that it has: {}</source>
        <translation>選べる値は {} です</translation>
    </message>
</context>
<context>
    <name>device.choose-or-aim-at-screen</name>
    <message>
        <source>choose {}, or aim the camera at {}</source>
        <translation>{} を選ぶか、カメラを {} に向けてください</translation>
    </message>
</context>
<context>
    <name>device.choose-readable-pixel-format</name>
    <message>
        <source>it has {}; unpacked Mono, Bayer and RGB of 8 to 16 bits are read</source>
        <translation>カメラの形式は {} です。読み込めるのは 8～16 ビットの非パック形式の Mono、Bayer、RGB です</translation>
    </message>
</context>
<context>
    <name>device.claimed-exposures-invalid</name>
    <message>
        <source>the camera claims exposures of {} to {} s</source>
        <translation>カメラが無効な露出範囲（{}～{} 秒）を報告しています</translation>
    </message>
</context>
<context>
    <name>device.close-menus-and-live-view</name>
    <message>
        <source>close its menus and its playback, and leave live view</source>
        <translation>カメラのメニューと再生画面を閉じ、ライブビューを終了してください</translation>
    </message>
</context>
<context>
    <name>device.close-menus-and-restart</name>
    <message>
        <source>close its menus, and switch it off and on</source>
        <translation>カメラのメニューを閉じ、電源を入れ直してください</translation>
    </message>
</context>
<context>
    <name>device.close-other-program</name>
    <message>
        <source>close the other program, a camera viewer or a second Relucent perhaps</source>
        <translation>ほかのプログラム（カメラビューアーや 2 つ目の Relucent など）を閉じてください</translation>
    </message>
</context>
<context>
    <name>device.close-other-programs</name>
    <message>
        <source>close other programs and try again</source>
        <translation>ほかのプログラムを終了して、再試行してください</translation>
    </message>
</context>
<context>
    <name>device.colour-filter-not-bayer</name>
    <message>
        <source>the camera&apos;s colour filter is not a Bayer filter</source>
        <translation>カメラのカラーフィルターがベイヤー配列ではありません</translation>
    </message>
</context>
<context>
    <name>device.command-failed</name>
    <message>
        <source>the command failed with status {}</source>
        <translation>コマンドがステータス {} で失敗しました</translation>
    </message>
</context>
<context>
    <name>device.command-failed-saying</name>
    <message>
        <source>the command failed with status {}, saying &quot;{}&quot;</source>
        <translation>コマンドがステータス {} で失敗しました。出力：「{}」</translation>
    </message>
</context>
<context>
    <name>device.command-killed</name>
    <message>
        <source>the command was killed by signal {}</source>
        <translation>コマンドがシグナル {} で強制終了されました</translation>
    </message>
</context>
<context>
    <name>device.command-killed-saying</name>
    <message>
        <source>the command was killed by signal {}, saying &quot;{}&quot;</source>
        <translation>コマンドがシグナル {} で強制終了されました。出力：「{}」</translation>
    </message>
</context>
<context>
    <name>device.command-too-long</name>
    <message>
        <source>the command took longer than {} s</source>
        <translation>コマンドが {} 秒以内に終わりませんでした</translation>
    </message>
</context>
<context>
    <name>device.command-too-long-saying</name>
    <message>
        <source>the command took longer than {} s, saying &quot;{}&quot;</source>
        <translation>コマンドが {} 秒以内に終わりませんでした。出力：「{}」</translation>
    </message>
</context>
<context>
    <name>device.command-without-consent</name>
    <message>
        <source>the calibration runs a program to which nobody at this computer has agreed: {}</source>
        <translation>このコンピューターで誰も許可していないプログラムをキャリブレーションが実行します: {}</translation>
    </message>
</context>
<context>
    <name>device.command-wrote-nothing</name>
    <message>
        <source>the command ended well but wrote nothing, not {}</source>
        <translation>コマンドは正常に終了しましたが、{} に何も書き込みませんでした</translation>
    </message>
</context>
<context>
    <name>device.command-wrote-something-else</name>
    <message>
        <source>the command ended well but wrote {}, not {}</source>
        <translation>コマンドは正常に終了しましたが、{1} ではなく {0} を書き込みました</translation>
    </message>
</context>
<context>
    <name>device.copy-or-retake-photograph</name>
    <message>
        <source>copy it again, or take the photograph again; a camera newer than this LibRaw needs DNG files</source>
        <translation>コピーし直すか、撮影し直してください。カメラがこの LibRaw より新しい場合は DNG ファイルが必要です</translation>
    </message>
</context>
<context>
    <name>device.delivers-8-bits</name>
    <message>
        <source>delivers 8 bits: dark places stay uncertain</source>
        <translation>8 ビットで出力します: 暗い部分は不確かになります</translation>
    </message>
</context>
<context>
    <name>device.develop-linearly</name>
    <message>
        <source>develop the files linearly, as 16-bit TIFF, or use another camera</source>
        <translation>ファイルを線形の 16 ビット TIFF に現像するか、別のカメラを使ってください</translation>
    </message>
</context>
<context>
    <name>device.exposure-range-invalid</name>
    <message>
        <source>the shortest exposure must be above zero and no longer than the longest</source>
        <translation>最短の露出は 0 より大きく、最長の露出以下でなければなりません</translation>
    </message>
</context>
<context>
    <name>device.exposure-refused</name>
    <message>
        <source>the camera was asked to expose {} s but exposes {} s</source>
        <translation>カメラに {} 秒の露出を指定しましたが、{} 秒のままです</translation>
    </message>
</context>
<context>
    <name>device.exposure-time-cannot-be-set</name>
    <message>
        <source>the camera&apos;s exposure time cannot be set</source>
        <translation>カメラの露出時間を設定できません</translation>
    </message>
</context>
<context>
    <name>device.exposure-time-fixed</name>
    <message>
        <source>the camera exposes {} s whatever exposure it is asked for</source>
        <translation>どの露出を指定しても、カメラの露出は {} 秒のままです</translation>
    </message>
</context>
<context>
    <name>device.focuses-by-itself</name>
    <message>
        <source>focuses by itself: switch its lens to manual focus</source>
        <translation>自動でピントを合わせます: レンズをマニュアルフォーカスに切り替えてください</translation>
    </message>
</context>
<context>
    <name>device.free-space-or-record-elsewhere</name>
    <message>
        <source>free some space, or record elsewhere</source>
        <translation>空き容量を増やすか、別の場所に記録してください</translation>
    </message>
</context>
<context>
    <name>device.free-space-or-set-tmpdir</name>
    <message>
        <source>free some space there, or set TMPDIR to a folder that you may write to</source>
        <translation>そこの空き容量を増やすか、TMPDIR に書き込めるフォルダーを指定してください</translation>
    </message>
</context>
<context>
    <name>device.gain-out-of-range</name>
    <message>
        <source>a gain of {} is wanted</source>
        <translation>ゲイン {} が指定されています</translation>
    </message>
</context>
<context>
    <name>device.gain-refused</name>
    <message>
        <source>was asked for a gain of {} but uses {}</source>
        <translation>ゲイン {} を指定しましたが、{} のままです</translation>
    </message>
</context>
<context>
    <name>device.genicam-missing</name>
    <message>
        <source>GigE Vision and USB3 Vision cameras: this build lacks Aravis; install libaravis-dev and build again</source>
        <translation>GigE Vision・USB3 Vision カメラ: このビルドには Aravis がありません。libaravis-dev をインストールして再ビルドしてください</translation>
    </message>
</context>
<context>
    <name>device.gphoto-missing</name>
    <message>
        <source>DSLR and mirrorless cameras: this build lacks libgphoto2 or LibRaw; install libgphoto2-dev and libraw-dev and build again</source>
        <translation>一眼レフ・ミラーレスカメラ: このビルドには libgphoto2 または LibRaw がありません。libgphoto2-dev と libraw-dev をインストールして再ビルドしてください</translation>
    </message>
</context>
<context>
    <name>device.held-by-desktop</name>
    <message>
        <source>another program is using the camera, usually the desktop, which mounts it like a memory stick</source>
        <translation>ほかのプログラムがカメラを使用しています。多くの場合、デスクトップがカメラを USB メモリのようにマウントしています</translation>
    </message>
</context>
<context>
    <name>device.install-aravis</name>
    <message>
        <source>install Aravis (libaravis-dev) and build again, or use another kind of camera</source>
        <translation>Aravis（libaravis-dev）をインストールしてビルドし直すか、別の種類のカメラを使ってください</translation>
    </message>
</context>
<context>
    <name>device.install-libgphoto2</name>
    <message>
        <source>install libgphoto2 and LibRaw (libgphoto2-dev, libraw-dev) and build again, or use a command</source>
        <translation>libgphoto2 と LibRaw（libgphoto2-dev、libraw-dev）をインストールしてビルドし直すか、コマンドを使ってください</translation>
    </message>
</context>
<context>
    <name>device.iso-refused</name>
    <message>
        <source>was asked for ISO {} but uses ISO {}</source>
        <translation>ISO {} を指定しましたが、ISO {} のままです</translation>
    </message>
</context>
<context>
    <name>device.iso-wanted-not-there</name>
    <message>
        <source>ISO {} is wanted and the camera does not have it</source>
        <translation>ISO {} を指定しましたが、カメラが対応していません</translation>
    </message>
</context>
<context>
    <name>device.lift-exposure-limits</name>
    <message>
        <source>switch its automatic exposure and its frame rate limit off</source>
        <translation>カメラの自動露出とフレームレート制限をオフにしてください</translation>
    </message>
</context>
<context>
    <name>device.longest-exposure-overstated</name>
    <message>
        <source>claims exposures up to {} s but reaches only {} s</source>
        <translation>{} 秒までの露出に対応すると表示しますが、実際は {} 秒までです</translation>
    </message>
</context>
<context>
    <name>device.may-fire-flash</name>
    <message>
        <source>may fire its flash: close it</source>
        <translation>フラッシュが光ることがあります: フラッシュを閉じてください</translation>
    </message>
</context>
<context>
    <name>device.may-take-dark-frame</name>
    <message>
        <source>may take a dark frame after long exposures, which doubles their time</source>
        <translation>長時間露出の後にダーク画像を撮ることがあり、時間が倍になります</translation>
    </message>
</context>
<context>
    <name>device.may-take-several-photographs</name>
    <message>
        <source>may take several photographs at once: switch it to single shots</source>
        <translation>一度に複数枚撮ることがあります: 1 枚撮影に切り替えてください</translation>
    </message>
</context>
<context>
    <name>device.mode-dial-not-manual</name>
    <message>
        <source>the camera&apos;s mode dial is set to {}, where the camera chooses exposures itself</source>
        <translation>カメラのモードダイヤルが {} になっており、カメラが露出を自動で決めます</translation>
    </message>
</context>
<context>
    <name>device.name-camera-by-port</name>
    <message>
        <source>name one by its port: gphoto2:{} or gphoto2:{}</source>
        <translation>どちらかをポートで指定してください：gphoto2:{} または gphoto2:{}</translation>
    </message>
</context>
<context>
    <name>device.name-connected-camera</name>
    <message>
        <source>name that one: gphoto2:{}</source>
        <translation>そのカメラを指定してください：gphoto2:{}</translation>
    </message>
</context>
<context>
    <name>device.no-capture-times</name>
    <message>
        <source>does not say when pictures were captured: some are dropped before each photograph</source>
        <translation>撮影時刻を知らせません: 撮影のたびに数枚を捨てます</translation>
    </message>
</context>
<context>
    <name>device.no-contrast</name>
    <message>
        <source>the camera sees no difference between white and black</source>
        <translation>カメラに白と黒の差が見えていません</translation>
    </message>
</context>
<context>
    <name>device.no-focus</name>
    <message>
        <source>the camera could not focus and took no photograph ({})</source>
        <translation>ピントが合わず、カメラは撮影しませんでした（{}）</translation>
    </message>
</context>
<context>
    <name>device.no-genicam-camera-answers</name>
    <message>
        <source>no GenICam camera &apos;{}&apos; answers</source>
        <translation>GenICam カメラ「{}」が応答しません</translation>
    </message>
</context>
<context>
    <name>device.no-photograph-came</name>
    <message>
        <source>a photograph was asked for and none came</source>
        <translation>撮影を要求しましたが、写真が届きませんでした</translation>
    </message>
</context>
<context>
    <name>device.no-raw-file-sent</name>
    <message>
        <source>the camera sent {} and no raw file</source>
        <translation>カメラが送ったのは {} で、RAW ファイルではありません</translation>
    </message>
</context>
<context>
    <name>device.no-raw-files</name>
    <message>
        <source>the camera does not deliver raw files</source>
        <translation>カメラが RAW ファイルを出力しません</translation>
    </message>
</context>
<context>
    <name>device.no-readable-pixel-format</name>
    <message>
        <source>none of the camera&apos;s pixel formats can be read</source>
        <translation>カメラの画素形式はどれも読み込めません</translation>
    </message>
</context>
<context>
    <name>device.no-software-trigger</name>
    <message>
        <source>has no software trigger: each photograph may wait for one more exposure</source>
        <translation>ソフトウェアトリガーがありません: 撮影ごとに露出 1 回分余計に待つことがあります</translation>
    </message>
</context>
<context>
    <name>device.no-video-pictures</name>
    <message>
        <source>the video device sends no pictures</source>
        <translation>ビデオデバイスから画像が届きません</translation>
    </message>
</context>
<context>
    <name>device.only-other-camera-connected</name>
    <message>
        <source>no camera of this name is plugged in, but {} is</source>
        <translation>この名前のカメラは接続されていません。接続されているのは {} です</translation>
    </message>
</context>
<context>
    <name>device.other-screen-seen</name>
    <message>
        <source>the camera sees {}, not {}</source>
        <translation>カメラに見えているのは {1} ではなく {0} です</translation>
    </message>
</context>
<context>
    <name>device.part-of-sensor-lost</name>
    <message>
        <source>the camera does not go back to the part of the sensor that it had</source>
        <translation>カメラがセンサーの元の範囲に戻りません</translation>
    </message>
</context>
<context>
    <name>device.parts-lost-on-the-way</name>
    <message>
        <source>parts of the photograph were lost on the way</source>
        <translation>写真の一部が転送中に失われました</translation>
    </message>
</context>
<context>
    <name>device.photograph-attempts-failed</name>
    <message>
        <source>{} attempts at a photograph failed: {}</source>
        <translation>撮影に {} 回失敗しました：{}</translation>
    </message>
</context>
<context>
    <name>device.photograph-exceeds-sensor</name>
    <message>
        <source>{} pixels are wanted and the camera has {}</source>
        <translation>{} 画素を指定しましたが、カメラの画素数は {} です</translation>
    </message>
</context>
<context>
    <name>device.photograph-format-changed</name>
    <message>
        <source>the photograph has {} pixels as {} where {} as {} were agreed</source>
        <translation>写真が {} 画素（{}）で、取り決めた {}（{}）と異なります</translation>
    </message>
</context>
<context>
    <name>device.photograph-larger-than-announced</name>
    <message>
        <source>the photograph is larger than the camera announced</source>
        <translation>写真が、カメラの通知したサイズより大きくなっています</translation>
    </message>
</context>
<context>
    <name>device.photograph-not-finished</name>
    <message>
        <source>the photograph was not finished</source>
        <translation>写真が最後まで届きませんでした</translation>
    </message>
</context>
<context>
    <name>device.photograph-size-refused</name>
    <message>
        <source>{} pixels are wanted and the camera gives {}</source>
        <translation>{} 画素を指定しましたが、カメラの出力は {} です</translation>
    </message>
</context>
<context>
    <name>device.photograph-size-unexpected</name>
    <message>
        <source>the photograph has {} pixels where {} were announced</source>
        <translation>写真が {} 画素で、通知された {} と異なります</translation>
    </message>
</context>
<context>
    <name>device.photograph-timed-out</name>
    <message>
        <source>no photograph came within {} s</source>
        <translation>{} 秒以内に写真が届きませんでした</translation>
    </message>
</context>
<context>
    <name>device.photograph-truncated</name>
    <message>
        <source>a photograph of {} pixels as {} came with {} of {} bytes</source>
        <translation>{0} 画素（{1}）の写真が、{3} バイト中 {2} バイトしか届きませんでした</translation>
    </message>
</context>
<context>
    <name>device.picture-not-settled</name>
    <message>
        <source>a new picture has not fully appeared after {} frames</source>
        <translation>新しい画像が {} フレーム後もまだ完全に表示されません</translation>
    </message>
</context>
<context>
    <name>device.pixel-format-lost</name>
    <message>
        <source>the camera has forgotten the pixel format that it was set to</source>
        <translation>カメラに設定した画素形式が失われました</translation>
    </message>
</context>
<context>
    <name>device.pixel-format-not-offered</name>
    <message>
        <source>the camera has no pixel format {} that can be read</source>
        <translation>カメラには、読み込める画素形式 {} がありません</translation>
    </message>
</context>
<context>
    <name>device.projector-command-empty</name>
    <message>
        <source>the projector&apos;s command is empty</source>
        <translation>プロジェクターのコマンドが空です</translation>
    </message>
</context>
<context>
    <name>device.projector-command-lacks</name>
    <message>
        <source>the projector&apos;s command does not contain {}</source>
        <translation>プロジェクターのコマンドに {} がありません</translation>
    </message>
</context>
<context>
    <name>device.projector-size-out-of-range</name>
    <message>
        <source>a projector of {} pixels is impossible: each side is {} to {}</source>
        <translation>{} 画素のプロジェクターはありえません：各辺は {}～{} です</translation>
    </message>
</context>
<context>
    <name>device.projector-unseen</name>
    <message>
        <source>no camera sees what is shown on {}</source>
        <translation>{} に表示されたものがどのカメラにも見えません</translation>
    </message>
</context>
<context>
    <name>device.push-cable-in</name>
    <message>
        <source>push in the camera&apos;s cable at both ends</source>
        <translation>カメラのケーブルを両端とも差し込んでください</translation>
    </message>
</context>
<context>
    <name>device.raw-file-empty</name>
    <message>
        <source>it is empty</source>
        <translation>ファイルが空です</translation>
    </message>
</context>
<context>
    <name>device.raw-file-incomplete</name>
    <message>
        <source>parts of it are missing</source>
        <translation>ファイルの一部が欠けています</translation>
    </message>
</context>
<context>
    <name>device.raw-file-unreadable</name>
    <message>
        <source>the raw file cannot be read ({})</source>
        <translation>RAW ファイルを読み込めません（{}）</translation>
    </message>
</context>
<context>
    <name>device.raw-file-without-sensor-values</name>
    <message>
        <source>the raw file does not hold the sensor&apos;s own values</source>
        <translation>RAW ファイルにセンサーの生の値が入っていません</translation>
    </message>
</context>
<context>
    <name>device.reconnect-same-camera</name>
    <message>
        <source>connect the camera that the measurement was begun with</source>
        <translation>測定を始めたときのカメラを接続してください</translation>
    </message>
</context>
<context>
    <name>device.reconnected-camera-size-differs</name>
    <message>
        <source>the camera came back with {} pixels instead of {}</source>
        <translation>再接続されたカメラの画素数が {1} ではなく {0} です</translation>
    </message>
</context>
<context>
    <name>device.release-from-desktop</name>
    <message>
        <source>make the desktop release it with `gio mount -s gphoto2` (or eject it in the file manager) and close photo programs</source>
        <translation>`gio mount -s gphoto2` でデスクトップのマウントを解除し（またはファイルマネージャーで取り出し）、写真用のプログラムを終了してください</translation>
    </message>
</context>
<context>
    <name>device.remove-file-by-hand</name>
    <message>
        <source>remove it by hand, then try again</source>
        <translation>手動で削除してから、再試行してください</translation>
    </message>
</context>
<context>
    <name>device.request-refused</name>
    <message>
        <source>the camera refused what it was asked for ({})</source>
        <translation>カメラが要求を拒否しました（{}）</translation>
    </message>
</context>
<context>
    <name>device.restart-or-change-pixel-format</name>
    <message>
        <source>switch the camera off and on, or choose another of its pixel formats</source>
        <translation>カメラの電源を入れ直すか、別の画素形式を選んでください</translation>
    </message>
</context>
<context>
    <name>device.restart-with-default-settings</name>
    <message>
        <source>switch it off and on, load its default settings with its maker&apos;s program, and try again</source>
        <translation>電源を入れ直し、メーカーのプログラムで初期設定を読み込んでから、再試行してください</translation>
    </message>
</context>
<context>
    <name>device.run-command-in-terminal</name>
    <message>
        <source>run it in a terminal to find out why: {}</source>
        <translation>ターミナルで実行して原因を調べてください：{}</translation>
    </message>
</context>
<context>
    <name>device.screen-loses-picture</name>
    <message>
        <source>the projector&apos;s screen keeps losing its picture</source>
        <translation>プロジェクターの画面の表示が何度も途切れます</translation>
    </message>
</context>
<context>
    <name>device.screen-not-seen</name>
    <message>
        <source>the camera does not see what is shown on {}</source>
        <translation>{} の表示内容がカメラに見えていません</translation>
    </message>
</context>
<context>
    <name>device.screen-twice</name>
    <message>
        <source>screen {} is projector {} and projector {}: choose another screen</source>
        <translation>画面 {} はプロジェクター {} とプロジェクター {} の両方になっています: 別の画面を選んでください</translation>
    </message>
</context>
<context>
    <name>device.sees-no-colours</name>
    <message>
        <source>sees no colours: brightness can be compensated, colours cannot</source>
        <translation>色を見分けません: 明るさは補正できますが、色はできません</translation>
    </message>
</context>
<context>
    <name>device.set-iso-100</name>
    <message>
        <source>set it to ISO 100 by hand</source>
        <translation>カメラを手動で ISO 100 に設定してください</translation>
    </message>
</context>
<context>
    <name>device.set-manual-exposure-mode</name>
    <message>
        <source>set its exposure mode to timed and manual, or update its firmware</source>
        <translation>露出モードを Timed（手動）に設定するか、ファームウェアを更新してください</translation>
    </message>
</context>
<context>
    <name>device.several-cameras-of-model</name>
    <message>
        <source>{} cameras of this model are plugged in</source>
        <translation>この機種のカメラが {} 台接続されています</translation>
    </message>
</context>
<context>
    <name>device.shortest-exposure-understated</name>
    <message>
        <source>claims exposures from {} s but does not go below {} s</source>
        <translation>{} 秒からの露出に対応すると表示しますが、実際は {} 秒までです</translation>
    </message>
</context>
<context>
    <name>device.simulated-camera-unplugged</name>
    <message>
        <source>the camera&apos;s cable is out</source>
        <translation>カメラのケーブルが抜けています</translation>
    </message>
</context>
<context>
    <name>device.steady-view-and-expose-briefly</name>
    <message>
        <source>check that the camera&apos;s view is steady and its exposure short, and switch the projector&apos;s smoothing of motion off</source>
        <translation>カメラの視野が動いていないことと露出が短いことを確認し、プロジェクターの動き補間をオフにしてください</translation>
    </message>
</context>
<context>
    <name>device.switch-off-automatic-exposure</name>
    <message>
        <source>switch its automatic exposure off; a camera without manual exposure cannot be used</source>
        <translation>カメラの自動露出をオフにしてください。手動露出のないカメラは使用できません</translation>
    </message>
</context>
<context>
    <name>device.switch-off-with-makers-program</name>
    <message>
        <source>switch it off with the camera maker&apos;s program, or use another camera</source>
        <translation>カメラメーカーのプログラムでオフにするか、別のカメラを使ってください</translation>
    </message>
</context>
<context>
    <name>device.switch-off-with-v4l2-ctl</name>
    <message>
        <source>switch it off with v4l2-ctl (--list-ctrls names what it has), or use another camera</source>
        <translation>v4l2-ctl でオフにするか（--list-ctrls で設定項目を一覧できます）、別のカメラを使ってください</translation>
    </message>
</context>
<context>
    <name>device.switch-on-and-keep-awake</name>
    <message>
        <source>check its cable, switch it on and disable its automatic power-off</source>
        <translation>ケーブルを確認し、カメラの電源を入れ、自動電源オフを無効にしてください</translation>
    </message>
</context>
<context>
    <name>device.switch-quality-to-raw</name>
    <message>
        <source>switch its picture quality to RAW by hand; a camera without RAW cannot be used</source>
        <translation>カメラの画質設定を手動で RAW に切り替えてください。RAW のないカメラは使用できません</translation>
    </message>
</context>
<context>
    <name>device.switch-to-full-size-raw</name>
    <message>
        <source>switch the camera to full-size RAW (no sRAW, mRAW, no linear DNG)</source>
        <translation>カメラをフルサイズの RAW に切り替えてください（sRAW、mRAW、リニア DNG は不可）</translation>
    </message>
</context>
<context>
    <name>device.switch-to-manual-focus</name>
    <message>
        <source>switch its lens to manual focus</source>
        <translation>レンズをマニュアルフォーカスに切り替えてください</translation>
    </message>
</context>
<context>
    <name>device.switches-itself-off</name>
    <message>
        <source>switches itself off after a while: switch that off</source>
        <translation>しばらくすると自動で電源が切れます: その設定をオフにしてください</translation>
    </message>
</context>
<context>
    <name>device.take-photograph-by-hand</name>
    <message>
        <source>switch its lens to manual focus, close its menus, and take a photograph by hand to see what it complains of</source>
        <translation>レンズをマニュアルフォーカスに切り替え、カメラのメニューを閉じ、手動で 1 枚撮影して、カメラに出るエラーを確認してください</translation>
    </message>
</context>
<context>
    <name>device.then-go-on</name>
    <message>
        <source>{}, then go on: every photograph so far is kept</source>
        <translation>{}。その後、続行してください：これまでの写真はすべて保持されています</translation>
    </message>
</context>
<context>
    <name>device.trial-photograph-failed</name>
    <message>
        <source>the camera was asked for a photograph and took none</source>
        <translation>カメラに撮影を要求しましたが、撮影されませんでした</translation>
    </message>
</context>
<context>
    <name>device.turn-dial-or-change-camera</name>
    <message>
        <source>turn its mode dial to M; a camera without manual exposure cannot be used</source>
        <translation>カメラのモードダイヤルを M に合わせてください。M のないカメラは使用できません</translation>
    </message>
</context>
<context>
    <name>device.turn-dial-to-m</name>
    <message>
        <source>turn it to M</source>
        <translation>ダイヤルを M に合わせてください</translation>
    </message>
</context>
<context>
    <name>device.use-manual-exposure-camera</name>
    <message>
        <source>use a camera with manual exposure</source>
        <translation>手動露出のあるカメラを使ってください</translation>
    </message>
</context>
<context>
    <name>device.video-device</name>
    <message>
        <source>video device</source>
        <translation>ビデオデバイス</translation>
    </message>
</context>
<context>
    <name>device.video-device-in-use</name>
    <message>
        <source>the video device cannot be opened: another program may be using it</source>
        <translation>ビデオデバイスを開けません：ほかのプログラムが使用しているかもしれません</translation>
    </message>
</context>
<context>
    <name>device.video-device-missing</name>
    <message>
        <source>no such video device is plugged in</source>
        <translation>そのビデオデバイスは接続されていません</translation>
    </message>
</context>
<context>
    <name>device.video-device-unplugged</name>
    <message>
        <source>the video device has been unplugged</source>
        <translation>ビデオデバイスの接続が外れました</translation>
    </message>
</context>
<context>
    <name>device.video-exposure-not-settable</name>
    <message>
        <source>the video device has no exposure that can be set</source>
        <translation>ビデオデバイスに、設定できる露出がありません</translation>
    </message>
</context>
<context>
    <name>device.video-size-refused</name>
    <message>
        <source>{} pixels are wanted and the video device gives {}</source>
        <translation>{} 画素を指定しましたが、ビデオデバイスの出力は {} です</translation>
    </message>
</context>
<context>
    <name>device.wake-camera</name>
    <message>
        <source>press its shutter button half way or switch it off and on, and disable its automatic power-off</source>
        <translation>シャッターボタンを半押しするか電源を入れ直し、自動電源オフを無効にしてください</translation>
    </message>
</context>
<context>
    <name>device.write-announced-size</name>
    <message>
        <source>let the command write that size, or begin again with the size that the camera delivers</source>
        <translation>コマンドがそのサイズで書き込むようにするか、カメラが出力するサイズで最初からやり直してください</translation>
    </message>
</context>
<context>
    <name>device.write-photograph-to-output</name>
    <message>
        <source>let it write the photograph to {output}: {}</source>
        <translation>コマンドが写真を {output} に書き込むようにしてください：{}</translation>
    </message>
</context>
<context>
    <name>disk.cannot-create-folder</name>
    <message>
        <source>cannot create the folder ({})</source>
        <translation>フォルダーを作成できません（{}）</translation>
    </message>
</context>
<context>
    <name>disk.cannot-open</name>
    <message>
        <source>cannot open ({})</source>
        <translation>開けません（{}）</translation>
    </message>
</context>
<context>
    <name>disk.cannot-read</name>
    <message>
        <source>cannot read ({})</source>
        <translation>読み込めません（{}）</translation>
    </message>
</context>
<context>
    <name>disk.cannot-write</name>
    <message>
        <source>cannot write ({})</source>
        <translation>書き込めません（{}）</translation>
    </message>
</context>
<context>
    <name>disk.check-disk-and-cable</name>
    <message>
        <source>check the disk and its cable</source>
        <translation>ディスクとそのケーブルを確認してください</translation>
    </message>
</context>
<context>
    <name>disk.check-path</name>
    <message>
        <source>check the path</source>
        <translation>パスを確認してください</translation>
    </message>
</context>
<context>
    <name>disk.check-path-and-disk</name>
    <message>
        <source>check the path and the disk</source>
        <translation>パスとディスクを確認してください</translation>
    </message>
</context>
<context>
    <name>disk.choose-scratch-folder</name>
    <message>
        <source>let the environment variable TMPDIR name a folder on a disk that you may write to; what has been photographed is safe</source>
        <translation>環境変数 TMPDIR に、書き込みできるディスク上のフォルダーを指定してください。撮影済みの写真は安全です</translation>
    </message>
</context>
<context>
    <name>disk.choose-writable-folder</name>
    <message>
        <source>choose a folder that you may write to, or ask for the permission</source>
        <translation>書き込めるフォルダーを選ぶか、書き込み権限を取得してください</translation>
    </message>
</context>
<context>
    <name>disk.free-scratch-room</name>
    <message>
        <source>free some space there; what has been photographed is safe</source>
        <translation>そこに空きを作ってください。撮影済みの写真は安全です</translation>
    </message>
</context>
<context>
    <name>disk.free-space-or-check-disk</name>
    <message>
        <source>free some space there or check the disk, then try again</source>
        <translation>保存先の空き容量を増やすかディスクを確認してから、再試行してください</translation>
    </message>
</context>
<context>
    <name>disk.free-space-or-choose-another</name>
    <message>
        <source>free some space there or choose another disk, then try again</source>
        <translation>保存先の空き容量を増やすか別のディスクを選んでから、再試行してください</translation>
    </message>
</context>
<context>
    <name>disk.no-scratch-room</name>
    <message>
        <source>there is no room for intermediate results ({})</source>
        <translation>中間結果のための空きがありません（{}）</translation>
    </message>
</context>
<context>
    <name>duration.hours-minutes</name>
    <message>
        <source>{} h {} min</source>
        <translation>{} 時間 {} 分</translation>
    </message>
</context>
<context>
    <name>duration.minutes</name>
    <message>
        <source>{} min</source>
        <translation>{} 分</translation>
    </message>
</context>
<context>
    <name>duration.seconds</name>
    <message>
        <source>{} s</source>
        <translation>{} 秒</translation>
    </message>
</context>
<context>
    <name>duration.under-a-minute</name>
    <message>
        <source>under a minute</source>
        <translation>1 分未満</translation>
    </message>
</context>
<context>
    <name>engine.compute-on-processor</name>
    <message>
        <source>compute on the processor instead</source>
        <translation>CPU で処理してください</translation>
    </message>
</context>
<context>
    <name>engine.graphics-buffer-too-large</name>
    <message>
        <source>the graphics card can hold {} MB in one piece, but {} MB are needed</source>
        <translation>グラフィックカードが一度に扱えるのは {} MB ですが、{} MB 必要です</translation>
    </message>
</context>
<context>
    <name>engine.graphics-card-lost</name>
    <message>
        <source>the graphics card was lost</source>
        <translation>グラフィックカードが使えなくなりました</translation>
    </message>
</context>
<context>
    <name>engine.graphics-card-unusable</name>
    <message>
        <source>the graphics card cannot be used</source>
        <translation>グラフィックカードを使用できません</translation>
    </message>
</context>
<context>
    <name>engine.graphics-memory-exhausted</name>
    <message>
        <source>the graphics card has no {} MB of memory left</source>
        <translation>グラフィックカードのメモリに {} MB の空きがありません</translation>
    </message>
</context>
<context>
    <name>engine.install-driver</name>
    <message>
        <source>install the graphics card&apos;s driver, or compute on the processor</source>
        <translation>グラフィックカードのドライバーをインストールするか、CPU で処理してください</translation>
    </message>
</context>
<context>
    <name>engine.no-graphics-card</name>
    <message>
        <source>there is no graphics card with OpenGL 4.3 and compute shaders</source>
        <translation>OpenGL 4.3 とコンピュートシェーダーに対応したグラフィックカードがありません</translation>
    </message>
</context>
<context>
    <name>engine.no-libegl-or-libopengl</name>
    <message>
        <source>there is no libEGL or no libOpenGL, which open graphics cards without a display</source>
        <translation>ディスプレイなしでグラフィックカードを使うための libEGL または libOpenGL がありません</translation>
    </message>
</context>
<context>
    <name>engine.no-opengl</name>
    <message>
        <source>there is no OpenGL 4.3 with compute shaders</source>
        <translation>コンピュートシェーダー対応の OpenGL 4.3 がありません</translation>
    </message>
</context>
<context>
    <name>import.camera-taken-as-linear</name>
    <message>
        <source>The camera is taken to be linear, and one photograph counts as one second of exposure</source>
        <translation>カメラは線形とみなし、写真 1 枚を 1 秒の露出として扱います</translation>
    </message>
</context>
<context>
    <name>import.lit-share</name>
    <message>
        <source>The projector lights {} % of the camera&apos;s pixels</source>
        <translation>プロジェクターはカメラ画素の {} % を照らしています</translation>
    </message>
</context>
<context>
    <name>import.paired-by-time</name>
    <message>
        <source>The photographs were paired with the patterns in the order in which they were taken, from {} to {}, which is not that of their names</source>
        <translation>写真は撮影順（{} から {}）にパターンと対応付けました。これは名前の順とは異なります</translation>
    </message>
</context>
<context>
    <name>import.patterns-and-photographs-grey</name>
    <message>
        <source>Patterns and photographs are grey: colours are not told apart, and T&apos;s blocks are neutral</source>
        <translation>パターンと写真がグレーです：色は区別されず、T のブロックは無彩色です</translation>
    </message>
</context>
<context>
    <name>import.patterns-black-and-white</name>
    <message>
        <source>The patterns hold black and white only: the projector&apos;s response is assumed to be a gamma of 2.2</source>
        <translation>パターンは白黒のみです：プロジェクターの応答は 2.2 乗とみなします</translation>
    </message>
</context>
<context>
    <name>import.patterns-grey</name>
    <message>
        <source>The patterns are grey: how colours mix was not measured, and T&apos;s blocks are diagonal</source>
        <translation>パターンがグレーです：色の混ざり方は測定されておらず、T のブロックは対角です</translation>
    </message>
</context>
<context>
    <name>import.photographs-are-jpeg</name>
    <message>
        <source>The photographs are JPEG: they were made linear by the curve of sRGB, which cameras follow only roughly; develop them linearly, as TIFF or EXR, to measure more exactly</source>
        <translation>写真が JPEG です：sRGB のカーブで線形化しましたが、カメラはこれにおおよそしか従いません。より正確に測定するには、TIFF または EXR として線形に現像してください</translation>
    </message>
</context>
<context>
    <name>import.photographs-grey</name>
    <message>
        <source>The photographs are grey: what each of the projector&apos;s colours contributes is known in brightness only</source>
        <translation>写真がグレーです：プロジェクターの各色の寄与は明るさでしか分かりません</translation>
    </message>
</context>
<context>
    <name>linearization.choose-overlapping-exposures</name>
    <message>
        <source>set them to ranges of exposure times that overlap</source>
        <translation>露出時間の範囲が重なるようにカメラを設定してください</translation>
    </message>
</context>
<context>
    <name>linearization.halves-brighter-than-whole</name>
    <message>
        <source>{}: two halves of a picture are {} % brighter than the whole; switch off the dynamic iris, dynamic contrast and any picture mode that adapts to the content</source>
        <translation>{}：画像の二つの半分の合計が全体より {} % 明るくなっています。ダイナミックアイリス、ダイナミックコントラスト、内容に応じて変わる画質モードをオフにしてください</translation>
    </message>
</context>
<context>
    <name>linearization.halves-darker-than-whole</name>
    <message>
        <source>{}: two halves of a picture are {} % darker than the whole; switch off the dynamic iris, dynamic contrast and any picture mode that adapts to the content</source>
        <translation>{}：画像の二つの半分の合計が全体より {} % 暗くなっています。ダイナミックアイリス、ダイナミックコントラスト、内容に応じて変わる画質モードをオフにしてください</translation>
    </message>
</context>
<context>
    <name>linearization.highlights-overexposed</name>
    <message>
        <source>{}: some highlights are overexposed even at {} s, the shortest exposure, and will not be compensated; close the aperture or add a grey filter if they matter</source>
        <translation>{}：最短の露出 {} 秒でも一部のハイライトが露出オーバーで、補償されません。重要な場合は、絞りを絞るか ND フィルターを付けてください</translation>
    </message>
</context>
<context>
    <name>linearization.light-flickers</name>
    <message>
        <source>{}: the light changes by {} % from one photograph to the next; switch off the projector&apos;s dynamic lamp modes and other lamps nearby, and choose exposure times that are multiples of the mains period</source>
        <translation>{}：写真ごとに光が {} % 変化しています。プロジェクターのダイナミックなランプモードと近くの照明をオフにし、露出時間を電源周期の整数倍にしてください</translation>
    </message>
</context>
<context>
    <name>linearization.no-common-exposure</name>
    <message>
        <source>the cameras have no exposure time in common</source>
        <translation>カメラに共通する露出時間がありません</translation>
    </message>
</context>
<context>
    <name>linearization.overexposed</name>
    <message>
        <source>{}: the projection is overexposed even at {} s, the shortest exposure; close the aperture, lower the gain or add a grey filter</source>
        <translation>{}：最短の露出 {} 秒でも投影が露出オーバーです。絞りを絞るか、ゲインを下げるか、ND フィルターを付けてください</translation>
    </message>
</context>
<context>
    <name>linearization.response-uneven</name>
    <message>
        <source>{}: the brightness curves are not the same everywhere in its picture, by up to {} % of white; switch off uniformity correction, local dimming and edge blending in the projector</source>
        <translation>{}：明るさの曲線が画像のどこでも同じではなく、白の最大 {} % の差があります。プロジェクターの均一性補正、ローカルディミング、エッジブレンディングをオフにしてください</translation>
    </message>
</context>
<context>
    <name>linearization.underexposed</name>
    <message>
        <source>{}: the projection reaches only {} % of the camera&apos;s range at {} s, the longest exposure; open the aperture or raise the gain</source>
        <translation>{0}：最長の露出 {2} 秒でも、投影はカメラの範囲の {1} % にしか達しません。絞りを開くか、ゲインを上げてください</translation>
    </message>
</context>
<context>
    <name>linearization.white-brighter-than-colours</name>
    <message>
        <source>{}: white is {} % brighter than red, green and blue together; switch off the white segment (often called brilliant colour or bright mode) and choose a picture mode for video or sRGB</source>
        <translation>{}：白は赤・緑・青の合計より {} % 明るくなっています。ホワイトセグメント（「ブリリアントカラー」や「明るいモード」などと呼ばれます）をオフにし、ビデオまたは sRGB 用の画質モードを選んでください</translation>
    </message>
</context>
<context>
    <name>linearization.white-darker-than-colours</name>
    <message>
        <source>{}: white is {} % darker than red, green and blue together; switch off power saving, colour management and dynamic picture modes</source>
        <translation>{}：白は赤・緑・青の合計より {} % 暗くなっています。省電力、カラーマネジメント、ダイナミックな画質モードをオフにしてください</translation>
    </message>
</context>
<context>
    <name>masks.draw-again</name>
    <message>
        <source>draw it again, or correct the file</source>
        <translation>描き直すか、ファイルを直してください</translation>
    </message>
</context>
<context>
    <name>masks.unknown-key</name>
    <message>
        <source>mask {} has &quot;{}&quot;, which this version does not know</source>
        <translation>マスク {} の「{}」は、この版では知られていません</translation>
    </message>
</context>
<context>
    <name>masks.unreadable</name>
    <message>
        <source>mask {} cannot be read: it needs points as [[x, y], ...], and may have camera, outline and feather</source>
        <translation>マスク {} を読み込めません：points を [[x, y], ...] の形で指定し、camera、outline、feather は任意です</translation>
    </message>
</context>
<context>
    <name>night.hours-began</name>
    <message>
        <source>the show&apos;s hours began before it was done</source>
        <translation>終わる前にショーの時間が始まりました</translation>
    </message>
</context>
<context>
    <name>night.missed</name>
    <message>
        <source>it could not begin within two hours of its time: the show did not run, or the computer slept</source>
        <translation>予定時刻から2時間以内に始められませんでした：ショーが動いていなかったか、コンピューターがスリープしていました</translation>
    </message>
</context>
<context>
    <name>night.not-as-predicted</name>
    <message>
        <source>the picture has a colour error of {} where {} was predicted, and no repair helped</source>
        <translation>画像の色の誤差は {} で、予測は {} でした。修復しても改善しませんでした</translation>
    </message>
</context>
<context>
    <name>night.part-not-as-predicted</name>
    <message>
        <source>a part of the surface looks otherwise than predicted, by a colour error of {}, and no repair helped</source>
        <translation>表面の一部が予測と異なって見え、色の誤差は {} で、修復しても改善しませんでした</translation>
    </message>
</context>
<context>
    <name>night.too-long</name>
    <message>
        <source>it was not done within six hours</source>
        <translation>6時間以内に終わりませんでした</translation>
    </message>
</context>
<context>
    <name>perfect.camera-blinded</name>
    <message>
        <source>something blinds the camera: {} of its view is overexposed</source>
        <translation>何かがカメラに強い光を当てています：画面の {} が露出オーバーです</translation>
    </message>
</context>
<context>
    <name>perfect.camera-moved</name>
    <message>
        <source>the view of camera {} has moved by {}, {} pixels since the venue was measured</source>
        <translation>カメラ {} の視野が測定時から {}、{} ピクセル動いています</translation>
    </message>
</context>
<context>
    <name>perfect.light-missing</name>
    <message>
        <source>light is missing: is the lens covered, or a projector asleep?</source>
        <translation>光が足りません：レンズが覆われていませんか、またはプロジェクターがスリープ中ではありませんか</translation>
    </message>
</context>
<context>
    <name>perfect.something-else</name>
    <message>
        <source>the camera sees something else than expected: did somebody stand in the light, or did the room&apos;s light change?</source>
        <translation>カメラに予想と違うものが写っています：誰かが光の中に立っていたか、部屋の明かりが変わりませんでしたか</translation>
    </message>
</context>
<context>
    <name>pjlink.address-twice</name>
    <message>
        <source>projectors {} and {} have the same address, {}</source>
        <translation>プロジェクター {} と {} のアドレスが同じです（{}）</translation>
    </message>
</context>
<context>
    <name>pjlink.cannot-search</name>
    <message>
        <source>projectors cannot be searched ({})</source>
        <translation>プロジェクターを検索できません（{}）</translation>
    </message>
</context>
<context>
    <name>pjlink.check-address-and-port</name>
    <message>
        <source>check the address and the port of the projector</source>
        <translation>プロジェクターのアドレスとポートを確認してください</translation>
    </message>
</context>
<context>
    <name>pjlink.check-lens</name>
    <message>
        <source>check lens caps, shutter and input of the projector, and where the camera looks</source>
        <translation>レンズキャップ、プロジェクターのシャッターと入力、カメラの向きを確認してください</translation>
    </message>
</context>
<context>
    <name>pjlink.check-network</name>
    <message>
        <source>check its address, its network cable, and that PJLink and the network in standby are switched on in its menu</source>
        <translation>アドレスとネットワークケーブルを確認し、メニューで PJLink とスタンバイ時のネットワークが有効になっているか確認してください</translation>
    </message>
</context>
<context>
    <name>pjlink.check-own-network</name>
    <message>
        <source>check this computer&apos;s network, or give the projector&apos;s address</source>
        <translation>このコンピューターのネットワークを確認するか、プロジェクターのアドレスを指定してください</translation>
    </message>
</context>
<context>
    <name>pjlink.choose-class-one-authentication</name>
    <message>
        <source>choose the authentication of PJLink class 1 in its menu, or none</source>
        <translation>メニューで PJLink クラス 1 の認証、または認証なしを選んでください</translation>
    </message>
</context>
<context>
    <name>pjlink.closed</name>
    <message>
        <source>it closed the connection</source>
        <translation>接続が閉じられました</translation>
    </message>
</context>
<context>
    <name>pjlink.end-dimming</name>
    <message>
        <source>switch off its dynamic contrast, lamp dimming and eco modes, and daylight in the room; or measure without waiting for its lamp</source>
        <translation>ダイナミックコントラスト、ランプの調光、エコモードを切り、室内の外光を遮ってください。または、ランプを待たずに測定してください</translation>
    </message>
</context>
<context>
    <name>pjlink.frozen</name>
    <message>
        <source>projector {} freezes its picture: end that in its menu</source>
        <translation>プロジェクター {} の画像が静止しています。メニューで解除してください</translation>
    </message>
</context>
<context>
    <name>pjlink.give-password</name>
    <message>
        <source>give the PJLink password that is set in its menu</source>
        <translation>メニューで設定されている PJLink パスワードを指定してください</translation>
    </message>
</context>
<context>
    <name>pjlink.light-drifts</name>
    <message>
        <source>the light of projector {} still drifts by {} % within {} s after {} s</source>
        <translation>プロジェクター {0} の光は {3} 秒後もまだ {2} 秒間に {1} % 変化しています</translation>
    </message>
</context>
<context>
    <name>pjlink.light-unseen</name>
    <message>
        <source>no camera sees light of projector {}</source>
        <translation>プロジェクター {} の光がどのカメラにも見えません</translation>
    </message>
</context>
<context>
    <name>pjlink.look-at-projector</name>
    <message>
        <source>look at its lamps and its menu</source>
        <translation>表示ランプとメニューを確認してください</translation>
    </message>
</context>
<context>
    <name>pjlink.more-than-projectors</name>
    <message>
        <source>projector {} on the network is none of the {} that there are</source>
        <translation>ネットワーク上のプロジェクター {} は、{} 台あるうちのどれでもありません</translation>
    </message>
</context>
<context>
    <name>pjlink.newer-authentication</name>
    <message>
        <source>the projector at {} asks for its password in a way that this version does not know</source>
        <translation>{} のプロジェクターは、このバージョンが対応していない方法でパスワードを求めています</translation>
    </message>
</context>
<context>
    <name>pjlink.no-answer</name>
    <message>
        <source>the projector at {} does not answer ({})</source>
        <translation>{} のプロジェクターが応答しません（{}）</translation>
    </message>
</context>
<context>
    <name>pjlink.no-signal</name>
    <message>
        <source>projector {} has no signal at its input {}: choose the input of this computer</source>
        <translation>プロジェクター {} の入力 {} に信号がありません。このコンピューターの入力を選んでください</translation>
    </message>
</context>
<context>
    <name>pjlink.not-native</name>
    <message>
        <source>projector {} receives {} pixels and has {}: it scales the picture, which blurs the compensation; send it its own size</source>
        <translation>プロジェクター {} は {} 画素を受信し、自身は {} です。画像が拡大縮小され補正がぼやけます。本来の解像度で送ってください</translation>
    </message>
</context>
<context>
    <name>pjlink.not-on</name>
    <message>
        <source>projector {} was told to switch on and is not on after {} s</source>
        <translation>プロジェクター {} に電源オンを指示しましたが、{} 秒後もオンになりません</translation>
    </message>
</context>
<context>
    <name>pjlink.not-pjlink</name>
    <message>
        <source>what answers at {} does not speak PJLink</source>
        <translation>{} で応答する機器は PJLink に対応していません</translation>
    </message>
</context>
<context>
    <name>pjlink.open-shutter-by-hand</name>
    <message>
        <source>open it at the projector, and start again</source>
        <translation>プロジェクター本体で開いてから、やり直してください</translation>
    </message>
</context>
<context>
    <name>pjlink.other-signal</name>
    <message>
        <source>projector {} receives {} pixels where {} are sent: something between scales the picture, or it shows another input</source>
        <translation>プロジェクター {} は {} 画素を受信していますが、送信は {} です。途中の機器が拡大縮小しているか、別の入力を表示しています</translation>
    </message>
</context>
<context>
    <name>pjlink.own-failure</name>
    <message>
        <source>the projector at {} reports a failure of its own</source>
        <translation>{} のプロジェクターが自身の故障を報告しています</translation>
    </message>
</context>
<context>
    <name>pjlink.part-cover</name>
    <message>
        <source>cover open</source>
        <translation>カバーが開いている</translation>
    </message>
</context>
<context>
    <name>pjlink.part-fan</name>
    <message>
        <source>fan</source>
        <translation>ファン</translation>
    </message>
</context>
<context>
    <name>pjlink.part-filter</name>
    <message>
        <source>filter</source>
        <translation>フィルター</translation>
    </message>
</context>
<context>
    <name>pjlink.part-lamp</name>
    <message>
        <source>lamp</source>
        <translation>ランプ</translation>
    </message>
</context>
<context>
    <name>pjlink.part-other</name>
    <message>
        <source>something else</source>
        <translation>その他</translation>
    </message>
</context>
<context>
    <name>pjlink.part-temperature</name>
    <message>
        <source>temperature</source>
        <translation>温度</translation>
    </message>
</context>
<context>
    <name>pjlink.reports-error</name>
    <message>
        <source>projector {} reports an error: {}</source>
        <translation>プロジェクター {} がエラーを報告しています: {}</translation>
    </message>
</context>
<context>
    <name>pjlink.reports-warning</name>
    <message>
        <source>projector {} warns: {}</source>
        <translation>プロジェクター {} の警告: {}</translation>
    </message>
</context>
<context>
    <name>pjlink.shutter-stays-closed</name>
    <message>
        <source>the shutter of projector {} does not open</source>
        <translation>プロジェクター {} のシャッターが開きません</translation>
    </message>
</context>
<context>
    <name>pjlink.still-warming</name>
    <message>
        <source>projector {} is still warming up or cooling down after {} s</source>
        <translation>プロジェクター {} は {} 秒後もまだウォームアップ中または冷却中です</translation>
    </message>
</context>
<context>
    <name>pjlink.switch-on-by-hand</name>
    <message>
        <source>look at its lamps and its menu, switch it on by hand, and start again</source>
        <translation>表示ランプとメニューを確認し、手動で電源を入れて、やり直してください</translation>
    </message>
</context>
<context>
    <name>pjlink.too-slow</name>
    <message>
        <source>nothing complete came in time</source>
        <translation>時間内に完全な応答がありませんでした</translation>
    </message>
</context>
<context>
    <name>pjlink.wants-password</name>
    <message>
        <source>the projector at {} asks for a password</source>
        <translation>{} のプロジェクターがパスワードを求めています</translation>
    </message>
</context>
<context>
    <name>pjlink.wrong-password</name>
    <message>
        <source>the projector at {} refuses the password</source>
        <translation>{} のプロジェクターがパスワードを拒否しました</translation>
    </message>
</context>
<context>
    <name>reduction.binned</name>
    <message>
        <source>of the camera&apos;s {} pixels, {} are made: of the part around what is lit, every {} become one</source>
        <translation>カメラの {} 画素から {} を作ります。照らされた部分とその周囲で、{} 画素ごとに 1 つにまとめます</translation>
    </message>
</context>
<context>
    <name>reduction.binned-for-memory</name>
    <message>
        <source>of the camera&apos;s {} pixels, {} are made: every {} become one, as there is memory for no more</source>
        <translation>カメラの {} 画素から {} を作ります。それ以上はメモリーに収まらないため、{} 画素ごとに 1 つにまとめます</translation>
    </message>
</context>
<context>
    <name>reduction.cropped</name>
    <message>
        <source>of the camera&apos;s {} pixels, the {} around what is lit are used</source>
        <translation>カメラの {} 画素のうち、照らされた部分とその周囲の {} を使います</translation>
    </message>
</context>
<context>
    <name>reduction.fewer-camera-pixels</name>
    <message>
        <source>choose fewer camera pixels: automatic ones are as many as fit</source>
        <translation>カメラの画素を減らしてください。自動にすると、収まるだけの画素が使われます</translation>
    </message>
</context>
<context>
    <name>reduction.memory-too-little</name>
    <message>
        <source>measuring would take {} GB of memory, and {} GB may be taken</source>
        <translation>測定には {} GB のメモリーが要りますが、使えるのは {} GB です</translation>
    </message>
</context>
<context>
    <name>reduction.more-memory-or-smaller-projector</name>
    <message>
        <source>use a computer or a limit with more memory, or a projector signal of fewer pixels</source>
        <translation>メモリーの多いコンピューターや上限にするか、プロジェクターの信号の画素を減らしてください</translation>
    </message>
</context>
<context>
    <name>reduction.other-size</name>
    <message>
        <source>the camera delivers {} pixels where {} were calibrated</source>
        <translation>カメラは {} 画素ですが、校正は {} 画素で行われました</translation>
    </message>
</context>
<context>
    <name>reduction.restore-camera-size</name>
    <message>
        <source>set the camera to the size that it had, or calibrate again</source>
        <translation>カメラを元のサイズに戻すか、もう一度校正してください</translation>
    </message>
</context>
<context>
    <name>relucent::gui::AcquirePage</name>
    <message>
        <source>Paused, %1</source>
        <translation>一時停止中、%1</translation>
    </message>
    <message>
        <source>Measuring, %1</source>
        <translation>測定中、%1</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s), %1</source>
        <translation>
            <numerusform>パターン %n 枚、%1</numerusform>
        </translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>測定済み</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>要更新</translation>
    </message>
    <message>
        <source>Stopped by a failure</source>
        <translation>エラーで停止</translation>
    </message>
    <message>
        <source>Waiting for you. Nothing is being projected.</source>
        <translation>操作を待っています。何も投影していません。</translation>
    </message>
    <message>
        <source>Every photograph is saved. Threshold opens when the last is taken.</source>
        <translation>写真はすべて保存されます。最後の撮影が済むと「しきい値」が開きます。</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>機器は「%1」で使用中です。</translation>
    </message>
    <message>
        <source>Measured in %1</source>
        <translation>測定時間 %1</translation>
    </message>
    <message>
        <source>Leave the room dark and still, then start.</source>
        <translation>室内を暗くし、何も動かさずに開始してください。</translation>
    </message>
    <message>
        <source>Show threshold</source>
        <translation>しきい値を表示</translation>
    </message>
    <message>
        <source>Resume</source>
        <translation>再開</translation>
    </message>
    <message>
        <source>Start measuring</source>
        <translation>測定を開始</translation>
    </message>
    <message>
        <source>Stop and keep</source>
        <translation>終了して保持</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>一時停止</translation>
    </message>
    <message>
        <source>This measurement belongs to earlier settings</source>
        <translation>この測定は以前の設定によるものです</translation>
    </message>
    <message>
        <source>It still works and stays until the new one is ready.</source>
        <translation>引き続き使えます。新しい測定ができるまで残ります。</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>再測定</translation>
    </message>
    <message>
        <source>The last session ended before it was finished</source>
        <translation>前回の作業は途中で終わりました</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>何も変更していません。</translation>
    </message>
    <message>
        <source>Fineness</source>
        <translation>細かさ</translation>
    </message>
    <message>
        <source>Acquire</source>
        <translation>光輸送測定</translation>
    </message>
    <message>
        <source>Measure how every projector pixel lights every camera pixel. Leave the room dark and still.</source>
        <translation>プロジェクターの各画素がカメラの各画素をどう照らすかを測定します。室内を暗くし、何も動かさないでください。</translation>
    </message>
    <message>
        <source>Sent to the projector</source>
        <translation>プロジェクターへ送信</translation>
    </message>
    <message>
        <source>Seen by the camera</source>
        <translation>カメラの撮影</translation>
    </message>
    <message>
        <source>Pattern that the projector shows</source>
        <translation>プロジェクターが表示するパターン</translation>
    </message>
    <message>
        <source>Last photograph</source>
        <translation>最新の写真</translation>
    </message>
    <message>
        <source>Appears when measuring begins. Nothing is projected before you start.</source>
        <translation>測定が始まると表示されます。開始するまで何も投影しません。</translation>
    </message>
    <message>
        <source>How finely</source>
        <translation>測定の細かさ</translation>
    </message>
    <message>
        <source>Fast</source>
        <translation>高速</translation>
    </message>
    <message>
        <source>a first look; misses weak bounces</source>
        <translation>お試し用。弱い相互反射は対象外</translation>
    </message>
    <message>
        <source>Usual</source>
        <translation>標準</translation>
    </message>
    <message>
        <source>suits most surfaces</source>
        <translation>ほとんどの投影面向け</translation>
    </message>
    <message>
        <source>Fine</source>
        <translation>精密</translation>
    </message>
    <message>
        <source>glass, gloss, deep corners</source>
        <translation>ガラス、光沢、奥まった角</translation>
    </message>
    <message>
        <source>Disk still needed</source>
        <translation>今後必要な容量</translation>
    </message>
    <message>
        <source>Watching</source>
        <translation>監視</translation>
    </message>
    <message>
        <source>Paused</source>
        <translation>一時停止中</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>測定中</translation>
    </message>
    <message>
        <source>about %1</source>
        <translation>約 %1</translation>
    </message>
    <message>
        <source>alarm beyond</source>
        <translation>ここを超えると警告</translation>
    </message>
    <message>
        <source>taken again</source>
        <translation>撮り直し</translation>
    </message>
    <message>
        <source>During the measurement</source>
        <translation>測定中</translation>
    </message>
    <message>
        <source>light that would spoil photographs</source>
        <translation>写真を損なう光</translation>
    </message>
    <message>
        <source>Minutes</source>
        <translation>分</translation>
    </message>
    <message>
        <source>Room light, % of full light</source>
        <translation>室内光、全点灯に対する %</translation>
    </message>
    <message>
        <source>Room light during the measurement</source>
        <translation>測定中の室内光</translation>
    </message>
    <message>
        <source>Taken again</source>
        <translation>撮り直し</translation>
    </message>
    <message numerus="yes">
        <source>About %n pattern(s), %1. Leave the room dark and still.</source>
        <translation>
            <numerusform>パターン約 %n 枚、%1。部屋を暗く静かに保ってください。</numerusform>
        </translation>
    </message>
    <message>
        <source>What was measured</source>
        <translation>測定結果</translation>
    </message>
    <message>
        <source>Patterns</source>
        <translation>パターン</translation>
    </message>
    <message>
        <source>Error of the test patterns</source>
        <translation>テストパターンの誤差</translation>
    </message>
    <message>
        <source>Continue anyway</source>
        <translation>このまま続行</translation>
    </message>
    <message>
        <source>Found while measuring</source>
        <translation>測定中の検出事項</translation>
    </message>
    <message numerus="yes">
        <source>Begins in %n second(s)</source>
        <translation>
            <numerusform>%n 秒後に開始</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Measuring begins in %n second(s). Leave the room dark and still.</source>
        <translation>
            <numerusform>測定は %n 秒後に始まります。部屋を暗く静かに保ってください。</numerusform>
        </translation>
    </message>
    <message>
        <source>Start now</source>
        <translation>今すぐ開始</translation>
    </message>
    <message>
        <source>Not now</source>
        <translation>中止</translation>
    </message>
    <message numerus="yes">
        <source>Compared with the start every %n pattern(s). What changed is photographed again; if that does not help, the measurement pauses and asks.</source>
        <translation>
            <numerusform>パターン %n 枚ごとに開始時と比較します。変化した分は撮り直し、それでも直らない場合は測定を一時停止して確認します。</numerusform>
        </translation>
    </message>
    <message>
        <source>Start</source>
        <translation>開始</translation>
    </message>
    <message>
        <source>Leave the room first</source>
        <translation>先に退室する</translation>
    </message>
    <message>
        <source>Time to leave the room before measuring begins</source>
        <translation>測定開始までの退室時間</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 秒</translation>
    </message>
    <message>
        <source>A sound when it ends or needs me</source>
        <translation>終了時や対応が必要なときに音で知らせる</translation>
    </message>
    <message>
        <source>Ready</source>
        <translation>準備状況</translation>
    </message>
    <message>
        <source>Dark enough</source>
        <translation>十分に暗い</translation>
    </message>
    <message>
        <source>Room light is %1 of full light, limit %2.</source>
        <translation>室内光は全光の %1、限度は %2 です。</translation>
    </message>
    <message>
        <source>It is too bright here</source>
        <translation>明るすぎます</translation>
    </message>
    <message>
        <source>Room light is %1 of full light. Cover windows and lamps: less light, less noise.</source>
        <translation>室内光は全光の %1 です。窓や照明を覆ってください。光が減ればノイズも減ります。</translation>
    </message>
    <message>
        <source>Needs %1 of %2.</source>
        <translation>%2 のうち %1 が必要です。</translation>
    </message>
    <message>
        <source>Room on the disk</source>
        <translation>ディスクの空きは十分</translation>
    </message>
    <message>
        <source>The disk is too full</source>
        <translation>ディスクの空きが足りません</translation>
    </message>
    <message>
        <source>Floodlight image</source>
        <translation>全光画像</translation>
    </message>
    <message>
        <source>the projector fully white</source>
        <translation>プロジェクターは全面白</translation>
    </message>
    <message>
        <source>The surface in the projector&apos;s full light</source>
        <translation>プロジェクターの全光で照らされた面</translation>
    </message>
    <message>
        <source>%1 px</source>
        <translation>%1 px</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%2 中 %1</translation>
    </message>
    <message>
        <source>Level %1 of %2, %3 of %4 patterns.</source>
        <translation>レベル %1 / %2、パターン %3 / %4。</translation>
    </message>
    <message>
        <source>Patterns for each block size</source>
        <translation>ブロックサイズごとのパターン</translation>
    </message>
    <message>
        <source>blocks are divided only where light needs it</source>
        <translation>光に応じて必要な所だけブロックを分割します</translation>
    </message>
    <message>
        <source>Stopped at %1 px</source>
        <translation>%1 px で終了</translation>
    </message>
    <message>
        <source>Measuring was stopped at blocks of %1 px</source>
        <translation>測定は %1 px のブロックで終了しました</translation>
    </message>
    <message>
        <source>Finer light is missing. Go on any time, if nothing has moved.</source>
        <translation>細かい光がまだ測定されていません。何も動いていなければ、いつでも続けられます。</translation>
    </message>
    <message numerus="yes">
        <source>%1 dB expected, about %2 dB with %n more photograph(s), %3. Go on any time, if nothing has moved.</source>
        <translation>
            <numerusform>見込みは %1 dB、あと %n 枚の写真で約 %2 dB、%3。何も動いていなければ、いつでも続けられます。</numerusform>
        </translation>
    </message>
    <message>
        <source>Pictures expected at</source>
        <translation>画像の見込み</translation>
    </message>
    <message>
        <source>rough</source>
        <translation>粗い</translation>
    </message>
    <message>
        <source>fair</source>
        <translation>まずまず</translation>
    </message>
    <message>
        <source>good</source>
        <translation>良好</translation>
    </message>
    <message>
        <source>very good</source>
        <translation>非常に良好</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1、%2</translation>
    </message>
    <message>
        <source>%1 dB</source>
        <translation>%1 dB</translation>
    </message>
    <message>
        <source>dB says how close the picture comes to the one wanted, where it can be reached at all: 20 dB looks rough, 30 dB good, and every 6 dB halve what is off.</source>
        <translation>dB は、到達できる範囲で画像が望みのものにどれだけ近いかを表します。20 dB は粗く、30 dB は良好に見え、6 dB 増えるごとにずれは半分になります。</translation>
    </message>
    <message>
        <source>Compensated so far</source>
        <translation>ここまでの補正</translation>
    </message>
    <message>
        <source>A picture, compensated with what is measured so far</source>
        <translation>ここまでの測定で補正した画像</translation>
    </message>
    <message>
        <source>Appears after the first patterns, and grows sharper.</source>
        <translation>最初のパターンの後に現れ、次第に鮮明になります。</translation>
    </message>
    <message>
        <source>Expected now</source>
        <translation>現在の見込み</translation>
    </message>
    <message>
        <source>Blocks of %1 px. Expected now: %2. In the end: %3.</source>
        <translation>%1 px のブロック。現在の見込み: %2。最終: %3。</translation>
    </message>
    <message>
        <source>In the end</source>
        <translation>最終</translation>
    </message>
    <message>
        <source>Waiting for room on the disk. Nothing is being projected.</source>
        <translation>ディスクの空きを待っています。何も投影していません。</translation>
    </message>
    <message>
        <source>Go on now</source>
        <translation>今すぐ続ける</translation>
    </message>
    <message>
        <source>Photographs to keep</source>
        <translation>残す写真</translation>
    </message>
    <message>
        <source>Photographs to keep once all is measured</source>
        <translation>測定がすべて終わった後に残す写真</translation>
    </message>
    <message>
        <source>All</source>
        <translation>すべて</translation>
    </message>
    <message>
        <source>Of the latest measurement</source>
        <translation>最新の測定のもの</translation>
    </message>
    <message>
        <source>None: results only</source>
        <translation>なし：結果のみ</translation>
    </message>
    <message>
        <source>Those that were set aside by measuring again are removed once all is measured.</source>
        <translation>再測定のときに取り置いた写真は、測定がすべて終わると削除されます。</translation>
    </message>
    <message>
        <source>Removed once all is measured. Other settings then have to photograph everything again.</source>
        <translation>測定がすべて終わると削除されます。別の設定では、すべて撮り直しになります。</translation>
    </message>
    <message>
        <source>Measuring with other settings then needs fewer new photographs.</source>
        <translation>別の設定で測定するとき、新しい写真が少なくて済みます。</translation>
    </message>
    <message>
        <source>Those of the last measurement were removed: all are taken again.</source>
        <translation>前回の測定の写真は削除されているため、すべて撮り直します。</translation>
    </message>
    <message>
        <source>Waiting for the projector&apos;s screen.</source>
        <translation>プロジェクターの画面を待っています。</translation>
    </message>
    <message>
        <source>Every photograph is saved. The earlier measurement is used until the new one is ready.</source>
        <translation>写真はすべて保存されます。新しい測定ができるまで前の測定を使います。</translation>
    </message>
    <message>
        <source>To go on measuring, confirm that the room is clear.</source>
        <translation>測定を続けるには、退避が完了したことを確認してください。</translation>
    </message>
    <message>
        <source>Takes every photograph again. What is measured stays until then.</source>
        <translation>すべての写真を撮り直します。それまで測定結果は残ります。</translation>
    </message>
    <message>
        <source>Measuring again has not ended</source>
        <translation>再測定が終わっていません</translation>
    </message>
    <message>
        <source>Measuring with these settings.</source>
        <translation>この設定で測定中です。</translation>
    </message>
    <message>
        <source>Waiting for the camera.</source>
        <translation>カメラを待っています。</translation>
    </message>
    <message>
        <source>Keep the earlier one</source>
        <translation>前の測定に戻す</translation>
    </message>
    <message>
        <source>The earlier measurement is used again, with all that followed from it.</source>
        <translation>前の測定と、そこから得られたものが再び使われます。</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>測定済みのデータは無事です。</translation>
    </message>
    <message>
        <source>Paused, about %1 left</source>
        <translation>一時停止中、残り約 %1</translation>
    </message>
    <message>
        <source>%1 of about %2</source>
        <translation>約 %2 中 %1</translation>
    </message>
    <message>
        <source>About %1 left</source>
        <translation>残り約 %1</translation>
    </message>
    <message>
        <source>Ends near %1. %2</source>
        <translation>%1 頃に終了。%2</translation>
    </message>
    <message>
        <source>Put the camera back</source>
        <translation>カメラを元に戻す</translation>
    </message>
    <message>
        <source>Test patterns are predicted from the measurement, then photographed: this is how far the two differ, the photographs&apos; noise included.</source>
        <translation>テストパターンを測定結果から予測し、撮影して比べます。これはその差で、写真のノイズを含みます。</translation>
    </message>
    <message>
        <source>%1; light right within about %2</source>
        <translation>%1、光の誤差は約 %2</translation>
    </message>
    <message>
        <source>Reading, %1</source>
        <translation>読み込み中、%1</translation>
    </message>
    <message>
        <source>Waiting for your answer. Every photograph is saved.</source>
        <translation>回答を待っています。写真はすべて保存済みです。</translation>
    </message>
    <message>
        <source>Go on measuring</source>
        <translation>測定を続ける</translation>
    </message>
    <message>
        <source>Answer</source>
        <translation>回答する</translation>
    </message>
    <message>
        <source>Try again</source>
        <translation>再試行</translation>
    </message>
    <message>
        <source>The camera is back at its place</source>
        <translation>カメラは元の位置に戻りました</translation>
    </message>
    <message>
        <source>It had moved while it measured, and looks again where it looked.</source>
        <translation>測定中に動きましたが、元と同じ場所を写しています。</translation>
    </message>
    <message numerus="yes">
        <source>“%1” photographs %n pattern(s) again, from No. %2 on, and goes on from there.</source>
        <translation>
            <numerusform>「%1」は No. %2 からパターン %n 枚を撮り直し、そこから続けます。</numerusform>
        </translation>
    </message>
    <message>
        <source>“%1” looks once more, and goes on.</source>
        <translation>「%1」はもう一度確かめて続けます。</translation>
    </message>
    <message>
        <source>“%1” keeps all as it is: what changed will be wrong, and the report says so.</source>
        <translation>「%1」は現状のまま続けます。変わった箇所は正しくならず、レポートに記されます。</translation>
    </message>
    <message>
        <source>Measuring waits for your answer.</source>
        <translation>測定は回答を待っています。</translation>
    </message>
    <message>
        <source>Kept photographs are read first.</source>
        <translation>先に保存済みの写真を読み込みます。</translation>
    </message>
    <message>
        <source>Nothing is being projected.</source>
        <translation>何も投影していません。</translation>
    </message>
    <message>
        <source>Reading</source>
        <translation>読み込み中</translation>
    </message>
    <message>
        <source>Reading, under a minute left</source>
        <translation>読み込み中、残り 1 分未満</translation>
    </message>
    <message>
        <source>Reading, about %1 left</source>
        <translation>読み込み中、残り約 %1</translation>
    </message>
    <message>
        <source>Paused, under a minute left</source>
        <translation>一時停止、残り 1 分未満</translation>
    </message>
    <message>
        <source>Under a minute left</source>
        <translation>残り 1 分未満</translation>
    </message>
    <message>
        <source>%1 expected</source>
        <translation>見込み %1</translation>
    </message>
    <message>
        <source>To measure again, confirm that the room is clear.</source>
        <translation>測定し直すには、退避が完了したことを確認してください。</translation>
    </message>
    <message>
        <source>%1, %2 a minute</source>
        <translation>%1、毎分 %2</translation>
    </message>
    <message>
        <source>all projectors fully white</source>
        <translation>すべてのプロジェクターが全面白</translation>
    </message>
    <message>
        <source>Reading what was measured</source>
        <translation>測定結果を読み込んでいます</translation>
    </message>
    <message>
        <source>The camera is at its place</source>
        <translation>カメラは元の位置にあります</translation>
    </message>
    <message>
        <source>It looks where it looked. Perhaps the light flickered.</source>
        <translation>以前と同じ所を見ています。光がちらついたのかもしれません。</translation>
    </message>
    <message>
        <source>Ended by a change</source>
        <translation>変化により終了</translation>
    </message>
    <message>
        <source>Put right what changed, then go on measuring.</source>
        <translation>変わったものを元に戻してから、測定を続けてください。</translation>
    </message>
    <message>
        <source>Measure again as it stands now, or put it back and go on measuring.</source>
        <translation>今の状態で再測定するか、元に戻して測定を続けてください。</translation>
    </message>
    <message>
        <source>Measuring was stopped at blocks of %1 px: something had changed</source>
        <translation>%1 px のブロックで測定を終了しました：何かが変わっていました</translation>
    </message>
    <message>
        <source>Measuring ended, and something had changed</source>
        <translation>測定は終わりましたが、何かが変わっていました</translation>
    </message>
    <message>
        <source>What was photographed since the look before is left out, all before it is kept.</source>
        <translation>前回の確認より後の写真は使わず、それより前はすべて残します。</translation>
    </message>
    <message>
        <source>Working out, %1</source>
        <translation>計算中、%1</translation>
    </message>
    <message>
        <source>Working out the result</source>
        <translation>結果を計算中</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s)</source>
        <translation>
            <numerusform>%n パターン</numerusform>
        </translation>
    </message>
    <message>
        <source>Waits for an answer</source>
        <translation>回答待ち</translation>
    </message>
    <message>
        <source>%1 too bright</source>
        <translation>%1 が明るすぎ</translation>
    </message>
    <message>
        <source>%1 left out</source>
        <translation>%1 を除外</translation>
    </message>
    <message>
        <source>Waiting for your answer.</source>
        <translation>回答を待っています。</translation>
    </message>
    <message>
        <source>Stop and keep this one</source>
        <translation>終了してこれを保持</translation>
    </message>
    <message>
        <source>Going on has not ended</source>
        <translation>続きの測定が終わっていません</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s) expected, %1 of them checks; known exactly as each level begins</source>
        <translation>
            <numerusform>%n パターンの見込み、うち %1 は確認。正確な数は各段階の開始時に分かります</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s), %1 of them checks</source>
        <translation>
            <numerusform>%n パターン、うち %1 は確認</numerusform>
        </translation>
    </message>
    <message>
        <source>Ending</source>
        <translation>終了中</translation>
    </message>
    <message>
        <source>Measure with these settings</source>
        <translation>この設定で測定</translation>
    </message>
    <message>
        <source>Use the earlier one</source>
        <translation>以前の測定を使う</translation>
    </message>
    <message>
        <source>Waiting</source>
        <translation>待機中</translation>
    </message>
    <message>
        <source>Waiting, under a minute left</source>
        <translation>待機中、残り 1 分未満</translation>
    </message>
    <message>
        <source>Waiting, about %1 left</source>
        <translation>待機中、残り約 %1</translation>
    </message>
    <message>
        <source>Keep the new ones</source>
        <translation>新しい写真を残す</translation>
    </message>
    <message>
        <source>Keep the earlier measurement?</source>
        <translation>前の測定に戻しますか？</translation>
    </message>
    <message>
        <source>The new photographs are set aside and not used again: measuring again then takes every photograph again.</source>
        <translation>新しい写真は別に移され、もう使われません。再測定では、すべての写真を撮り直します。</translation>
    </message>
    <message>
        <source>The earlier measurement, and all that followed from it.</source>
        <translation>前の測定と、そこから得られたものすべて。</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s) kept</source>
        <translation>
            <numerusform>%n パターンを保持</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The photographs of %n pattern(s) are read first. Then measuring goes on where it ended.</source>
        <translation>
            <numerusform>先に %n パターンの写真を読み込み、続きから測定します。</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The photographs of %n pattern(s) are safe. Resuming gives the same result as if nothing had happened.</source>
        <translation>
            <numerusform>%n パターンの写真は無事です。再開すれば、中断がなかった場合と同じ結果になります。</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The new photographs of %n pattern(s) are safe: resume any time. Until then the earlier measurement is used.</source>
        <translation>
            <numerusform>%n パターンの新しい写真は無事です。いつでも再開できます。それまでは前の測定を使います。</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The photographs of %n pattern(s) are on the disk. The pattern under way is not counted.</source>
        <translation>
            <numerusform>%n パターンの写真はディスクにあります。撮影中のパターンは含みません。</numerusform>
        </translation>
    </message>
    <message>
        <source>Photographs</source>
        <translation>写真</translation>
    </message>
    <message numerus="yes">
        <source>Reading the photographs of %n pattern(s): %1.</source>
        <translation>
            <numerusform>%n パターンの写真を読み込み中：%1</numerusform>
        </translation>
    </message>
    <message>
        <source>Keep the new one</source>
        <translation>新しい測定を残す</translation>
    </message>
    <message>
        <source>Use the earlier measurement?</source>
        <translation>前の測定を使いますか？</translation>
    </message>
    <message>
        <source>%1; lit, within the dashes: %2 of the view</source>
        <translation>%1、照射範囲（破線の内側）は視野の %2</translation>
    </message>
    <message>
        <source>Stopped after %1</source>
        <translation>%1で停止</translation>
    </message>
    <message>
        <source>Stopped early: light finer than blocks of %1 px is missing.</source>
        <translation>途中で停止しました：%1 px のブロックより細かい光は含まれません。</translation>
    </message>
    <message>
        <source>Again, not ended</source>
        <translation>再測定は未完了</translation>
    </message>
    <message>
        <source>What was measured cannot be read</source>
        <translation>測定内容を読み込めません</translation>
    </message>
    <message>
        <source>Use the earlier measurement, or measure again.</source>
        <translation>以前の測定を使うか、再測定してください。</translation>
    </message>
    <message>
        <source>Measure again.</source>
        <translation>再測定してください。</translation>
    </message>
    <message>
        <source>%1 dB expected: what was measured does not fit together, and pictures are no better than uncorrected.</source>
        <translation>予測 %1 dB：測定内容が互いに合わず、補正しない場合より良くなりません。</translation>
    </message>
    <message>
        <source>%1 dB expected. Go on any time, if nothing has moved.</source>
        <translation>予測 %1 dB。何も動いていなければいつでも続けられます。</translation>
    </message>
    <message>
        <source>What was measured cannot be read.</source>
        <translation>測定内容を読み込めません。</translation>
    </message>
    <message>
        <source>%1: what was photographed since the check before is taken again.</source>
        <translation>%1：前回の確認以降に撮影したものを撮り直しています。</translation>
    </message>
    <message>
        <source>The light of the room was another one, too: see that it is as it was.</source>
        <translation>部屋の照明も変わっていました。元に戻っていることを確認してください。</translation>
    </message>
    <message>
        <source>Ending: what is begun is photographed to its end, and test patterns. Then all of it is kept.</source>
        <translation>終了中：始めた分と検証パターンを最後まで撮影し、すべて保存します。</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the patterns flash.</source>
        <translation>退避が完了したことを確認してください。パターンは点滅します。</translation>
    </message>
    <message>
        <source>%1: all patterns are taken again, from the first.</source>
        <translation>%1: すべてのパターンを最初から撮り直しています。</translation>
    </message>
    <message>
        <source>Measured in %1, and repaired since</source>
        <translation>測定時間 %1、その後修復</translation>
    </message>
    <message>
        <source>Photographs of the repair since</source>
        <translation>その後の修復の撮影枚数</translation>
    </message>
    <message>
        <source>Stopped too early</source>
        <translation>停止が早すぎます</translation>
    </message>
</context>
<context>
    <name>relucent::gui::AcquisitionTrace</name>
    <message>
        <source>the light flickered</source>
        <translation>光がちらつきました</translation>
    </message>
    <message>
        <source>the room light changed</source>
        <translation>室内光が変わりました</translation>
    </message>
    <message>
        <source>the projector&apos;s light changed</source>
        <translation>プロジェクターの光が変わりました</translation>
    </message>
    <message>
        <source>the camera or the projector moved</source>
        <translation>カメラかプロジェクターが動きました</translation>
    </message>
    <message>
        <source>the picture was not the one sent</source>
        <translation>送った画像ではありませんでした</translation>
    </message>
    <message>
        <source>the camera saw nothing</source>
        <translation>カメラに何も写りませんでした</translation>
    </message>
    <message>
        <source>the projector showed nothing</source>
        <translation>プロジェクターに何も映りませんでした</translation>
    </message>
    <message>
        <source>too bright, shorter exposure</source>
        <translation>明るすぎ、露光を短縮</translation>
    </message>
    <message>
        <source>does not fit what was seen before</source>
        <translation>以前の結果と合いません</translation>
    </message>
    <message>
        <source>No. %1</source>
        <translation>%1 番</translation>
    </message>
    <message>
        <source>No. %1 to %2</source>
        <translation>%1～%2 番</translation>
    </message>
    <message>
        <source>Room light</source>
        <translation>室内光</translation>
    </message>
    <message>
        <source>Camera and view</source>
        <translation>カメラと視野</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>プロジェクター</translation>
    </message>
    <message>
        <source>Flicker</source>
        <translation>ちらつき</translation>
    </message>
    <message>
        <source>Room light steady</source>
        <translation>室内光は安定</translation>
    </message>
    <message>
        <source>Room light changed</source>
        <translation>室内光が変わりました</translation>
    </message>
    <message>
        <source>%1 of full light, changed by %2 since the start.</source>
        <translation>全点灯の %1、開始時から %2 変化。</translation>
    </message>
    <message>
        <source>Camera still</source>
        <translation>カメラは静止</translation>
    </message>
    <message>
        <source>The view changed</source>
        <translation>視野が変わりました</translation>
    </message>
    <message>
        <source>The view differs by %1 from the first.</source>
        <translation>最初の視野との差は %1 です。</translation>
    </message>
    <message>
        <source>Projector steady</source>
        <translation>プロジェクターは安定</translation>
    </message>
    <message>
        <source>The projector&apos;s light changed</source>
        <translation>プロジェクターの光が変わりました</translation>
    </message>
    <message>
        <source>Its light drifted by %1 and is corrected.</source>
        <translation>光のずれ %1 は補正されます。</translation>
    </message>
    <message>
        <source>No flicker</source>
        <translation>ちらつきなし</translation>
    </message>
    <message>
        <source>Photographs of one pattern agree within %1.</source>
        <translation>同じパターンの写真の差は %1 以内です。</translation>
    </message>
    <message>
        <source>No difference between photographs of one pattern was found.</source>
        <translation>同じパターンの写真に差はありませんでした。</translation>
    </message>
    <message>
        <source>The camera or the projector moved</source>
        <translation>カメラかプロジェクターが動きました</translation>
    </message>
    <message>
        <source>The picture is not the one sent</source>
        <translation>送った画像と違います</translation>
    </message>
    <message>
        <source>The camera sees nothing</source>
        <translation>カメラに何も見えません</translation>
    </message>
    <message>
        <source>The projector shows nothing</source>
        <translation>プロジェクターに何も映っていません</translation>
    </message>
    <message>
        <source>Put right</source>
        <translation>対処済み</translation>
    </message>
    <message>
        <source>Looked at again at the next check.</source>
        <translation>次の確認でもう一度調べます。</translation>
    </message>
    <message>
        <source>the light flickered, or something moved</source>
        <translation>光がちらついたか、何かが動きました</translation>
    </message>
    <message>
        <source>The light flickers, or something moves</source>
        <translation>光がちらついているか、何かが動いています</translation>
    </message>
    <message>
        <source>Not known while the view has changed.</source>
        <translation>視野が違う間は分かりません。</translation>
    </message>
    <message>
        <source>The light flickers, or was switched</source>
        <translation>光がちらついているか、点灯・消灯されました</translation>
    </message>
    <message>
        <source>Photographed again</source>
        <translation>撮り直しました</translation>
    </message>
    <message>
        <source>dark: lens covered for a moment?</source>
        <translation>暗い：レンズが一時覆われた？</translation>
    </message>
    <message>
        <source>Found since the last check.</source>
        <translation>前回の確認のあとに見つかりました。</translation>
    </message>
    <message>
        <source>something in the view changed</source>
        <translation>視野内の何かが変わりました</translation>
    </message>
    <message>
        <source>Something in the view changed</source>
        <translation>視野内の何かが変わりました</translation>
    </message>
    <message>
        <source>Not known while the camera sees nothing.</source>
        <translation>カメラに何も写っていない間は分かりません。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ActionBar</name>
    <message>
        <source>Progress of the measurement</source>
        <translation>測定の進行状況</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>戻る</translation>
    </message>
    <message>
        <source>Show where</source>
        <translation>場所を表示</translation>
    </message>
</context>
<context>
    <name>relucent::gui::CameraPage</name>
    <message>
        <source>Choose</source>
        <translation>選択</translation>
    </message>
    <message>
        <source>Choose %1</source>
        <translation>%1 を選択</translation>
    </message>
    <message>
        <source>Choose the one that looks at the surface.</source>
        <translation>投影面に向いているカメラを選んでください。</translation>
    </message>
    <message>
        <source>Looking for cameras</source>
        <translation>カメラを検索中</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>何も変更していません。</translation>
    </message>
    <message>
        <source>Checking</source>
        <translation>確認中</translation>
    </message>
    <message>
        <source>Checked %1</source>
        <translation>%1 に確認</translation>
    </message>
    <message>
        <source>Choose the camera that looks at the surface.</source>
        <translation>投影面に向いているカメラを選んでください。</translation>
    </message>
    <message>
        <source>Opening the devices</source>
        <translation>機器への接続</translation>
    </message>
    <message>
        <source>%1 is too bright in every exposure.</source>
        <translation>%1 がどの露出でも明るすぎます。</translation>
    </message>
    <message>
        <source>Look through the camera first.</source>
        <translation>先にライブビューで確認してください。</translation>
    </message>
    <message>
        <source>Next: test patterns for the projector&apos;s response</source>
        <translation>次：プロジェクターの応答を測るテストパターン</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>一時停止</translation>
    </message>
    <message>
        <source>Check again</source>
        <translation>再確認</translation>
    </message>
    <message>
        <source>Choose another camera</source>
        <translation>別のカメラを選択</translation>
    </message>
    <message>
        <source>Focus area</source>
        <translation>ピント領域</translation>
    </message>
    <message>
        <source>Nothing is measured at this step, so nothing is lost.</source>
        <translation>このステップでは何も測定しないため、失われるものはありません。</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>カメラ</translation>
    </message>
    <message>
        <source>Frame the surface, focus, and let the exposures cover its brightest and darkest parts.</source>
        <translation>投影面を構図に収め、ピントを合わせ、最も明るい部分と暗い部分まで露出でカバーします。</translation>
    </message>
    <message>
        <source>Focus, %1 of best</source>
        <translation>ピント、最良値の %1</translation>
    </message>
    <message>
        <source>Camera view</source>
        <translation>カメラ視野</translation>
    </message>
    <message>
        <source>What the camera sees now</source>
        <translation>カメラに今映っているもの</translation>
    </message>
    <message>
        <source>The camera is not being looked through.</source>
        <translation>ライブビューは停止しています。</translation>
    </message>
    <message>
        <source>Light in this exposure: red, green, blue</source>
        <translation>この露出での光：赤、緑、青</translation>
    </message>
    <message>
        <source>Signal</source>
        <translation>信号</translation>
    </message>
    <message>
        <source>Focus</source>
        <translation>ピント</translation>
    </message>
    <message>
        <source>Turn the lens until the bar stays at the mark: the best so far.</source>
        <translation>バーが印（これまでの最良値）で止まるまでレンズを回してください。</translation>
    </message>
    <message>
        <source>Exposures</source>
        <translation>露出</translation>
    </message>
    <message>
        <source>Checks</source>
        <translation>確認項目</translation>
    </message>
    <message>
        <source>Signal, share of full</source>
        <translation>信号（最大値に対する割合）</translation>
    </message>
    <message>
        <source>Pixels</source>
        <translation>画素</translation>
    </message>
    <message>
        <source>The camera sees the projector</source>
        <translation>プロジェクターの光を検出済み</translation>
    </message>
    <message>
        <source>White and black differ as they should.</source>
        <translation>白と黒の差は正常です。</translation>
    </message>
    <message>
        <source>Bright parts are covered</source>
        <translation>明るい部分はカバー済み</translation>
    </message>
    <message>
        <source>%1 is too bright in every exposure</source>
        <translation>%1 がどの露出でも明るすぎます</translation>
    </message>
    <message>
        <source>Close the lens a little, or shade lamps in the view.</source>
        <translation>レンズを少し絞るか、視野内の照明を遮ってください。</translation>
    </message>
    <message>
        <source>Dark parts are covered</source>
        <translation>暗い部分はカバー済み</translation>
    </message>
    <message>
        <source>%1 is too dark in every exposure</source>
        <translation>%1 がどの露出でも暗すぎます</translation>
    </message>
    <message>
        <source>The projector may not reach there. Where it should, open the lens.</source>
        <translation>プロジェクターの光が届かない場所かもしれません。届くはずなら、レンズの絞りを開けてください。</translation>
    </message>
    <message>
        <source>Keep exposures</source>
        <translation>露出を保持</translation>
    </message>
    <message>
        <source>too bright to tell</source>
        <translation>明るすぎて判定できません</translation>
    </message>
    <message>
        <source>Too bright %1</source>
        <translation>明るすぎ %1</translation>
    </message>
    <message>
        <source>Too dark %1</source>
        <translation>暗すぎ %1</translation>
    </message>
    <message>
        <source>No camera is chosen yet</source>
        <translation>カメラが選ばれていません</translation>
    </message>
    <message>
        <source>Camera pixels</source>
        <translation>カメラの画素</translation>
    </message>
    <message>
        <source>As many as needed: %1</source>
        <translation>必要なだけ: %1</translation>
    </message>
    <message>
        <source>All: %1</source>
        <translation>すべて: %1</translation>
    </message>
    <message>
        <source>%1 become one: %2</source>
        <translation>%1 を 1 つに: %2</translation>
    </message>
    <message>
        <source>Camera pixels that are used</source>
        <translation>使用するカメラの画素</translation>
    </message>
    <message>
        <source>Memory</source>
        <translation>メモリ</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>ディスク</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>時間</translation>
    </message>
    <message>
        <source>More camera pixels than projector pixels show nothing more. The photographs that prove the result stay as large as they are.</source>
        <translation>プロジェクターより多いカメラ画素があっても、得られるものは増えません。結果を確かめる写真は元の大きさのままです。</translation>
    </message>
    <message>
        <source>Mark what is sharp</source>
        <translation>鮮明な所に印</translation>
    </message>
    <message>
        <source>Checked before. Check again if camera or projector were moved.</source>
        <translation>確認済みです。カメラかプロジェクターを動かした場合は、もう一度確認してください。</translation>
    </message>
    <message>
        <source>Continue</source>
        <translation>続ける</translation>
    </message>
    <message>
        <source>Exposure times</source>
        <translation>露出時間</translation>
    </message>
    <message>
        <source>The projector&apos;s picture: the camera sees %1 of it</source>
        <translation>プロジェクターの画像：カメラに見えるのは %1</translation>
    </message>
    <message>
        <source>at the left</source>
        <translation>左</translation>
    </message>
    <message>
        <source>at the right</source>
        <translation>右</translation>
    </message>
    <message>
        <source>at the top</source>
        <translation>上</translation>
    </message>
    <message>
        <source>at the bottom</source>
        <translation>下</translation>
    </message>
    <message>
        <source>Missing are places within it: in shadow, or too dark for the camera.</source>
        <translation>内側に見えない部分があります。影になっているか、カメラには暗すぎます。</translation>
    </message>
    <message>
        <source>Missing: %1. Aim the camera there, or move it back.</source>
        <translation>見えない側：%1。カメラをそちらへ向けるか、後ろへ下げてください。</translation>
    </message>
    <message>
        <source>%1 of the projector&apos;s picture is seen</source>
        <translation>プロジェクターの画像の %1 が見えています</translation>
    </message>
    <message>
        <source>%1 of projector %2&apos;s picture is seen</source>
        <translation>プロジェクター %2 の画像の %1 が見えています</translation>
    </message>
    <message>
        <source>Every exposure is a multiple of %1</source>
        <translation>露出はすべて %1 の倍数です</translation>
    </message>
    <message>
        <source>The projector&apos;s light changes as quickly as that: each photograph has all of it.</source>
        <translation>プロジェクターの光はこの周期で変わります。どの写真もその全体を含みます。</translation>
    </message>
    <message>
        <source>Allow any exposure</source>
        <translation>どの露出も使う</translation>
    </message>
    <message>
        <source>Exposures shorter than %1 flicker</source>
        <translation>%1 より短い露出はちらつきます</translation>
    </message>
    <message>
        <source>The projector&apos;s light changes within that time.</source>
        <translation>プロジェクターの光はこの時間のうちに変わります。</translation>
    </message>
    <message>
        <source>Use multiples of %1</source>
        <translation>%1 の倍数を使う</translation>
    </message>
    <message>
        <source>Checked before</source>
        <translation>確認済み</translation>
    </message>
    <message>
        <source>These exposures are kept. “Check again” looks through the camera.</source>
        <translation>これらの露出は保存されています。「再確認」でカメラの映像を見ます。</translation>
    </message>
    <message>
        <source>Not checked yet</source>
        <translation>まだ確認していません</translation>
    </message>
    <message>
        <source>Missing: %1. A simulated camera stays where it stands: go on, what it does not see is left as it is.</source>
        <translation>見えていない部分：%1。シミュレーションのカメラは動かせません。このまま進んでください。見えない部分はそのまま残ります。</translation>
    </message>
    <message>
        <source>Exposures as measured</source>
        <translation>測定時の露出</translation>
    </message>
    <message>
        <source>Camera %1: %2 is too bright in every exposure.</source>
        <translation>カメラ %1: どの露出でも %2 が明るすぎます。</translation>
    </message>
    <message>
        <source>What %1 sees now</source>
        <translation>%1 に今見えているもの</translation>
    </message>
    <message>
        <source>Focus %1</source>
        <translation>ピント %1</translation>
    </message>
    <message numerus="yes">
        <source>%n projector(s): %1</source>
        <translation>
            <numerusform>プロジェクター %n 台: %1</numerusform>
        </translation>
    </message>
    <message>
        <source>Light</source>
        <translation>光</translation>
    </message>
    <message>
        <source>Overlap</source>
        <translation>重なり</translation>
    </message>
    <message>
        <source>how many projectors light each place</source>
        <translation>各所を照らすプロジェクターの数</translation>
    </message>
    <message>
        <source>Checks done</source>
        <translation>確認完了</translation>
    </message>
    <message>
        <source>%1 of every picture is seen</source>
        <translation>どの映像も %1 が見えています</translation>
    </message>
    <message>
        <source>Exposures, kept</source>
        <translation>露出（保存済み）</translation>
    </message>
    <message>
        <source>Check again to look with another one.</source>
        <translation>別の露出で見るには、もう一度確認します。</translation>
    </message>
    <message>
        <source>Exposures, paused</source>
        <translation>露出（一時停止中）</translation>
    </message>
    <message>
        <source>places within it</source>
        <translation>内側の一部</translation>
    </message>
    <message>
        <source>All of the view, by one exposure or another.</source>
        <translation>視野全体が、いずれかの露出で。</translation>
    </message>
    <message>
        <source>All but %1 of the view, by one exposure or another.</source>
        <translation>視野の %1 を除くすべてが、いずれかの露出で。</translation>
    </message>
    <message>
        <source>%1 too bright</source>
        <translation>%1 が明るすぎ</translation>
    </message>
    <message>
        <source>Keep the former camera</source>
        <translation>前のカメラを使い続ける</translation>
    </message>
    <message>
        <source>exposure %1, click to judge focus</source>
        <translation>露出 %1、クリックでピントを評価</translation>
    </message>
    <message>
        <source>Checks under way</source>
        <translation>確認中</translation>
    </message>
    <message>
        <source>Stop the checks</source>
        <translation>チェックを中止</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the checks begin with that.</source>
        <translation>退避が完了したことを確認してください。確認するとチェックが始まります。</translation>
    </message>
    <message>
        <source>as it was seen last, exposure %1</source>
        <translation>最後に見た状態、露出 %1</translation>
    </message>
    <message>
        <source>%1 of full light was too bright in every exposure. “Check again” looks through the camera.</source>
        <translation>全光の %1 がどの露出でも明るすぎました。「再確認」でカメラの映像を見ます。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::CameraRows</name>
    <message>
        <source>Cameras</source>
        <translation>カメラ</translation>
    </message>
    <message>
        <source>Look again</source>
        <translation>再検索</translation>
    </message>
    <message>
        <source>Looking for cameras</source>
        <translation>カメラを検索中</translation>
    </message>
    <message>
        <source>Cannot be used: %1</source>
        <translation>使用できません：%1</translation>
    </message>
    <message numerus="yes">
        <source>%1 pixels, %n bit(s), exposures %2 to %3</source>
        <translation>
            <numerusform>%1 画素、%n ビット、露出 %2～%3</numerusform>
        </translation>
    </message>
    <message>
        <source>Recommended: it tells faint light apart best</source>
        <translation>おすすめ: かすかな光を最もよく区別します</translation>
    </message>
    <message>
        <source>Fewer bits: faint light is told apart less well</source>
        <translation>ビット数が少なく、かすかな光の区別が劣ります</translation>
    </message>
    <message>
        <source>Recommended: its exposures cover most, from bright to dark</source>
        <translation>おすすめ: 露出の範囲が明から暗まで最も広い</translation>
    </message>
    <message>
        <source>Fewer exposures: bright and dark are harder to cover</source>
        <translation>露出の範囲が狭く、明暗を収めにくくなります</translation>
    </message>
    <message>
        <source>Recommended: it has most pixels</source>
        <translation>おすすめ: 画素数が最も多い</translation>
    </message>
    <message>
        <source>Fewer pixels than the first</source>
        <translation>最初のものより画素数が少ない</translation>
    </message>
    <message>
        <source>As suitable as the first</source>
        <translation>最初のものと同じくらい適しています</translation>
    </message>
    <message>
        <source>No camera answers. Check its cable and its power, and close other programs that use it.</source>
        <translation>応答するカメラがありません。ケーブルと電源を確認し、カメラを使っているほかのプログラムを終了してください。</translation>
    </message>
    <message>
        <source>These are found here: webcams and other video devices, industrial cameras by GigE Vision or USB3 Vision, and still cameras on USB.</source>
        <translation>ここに表示されるもの：ウェブカメラなどのビデオ機器、GigE VisionまたはUSB3 Visionの産業用カメラ、USB接続のスチルカメラ。</translation>
    </message>
    <message>
        <source>Any other is driven by a program of yours: go Back and choose “New venue by script”. The guide (F1) tells how cameras are set up.</source>
        <translation>そのほかのカメラは、お手持ちのプログラムで動かします。「戻る」を押し、「スクリプトで新しい会場」を選んでください。カメラの準備はガイド（F1）にあります。</translation>
    </message>
    <message>
        <source>Any other is driven by a program of yours. The guide (F1) tells how cameras are set up.</source>
        <translation>そのほかのカメラは、お手持ちのプログラムで動かします。カメラの準備はガイド（F1）にあります。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ClusterPage</name>
    <message>
        <source>What is measured is safe.</source>
        <translation>測定済みのデータは無事です。</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>要更新</translation>
    </message>
    <message>
        <source>Grouping again</source>
        <translation>クラスター分けをやり直し中</translation>
    </message>
    <message>
        <source>Grouping</source>
        <translation>クラスター分け中</translation>
    </message>
    <message>
        <source>Reading the light transport</source>
        <translation>光輸送の読み込み</translation>
    </message>
    <message>
        <source>Preview content</source>
        <translation>プレビューへ</translation>
    </message>
    <message>
        <source>The clusters that are kept belong to an earlier threshold</source>
        <translation>保持しているクラスターは以前のしきい値によるものです</translation>
    </message>
    <message>
        <source>What you see here has been grouped again. Going on keeps it.</source>
        <translation>ここに見えるのは新しいクラスター分けです。先へ進むと保持されます。</translation>
    </message>
    <message>
        <source>Cluster</source>
        <translation>クラスター</translation>
    </message>
    <message>
        <source>Cluster map</source>
        <translation>クラスターマップ</translation>
    </message>
    <message>
        <source>click a pixel</source>
        <translation>画素をクリック</translation>
    </message>
    <message>
        <source>Error map</source>
        <translation>誤差マップ</translation>
    </message>
    <message>
        <source>Flat</source>
        <translation>平面</translation>
    </message>
    <message>
        <source>Relief</source>
        <translation>立体</translation>
    </message>
    <message>
        <source>Cluster sizes</source>
        <translation>クラスターサイズ</translation>
    </message>
    <message>
        <source>Projector pixels in the cluster</source>
        <translation>クラスター内のプロジェクター画素数</translation>
    </message>
    <message>
        <source>Clusters</source>
        <translation>クラスター</translation>
    </message>
    <message>
        <source>%1, %2: in no cluster</source>
        <translation>%1, %2：クラスターなし</translation>
    </message>
    <message>
        <source>Error map, median %1</source>
        <translation>誤差マップ、中央値 %1</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>距離</translation>
    </message>
    <message>
        <source>small, sharp</source>
        <translation>小さく、精細</translation>
    </message>
    <message>
        <source>large, fast</source>
        <translation>大きく、高速</translation>
    </message>
    <message>
        <source>Share of the brightest</source>
        <translation>最大値に対する割合</translation>
    </message>
    <message>
        <source>more detail</source>
        <translation>精細さ重視</translation>
    </message>
    <message>
        <source>more speed</source>
        <translation>速度重視</translation>
    </message>
    <message>
        <source>Largest cluster</source>
        <translation>最大クラスター</translation>
    </message>
    <message>
        <source>fast</source>
        <translation>高速</translation>
    </message>
    <message>
        <source>exact</source>
        <translation>正確</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>結果</translation>
    </message>
    <message>
        <source>Light kept in clusters</source>
        <translation>クラスター内に残る光</translation>
    </message>
    <message>
        <source>Median error</source>
        <translation>誤差の中央値</translation>
    </message>
    <message>
        <source>%1 px</source>
        <translation>%1 px</translation>
    </message>
    <message>
        <source>%1 of light</source>
        <translation>光の %1</translation>
    </message>
    <message numerus="yes">
        <source>%n cluster(s)</source>
        <translation>
            <numerusform>クラスター %n 個</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n cluster(s), median %1 px</source>
        <translation>
            <numerusform>クラスター %n 個、中央値 %1 px</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1, %2: %n projector pixel(s), error %3</source>
        <translation>
            <numerusform>%1, %2：プロジェクター画素 %n、誤差 %3</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Cluster map, %n cluster(s), largest %1</source>
        <translation>
            <numerusform>クラスターマップ、クラスター %n 個、最大 %1</numerusform>
        </translation>
    </message>
    <message>
        <source>95 % of pixels below</source>
        <translation>画素の 95 % が以下</translation>
    </message>
    <message numerus="yes">
        <source>%1, %2: %n projector pixel(s)</source>
        <translation>
            <numerusform>%1, %2：プロジェクター画素 %n</numerusform>
        </translation>
    </message>
    <message>
        <source>error</source>
        <translation>誤差</translation>
    </message>
    <message>
        <source>limit %1</source>
        <translation>上限 %1</translation>
    </message>
    <message>
        <source>over %1</source>
        <translation>%1 以上</translation>
    </message>
    <message>
        <source>about %1</source>
        <translation>約 %1</translation>
    </message>
    <message>
        <source>Cut off by the size limit</source>
        <translation>上限で切られた光</translation>
    </message>
    <message>
        <source>Films, frames a second</source>
        <translation>動画、毎秒フレーム数</translation>
    </message>
    <message>
        <source>What this computer manages in Full HD with the light that Threshold keeps. The groups make no difference to it: films are solved in overlapping windows.</source>
        <translation>しきい値で残した光を使って、このコンピューターがフル HD で出せる速さです。グループによって変わりません。動画は重なり合う局所窓で解きます。</translation>
    </message>
    <message>
        <source>Without a size limit, one cluster would cover %1 of the picture.</source>
        <translation>上限がなければ、1 つのクラスターが画像の %1 を占めます。</translation>
    </message>
    <message>
        <source>The surface is blurred across neighbouring pixels, so groups join up. The limit keeps them apart.</source>
        <translation>面のぼけが隣の画素に広がるため、グループがつながります。上限がそれを分けます。</translation>
    </message>
    <message>
        <source>The clusters that are kept belong to an earlier measurement</source>
        <translation>保持しているクラスターは以前の測定によるものです</translation>
    </message>
    <message>
        <source>Films are shown by “All bounces, for films”, whatever the clusters are. Clusters tell which places light each other, and can be compared at Preview.</source>
        <translation>動画は、クラスターにかかわらず「相互反射すべて、動画用」で表示されます。クラスターは互いに照らし合う場所を示し、プレビューで比較できます。</translation>
    </message>
    <message>
        <source>See which parts of the surface light each other, and split them into groups that can be solved on their own.</source>
        <translation>投影面のどの部分が互いに照らし合うかを調べ、個別に解けるグループに分けます。</translation>
    </message>
    <message>
        <source>Grouped anew</source>
        <translation>新たに分割済み</translation>
    </message>
    <message>
        <source>Changed: it is applied as soon as you go on.</source>
        <translation>変更済み：次へ進むと適用されます。</translation>
    </message>
    <message>
        <source>What was measured is too coarse to group. Go on measuring.</source>
        <translation>測定が粗すぎて、グループに分けられません。測定を続けてください。</translation>
    </message>
    <message>
        <source>No light is strong enough to group.</source>
        <translation>グループに分けられるほど強い光がありません。</translation>
    </message>
    <message>
        <source>Reliefs need OpenGL, which is not there.</source>
        <translation>立体表示には OpenGL が必要です。</translation>
    </message>
    <message>
        <source>An error of %1 is normal here.</source>
        <translation>ここでは %1 の誤差は正常です。</translation>
    </message>
    <message>
        <source>Grouping drops the blur of the lens on purpose: little where it is sharp, 70 to 80 % where it is blurred. Look for patches that stand out from their surroundings.</source>
        <translation>クラスター分けでは、レンズのボケを意図的に除きます。鮮明なところではわずか、ボケたところでは 70～80 % です。周囲から目立つ部分がないか確認してください。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::CornerView</name>
    <message>
        <source>Top left corner, %1, %2.</source>
        <translation>左上の角、%1, %2。</translation>
    </message>
    <message>
        <source>Top right corner, %1, %2.</source>
        <translation>右上の角、%1, %2。</translation>
    </message>
    <message>
        <source>Bottom right corner, %1, %2.</source>
        <translation>右下の角、%1, %2。</translation>
    </message>
    <message>
        <source>Bottom left corner, %1, %2.</source>
        <translation>左下の角、%1, %2。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::DevicePage</name>
    <message>
        <source>A show is playing</source>
        <translation>ショーを再生中です</translation>
    </message>
    <message>
        <source>What is begun here shines in its place. The show is seen again once it has ended.</source>
        <translation>ここで始めた作業の光が代わりに投影されます。終わるとショーに戻ります。</translation>
    </message>
    <message>
        <source>Another program plays a show of this venue</source>
        <translation>別のプログラムがこの会場のショーを再生しています</translation>
    </message>
    <message>
        <source>The show plays on.</source>
        <translation>ショーは続いています。</translation>
    </message>
    <message>
        <source>End that show</source>
        <translation>そのショーを終了</translation>
    </message>
    <message>
        <source>End the show</source>
        <translation>ショーを終了</translation>
    </message>
    <message>
        <source>Let it play</source>
        <translation>再生を続ける</translation>
    </message>
    <message>
        <source>The show that another program plays of this venue: the projector&apos;s screen goes dark.</source>
        <translation>別のプログラムが再生しているこの会場のショー：プロジェクターの画面が暗くなります。</translation>
    </message>
    <message>
        <source>Venue and playlist stay. An installed show starts again at the next log-in.</source>
        <translation>会場とプレイリストは残ります。インストール済みのショーは次のログイン時に再び始まります。</translation>
    </message>
    <message>
        <source>Its pictures shine on the projector whatever is shown from here, and may come between patterns that are measured.</source>
        <translation>ここから何を表示しても、その画像がプロジェクターに映り、測定するパターンの間に現れることがあります。</translation>
    </message>
    <message>
        <source>It is ending</source>
        <translation>終了しています</translation>
    </message>
    <message>
        <source>The show that another program plays of another venue: the projector&apos;s screen goes dark.</source>
        <translation>別のプログラムが再生している別の会場のショー：プロジェクターの画面が暗くなります。</translation>
    </message>
    <message>
        <source>Another program plays a show of another venue on this projector</source>
        <translation>別のプログラムがこのプロジェクターで別の会場のショーを再生しています</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged. Plug it in again: the show comes back by itself.</source>
        <translation>プロジェクターの画面が外れています。接続し直すと、ショーは自動的に戻ります。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::DeviceSelector</name>
    <message>
        <source>Projector that is shown</source>
        <translation>表示中のプロジェクター</translation>
    </message>
    <message>
        <source>Camera that is shown</source>
        <translation>表示中のカメラ</translation>
    </message>
</context>
<context>
    <name>relucent::gui::EndingDialog</name>
    <message>
        <source>Ending</source>
        <translation>終了中</translation>
    </message>
    <message>
        <source>Ending…</source>
        <translation>終了中…</translation>
    </message>
    <message>
        <source>Everything that was measured is safe. The devices finish what they are doing, which can take half a minute; then this window closes by itself.</source>
        <translation>測定したものはすべて安全です。機器が作業を終えるまで 30 秒ほどかかることがあります。その後、このウィンドウは自動で閉じます。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::FailureDialog</name>
    <message>
        <source>The disk did not do what was asked</source>
        <translation>ディスクの操作に失敗しました</translation>
    </message>
    <message>
        <source>The memory is full</source>
        <translation>メモリがいっぱいです</translation>
    </message>
    <message>
        <source>A file cannot be read</source>
        <translation>ファイルを読み込めません</translation>
    </message>
    <message>
        <source>This cannot be done as it is</source>
        <translation>このままでは実行できません</translation>
    </message>
    <message>
        <source>The computation failed</source>
        <translation>計算に失敗しました</translation>
    </message>
    <message>
        <source>What happened</source>
        <translation>発生した問題</translation>
    </message>
    <message>
        <source>What is safe</source>
        <translation>無事なもの</translation>
    </message>
    <message>
        <source>What to do</source>
        <translation>対処方法</translation>
    </message>
    <message>
        <source>Copy details</source>
        <translation>詳細をコピー</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>閉じる</translation>
    </message>
    <message>
        <source>What it ends</source>
        <translation>終了するもの</translation>
    </message>
    <message>
        <source>What happens</source>
        <translation>起きること</translation>
    </message>
    <message>
        <source>A device did not do what was asked</source>
        <translation>機器の操作に失敗しました</translation>
    </message>
</context>
<context>
    <name>relucent::gui::FlashConsent</name>
    <message>
        <source>The projector shows patterns that change as quickly as the devices can, perhaps more than 3 times a second.</source>
        <translation>プロジェクターが、機器の最高速で切り替わるパターンを表示します。毎秒 3 回を超えることがあります。</translation>
    </message>
    <message>
        <source>The room is clear</source>
        <translation>退避完了</translation>
    </message>
    <message>
        <source>Flashing light</source>
        <translation>点滅光</translation>
    </message>
    <message>
        <source>The room is clear and everyone here knows</source>
        <translation>退避完了、ここにいる全員に周知済み</translation>
    </message>
    <message>
        <source>Flashing light can cause seizures. Clear the room and cover the entrance.</source>
        <translation>点滅光は発作を引き起こすことがあります。室内から人を退避させ、入口を覆ってください。</translation>
    </message>
    <message numerus="yes">
        <source>The projector shows patterns that change about %n time(s) a second, and at times more often.</source>
        <translation>
            <numerusform>プロジェクターが毎秒約 %n 回切り替わるパターンを表示します。もっと速いこともあります。</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::gui::HelpWindow</name>
    <message>
        <source>Help</source>
        <translation>ヘルプ</translation>
    </message>
    <message>
        <source>Search the guide</source>
        <translation>ガイドを検索</translation>
    </message>
    <message>
        <source>Pages of the guide</source>
        <translation>ガイドのページ</translation>
    </message>
    <message>
        <source>The page</source>
        <translation>ページ</translation>
    </message>
    <message>
        <source>No page holds these words.</source>
        <translation>この語句を含むページはありません。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::IdentifyOverlay</name>
    <message>
        <source>%1, %2 × %3, %4 Hz</source>
        <translation>%1、%2 × %3、%4 Hz</translation>
    </message>
    <message>
        <source>Lines sharp? Then this is the projector&apos;s own resolution.</source>
        <translation>線がくっきり見えれば、プロジェクター本来の解像度です。</translation>
    </message>
    <message>
        <source>Screen %1</source>
        <translation>画面 %1</translation>
    </message>
</context>
<context>
    <name>relucent::gui::LinearizePage</name>
    <message>
        <source>The photographs of this step are still in the folder.</source>
        <translation>このステップの写真はフォルダーに残っています。</translation>
    </message>
    <message>
        <source>Measuring, %1</source>
        <translation>測定中、%1</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>測定済み</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>要更新</translation>
    </message>
    <message>
        <source>Stopped by a failure</source>
        <translation>エラーで停止</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>機器は「%1」で使用中です。</translation>
    </message>
    <message>
        <source>The colours do not add up. Continuing is recorded in the report.</source>
        <translation>色の加法性が成り立ちません。続行すると、レポートに記録されます。</translation>
    </message>
    <message>
        <source>Measured in %1</source>
        <translation>測定時間 %1</translation>
    </message>
    <message>
        <source>Plan acquisition</source>
        <translation>光輸送測定へ</translation>
    </message>
    <message>
        <source>Continue anyway</source>
        <translation>このまま続行</translation>
    </message>
    <message>
        <source>Measure response</source>
        <translation>応答を測定</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>中止</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>再測定</translation>
    </message>
    <message>
        <source>These curves belong to earlier settings</source>
        <translation>このカーブは以前の設定によるものです</translation>
    </message>
    <message>
        <source>They still work and stay until the new ones are measured.</source>
        <translation>引き続き使えます。新しいカーブを測定するまで残ります。</translation>
    </message>
    <message>
        <source>Levels</source>
        <translation>レベル数</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>何も変更していません。</translation>
    </message>
    <message>
        <source>Try again</source>
        <translation>再試行</translation>
    </message>
    <message>
        <source>Every photograph that was taken is on the disk. Trying again goes on from there.</source>
        <translation>撮影した写真はすべてディスクにあります。再試行するとその続きから進みます。</translation>
    </message>
    <message>
        <source>Linearize</source>
        <translation>線形化</translation>
    </message>
    <message>
        <source>Measure how much light each step of the projector&apos;s three colours really gives.</source>
        <translation>プロジェクターの 3 色について、各段階で実際に出る光の量を測定します。</translation>
    </message>
    <message>
        <source>Red</source>
        <translation>赤</translation>
    </message>
    <message>
        <source>Green</source>
        <translation>緑</translation>
    </message>
    <message>
        <source>Blue</source>
        <translation>青</translation>
    </message>
    <message>
        <source>Sent to the projector</source>
        <translation>プロジェクターへ送信</translation>
    </message>
    <message>
        <source>Seen by the camera</source>
        <translation>カメラの撮影</translation>
    </message>
    <message>
        <source>Pattern that the projector shows</source>
        <translation>プロジェクターが表示するパターン</translation>
    </message>
    <message>
        <source>Last photograph</source>
        <translation>最新の写真</translation>
    </message>
    <message>
        <source>Appears when measuring begins.</source>
        <translation>測定が始まると表示されます。</translation>
    </message>
    <message>
        <source>%1, photograph %2</source>
        <translation>%1、写真 %2</translation>
    </message>
    <message>
        <source>Response of the projector</source>
        <translation>プロジェクターの応答</translation>
    </message>
    <message>
        <source>Level sent to the projector</source>
        <translation>プロジェクターへ送るレベル</translation>
    </message>
    <message>
        <source>Light, % of full</source>
        <translation>光（全点灯比 %）</translation>
    </message>
    <message>
        <source>Light of every level, three colours</source>
        <translation>各レベルの光、3 色</translation>
    </message>
    <message>
        <source>as it is measured</source>
        <translation>測定順</translation>
    </message>
    <message numerus="yes">
        <source>%n level(s) a colour, drift removed</source>
        <translation>
            <numerusform>各色 %n レベル、ドリフト除去済み</numerusform>
        </translation>
    </message>
    <message>
        <source>not measured yet</source>
        <translation>未測定</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>結果</translation>
    </message>
    <message>
        <source>Exposures</source>
        <translation>露出</translation>
    </message>
    <message>
        <source>Chosen for this venue</source>
        <translation>この会場用に選択</translation>
    </message>
    <message>
        <source>Measure with</source>
        <translation>測定条件</translation>
    </message>
    <message>
        <source>Levels a colour</source>
        <translation>各色のレベル数</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>測定中</translation>
    </message>
    <message>
        <source>Not measured yet</source>
        <translation>まだ測定していません</translation>
    </message>
    <message>
        <source>Whether the colours add up, the camera is linear and every level is brighter than the one below is told when all levels are measured.</source>
        <translation>色の加法性、カメラの線形性、各レベルが一つ下より明るいかどうかは、全レベルの測定後に表示されます。</translation>
    </message>
    <message>
        <source>The colours add up</source>
        <translation>色の加法性が成り立ちます</translation>
    </message>
    <message>
        <source>Red, green and blue together give white within %1.</source>
        <translation>赤、緑、青の合計は、誤差 %1 以内で白と一致します。</translation>
    </message>
    <message>
        <source>The colours do not add up</source>
        <translation>色の加法性が成り立ちません</translation>
    </message>
    <message>
        <source>White differs by %1 from its colours. Turn off “brilliant” or “dynamic” in the projector&apos;s menu, then measure again.</source>
        <translation>白が各色の合計と %1 異なります。プロジェクターのメニューで「ブリリアント」や「ダイナミック」をオフにして、再測定してください。</translation>
    </message>
    <message>
        <source>The camera is linear</source>
        <translation>カメラは線形です</translation>
    </message>
    <message>
        <source>The camera&apos;s curve is known</source>
        <translation>カメラのカーブは既知です</translation>
    </message>
    <message>
        <source>Doubling the exposure doubles the signal.</source>
        <translation>露出を 2 倍にすると信号も 2 倍になります。</translation>
    </message>
    <message>
        <source>Its photographs are brought back to linear light.</source>
        <translation>写真は線形の光に戻されます。</translation>
    </message>
    <message>
        <source>Curves rise everywhere</source>
        <translation>カーブは全域で上昇</translation>
    </message>
    <message>
        <source>No level is darker than the one below it.</source>
        <translation>一つ下より暗いレベルはありません。</translation>
    </message>
    <message>
        <source>Found while measuring</source>
        <translation>測定中の検出事項</translation>
    </message>
    <message numerus="yes">
        <source>About %n test pattern(s)</source>
        <translation>
            <numerusform>テストパターン約 %n 枚</numerusform>
        </translation>
    </message>
    <message>
        <source>Go on now</source>
        <translation>今すぐ続ける</translation>
    </message>
    <message>
        <source>Measuring with these settings. Stop to change them.</source>
        <translation>この設定で測定中です。変更するには停止してください。</translation>
    </message>
    <message>
        <source>Keep the earlier one</source>
        <translation>前の測定に戻す</translation>
    </message>
    <message>
        <source>The earlier curves are used again, with all that followed from them.</source>
        <translation>前の曲線と、そこから得られたものが再び使われます。</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>測定済みのデータは無事です。</translation>
    </message>
    <message>
        <source>Black level</source>
        <translation>黒レベル</translation>
    </message>
    <message>
        <source>Contrast</source>
        <translation>コントラスト</translation>
    </message>
    <message>
        <source>%1 of full light</source>
        <translation>全光の %1</translation>
    </message>
    <message>
        <source>Colours within %1</source>
        <translation>色の誤差 %1 以内</translation>
    </message>
    <message>
        <source>How far each level&apos;s light is from the fitted curve</source>
        <translation>各レベルの光と曲線との差</translation>
    </message>
    <message>
        <source>within ±%1</source>
        <translation>±%1 以内</translation>
    </message>
    <message>
        <source>One test pattern shows many levels side by side, so few patterns are enough.</source>
        <translation>1 枚のテストパターンに多くの段階が並ぶため、少ない枚数で足ります。</translation>
    </message>
    <message>
        <source>Off the curve</source>
        <translation>曲線からのずれ</translation>
    </message>
    <message>
        <source>Residuals: what was photographed, less the curve that was fitted to it.</source>
        <translation>残差：撮影した値から、当てはめた曲線を引いたものです。</translation>
    </message>
    <message>
        <source>Off the curve, % of full</source>
        <translation>曲線からのずれ、最大の %</translation>
    </message>
    <message>
        <source>Stopping after the photograph under way.</source>
        <translation>撮影中の写真の後に停止します。</translation>
    </message>
    <message>
        <source>To measure again, confirm that the room is clear.</source>
        <translation>測定し直すには、退避が完了したことを確認してください。</translation>
    </message>
    <message>
        <source>Colours off by %1</source>
        <translation>色の誤差 %1</translation>
    </message>
    <message>
        <source>The photographs contradict each other. See that nothing covers the lens, then measure again.</source>
        <translation>写真どうしが矛盾しています。レンズを覆うものがないことを確かめてから、測定し直してください。</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the patterns flash.</source>
        <translation>退避が完了したことを確認してください。パターンは点滅します。</translation>
    </message>
    <message>
        <source>The photographs contradict each other</source>
        <translation>写真どうしが矛盾しています</translation>
    </message>
    <message>
        <source>White differs by %1 from its colours, and levels by up to %2 from their curve: no picture mode does that. Something covered the lens or the picture, or the light changed. Nothing else is told from these photographs; measure again.</source>
        <translation>白は各色の合計と %1、各レベルは曲線と最大 %2 ずれています。画質モードではこうはなりません。レンズまたは投影像が覆われたか、光が変わりました。これらの写真からほかのことは判断できません。測定し直してください。</translation>
    </message>
    <message>
        <source>The camera sees hardly any light of the projector</source>
        <translation>カメラにプロジェクターの光がほとんど届いていません</translation>
    </message>
    <message>
        <source>See that nothing covers the lens or the picture. What is photographed meanwhile is lost: stop, and measure again.</source>
        <translation>レンズや投影像を覆うものがないことを確かめてください。その間の写真は使えません。停止して、測定し直してください。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MainWindow</name>
    <message>
        <source>Dim pictures</source>
        <translation>画像を減光</translation>
    </message>
    <message>
        <source>Pictures dimmed</source>
        <translation>画像を減光中</translation>
    </message>
    <message>
        <source>Settings</source>
        <translation>設定</translation>
    </message>
    <message>
        <source>Help</source>
        <translation>ヘルプ</translation>
    </message>
    <message>
        <source>F1</source>
        <translation>F1</translation>
    </message>
    <message>
        <source>Less light from this screen falls into the room (F9)</source>
        <translation>この画面から室内に入る光を減らします（F9）</translation>
    </message>
    <message>
        <source>Undone: %1</source>
        <translation>元に戻しました：%1</translation>
    </message>
    <message>
        <source>Nothing to undo here</source>
        <translation>ここで元に戻せるものはありません</translation>
    </message>
    <message>
        <source>Done again: %1</source>
        <translation>やり直しました：%1</translation>
    </message>
    <message>
        <source>Nothing to do again</source>
        <translation>やり直せるものはありません</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MaskEditing</name>
    <message>
        <source>This is no mask: %1.</source>
        <translation>これはマスクになりません：%1。</translation>
    </message>
    <message>
        <source>New mask</source>
        <translation>新しいマスク</translation>
    </message>
    <message>
        <source>Outline of a mask</source>
        <translation>マスクの輪郭</translation>
    </message>
    <message>
        <source>Feather of a mask</source>
        <translation>マスクのぼかし</translation>
    </message>
    <message>
        <source>Removed mask</source>
        <translation>マスクの削除</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MaskView</name>
    <message numerus="yes">
        <source>Drawing a mask: %n point(s). Space sets one at %1, %2. Return closes it, Escape leaves it.</source>
        <translation>
            <numerusform>マスクを描いています：点 %n 個。スペースで %1、%2 に点を置きます。Enter で閉じ、Escape で中止します。</numerusform>
        </translation>
    </message>
    <message>
        <source>Point %1 of %2, %3, %4.</source>
        <translation>点 %1／%2、%3、%4。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MatrixView</name>
    <message>
        <source>camera %1
projector %2</source>
        <translation>カメラ %1
プロジェクター %2</translation>
    </message>
    <message>
        <source>%1
%2</source>
        <translation>%1
%2</translation>
    </message>
    <message>
        <source>transport</source>
        <translation>輸送値</translation>
    </message>
    <message>
        <source>projector x, y</source>
        <translation>プロジェクター x, y</translation>
    </message>
    <message>
        <source>projector line</source>
        <translation>プロジェクターのライン</translation>
    </message>
    <message>
        <source>camera x, y</source>
        <translation>カメラ x, y</translation>
    </message>
    <message>
        <source>camera line</source>
        <translation>カメラのライン</translation>
    </message>
    <message>
        <source>%1 across, %2 down</source>
        <translation>横：%1、縦：%2</translation>
    </message>
</context>
<context>
    <name>relucent::gui::NameDialog</name>
    <message>
        <source>Name</source>
        <translation>名前</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>キャンセル</translation>
    </message>
    <message>
        <source>Type a name.</source>
        <translation>名前を入力してください。</translation>
    </message>
    <message>
        <source>It has this name.</source>
        <translation>すでにこの名前です。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Nights</name>
    <message>
        <source>The venue was as it was measured.</source>
        <translation>会場は測定したときのままでした。</translation>
    </message>
    <message>
        <source>Repaired.</source>
        <translation>修復しました。</translation>
    </message>
    <message>
        <source>Something has changed, and no better picture came of a repair.</source>
        <translation>何かが変わりましたが、修復しても画像は良くなりませんでした。</translation>
    </message>
    <message>
        <source>%1 dB</source>
        <translation>%1 dB</translation>
    </message>
    <message>
        <source>Photographed</source>
        <translation>撮影</translation>
    </message>
    <message>
        <source>Predicted</source>
        <translation>予測</translation>
    </message>
    <message>
        <source>Repaired</source>
        <translation>修復</translation>
    </message>
    <message>
        <source>Alarm</source>
        <translation>警報</translation>
    </message>
    <message>
        <source>Days before the last night</source>
        <translation>最後の夜までの日数</translation>
    </message>
    <message>
        <source>Colour error ΔE</source>
        <translation>色の誤差 ΔE</translation>
    </message>
    <message numerus="yes">
        <source>%n night(s).</source>
        <translation>
            <numerusform>%n夜。</numerusform>
        </translation>
    </message>
    <message>
        <source>Photographed: %1 to %2, last %3.</source>
        <translation>撮影：%1～%2、最後は %3。</translation>
    </message>
    <message>
        <source>Repairs: %1. Alarms: %2.</source>
        <translation>修復：%1。警報：%2。</translation>
    </message>
    <message>
        <source>Left out: %1</source>
        <translation>見送り：%1</translation>
    </message>
    <message>
        <source>Alarm: %1</source>
        <translation>警報：%1</translation>
    </message>
    <message numerus="yes">
        <source>%n picture(s) perfected.</source>
        <translation>
            <numerusform>%n枚の画像を仕上げました。</numerusform>
        </translation>
    </message>
    <message>
        <source>Photographed: %1, predicted: %2.</source>
        <translation>撮影：%1、予測：%2。</translation>
    </message>
    <message>
        <source>Nobody was told: %1</source>
        <translation>誰にも通知できませんでした：%1</translation>
    </message>
    <message>
        <source>Quality, dB</source>
        <translation>画質、dB</translation>
    </message>
</context>
<context>
    <name>relucent::gui::NightsDialog</name>
    <message>
        <source>Quality over weeks</source>
        <translation>数週間の画質</translation>
    </message>
    <message>
        <source>Colour error</source>
        <translation>色の誤差</translation>
    </message>
    <message>
        <source>What the photograph of each night&apos;s proof came to, beside what was predicted.</source>
        <translation>各夜の検証写真の結果と、予測していた値です。</translation>
    </message>
    <message>
        <source>Quality of the picture, night by night</source>
        <translation>夜ごとの画質</translation>
    </message>
    <message>
        <source>What came of each night, the last one first</source>
        <translation>各夜の結果、新しい順</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>閉じる</translation>
    </message>
    <message>
        <source>Quality</source>
        <translation>画質</translation>
    </message>
    <message>
        <source>Colour error: CIEDE2000, less is better. Quality: peak signal-to-noise ratio, PSNR, in dB; more is better.</source>
        <translation>色の誤差：CIEDE2000、小さいほど良好。画質：ピーク信号対雑音比（PSNR）、dB、大きいほど良好。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::NightsPart</name>
    <message>
        <source>Every night</source>
        <translation>毎晩</translation>
    </message>
    <message>
        <source>Quality over weeks</source>
        <translation>数週間の画質</translation>
    </message>
    <message>
        <source>A chart of all nights, and what came of each.</source>
        <translation>すべての夜のグラフと、それぞれの結果です。</translation>
    </message>
    <message>
        <source>There was no night yet</source>
        <translation>まだ夜の記録がありません</translation>
    </message>
    <message>
        <source>Somebody has to look, %1</source>
        <translation>確認が必要です、%1</translation>
    </message>
    <message>
        <source>Left out, %1</source>
        <translation>見送り、%1</translation>
    </message>
    <message>
        <source>All is well, %1</source>
        <translation>問題ありません、%1</translation>
    </message>
    <message>
        <source>Look after the picture</source>
        <translation>映像の手入れ</translation>
    </message>
    <message>
        <source>never</source>
        <translation>しない</translation>
    </message>
    <message>
        <source>at %1</source>
        <translation>%1</translation>
    </message>
    <message>
        <source>A show can look after the picture by itself at night: it checks, repairs, perfects and proves, and tells here what came of it. Its camera has to stay where it is.</source>
        <translation>ショーは夜間に自分で映像を手入れできます：確認し、修復し、仕上げ、検証して、結果をここに示します。カメラはそのままの位置に置いてください。</translation>
    </message>
    <message>
        <source>No show of a rehearsal is looked after.</source>
        <translation>リハーサルのショーは手入れしません。</translation>
    </message>
    <message>
        <source>The installed show has its first one at %1, if it plays by then. Its camera has to stay where it is.</source>
        <translation>インストール済みのショーは、その時点で動いていれば %1 に最初の夜間手入れを行います。カメラはその場所に置いたままにしてください。</translation>
    </message>
    <message>
        <source>A night is under way</source>
        <translation>夜間の手入れを実行中です</translation>
    </message>
    <message>
        <source>The show makes way while its picture is looked after. What comes of it is told here.</source>
        <translation>映像の手入れのあいだ、ショーは場所を空けます。結果はここに表示されます。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::NudgeDialog</name>
    <message>
        <source>fits</source>
        <translation>一致</translation>
    </message>
    <message>
        <source>Turn the camera to the right and down.</source>
        <translation>カメラを右下へ向けてください。</translation>
    </message>
    <message>
        <source>Turn the camera to the right and up.</source>
        <translation>カメラを右上へ向けてください。</translation>
    </message>
    <message>
        <source>Turn the camera to the left and down.</source>
        <translation>カメラを左下へ向けてください。</translation>
    </message>
    <message>
        <source>Turn the camera to the left and up.</source>
        <translation>カメラを左上へ向けてください。</translation>
    </message>
    <message>
        <source>Turn the camera to the right.</source>
        <translation>カメラを右へ向けてください。</translation>
    </message>
    <message>
        <source>Turn the camera to the left.</source>
        <translation>カメラを左へ向けてください。</translation>
    </message>
    <message>
        <source>Turn the camera down.</source>
        <translation>カメラを下へ向けてください。</translation>
    </message>
    <message>
        <source>Turn the camera up.</source>
        <translation>カメラを上へ向けてください。</translation>
    </message>
    <message>
        <source>Tilt the camera clockwise.</source>
        <translation>カメラを時計回りに傾けてください。</translation>
    </message>
    <message>
        <source>Tilt the camera anticlockwise.</source>
        <translation>カメラを反時計回りに傾けてください。</translation>
    </message>
    <message>
        <source>What the camera saw, and what it sees now</source>
        <translation>カメラが以前見ていたものと今見ているもの</translation>
    </message>
    <message>
        <source>The projector shows full light. Left of the line stands what the camera saw when the venue was measured, right of it what it sees now.</source>
        <translation>プロジェクターは全光を投影しています。線の左は測定時にカメラが見ていたもの、右は今見ているものです。</translation>
    </message>
    <message>
        <source>Sideways</source>
        <translation>左右</translation>
    </message>
    <message>
        <source>Up and down</source>
        <translation>上下</translation>
    </message>
    <message>
        <source>Tilt</source>
        <translation>傾き</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>閉じる</translation>
    </message>
    <message>
        <source>Opening the devices</source>
        <translation>機器への接続</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>測定済み</translation>
    </message>
    <message>
        <source>Now</source>
        <translation>今</translation>
    </message>
    <message>
        <source>%1 px to the right</source>
        <translation>右へ %1 px</translation>
    </message>
    <message>
        <source>%1 px to the left</source>
        <translation>左へ %1 px</translation>
    </message>
    <message>
        <source>%1 px down</source>
        <translation>下へ %1 px</translation>
    </message>
    <message>
        <source>%1 px up</source>
        <translation>上へ %1 px</translation>
    </message>
    <message>
        <source>%1°</source>
        <translation>%1°</translation>
    </message>
    <message>
        <source>Looking through the camera</source>
        <translation>ライブビュー</translation>
    </message>
    <message>
        <source>The camera looks where it looked.</source>
        <translation>カメラは元の向きを向いています。</translation>
    </message>
    <message>
        <source>Fasten it, look once more, and close this window.</source>
        <translation>固定してもう一度確かめ、このウィンドウを閉じてください。</translation>
    </message>
    <message>
        <source>The arrow shows where. If the projector was bumped instead, move its picture the other way.</source>
        <translation>矢印が向きを示します。プロジェクターが動いた場合は、その映像を逆向きに動かしてください。</translation>
    </message>
    <message>
        <source>What is seen is not the view that was measured.</source>
        <translation>見えているのは測定したときの眺めではありません。</translation>
    </message>
    <message>
        <source>Turn the camera until both halves look alike. If they do, the light or the surface has changed.</source>
        <translation>左右が同じに見えるまでカメラを動かしてください。すでに同じなら、光か面が変わっています。</translation>
    </message>
    <message>
        <source>Put the camera back</source>
        <translation>カメラを元に戻す</translation>
    </message>
    <message>
        <source>In a rehearsal it comes back by itself while you look.</source>
        <translation>リハーサルでは、見ている間に自然に元へ戻ります。</translation>
    </message>
    <message>
        <source>%1° clockwise</source>
        <translation>時計回りに %1°</translation>
    </message>
    <message>
        <source>%1° anticlockwise</source>
        <translation>反時計回りに %1°</translation>
    </message>
    <message>
        <source>If the projector was bumped instead, move its picture the other way.</source>
        <translation>プロジェクターが動いた場合は、映像を逆方向に動かしてください。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputPage</name>
    <message>
        <source>Projector&apos;s screen</source>
        <translation>プロジェクターの画面</translation>
    </message>
    <message>
        <source>This screen</source>
        <translation>この画面</translation>
    </message>
    <message>
        <source>%1: measured ΔE %2, predicted %3</source>
        <translation>%1：測定 ΔE %2、予測 %3</translation>
    </message>
    <message>
        <source>Not photographed yet</source>
        <translation>未撮影</translation>
    </message>
    <message>
        <source>One photograph shows whether the surface looks as predicted.</source>
        <translation>写真 1 枚で、投影面が予測どおりに見えるか確認できます。</translation>
    </message>
    <message>
        <source>Corrected</source>
        <translation>補正後</translation>
    </message>
    <message>
        <source>Original</source>
        <translation>元画像</translation>
    </message>
    <message>
        <source>%1 of the picture can be reached.</source>
        <translation>画像の %1 を再現できます。</translation>
    </message>
    <message>
        <source>The surface looks as predicted</source>
        <translation>投影面は予測どおりに見えます</translation>
    </message>
    <message>
        <source>The camera or projector may have moved.</source>
        <translation>カメラかプロジェクターが動いた可能性があります。</translation>
    </message>
    <message>
        <source>Error of the test patterns: %1, when measured %2. %3 of the view changed.</source>
        <translation>テストパターンの誤差：%1、測定時は %2。視野の %3 が変化しました。</translation>
    </message>
    <message>
        <source>The measurement still holds</source>
        <translation>測定結果は今も有効です</translation>
    </message>
    <message>
        <source>Verification</source>
        <translation>検証</translation>
    </message>
    <message>
        <source>Take verification photograph</source>
        <translation>検証写真を撮影</translation>
    </message>
    <message>
        <source>Ctrl+Shift+V</source>
        <translation>Ctrl+Shift+V</translation>
    </message>
    <message>
        <source>Check for drift</source>
        <translation>ドリフトを確認</translation>
    </message>
    <message>
        <source>Photographs the test patterns of the measurement again, ten or so.</source>
        <translation>測定時のテストパターンを 10 枚ほど撮影し直します。</translation>
    </message>
    <message>
        <source>Hand over</source>
        <translation>引き渡し</translation>
    </message>
    <message>
        <source>Save report</source>
        <translation>レポートを保存</translation>
    </message>
    <message>
        <source>Installed. The show starts at the next log-in, without camera or wizard.</source>
        <translation>登録済み。次回のログイン時から、カメラもウィザードもなしでショーが始まります。</translation>
    </message>
    <message>
        <source>Playlist</source>
        <translation>プレイリスト</translation>
    </message>
    <message>
        <source>The picture stands in its middle, pixel for pixel.</source>
        <translation>画像は中央に等倍で表示されます。</translation>
    </message>
    <message>
        <source>Still pictures: %1</source>
        <translation>静止画：%1</translation>
    </message>
    <message>
        <source>Films and cross-fades use windows and steps, which are quick enough.</source>
        <translation>動画とクロスフェードには、十分に高速な「局所窓＋反復」を使います。</translation>
    </message>
    <message>
        <source>Make the list again.</source>
        <translation>リストを作り直してください。</translation>
    </message>
    <message>
        <source>Black</source>
        <translation>黒表示</translation>
    </message>
    <message>
        <source>Frozen</source>
        <translation>静止中</translation>
    </message>
    <message>
        <source>Playing</source>
        <translation>再生中</translation>
    </message>
    <message>
        <source>Add a picture or a film to the playlist.</source>
        <translation>プレイリストに画像か動画を追加してください。</translation>
    </message>
    <message>
        <source>Choose the projector&apos;s screen.</source>
        <translation>プロジェクターの画面を選んでください。</translation>
    </message>
    <message>
        <source>Playing. Hold A to compare.</source>
        <translation>再生中。A キー長押しで比較。</translation>
    </message>
    <message>
        <source>Take a verification photograph, or install without proof.</source>
        <translation>検証写真を撮影するか、検証なしで登録してください。</translation>
    </message>
    <message>
        <source>Nothing is projected before you open the output.</source>
        <translation>出力を開くまで何も投影しません。</translation>
    </message>
    <message>
        <source>Install show</source>
        <translation>ショーを登録</translation>
    </message>
    <message>
        <source>Install without proof</source>
        <translation>検証なしで登録</translation>
    </message>
    <message>
        <source>Open output</source>
        <translation>出力を開く</translation>
    </message>
    <message>
        <source>Play</source>
        <translation>再生</translation>
    </message>
    <message>
        <source>Freeze</source>
        <translation>静止</translation>
    </message>
    <message>
        <source>Show again</source>
        <translation>再表示</translation>
    </message>
    <message>
        <source>Close output</source>
        <translation>出力を閉じる</translation>
    </message>
    <message>
        <source>Add to the playlist</source>
        <translation>プレイリストに追加</translation>
    </message>
    <message>
        <source>Remove from the playlist</source>
        <translation>プレイリストから削除</translation>
    </message>
    <message>
        <source>Order of the playlist</source>
        <translation>プレイリストの順序</translation>
    </message>
    <message>
        <source>Repeat</source>
        <translation>繰り返し</translation>
    </message>
    <message>
        <source>Cross-fade</source>
        <translation>クロスフェード</translation>
    </message>
    <message>
        <source>The calibration is as it was.</source>
        <translation>校正データは元のままです。</translation>
    </message>
    <message>
        <source>Output</source>
        <translation>出力</translation>
    </message>
    <message>
        <source>Play corrected content, prove that it works with one photograph, and hand the venue over.</source>
        <translation>補正したコンテンツを再生し、写真 1 枚で効果を検証して、会場を引き渡します。</translation>
    </message>
    <message>
        <source>Playback</source>
        <translation>再生状況</translation>
    </message>
    <message>
        <source>frames a second</source>
        <translation>フレーム/秒</translation>
    </message>
    <message>
        <source>frame time</source>
        <translation>フレーム時間</translation>
    </message>
    <message>
        <source>frames late</source>
        <translation>遅延フレーム</translation>
    </message>
    <message>
        <source>Seconds</source>
        <translation>秒</translation>
    </message>
    <message>
        <source>Frame time, ms</source>
        <translation>フレーム時間（ms）</translation>
    </message>
    <message>
        <source>Frame times of the last minute</source>
        <translation>直近 1 分間のフレーム時間</translation>
    </message>
    <message>
        <source>%1 ms</source>
        <translation>%1 ms</translation>
    </message>
    <message>
        <source>closed</source>
        <translation>停止中</translation>
    </message>
    <message>
        <source>on %1</source>
        <translation>%1 で実行</translation>
    </message>
    <message>
        <source>still picture, on %1</source>
        <translation>静止画、%1 で実行</translation>
    </message>
    <message>
        <source>On the projector now</source>
        <translation>現在の投影</translation>
    </message>
    <message>
        <source>What the projector shows</source>
        <translation>プロジェクターの表示内容</translation>
    </message>
    <message>
        <source>Photograph of the surface</source>
        <translation>投影面の写真</translation>
    </message>
    <message>
        <source>What was wanted at the left of the divider, the photograph at the right</source>
        <translation>境界線の左が目標、右が写真</translation>
    </message>
    <message>
        <source>No verification photograph has been taken.</source>
        <translation>検証写真はまだありません。</translation>
    </message>
    <message>
        <source>Photograph against wanted</source>
        <translation>写真と目標の比較</translation>
    </message>
    <message>
        <source>colour difference</source>
        <translation>色差</translation>
    </message>
    <message>
        <source>Colour difference between the photograph and what was wanted</source>
        <translation>写真と目標との色差</translation>
    </message>
    <message>
        <source>A verification photograph shows here what is left to see.</source>
        <translation>検証写真を撮影すると、残っている差がここに表示されます。</translation>
    </message>
    <message>
        <source>taken %1</source>
        <translation>%1 に撮影</translation>
    </message>
    <message>
        <source>Wanted</source>
        <translation>目標</translation>
    </message>
    <message>
        <source>Photograph</source>
        <translation>写真</translation>
    </message>
    <message>
        <source>Delete removes an item, Ctrl+Up and Ctrl+Down move it. Files can be dropped here.</source>
        <translation>Delete で項目を削除、Ctrl+Up と Ctrl+Down で移動。ファイルをここにドロップできます。</translation>
    </message>
    <message>
        <source>%1, playing</source>
        <translation>%1、再生中</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>追加</translation>
    </message>
    <message>
        <source>Add files to the playlist</source>
        <translation>プレイリストにファイルを追加</translation>
    </message>
    <message>
        <source>Move up</source>
        <translation>上へ移動</translation>
    </message>
    <message>
        <source>Move down</source>
        <translation>下へ移動</translation>
    </message>
    <message>
        <source>Cross-fade, tenths of a second</source>
        <translation>クロスフェード（0.1 秒単位）</translation>
    </message>
    <message>
        <source>Add pictures or films</source>
        <translation>画像か動画を追加</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 秒</translation>
    </message>
    <message>
        <source>Skipped: %1</source>
        <translation>スキップ：%1</translation>
    </message>
    <message>
        <source>This screen&apos;s resolution is not that of the projector that was measured.</source>
        <translation>この画面の解像度は、測定したプロジェクターと異なります。</translation>
    </message>
    <message>
        <source>Written to %1, and for paper to report.pdf beside it.</source>
        <translation>%1 に書き出しました。印刷用は隣の report.pdf です。</translation>
    </message>
    <message>
        <source>The projector is another screen now</source>
        <translation>プロジェクターは別の画面になりました</translation>
    </message>
    <message>
        <source>Show installed</source>
        <translation>ショーを登録済み</translation>
    </message>
    <message>
        <source>Installed at %1: the show starts at the next log-in. Hold A to compare.</source>
        <translation>%1 に登録済み: 次回ログイン時にショーが始まります。A を押し続けると比較できます。</translation>
    </message>
    <message>
        <source>The output will cover this window. Esc closes the output.</source>
        <translation>出力がこのウィンドウを覆います。Esc で出力を閉じます。</translation>
    </message>
    <message>
        <source>Install again</source>
        <translation>再登録</translation>
    </message>
    <message>
        <source>The projector&apos;s screen %1 is not there. Plug it in, or choose another.</source>
        <translation>プロジェクターの画面 %1 がありません。接続するか、別の画面を選んでください。</translation>
    </message>
    <message>
        <source>Choose a screen for projector %1.</source>
        <translation>プロジェクター %1 の画面を選んでください。</translation>
    </message>
    <message numerus="yes">
        <source>Each of the %n projector(s) needs a screen of its own. Plug in another one.</source>
        <translation>
            <numerusform>%n 台のプロジェクターにはそれぞれ画面が必要です。もう一つ接続してください。</numerusform>
        </translation>
    </message>
    <message>
        <source>There is one screen only. Plug the projector in and extend the desktop to it, or choose this screen.</source>
        <translation>画面が一つしかありません。プロジェクターを接続してデスクトップを拡張するか、この画面を選んでください。</translation>
    </message>
    <message>
        <source>still picture, %1 of the pixels at their limit</source>
        <translation>静止画、限界に達した画素 %1</translation>
    </message>
    <message>
        <source>%1 fps, %2 ms, %3 of the pixels at their limit</source>
        <translation>%1 fps、%2 ms、限界に達した画素 %3</translation>
    </message>
    <message>
        <source>Screen unplugged</source>
        <translation>画面が未接続</translation>
    </message>
    <message>
        <source>The surface does not look as predicted. Find out whether something moved.</source>
        <translation>表面が予測どおりに見えません。何かが動いていないか確認してください。</translation>
    </message>
    <message>
        <source>Something has changed since it was measured. Measure again, then install.</source>
        <translation>測定後に何かが変化しています。測定し直してから登録してください。</translation>
    </message>
    <message>
        <source>Install anyway</source>
        <translation>それでも登録</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>再測定</translation>
    </message>
    <message>
        <source>Aim again</source>
        <translation>合わせ直す</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged</source>
        <translation>プロジェクターの画面が外れています</translation>
    </message>
    <message>
        <source>Nothing is lost. Plug it in again: the show comes back by itself.</source>
        <translation>何も失われていません。接続し直すと、ショーは自動的に戻ります。</translation>
    </message>
    <message>
        <source>The camera&apos;s view has moved by %1 px sideways and %2 px up or down.</source>
        <translation>カメラの視野が左右に %1 px、上下に %2 px ずれました。</translation>
    </message>
    <message>
        <source>Shows full light, and where the camera has to be turned to look where it looked.</source>
        <translation>全光を投影し、元の向きに戻すにはカメラをどちらへ向けるかを示します。</translation>
    </message>
    <message>
        <source>Limit for %1 frames a second: %2 ms</source>
        <translation>毎秒 %1 フレームの上限: %2 ms</translation>
    </message>
    <message>
        <source>the processor</source>
        <translation>プロセッサー</translation>
    </message>
    <message>
        <source>Next test chart (T)</source>
        <translation>次のテストチャート (T)</translation>
    </message>
    <message>
        <source>Figures over the picture (O)</source>
        <translation>映像に数値を重ねる (O)</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>機器は「%1」で使用中です。</translation>
    </message>
    <message>
        <source>Put the camera back</source>
        <translation>カメラを元に戻す</translation>
    </message>
    <message>
        <source>On this page only</source>
        <translation>このページのみ</translation>
    </message>
    <message>
        <source>The photograph is out of date</source>
        <translation>写真は古くなっています</translation>
    </message>
    <message>
        <source>Another venue&apos;s show starts at log-in. Installing this one replaces it.</source>
        <translation>別の会場のショーがログイン時に始まります。こちらを登録すると置き換わります。</translation>
    </message>
    <message>
        <source>Another venue&apos;s show starts at log-in. This is a rehearsal, which is not installed.</source>
        <translation>別の会場のショーがログイン時に始まります。これはリハーサルなので登録できません。</translation>
    </message>
    <message>
        <source>Once installed, the show starts at every log-in, without camera or wizard.</source>
        <translation>登録すると、ログインするたびに、カメラもウィザードもなしでショーが始まります。</translation>
    </message>
    <message>
        <source>This is a rehearsal with simulated devices: its show is not installed. That of a real venue starts at every log-in.</source>
        <translation>これは模擬機器によるリハーサルなので、ショーは登録できません。実際の会場のショーは、ログインするたびに始まります。</translation>
    </message>
    <message>
        <source>Remove installed show</source>
        <translation>登録したショーを解除</translation>
    </message>
    <message>
        <source>It does not start at log-in any more. Venue and playlist stay.</source>
        <translation>ログイン時に始まらなくなります。会場と再生リストは残ります。</translation>
    </message>
    <message>
        <source>Proof out of date</source>
        <translation>検証が要更新</translation>
    </message>
    <message>
        <source>Take a verification photograph: it proves that the venue is measured well.</source>
        <translation>検証写真を撮影してください。会場が正しく測定されたことを示します。</translation>
    </message>
    <message>
        <source>This rehearsal plays on this page only: nothing is projected.</source>
        <translation>このリハーサルはこのページだけで再生します。何も投影しません。</translation>
    </message>
    <message>
        <source>Black: the show goes on unseen until you show it again.</source>
        <translation>黒表示中：もう一度表示するまで、ショーは見えないまま進みます。</translation>
    </message>
    <message>
        <source>Frozen: this picture stands until you press Play.</source>
        <translation>静止中：「再生」を押すまで、この画像のままです。</translation>
    </message>
    <message>
        <source>Rehearsed to the end. A simulated venue is not installed. Hold A to compare.</source>
        <translation>リハーサルは最後まで完了。模擬会場は登録できません。A キー長押しで比較。</translation>
    </message>
    <message>
        <source>The verification photograph is out of date</source>
        <translation>検証写真が古くなっています</translation>
    </message>
    <message>
        <source>taken %1, out of date</source>
        <translation>%1 に撮影、要更新</translation>
    </message>
    <message>
        <source>No screen chosen</source>
        <translation>画面が選ばれていません</translation>
    </message>
    <message>
        <source>%1, unplugged</source>
        <translation>%1、未接続</translation>
    </message>
    <message>
        <source>Not to be proved yet</source>
        <translation>まだ検証できません</translation>
    </message>
    <message>
        <source>What it was taken of has been measured or chosen anew since, or is another set. Take it again to prove what is shown now.</source>
        <translation>撮影後に、測定または設定が変わったか、別のセットです。今の表示を検証するには撮影し直してください。</translation>
    </message>
    <message>
        <source>As predicted, but errors are plain to see</source>
        <translation>予測どおりですが、誤差がはっきり見えます</translation>
    </message>
    <message>
        <source>Nothing has moved: the prediction itself is coarse. Measuring finer or darker content helps.</source>
        <translation>何も動いていません。予測そのものが粗いのです。より細かい測定や、暗めのコンテンツで改善します。</translation>
    </message>
    <message>
        <source>Waiting for the projector&apos;s screen to come back.</source>
        <translation>プロジェクターの画面が戻るのを待っています。</translation>
    </message>
    <message>
        <source>What plays is not what was measured or chosen last. Show that first.</source>
        <translation>再生中の補正は、最後の測定や設定のものではありません。まずそれを表示してください。</translation>
    </message>
    <message>
        <source>Look at it first</source>
        <translation>先に確認</translation>
    </message>
    <message>
        <source>What was measured or chosen since is not on the projector yet.</source>
        <translation>その後の測定や設定は、まだ投影されていません。</translation>
    </message>
    <message>
        <source>What was measured or chosen since is not on the projector yet. Steps that are out of date count with what was chosen there before.</source>
        <translation>その後の測定や設定は、まだ投影されていません。古くなった手順は、以前の設定のまま使われます。</translation>
    </message>
    <message>
        <source>The screen %1 is unplugged. Nothing is projected.</source>
        <translation>画面 %1 が外れています。何も投影していません。</translation>
    </message>
    <message>
        <source>Camera %1: %2, as predicted</source>
        <translation>カメラ %1: %2、予測どおり</translation>
    </message>
    <message>
        <source>Camera %1: %2, not as predicted</source>
        <translation>カメラ %1: %2、予測と違います</translation>
    </message>
    <message>
        <source>The view of camera %3 has moved by %1 px sideways and %2 px up or down.</source>
        <translation>カメラ %3 の視野が横に %1 px、縦に %2 px 動いています。</translation>
    </message>
    <message>
        <source>Camera %1 or a projector may have moved.</source>
        <translation>カメラ %1 かプロジェクターが動いた可能性があります。</translation>
    </message>
    <message>
        <source>Something has changed. Repair the calibration.</source>
        <translation>何かが変わりました。校正を修復してください。</translation>
    </message>
    <message>
        <source>Something has changed since it was measured. Repair the calibration: only that is measured again.</source>
        <translation>測定後に何かが変わりました。校正を修復してください。変わった部分だけが再測定されます。</translation>
    </message>
    <message>
        <source>Repair the calibration</source>
        <translation>校正を修復</translation>
    </message>
    <message>
        <source>Nothing to repair</source>
        <translation>修復するものはありません</translation>
    </message>
    <message>
        <source>The venue is as it was measured.</source>
        <translation>会場は測定したときのままです。</translation>
    </message>
    <message>
        <source>Not repaired</source>
        <translation>修復されませんでした</translation>
    </message>
    <message>
        <source>No better picture came of it: the measurement is used as before.</source>
        <translation>画像は良くなりませんでした。測定はこれまでどおり使われます。</translation>
    </message>
    <message>
        <source>Repaired, %1</source>
        <translation>修復済み、%1</translation>
    </message>
    <message>
        <source>Colour error of a photographed picture: %1 before, %2 now.</source>
        <translation>撮影した画像の色の誤差：以前 %1、現在 %2。</translation>
    </message>
    <message>
        <source>Finds what has changed, measures only that again, and keeps it if a photograph of the picture is better by it.</source>
        <translation>変わった部分を見つけて、そこだけを測定し直し、撮影した画像が良くなればそれを保存します。</translation>
    </message>
    <message>
        <source>Use the measurement before</source>
        <translation>以前の測定を使う</translation>
    </message>
    <message>
        <source>Takes the repair back.</source>
        <translation>修復を取り消します。</translation>
    </message>
    <message>
        <source>arrival to light</source>
        <translation>到着から投影まで</translation>
    </message>
    <message>
        <source>From a live picture&apos;s arrival at this computer until the projectors have it: the longest of the last five seconds. The way there is not in it.</source>
        <translation>ライブ映像がこのコンピューターに到着してからプロジェクターに渡るまでの時間で、直近 5 秒間の最大値です。ここまでの伝送時間は含みません。</translation>
    </message>
    <message>
        <source>Connecting to %1</source>
        <translation>%1 に接続中</translation>
    </message>
    <message>
        <source>Lost: %1. %2</source>
        <translation>途切れました：%1。%2</translation>
    </message>
    <message>
        <source>Add a stream</source>
        <translation>ストリームを追加</translation>
    </message>
    <message>
        <source>A live picture from the network, as cameras and encoders send it.</source>
        <translation>カメラやエンコーダーが送るネットワーク上のライブ映像です。</translation>
    </message>
    <message>
        <source>Nothing has moved: of the light only %1 is kept at Threshold, so that bounces are missing, in the prediction too. Keep more of it.</source>
        <translation>何も動いていません。「しきい値」で光の%1しか残していないため、予測でも反射光が欠けています。もっと残してください。</translation>
    </message>
    <message>
        <source>The show of another venue will no longer start at log-in.</source>
        <translation>別の会場のショーは、ログイン時に始まらなくなります。</translation>
    </message>
    <message>
        <source>The show of this venue will no longer start at log-in.</source>
        <translation>この会場のショーは、ログイン時に始まらなくなります。</translation>
    </message>
    <message>
        <source>Venue and playlist stay. It can be installed again from its venue&apos;s Output.</source>
        <translation>会場と再生リストは残ります。その会場の「出力」から再び登録できます。</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>削除</translation>
    </message>
    <message>
        <source>Keep</source>
        <translation>残す</translation>
    </message>
    <message>
        <source>To end it, hold Esc for two seconds at the projector&apos;s screen.</source>
        <translation>終了するには、プロジェクターの画面で Esc を 2 秒間押し続けます。</translation>
    </message>
    <message>
        <source>Test chart</source>
        <translation>テストチャート</translation>
    </message>
    <message>
        <source>A test chart is on the surface. T shows the next one, then the playlist.</source>
        <translation>表面にテストチャートを投影中です。T で次のチャート、その後はプレイリストに戻ります。</translation>
    </message>
    <message>
        <source>Show the playlist</source>
        <translation>プレイリストを表示</translation>
    </message>
    <message>
        <source>A test chart is on the surface</source>
        <translation>表面にテストチャートを投影中です</translation>
    </message>
    <message>
        <source>The playlist runs on unseen until you show it again.</source>
        <translation>もう一度表示するまで、プレイリストは見えないまま進みます。</translation>
    </message>
    <message>
        <source>Times of sets</source>
        <translation>セットの時刻</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>セット</translation>
    </message>
    <message>
        <source>Times of the day…</source>
        <translation>時刻…</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1：%2</translation>
    </message>
    <message>
        <source>The installed show plays this one all day.</source>
        <translation>登録したショーは終日このセットで再生します。</translation>
    </message>
    <message>
        <source>The picture is being perfected.</source>
        <translation>画像を仕上げています。</translation>
    </message>
    <message>
        <source>The output is being opened.</source>
        <translation>出力を開いています。</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged.</source>
        <translation>プロジェクターの画面が外れています。</translation>
    </message>
    <message>
        <source>There is nothing else on the list.</source>
        <translation>リストにほかの項目がありません。</translation>
    </message>
    <message>
        <source>The playlist is empty.</source>
        <translation>プレイリストは空です。</translation>
    </message>
    <message>
        <source>There is no other set.</source>
        <translation>ほかのセットがありません。</translation>
    </message>
    <message>
        <source>The show changes by itself, here too: %1</source>
        <translation>ショーは自動で切り替わります（ここでも）：%1</translation>
    </message>
    <message>
        <source>Choose in the desktop&apos;s dialog what to show as %1</source>
        <translation>%1 として表示するものをデスクトップのダイアログで選んでください</translation>
    </message>
    <message>
        <source>Add a screen or window</source>
        <translation>画面またはウィンドウを追加</translation>
    </message>
    <message>
        <source>The live picture of a screen of this computer, or of a window on it.</source>
        <translation>このコンピューターの画面、またはその上のウィンドウのライブ映像です。</translation>
    </message>
    <message>
        <source>A screen, chosen in the desktop&apos;s dialog</source>
        <translation>画面（デスクトップのダイアログで選択）</translation>
    </message>
    <message>
        <source>A window, chosen in the desktop&apos;s dialog</source>
        <translation>ウィンドウ（デスクトップのダイアログで選択）</translation>
    </message>
    <message>
        <source>Screen %1</source>
        <translation>画面 %1</translation>
    </message>
    <message>
        <source>Window %1</source>
        <translation>ウィンドウ %1</translation>
    </message>
    <message>
        <source>There is no desktop whose screens could be shown.</source>
        <translation>画面を表示できるデスクトップがありません。</translation>
    </message>
    <message>
        <source>The camera is back at its place</source>
        <translation>カメラは元の位置に戻りました</translation>
    </message>
    <message>
        <source>Put the camera back, or repair the calibration.</source>
        <translation>カメラを元に戻すか、校正を修復してください。</translation>
    </message>
    <message>
        <source>Perfecting</source>
        <translation>仕上げ中</translation>
    </message>
    <message>
        <source>Photographing</source>
        <translation>撮影中</translation>
    </message>
    <message>
        <source>Checking for drift</source>
        <translation>ずれを確認中</translation>
    </message>
    <message>
        <source>Repairing</source>
        <translation>修復中</translation>
    </message>
    <message>
        <source>The output is closed. Patterns to be photographed are projected.</source>
        <translation>出力は閉じています。撮影用のパターンを投影しています。</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>停止</translation>
    </message>
    <message>
        <source>Not as predicted</source>
        <translation>予測と異なる</translation>
    </message>
    <message>
        <source>The output is closed. The devices are in use at %1.</source>
        <translation>出力は閉じています。機器は「%1」で使用中です。</translation>
    </message>
    <message>
        <source>Show the current correction</source>
        <translation>現在の補正を表示</translation>
    </message>
    <message>
        <source>The projector still shows another correction. Show the current one, then take the photograph.</source>
        <translation>プロジェクターはまだ別の補正を表示しています。現在の補正を表示してから撮影してください。</translation>
    </message>
    <message>
        <source>Another correction</source>
        <translation>別の補正</translation>
    </message>
    <message>
        <source>The camera&apos;s view has moved. Put it back, then photograph again.</source>
        <translation>カメラの視野がずれました。元に戻してから、もう一度撮影してください。</translation>
    </message>
    <message>
        <source>The show still plays another correction</source>
        <translation>ショーはまだ別の補正で再生しています</translation>
    </message>
    <message>
        <source>Another correction plays. Show the current one first.</source>
        <translation>別の補正が再生されています。先に現在の補正を表示してください。</translation>
    </message>
    <message>
        <source>Another correction still plays.</source>
        <translation>まだ別の補正が再生されています。</translation>
    </message>
    <message>
        <source>Covered by %1</source>
        <translation>%1が表示中</translation>
    </message>
    <message>
        <source>The projector shows the light of another step: %1</source>
        <translation>プロジェクターは別のステップの光を表示しています：%1</translation>
    </message>
    <message>
        <source>The show goes on behind it, and is seen again when that has ended.</source>
        <translation>ショーはその背後で続き、終わると再び見えます。</translation>
    </message>
    <message>
        <source>The light of another step is before the show.</source>
        <translation>別のステップの光がショーの前に表示されています。</translation>
    </message>
    <message>
        <source>Time of a picture</source>
        <translation>画像の表示時間</translation>
    </message>
    <message>
        <source>%1, skipped</source>
        <translation>%1、スキップ</translation>
    </message>
    <message>
        <source>Seconds that the chosen picture stands</source>
        <translation>選んだ画像を表示する秒数</translation>
    </message>
    <message>
        <source> s</source>
        <translation> 秒</translation>
    </message>
    <message>
        <source>Picture stands for</source>
        <translation>画像の表示時間</translation>
    </message>
    <message>
        <source>Photographed %1.</source>
        <translation>撮影：%1。</translation>
    </message>
    <message>
        <source>Photographed %1, before the last check for drift.</source>
        <translation>撮影：%1、前回のドリフト確認より前。</translation>
    </message>
    <message>
        <source>The surface looked as predicted then</source>
        <translation>その時点では、投影面は予測どおりに見えました</translation>
    </message>
    <message>
        <source>Checked %1.</source>
        <translation>確認：%1。</translation>
    </message>
    <message>
        <source>Hold A for the original, Ctrl+P freezes, B makes it black, T shows test charts, O figures.</source>
        <translation>A を押している間は元の映像、Ctrl+P で静止、B で黒、T でテストチャート、O で数値。</translation>
    </message>
    <message>
        <source>No program here opens it: open it by hand, or take it to another computer.</source>
        <translation>ここには開けるプログラムがありません。手動で開くか、別のコンピューターに移してください。</translation>
    </message>
    <message>
        <source>Picture: %1</source>
        <translation>画像：%1</translation>
    </message>
    <message>
        <source>The check was ended: the room is not said to be clear</source>
        <translation>チェックを終了しました。退避の確認が取り消されています</translation>
    </message>
    <message>
        <source>It came to no result. Check again when the room is clear.</source>
        <translation>結果は得られていません。退避が完了したらもう一度チェックしてください。</translation>
    </message>
    <message>
        <source>The repair was ended: the room is not said to be clear</source>
        <translation>修復を終了しました。退避の確認が取り消されています</translation>
    </message>
    <message>
        <source>The measurement is used as before. Repair again when the room is clear.</source>
        <translation>測定はこれまでどおり使われます。退避が完了したらもう一度修復してください。</translation>
    </message>
    <message>
        <source>The output is closed. A picture to be photographed is projected.</source>
        <translation>出力は閉じています。撮影用の画像を投影しています。</translation>
    </message>
    <message>
        <source>The room is brighter by %1 of full light.</source>
        <translation>部屋は全点灯の %1 だけ明るくなっています。</translation>
    </message>
    <message>
        <source>The room is darker by %1 of full light.</source>
        <translation>部屋は全点灯の %1 だけ暗くなっています。</translation>
    </message>
    <message>
        <source>The projector gives %1 of the light that it gave.</source>
        <translation>プロジェクターの光は以前の %1 です。</translation>
    </message>
    <message>
        <source>The output is closed. Nothing is projected from here.</source>
        <translation>出力は閉じています。ここからは何も投影していません。</translation>
    </message>
    <message>
        <source>A photograph is being taken.</source>
        <translation>写真を撮影しています。</translation>
    </message>
    <message>
        <source>Slowly, as the room is not said to be clear: nothing flashes.</source>
        <translation>退避が確認されていないため、点滅しないようゆっくり行います。</translation>
    </message>
    <message>
        <source>It plays this playlist with the measurement that is in use by then.</source>
        <translation>そのとき使われている測定で、このプレイリストを再生します。</translation>
    </message>
    <message>
        <source>The output is closed here. Another program plays a show of this venue.</source>
        <translation>ここの出力は閉じています。別のプログラムがこの会場のショーを再生しています。</translation>
    </message>
    <message>
        <source>Hardly anything fits. Put the camera back or repair the calibration; if neither helps, aim and measure again.</source>
        <translation>ほとんど一致しません。カメラを元に戻すか、校正を修復してください。どちらも効かなければ、向きを合わせて測定し直してください。</translation>
    </message>
    <message>
        <source>Almost nothing of the projector&apos;s light is seen. Look at the lens and at the projector, then check again.</source>
        <translation>プロジェクターの光がほとんど見えません。レンズとプロジェクターを確認してから、もう一度検査してください。</translation>
    </message>
    <message>
        <source>Installed. The show starts at the next log-in, without wizard. The camera stays: at night it looks after the picture.</source>
        <translation>インストール済みです。ショーは次のログイン時に、ウィザードなしで始まります。カメラはそのまま残します。夜間に画像の手入れをします。</translation>
    </message>
    <message>
        <source>Another program plays</source>
        <translation>別のプログラムが再生中</translation>
    </message>
    <message>
        <source>Hardly anything fits. Put the camera back, repair the calibration, or aim and measure again.</source>
        <translation>ほとんど一致しません。カメラを元に戻す、校正を修復する、または向きを合わせて測定し直してください。</translation>
    </message>
    <message>
        <source>Another program plays a show of this venue.</source>
        <translation>別のプログラムがこの会場のショーを再生しています。</translation>
    </message>
    <message>
        <source>The room&apos;s light has changed. Restore it and check again, or repair the calibration.</source>
        <translation>室内の明かりが変わっています。元に戻してもう一度検査するか、校正を修復してください。</translation>
    </message>
    <message>
        <source>The camera looks elsewhere</source>
        <translation>カメラが別の場所を向いています</translation>
    </message>
    <message>
        <source>It was left %1 px from where it looked when it was measured. Put it back, or repair the calibration.</source>
        <translation>測定時の向きから %1 px ずれたままです。元に戻すか、校正を修復してください。</translation>
    </message>
    <message>
        <source>Put the camera back, or measure again.</source>
        <translation>カメラを元に戻すか、測定し直してください。</translation>
    </message>
    <message>
        <source>Something has changed. Measure again.</source>
        <translation>何かが変わりました。測定し直してください。</translation>
    </message>
    <message>
        <source>Hardly anything fits. Put the camera back, or aim and measure again.</source>
        <translation>ほとんど一致しません。カメラを元に戻すか、向きを合わせて測定し直してください。</translation>
    </message>
    <message>
        <source>Keep the repaired one</source>
        <translation>修復したものを使い続ける</translation>
    </message>
    <message>
        <source>Use the measurement before?</source>
        <translation>以前の測定を使いますか？</translation>
    </message>
    <message>
        <source>What was repaired is measured again if you repair once more.</source>
        <translation>修復した部分は、もう一度修復すると測定し直されます。</translation>
    </message>
    <message>
        <source>The measurement from before the repair is used as it was, with all that followed from it.</source>
        <translation>修復前の測定が、それに基づくすべてとともに、元のまま使われます。</translation>
    </message>
    <message>
        <source>Screen %1, which this plays on</source>
        <translation>画面 %1（再生先）</translation>
    </message>
    <message>
        <source>They are larger than predicted. A check for drift tells whether something has moved.</source>
        <translation>予測より大きくなっています。ドリフトを確認すると、何かが動いたかどうかが分かります。</translation>
    </message>
    <message>
        <source>Once installed, the show starts at every log-in, without wizard. The camera stays: at night it looks after the picture.</source>
        <translation>登録すると、ログインするたびに、ウィザードなしでショーが始まります。カメラはそのまま残し、夜間に画像の手入れをします。</translation>
    </message>
    <message>
        <source>Take a verification photograph. What was found before is not settled.</source>
        <translation>検証写真を撮影してください。以前に見つかったことは解決していません。</translation>
    </message>
    <message>
        <source>The surface did not look as predicted. Open the output: it leads to what helps.</source>
        <translation>面は予測どおりに見えませんでした。出力を開くと、次にすることが分かります。</translation>
    </message>
    <message>
        <source>Black: the frozen picture stands unseen until you show it again.</source>
        <translation>黒：静止した画像は、再び表示するまで見えません。</translation>
    </message>
    <message>
        <source>still picture, perfected by photographs</source>
        <translation>静止画、写真により仕上げ済み</translation>
    </message>
    <message>
        <source>Nothing has moved: part of the picture is out of the projector&apos;s reach, in a shadow, darker than its black or brighter than its white there. Another picture, or another place for it, helps.</source>
        <translation>何も動いていません。画像の一部がプロジェクターの届く範囲外です（影の中、その場所の黒より暗い、または白より明るい）。別の画像か別の位置にすると改善します。</translation>
    </message>
    <message>
        <source>Errors are plain to see</source>
        <translation>誤差がはっきり見えます</translation>
    </message>
    <message>
        <source>The frozen picture stands unseen until you show it again.</source>
        <translation>静止した画像は、再び表示するまで見えないまま残ります。</translation>
    </message>
    <message>
        <source>The output is closed here. Another program plays a show of another venue on this projector.</source>
        <translation>ここの出力は閉じています。別のプログラムがこのプロジェクターで別の会場のショーを再生しています。</translation>
    </message>
    <message>
        <source>Another program plays a show of another venue on this projector.</source>
        <translation>別のプログラムがこのプロジェクターで別の会場のショーを再生しています。</translation>
    </message>
    <message>
        <source>Two shows at once</source>
        <translation>2 つのショーが同時</translation>
    </message>
    <message>
        <source>The output is open here and in another program: whose picture is seen is not known. End one.</source>
        <translation>出力はここと別のプログラムの両方で開いています：どちらの画像が見えているか分かりません。一方を終了してください。</translation>
    </message>
    <message>
        <source>Perhaps under another program&apos;s picture</source>
        <translation>別のプログラムの画像の下かもしれません</translation>
    </message>
    <message>
        <source>Black: the test chart stands unseen. T shows the next one, then the playlist.</source>
        <translation>黒：テストチャートが見えないまま残っています。T で次のチャート、その後は再生リストに戻ります。</translation>
    </message>
    <message>
        <source>Hide the figures</source>
        <translation>数値を隠す</translation>
    </message>
    <message>
        <source>Figures are on the surface</source>
        <translation>サーフェスに数値が出ています</translation>
    </message>
    <message>
        <source>Whoever is in the room reads them over the picture.</source>
        <translation>会場にいる人には、画像の上に読めます。</translation>
    </message>
    <message>
        <source>Installed as it is. %1</source>
        <translation>このままインストールされました。%1</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the patterns flash.</source>
        <translation>退避が完了したことを確認してください。パターンは点滅します。</translation>
    </message>
    <message>
        <source>No picture has come yet: black</source>
        <translation>まだ映像が届いていません: 黒</translation>
    </message>
    <message>
        <source>The live picture is lost: black</source>
        <translation>ライブ映像が途切れました: 黒</translation>
    </message>
    <message>
        <source>The live picture is lost: its last one stands</source>
        <translation>ライブ映像が途切れました: 最後の映像を表示中</translation>
    </message>
    <message>
        <source>A film plays to its end.</source>
        <translation>動画は最後まで再生されます。</translation>
    </message>
    <message>
        <source>A part of the surface looks otherwise than predicted, by ΔE %1.</source>
        <translation>表面の一部が予測と異なって見えます（ΔE %1）。</translation>
    </message>
    <message>
        <source>Installed, but the show cannot start with what was measured last.</source>
        <translation>インストール済みですが、最後の測定ではショーを開始できません。</translation>
    </message>
    <message>
        <source>Go on measuring, or use the earlier one, at Acquire.</source>
        <translation>「光輸送測定」で、測定を続けるか以前の測定を使ってください。</translation>
    </message>
    <message>
        <source>Go on measuring at Acquire.</source>
        <translation>「光輸送測定」で測定を続けてください。</translation>
    </message>
    <message>
        <source>What was measured is too coarse to place content. Go on measuring.</source>
        <translation>測定が粗すぎて、コンテンツを配置できません。測定を続けてください。</translation>
    </message>
    <message>
        <source>Not all was decided on what is measured now</source>
        <translation>一部の設定は今の測定に基づいていません</translation>
    </message>
    <message>
        <source>Steps that are out of date count with what was chosen there before.</source>
        <translation>古くなった手順には、以前そこで選んだ内容が使われます。</translation>
    </message>
    <message>
        <source>The test patterns fit, the photograph does not</source>
        <translation>テストパターンは合っていますが、写真は合っていません</translation>
    </message>
    <message>
        <source>Few patterns can miss a small part. Where another photograph differs, too, a repair looks closer.</source>
        <translation>少ないパターンでは小さな部分を見落とすことがあります。もう一度撮影しても違う場合は、修復でさらに詳しく調べます。</translation>
    </message>
    <message>
        <source>This picture was perfected after the photograph.</source>
        <translation>この画像は写真の撮影後に仕上げられました。</translation>
    </message>
    <message>
        <source>In the camera&apos;s picture it is %1 from the left and %2 from the top.</source>
        <translation>カメラ画像の左から %1、上から %2 の位置です。</translation>
    </message>
    <message>
        <source>What was found before may have come of that: a photograph shows what is left of it.</source>
        <translation>その前に見つかったことはそのためかもしれません。検証写真で何が残っているかが分かります。</translation>
    </message>
    <message>
        <source>Black. %1</source>
        <translation>黒表示。%1</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputPlaylist</name>
    <message>
        <source>Demonstration picture</source>
        <translation>デモ画像</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputProjection</name>
    <message>
        <source>Open the output again.</source>
        <translation>出力をもう一度開いてください。</translation>
    </message>
    <message>
        <source>Relucent is projecting</source>
        <translation>Relucent が投影しています</translation>
    </message>
    <message>
        <source>%1, shown without OpenGL</source>
        <translation>%1、OpenGL なしで表示</translation>
    </message>
    <message>
        <source>The output goes on as before.</source>
        <translation>出力はこれまでどおり続きます。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputProof</name>
    <message>
        <source>No venue is open.</source>
        <translation>会場が開かれていません。</translation>
    </message>
    <message>
        <source>A photograph is being taken.</source>
        <translation>撮影しています。</translation>
    </message>
    <message>
        <source>Drift is being checked.</source>
        <translation>ドリフトを確認しています。</translation>
    </message>
    <message>
        <source>It is being repaired.</source>
        <translation>修復しています。</translation>
    </message>
    <message>
        <source>The report is being written.</source>
        <translation>レポートを書いています。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Perfecting</name>
    <message>
        <source>%1 The picture is shown as before. Try again.</source>
        <translation>%1 画像はこれまでどおり表示されます。もう一度お試しください。</translation>
    </message>
    <message>
        <source>The photographs found nothing better. The picture is shown as before.</source>
        <translation>写真からより良いものは見つかりませんでした。画像はこれまでどおり表示されます。</translation>
    </message>
    <message>
        <source>The picture is being perfected</source>
        <translation>画像を仕上げています</translation>
    </message>
    <message numerus="yes">
        <source>%n photograph(s) by now. Keep the room as it is.</source>
        <translation>
            <numerusform>これまでに写真 %n 枚。部屋をそのままにしてください。</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1: %2 before, %3 now, by %n photograph(s).</source>
        <translation>
            <numerusform>%1：以前 %2、現在 %3、写真 %n 枚。</numerusform>
        </translation>
    </message>
    <message>
        <source>This picture is perfected</source>
        <translation>この画像は仕上げ済みです</translation>
    </message>
    <message>
        <source>The picture is as it was</source>
        <translation>画像は元のままです</translation>
    </message>
    <message>
        <source>Not perfected</source>
        <translation>未仕上げ</translation>
    </message>
    <message>
        <source>A picture that stands can be corrected by photographs of itself, some eight of them. It is kept for this venue, placed as it is now.</source>
        <translation>静止画は、その画像自体の写真（8 枚ほど）で補正できます。この会場と現在の配置のために保存されます。</translation>
    </message>
    <message>
        <source>Perfect a picture</source>
        <translation>画像の仕上げ</translation>
    </message>
    <message>
        <source>Perfect this picture</source>
        <translation>この画像を仕上げる</translation>
    </message>
    <message>
        <source>Stop and keep the best</source>
        <translation>止めて最良を残す</translation>
    </message>
    <message>
        <source>Show it as before</source>
        <translation>以前の表示に戻す</translation>
    </message>
    <message>
        <source>What the photographs corrected is dropped.</source>
        <translation>写真による補正は破棄されます。</translation>
    </message>
    <message>
        <source>Perfect it again</source>
        <translation>もう一度仕上げる</translation>
    </message>
    <message>
        <source>No venue is open.</source>
        <translation>会場が開かれていません。</translation>
    </message>
    <message>
        <source>The picture is being perfected.</source>
        <translation>画像を仕上げています。</translation>
    </message>
    <message>
        <source>perfected, %1 before, %2 now.</source>
        <translation>仕上げ済み、以前 %1、現在 %2。</translation>
    </message>
    <message>
        <source>Tried last, %1: %2</source>
        <translation>前回の対象 %1：%2</translation>
    </message>
    <message>
        <source>Slowly, as the room is not said to be clear: nothing flashes.</source>
        <translation>退避が確認されていないため、点滅しないようゆっくり行います。</translation>
    </message>
    <message>
        <source>Picture: %1</source>
        <translation>画像：%1</translation>
    </message>
    <message>
        <source>Not perfected since it changed</source>
        <translation>変更後は未仕上げ</translation>
    </message>
    <message>
        <source>It was perfected for an earlier measurement, for another set, with other light or masks, or placed otherwise. That is kept, and is of no use now: perfect it once more.</source>
        <translation>以前の測定用、別のセット用、別の光やマスクで、または別の配置で仕上げられています。それは保存されていますが、今は使えません。もう一度仕上げてください。</translation>
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
        <translation>Esc で戻る</translation>
    </message>
</context>
<context>
    <name>relucent::gui::PreviewPage</name>
    <message>
        <source>Demonstration picture</source>
        <translation>デモ画像</translation>
    </message>
    <message>
        <source>Content</source>
        <translation>コンテンツ</translation>
    </message>
    <message>
        <source>Change</source>
        <translation>変更</translation>
    </message>
    <message>
        <source>Whole</source>
        <translation>全体</translation>
    </message>
    <message>
        <source>Fill</source>
        <translation>余白なし</translation>
    </message>
    <message>
        <source>Stretch</source>
        <translation>伸縮</translation>
    </message>
    <message>
        <source>Place automatically</source>
        <translation>自動配置</translation>
    </message>
    <message>
        <source>In the largest upright rectangle that can be reached</source>
        <translation>再現できる範囲で最大の、傾きのない長方形に配置</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>光</translation>
    </message>
    <message>
        <source>May stay too dark</source>
        <translation>暗いままでよい割合</translation>
    </message>
    <message>
        <source>Share of the content that may stay too dark, percent</source>
        <translation>コンテンツのうち暗いままでよい割合（パーセント）</translation>
    </message>
    <message>
        <source>Lift of the blacks</source>
        <translation>黒の持ち上げ</translation>
    </message>
    <message>
        <source>Lift of the blacks, percent</source>
        <translation>黒の持ち上げ（パーセント）</translation>
    </message>
    <message>
        <source>Reach</source>
        <translation>再現範囲</translation>
    </message>
    <message>
        <source>Can be reached</source>
        <translation>再現可能</translation>
    </message>
    <message>
        <source>Too dark to reach</source>
        <translation>明るさ不足</translation>
    </message>
    <message>
        <source>Never black enough</source>
        <translation>黒の沈み不足</translation>
    </message>
    <message>
        <source>Colour error</source>
        <translation>色差</translation>
    </message>
    <message>
        <source>Part of the picture gets no light from this projector.</source>
        <translation>画像の一部に、このプロジェクターの光が届きません。</translation>
    </message>
    <message>
        <source>A second could fill it.</source>
        <translation>2 台目で補えるかもしれません。</translation>
    </message>
    <message>
        <source>Choose a picture</source>
        <translation>画像を選択</translation>
    </message>
    <message>
        <source>Fit</source>
        <translation>収め方</translation>
    </message>
    <message>
        <source>Brightness</source>
        <translation>明るさ</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>測定済みのデータは無事です。</translation>
    </message>
    <message>
        <source>Picture</source>
        <translation>画像</translation>
    </message>
    <message>
        <source>The picture of before stays.</source>
        <translation>以前の画像のままです。</translation>
    </message>
    <message>
        <source>Preparing the preview</source>
        <translation>プレビューの準備</translation>
    </message>
    <message>
        <source>The corners cross over. Drag them apart.</source>
        <translation>四隅が交差しています。ドラッグして離してください。</translation>
    </message>
    <message>
        <source>Corners</source>
        <translation>四隅</translation>
    </message>
    <message>
        <source>Automatic place</source>
        <translation>自動配置</translation>
    </message>
    <message>
        <source>Preparing</source>
        <translation>準備中</translation>
    </message>
    <message>
        <source>%1 in reach</source>
        <translation>再現可能 %1</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>要更新</translation>
    </message>
    <message>
        <source>The preview is not prepared.</source>
        <translation>プレビューは準備されていません。</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>機器は「%1」で使用中です。</translation>
    </message>
    <message>
        <source>Predicting</source>
        <translation>予測中</translation>
    </message>
    <message>
        <source>Predicted from the measurement. Nothing is projected now.</source>
        <translation>測定からの予測です。現在は何も投影していません。</translation>
    </message>
    <message>
        <source>Preview</source>
        <translation>プレビュー</translation>
    </message>
    <message>
        <source>Place the content in the camera&apos;s view and see what the audience will see before you project it.</source>
        <translation>コンテンツをカメラ視野に配置し、投影する前に観客からの見え方を確認します。</translation>
    </message>
    <message>
        <source>Audience view</source>
        <translation>観客からの見え方</translation>
    </message>
    <message>
        <source>Reachable light</source>
        <translation>再現可能な光</translation>
    </message>
    <message>
        <source>Difference</source>
        <translation>差</translation>
    </message>
    <message>
        <source>What the audience will see, uncorrected at the left of the divider and corrected at the right</source>
        <translation>観客からの見え方。境界線の左が補正前、右が補正後</translation>
    </message>
    <message>
        <source>Colour difference between what is wanted and what is predicted</source>
        <translation>目標と予測との色差</translation>
    </message>
    <message>
        <source>Methods</source>
        <translation>方式</translation>
    </message>
    <message>
        <source>predicted for this content; click one to use it</source>
        <translation>このコンテンツでの予測。クリックして選択</translation>
    </message>
    <message>
        <source>Comparison of methods</source>
        <translation>方式の比較</translation>
    </message>
    <message>
        <source>Method</source>
        <translation>方式</translation>
    </message>
    <message>
        <source>Notes</source>
        <translation>備考</translation>
    </message>
    <message>
        <source>blind to bounces</source>
        <translation>相互反射を無視</translation>
    </message>
    <message>
        <source>limit of this venue</source>
        <translation>この会場の限界</translation>
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
        <translation>補正なし</translation>
    </message>
    <message>
        <source>Corrected, predicted</source>
        <translation>補正後（予測）</translation>
    </message>
    <message>
        <source>of white</source>
        <translation>白に対する比</translation>
    </message>
    <message>
        <source>The larger this share, the brighter the picture, and the more of it stays too dark.</source>
        <translation>この割合が大きいほど画像は明るくなり、明るさの足りない部分も増えます。</translation>
    </message>
    <message>
        <source>Part of the picture gets no light from any projector.</source>
        <translation>画像の一部にはどのプロジェクターの光も届きません。</translation>
    </message>
    <message>
        <source>Another one could fill it.</source>
        <translation>もう 1 台あれば補えます。</translation>
    </message>
    <message>
        <source>Go to output</source>
        <translation>出力へ</translation>
    </message>
    <message>
        <source>under 1 ms</source>
        <translation>1 ms 未満</translation>
    </message>
    <message>
        <source>Uncorrected, too</source>
        <translation>こちらも補正なし</translation>
    </message>
    <message>
        <source>What was measured is too coarse to place content. Go on measuring.</source>
        <translation>測定が粗すぎて、コンテンツを配置できません。測定を続けてください。</translation>
    </message>
    <message>
        <source>All of it can be reached</source>
        <translation>すべて届きます</translation>
    </message>
    <message>
        <source>no note</source>
        <translation>注記なし</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged.</source>
        <translation>プロジェクターの画面が外れています。</translation>
    </message>
    <message>
        <source>On the surface now: the corrected picture.</source>
        <translation>面に表示中：補正した画像。</translation>
    </message>
    <message>
        <source>On the surface now: the uncorrected picture.</source>
        <translation>面に表示中：補正なしの画像。</translation>
    </message>
    <message>
        <source>Stop shining</source>
        <translation>投影を止める</translation>
    </message>
    <message>
        <source>Shine on surface</source>
        <translation>面に投影</translation>
    </message>
    <message>
        <source>Shows this picture on the surface until you stop it or leave.</source>
        <translation>停止するかページを離れるまで、この画像を面に映します。</translation>
    </message>
    <message>
        <source>Show uncorrected</source>
        <translation>補正なしを表示</translation>
    </message>
    <message>
        <source>Show corrected</source>
        <translation>補正ありを表示</translation>
    </message>
    <message>
        <source>There is no preview yet.</source>
        <translation>プレビューはまだありません。</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is not there. Plug it in and extend the desktop to it.</source>
        <translation>プロジェクターの画面がありません。接続して、デスクトップを拡張してください。</translation>
    </message>
    <message>
        <source>The brightest light that can be reached; hatched where the content is out of reach</source>
        <translation>出せる最も明るい光。内容に届かない部分は斜線</translation>
    </message>
    <message>
        <source>Hatched: %1 cannot be reached</source>
        <translation>斜線：%1 は届きません</translation>
    </message>
    <message>
        <source>It has been measured again since the content was placed</source>
        <translation>コンテンツの配置後に、測定し直されています</translation>
    </message>
    <message>
        <source>The threshold has been changed since the content was placed</source>
        <translation>コンテンツの配置後に、しきい値が変更されています</translation>
    </message>
    <message>
        <source>What you see here is predicted anew. Going to the output keeps it.</source>
        <translation>ここに表示しているのは新しい予測です。出力へ進むと保存されます。</translation>
    </message>
    <message>
        <source>Still picture</source>
        <translation>静止画</translation>
    </message>
    <message>
        <source>How long a still picture takes to be solved, once. Films always play by “All bounces, for films” in the quicker show engine: how fast is said at Cluster.</source>
        <translation>静止画を 1 回計算するのにかかる時間です。動画は常に、より速いショー用エンジンで「相互反射すべて、動画用」により再生されます。速さは「クラスター」に表示されます。</translation>
    </message>
    <message>
        <source>Of this content, where it can be reached. What Acquire expects is a mean of other pictures: the two may differ by some dB.</source>
        <translation>このコンテンツの、再現できる範囲での値です。測定時の予想は別の画像の平均なので、数 dB 違うことがあります。</translation>
    </message>
    <message>
        <source>blind to light between clusters</source>
        <translation>クラスター間の光を無視</translation>
    </message>
    <message>
        <source>recommended</source>
        <translation>推奨</translation>
    </message>
    <message>
        <source>Compare</source>
        <translation>比較</translation>
    </message>
    <message>
        <source>Hide</source>
        <translation>隠す</translation>
    </message>
    <message>
        <source>This content comes to %1. Acquire expected %2 on average of three other pictures, by the recommended method.</source>
        <translation>このコンテンツは %1 です。「光輸送測定」での見込みは、別の 3 枚の画像の平均で %2（推奨の方法）でした。</translation>
    </message>
    <message>
        <source>Place of a camera</source>
        <translation>カメラの位置</translation>
    </message>
    <message>
        <source>no content</source>
        <translation>コンテンツなし</translation>
    </message>
    <message>
        <source>%1 dB, ΔE %2</source>
        <translation>%1 dB、ΔE %2</translation>
    </message>
    <message>
        <source>%1, counts %2</source>
        <translation>%1、重み %2</translation>
    </message>
    <message>
        <source>Views</source>
        <translation>視点</translation>
    </message>
    <message>
        <source>On the surface</source>
        <translation>投影面に沿う</translation>
    </message>
    <message>
        <source>Upright from here</source>
        <translation>ここから正立</translation>
    </message>
    <message>
        <source>Weight of this view</source>
        <translation>この視点の重み</translation>
    </message>
    <message>
        <source>Weight of the shown view, percent</source>
        <translation>表示中の視点の重み、パーセント</translation>
    </message>
    <message>
        <source>For one viewer who moves</source>
        <translation>動く一人の観客のため</translation>
    </message>
    <message>
        <source>Where the viewer stands, from the first camera to the last</source>
        <translation>最初のカメラから最後のカメラまでの観客の位置</translation>
    </message>
    <message>
        <source>Place in this view</source>
        <translation>この視点での位置</translation>
    </message>
    <message>
        <source>Weight of a view</source>
        <translation>視点の重み</translation>
    </message>
    <message>
        <source>Drag the cameras to where they stand, then move the viewer.</source>
        <translation>カメラを実際の位置へドラッグし、それから観客を動かしてください。</translation>
    </message>
    <message>
        <source>As little as hides where projectors end</source>
        <translation>プロジェクターの端が見えなくなる最小限</translation>
    </message>
    <message>
        <source>Place of the viewer</source>
        <translation>観客の位置</translation>
    </message>
    <message>
        <source>Contradiction</source>
        <translation>矛盾</translation>
    </message>
    <message>
        <source>How much worse a view is because of what the other views ask for</source>
        <translation>ほかの視点の要求によってこの視点がどれだけ悪くなるか</translation>
    </message>
    <message>
        <source>Comparing the views</source>
        <translation>視点を比較しています</translation>
    </message>
    <message>
        <source>Visibly worse because of other views: %1</source>
        <translation>ほかの視点のために目に見えて悪い部分：%1</translation>
    </message>
    <message>
        <source>Visibly worse because of other views</source>
        <translation>ほかの視点のために目に見えて悪い部分</translation>
    </message>
    <message>
        <source>Even</source>
        <translation>一様</translation>
    </message>
    <message>
        <source>One white for all pictures, as bright as most of the surface can show it.</source>
        <translation>すべての画像に一つの白を使います。投影面の大部分で表示できる明るさです。</translation>
    </message>
    <message>
        <source>By picture</source>
        <translation>画像ごと</translation>
    </message>
    <message>
        <source>Each picture has the white at which the least of it is lost: dark ones become brighter, bright ones dimmer.</source>
        <translation>失われる部分が最も少なくなる白を画像ごとに使います。暗い画像は明るく、明るい画像は暗くなります。</translation>
    </message>
    <message>
        <source>By region</source>
        <translation>領域ごと</translation>
    </message>
    <message>
        <source>The same for each part of the picture, smoothly from one to the next: the least is lost of all.</source>
        <translation>画像の部分ごとに同じことを行い、滑らかにつなぎます。失われる部分が最も少なくなります。</translation>
    </message>
    <message>
        <source>How bright white is</source>
        <translation>白の明るさ</translation>
    </message>
    <message>
        <source>The picture is shown as before.</source>
        <translation>画像はこれまでどおり表示されます。</translation>
    </message>
    <message>
        <source>Bright</source>
        <translation>明るく</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show are as bright as can be: white on a yellow wall turns yellow.</source>
        <translation>面が出せない色をできるだけ明るくします。黄色い壁の白は黄色くなります。</translation>
    </message>
    <message>
        <source>Between</source>
        <translation>中間</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show become somewhat dimmer and shift less.</source>
        <translation>面が出せない色を少し暗くし、色相のずれを抑えます。</translation>
    </message>
    <message>
        <source>True</source>
        <translation>忠実</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show are dimmed until their hue is right: for faces and logos.</source>
        <translation>面が出せない色を、色相が正しくなるまで暗くします。顔やロゴ向けです。</translation>
    </message>
    <message>
        <source>Colours out of reach</source>
        <translation>再現できない色</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show</source>
        <translation>面が出せない色</translation>
    </message>
    <message>
        <source>Uncertainty</source>
        <translation>不確かさ</translation>
    </message>
    <message>
        <source>95 of 100 pixels come within this of what is predicted, in percent of white. More photographs or longer exposures make it smaller.</source>
        <translation>100画素のうち95画素が予測からこの範囲に収まります（白に対するパーセント）。写真を増やすか露光を長くすると小さくなります。</translation>
    </message>
    <message>
        <source>How far the light may be from what is predicted, by the measurement&apos;s noise</source>
        <translation>測定のノイズのために光が予測からどれだけずれうるか</translation>
    </message>
    <message>
        <source>95 of 100 pixels come within the value shown, on average %1 of white</source>
        <translation>100画素のうち95画素が表示値の範囲に収まります。平均は白の%1です</translation>
    </message>
    <message>
        <source>Quality</source>
        <translation>画質</translation>
    </message>
    <message>
        <source>Detail kept</source>
        <translation>細部の再現</translation>
    </message>
    <message>
        <source>Peak signal-to-noise ratio, PSNR: 20 dB looks rough, 30 dB good.</source>
        <translation>ピーク信号対雑音比（PSNR）：20 dB は粗く、30 dB は良好に見えます。</translation>
    </message>
    <message>
        <source>Structural similarity, SSIM: 1 is all of it.</source>
        <translation>構造的類似度（SSIM）：1 ですべて再現。</translation>
    </message>
    <message>
        <source>What of it is shown</source>
        <translation>表示する内容</translation>
    </message>
    <message>
        <source>Mask %1</source>
        <translation>マスク %1</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1、%2</translation>
    </message>
    <message>
        <source>Masks</source>
        <translation>マスク</translation>
    </message>
    <message>
        <source>No light falls on these parts: doors, windows, where visitors sit.</source>
        <translation>これらの部分には光を当てません：扉、窓、来場者の席。</translation>
    </message>
    <message>
        <source>Draw a mask</source>
        <translation>マスクを描く</translation>
    </message>
    <message>
        <source>Click points in the picture, and the first one again to close. With the keyboard: arrow keys, Space, Return; Escape leaves it.</source>
        <translation>画像内の点をクリックし、最初の点をもう一度クリックして閉じます。キーボードでは矢印キー、スペース、Enter。Escape で中止します。</translation>
    </message>
    <message>
        <source>Straight</source>
        <translation>直線</translation>
    </message>
    <message>
        <source>Curved</source>
        <translation>曲線</translation>
    </message>
    <message>
        <source>How the points of the mask are joined</source>
        <translation>マスクの点のつなぎ方</translation>
    </message>
    <message>
        <source>Feather</source>
        <translation>ぼかし</translation>
    </message>
    <message>
        <source>How far beyond the mask the light comes back, thousandths of the view</source>
        <translation>マスクの外で光が戻るまでの幅（視野の千分率）</translation>
    </message>
    <message>
        <source>Remove the mask</source>
        <translation>マスクを削除</translation>
    </message>
    <message>
        <source>Stop drawing</source>
        <translation>描画を終える</translation>
    </message>
    <message>
        <source>errors weighed as an eye does</source>
        <translation>目の感じ方で誤差を重み付け</translation>
    </message>
    <message>
        <source>No venue is open.</source>
        <translation>会場が開かれていません。</translation>
    </message>
    <message>
        <source>The sets are as they were.</source>
        <translation>セットは元のままです。</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>セット</translation>
    </message>
    <message>
        <source>Without a name</source>
        <translation>名前なし</translation>
    </message>
    <message>
        <source>More</source>
        <translation>その他</translation>
    </message>
    <message>
        <source>More for the set</source>
        <translation>セットのその他の操作</translation>
    </message>
    <message>
        <source>Save as…</source>
        <translation>名前を付けて保存…</translation>
    </message>
    <message>
        <source>Rename…</source>
        <translation>名前を変更…</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>削除</translation>
    </message>
    <message>
        <source>It is placed automatically.</source>
        <translation>自動で配置されています。</translation>
    </message>
    <message>
        <source>A picture is on the surface.</source>
        <translation>面に画像を映しています。</translation>
    </message>
    <message>
        <source>The output is open. Close it first.</source>
        <translation>出力が開いています。先に閉じます。</translation>
    </message>
    <message>
        <source>Shine on %1</source>
        <translation>%1 に投影</translation>
    </message>
    <message>
        <source>A rehearsal has no surface: this lights the screen %1 until you stop it or leave.</source>
        <translation>リハーサルには面がありません。停止するかページを離れるまで、画面 %1 に映します。</translation>
    </message>
    <message>
        <source>Part of the picture lies where the view is left out.</source>
        <translation>画像の一部は視野から除外された場所にあります。</translation>
    </message>
    <message>
        <source>It stays uncorrected. Acquire says why.</source>
        <translation>そこは補正されません。理由は「光輸送測定」にあります。</translation>
    </message>
    <message>
        <source>Predicted from the measurement. The output stays as it is.</source>
        <translation>測定からの予測です。出力はそのままです。</translation>
    </message>
    <message>
        <source>The content was placed on another measurement or threshold</source>
        <translation>コンテンツは別の測定またはしきい値の上に配置されたものです</translation>
    </message>
    <message>
        <source>To shine on the surface, close the output first.</source>
        <translation>面に投影するには、先に出力を閉じてください。</translation>
    </message>
    <message>
        <source>Uncorrected, in blocks of %1 px</source>
        <translation>補正なし（%1 px のブロック）</translation>
    </message>
    <message>
        <source>Predicted from the measurement. Another program&apos;s show is projected.</source>
        <translation>測定からの予測です。別のプログラムのショーが投影されています。</translation>
    </message>
    <message>
        <source>The preview is being prepared.</source>
        <translation>プレビューを準備しています。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::RenameDialog</name>
    <message>
        <source>Rename a venue</source>
        <translation>会場の名前を変更</translation>
    </message>
    <message>
        <source>Its folder has the same name and is renamed with it. A show that starts at log-in follows.</source>
        <translation>フォルダーも同じ名前で、一緒に変更されます。ログイン時に始まるショーも追従します。</translation>
    </message>
    <message>
        <source>Rename</source>
        <translation>名前を変更</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Session</name>
    <message>
        <source>%1 is at work. What is chosen here can be kept when that has ended.</source>
        <translation>%1の実行中です。ここでの選択は、終わってから確定できます。</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>機器は「%1」で使用中です。</translation>
    </message>
    <message>
        <source>Confirm that the room is clear.</source>
        <translation>退避完了を確認してください。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::SetNameDialog</name>
    <message>
        <source>Save as a set</source>
        <translation>セットとして保存</translation>
    </message>
    <message>
        <source>Rename a set</source>
        <translation>セットの名前を変更</translation>
    </message>
    <message>
        <source>Day, night, school class</source>
        <translation>昼、夜、学校の団体</translation>
    </message>
    <message>
        <source>What you see becomes this set, and is changed in it from now on.</source>
        <translation>今見えている状態がこのセットになり、以後の変更はこのセットに加えられます。</translation>
    </message>
    <message>
        <source>Playlists and controllers that call it by its present name have to be changed, too.</source>
        <translation>現在の名前で呼び出しているプレイリストやコントローラーも変更する必要があります。</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>保存</translation>
    </message>
    <message>
        <source>Rename</source>
        <translation>名前を変更</translation>
    </message>
    <message>
        <source>There is a set of this name already.</source>
        <translation>この名前のセットはすでにあります。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::SetTimesDialog</name>
    <message>
        <source>Sets by the time of the day</source>
        <translation>時刻によるセット</translation>
    </message>
    <message>
        <source>From each time on the installed show plays that set, every day, until the next time.</source>
        <translation>登録したショーは毎日、各時刻から次の時刻までそのセットで再生します。</translation>
    </message>
    <message>
        <source>From this time on</source>
        <translation>この時刻から</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>セット</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>追加</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>削除</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>キャンセル</translation>
    </message>
    <message>
        <source>Apply</source>
        <translation>適用</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1：%2</translation>
    </message>
    <message>
        <source>There are no times yet.</source>
        <translation>まだ時刻がありません。</translation>
    </message>
    <message>
        <source>Type a time of the day, such as %1.</source>
        <translation>時刻を入力してください（例：%1）。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::SettingsDialog</name>
    <message>
        <source>Settings</source>
        <translation>設定</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>閉じる</translation>
    </message>
    <message>
        <source>Look</source>
        <translation>外観</translation>
    </message>
    <message>
        <source>Dark</source>
        <translation>ダーク</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>ライト</translation>
    </message>
    <message>
        <source>Theme. The dark one is for the dark room.</source>
        <translation>テーマ。ダークは暗い室内用です。</translation>
    </message>
    <message>
        <source>Dim pictures: the laptop is room light</source>
        <translation>画像を減光：ノート PC の光も室内光になります</translation>
    </message>
    <message>
        <source>As the computer</source>
        <translation>コンピューターと同じ</translation>
    </message>
    <message>
        <source>Language</source>
        <translation>言語</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>測定</translation>
    </message>
    <message>
        <source>As quickly as the devices can, after a consent</source>
        <translation>機器の最高速（同意が必要）</translation>
    </message>
    <message numerus="yes">
        <source>At most %n change(s) a second</source>
        <translation>
            <numerusform>毎秒 %n 回まで</numerusform>
        </translation>
    </message>
    <message>
        <source>Flashing light of the projector</source>
        <translation>プロジェクターの点滅光</translation>
    </message>
    <message>
        <source>More than three changes a second can cause seizures. Slower measuring needs no consent.</source>
        <translation>毎秒 3 回を超える切り替わりは発作を引き起こすことがあります。それより遅い測定に同意は不要です。</translation>
    </message>
    <message>
        <source>A sound when a measurement ends</source>
        <translation>測定終了時に音を鳴らす</translation>
    </message>
    <message>
        <source>New venues</source>
        <translation>新しい会場</translation>
    </message>
    <message>
        <source>Folder for new venues</source>
        <translation>新しい会場のフォルダー</translation>
    </message>
    <message>
        <source>Choose a folder</source>
        <translation>フォルダーを選択</translation>
    </message>
    <message>
        <source>Folder</source>
        <translation>フォルダー</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Show</name>
    <message>
        <source>A show is playing.</source>
        <translation>ショーを再生中です。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StatusPage</name>
    <message>
        <source>State</source>
        <translation>状態</translation>
    </message>
    <message>
        <source>Updated</source>
        <translation>更新</translation>
    </message>
    <message>
        <source>Computed on</source>
        <translation>計算デバイス</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>フレーム</translation>
    </message>
    <message>
        <source>Late frames</source>
        <translation>遅れたフレーム</translation>
    </message>
    <message>
        <source>Frames per second</source>
        <translation>毎秒フレーム数</translation>
    </message>
    <message>
        <source>Time per frame (ms)</source>
        <translation>1 フレームの時間 (ms)</translation>
    </message>
    <message>
        <source>Delay behind the viewer (ms)</source>
        <translation>視聴者への遅れ (ms)</translation>
    </message>
    <message>
        <source>Clipped share</source>
        <translation>クリップの割合</translation>
    </message>
    <message>
        <source>Steps</source>
        <translation>ステップ</translation>
    </message>
    <message>
        <source>Perfected</source>
        <translation>仕上げ済み</translation>
    </message>
    <message>
        <source>Item</source>
        <translation>項目</translation>
    </message>
    <message>
        <source>Items skipped</source>
        <translation>飛ばした項目</translation>
    </message>
    <message>
        <source>Failures</source>
        <translation>失敗</translation>
    </message>
    <message>
        <source>Most memory used (bytes)</source>
        <translation>最大メモリ使用量（バイト）</translation>
    </message>
    <message>
        <source>Displays</source>
        <translation>ディスプレイ</translation>
    </message>
    <message>
        <source>Connector</source>
        <translation>コネクター</translation>
    </message>
    <message>
        <source>Shining</source>
        <translation>点灯</translation>
    </message>
    <message>
        <source>Drawn by</source>
        <translation>描画</translation>
    </message>
    <message>
        <source>Projectors</source>
        <translation>プロジェクター</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>プロジェクター</translation>
    </message>
    <message>
        <source>Address</source>
        <translation>アドレス</translation>
    </message>
    <message>
        <source>Answers</source>
        <translation>応答</translation>
    </message>
    <message>
        <source>Problem</source>
        <translation>問題</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>名前</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>機種</translation>
    </message>
    <message>
        <source>Power</source>
        <translation>電源</translation>
    </message>
    <message>
        <source>Shutter</source>
        <translation>シャッター</translation>
    </message>
    <message>
        <source>Lamp hours</source>
        <translation>ランプ使用時間</translation>
    </message>
    <message>
        <source>Filter hours</source>
        <translation>フィルター使用時間</translation>
    </message>
    <message>
        <source>Input</source>
        <translation>入力</translation>
    </message>
    <message>
        <source>Signal</source>
        <translation>信号</translation>
    </message>
    <message>
        <source>Own pixels</source>
        <translation>本体の画素数</translation>
    </message>
    <message>
        <source>Remarks</source>
        <translation>備考</translation>
    </message>
    <message>
        <source>yes</source>
        <translation>はい</translation>
    </message>
    <message>
        <source>no</source>
        <translation>いいえ</translation>
    </message>
    <message>
        <source>Relucent: %1</source>
        <translation>Relucent: %1</translation>
    </message>
    <message>
        <source>Alarm</source>
        <translation>警報</translation>
    </message>
    <message>
        <source>Last night</source>
        <translation>昨夜</translation>
    </message>
    <message>
        <source>When</source>
        <translation>日時</translation>
    </message>
    <message>
        <source>Outcome</source>
        <translation>結果</translation>
    </message>
    <message>
        <source>Pictures perfected</source>
        <translation>仕上げた画像</translation>
    </message>
    <message>
        <source>Colour error (ΔE)</source>
        <translation>色の誤差（ΔE）</translation>
    </message>
    <message>
        <source>Predicted colour error (ΔE)</source>
        <translation>予測した色の誤差（ΔE）</translation>
    </message>
    <message>
        <source>Nobody was told</source>
        <translation>通知できず</translation>
    </message>
    <message>
        <source>Next night</source>
        <translation>次の夜</translation>
    </message>
    <message>
        <source>Somebody has to look</source>
        <translation>確認が必要です</translation>
    </message>
    <message>
        <source>Watched by camera</source>
        <translation>カメラによる監視</translation>
    </message>
    <message>
        <source>Photographs</source>
        <translation>写真</translation>
    </message>
    <message>
        <source>Photographs used</source>
        <translation>使用した写真</translation>
    </message>
    <message>
        <source>Share that can be told</source>
        <translation>判定できる割合</translation>
    </message>
    <message>
        <source>Time per photograph (ms)</source>
        <translation>写真1枚あたりの時間 (ms)</translation>
    </message>
    <message>
        <source>What has changed</source>
        <translation>変化したこと</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>種類</translation>
    </message>
    <message>
        <source>How much</source>
        <translation>量</translation>
    </message>
    <message>
        <source>What happened</source>
        <translation>起きたこと</translation>
    </message>
    <message>
        <source>What to do</source>
        <translation>対処方法</translation>
    </message>
    <message>
        <source>Delay of the live picture (ms)</source>
        <translation>ライブ映像の遅れ (ms)</translation>
    </message>
    <message>
        <source>Streams</source>
        <translation>ストリーム</translation>
    </message>
    <message>
        <source>Losses</source>
        <translation>途切れた回数</translation>
    </message>
    <message>
        <source>Pixels</source>
        <translation>ピクセル</translation>
    </message>
    <message>
        <source>Time from the sender, by its clock (ms)</source>
        <translation>送信元からの時間、送信元の時計による (ms)</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>セット</translation>
    </message>
    <message>
        <source>Black</source>
        <translation>黒表示</translation>
    </message>
    <message>
        <source>Frozen</source>
        <translation>静止中</translation>
    </message>
    <message>
        <source>Corrected</source>
        <translation>補正後</translation>
    </message>
    <message>
        <source>Brightness</source>
        <translation>明るさ</translation>
    </message>
    <message>
        <source>Test chart</source>
        <translation>テストチャート</translation>
    </message>
    <message>
        <source>starting</source>
        <translation>開始中</translation>
    </message>
    <message>
        <source>playing</source>
        <translation>再生中</translation>
    </message>
    <message>
        <source>resting until its hours</source>
        <translation>上演時間まで待機中</translation>
    </message>
    <message>
        <source>photographing</source>
        <translation>撮影中</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>失敗</translation>
    </message>
    <message>
        <source>stopped</source>
        <translation>停止</translation>
    </message>
    <message>
        <source>connecting</source>
        <translation>接続中</translation>
    </message>
    <message>
        <source>asking whether it may</source>
        <translation>許可を求めています</translation>
    </message>
    <message>
        <source>lost</source>
        <translation>切断</translation>
    </message>
    <message>
        <source>opening</source>
        <translation>開いています</translation>
    </message>
    <message>
        <source>watching</source>
        <translation>監視中</translation>
    </message>
    <message>
        <source>paused</source>
        <translation>一時停止</translation>
    </message>
    <message>
        <source>no camera</source>
        <translation>カメラなし</translation>
    </message>
    <message>
        <source>no calibration</source>
        <translation>校正なし</translation>
    </message>
    <message>
        <source>black, until somebody ends it</source>
        <translation>黒（解除されるまで）</translation>
    </message>
    <message>
        <source>test chart</source>
        <translation>テストチャート</translation>
    </message>
    <message>
        <source>frozen, until somebody ends it</source>
        <translation>静止（解除されるまで）</translation>
    </message>
    <message>
        <source>playing, but no display shows it</source>
        <translation>再生中ですが、どの画面にも出ていません</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StatusStrip</name>
    <message>
        <source>Projector</source>
        <translation>プロジェクター</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>カメラ</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>ディスク</translation>
    </message>
    <message>
        <source>none chosen</source>
        <translation>未選択</translation>
    </message>
    <message>
        <source>%1 free</source>
        <translation>空き %1</translation>
    </message>
    <message>
        <source>simulated</source>
        <translation>模擬</translation>
    </message>
    <message>
        <source>by script</source>
        <translation>スクリプト</translation>
    </message>
    <message>
        <source>%1, in use</source>
        <translation>%1、使用中</translation>
    </message>
    <message>
        <source>Saved %1</source>
        <translation>%1 に保存</translation>
    </message>
    <message>
        <source>Room light</source>
        <translation>室内光</translation>
    </message>
    <message>
        <source>%1, unplugged</source>
        <translation>%1、未接続</translation>
    </message>
    <message>
        <source>%1 of full light, steady</source>
        <translation>全光量の %1、安定</translation>
    </message>
    <message>
        <source>%1 of full light, changed</source>
        <translation>全光量の %1、変化あり</translation>
    </message>
    <message>
        <source>%1, silent</source>
        <translation>%1、応答なし</translation>
    </message>
    <message numerus="yes">
        <source>%n screen(s)</source>
        <translation>
            <numerusform>画面 %n 台</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n with %1, %2</source>
        <comment>projectors and their pixels</comment>
        <translation>
            <numerusform>%n 台、%1、%2</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n, simulated</source>
        <comment>cameras</comment>
        <translation>
            <numerusform>%n 台、シミュレーション</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n camera(s)</source>
        <translation>
            <numerusform>カメラ %n 台</numerusform>
        </translation>
    </message>
    <message>
        <source>none in use</source>
        <translation>使用なし</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StepRail</name>
    <message>
        <source>locked</source>
        <translation>ロック中</translation>
    </message>
    <message>
        <source>done</source>
        <translation>完了</translation>
    </message>
    <message>
        <source>out of date</source>
        <translation>要更新</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>失敗</translation>
    </message>
    <message>
        <source>current</source>
        <translation>現在のステップ</translation>
    </message>
    <message>
        <source>open</source>
        <translation>実行可能</translation>
    </message>
    <message>
        <source>Step %1, %2, %3</source>
        <translation>ステップ %1、%2、%3</translation>
    </message>
    <message>
        <source>No venue open</source>
        <translation>開いている会場なし</translation>
    </message>
    <message>
        <source>stopped early</source>
        <translation>途中で停止</translation>
    </message>
    <message>
        <source>under way</source>
        <translation>実行中</translation>
    </message>
    <message>
        <source>doubtful</source>
        <translation>要確認</translation>
    </message>
    <message>
        <source>Opens once %1 is done.</source>
        <translation>「%1」が終わると開きます。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StreamDialog</name>
    <message>
        <source>Add a stream</source>
        <translation>ストリームを追加</translation>
    </message>
    <message>
        <source>A live picture from the network, without its sound: RTSP, SRT, RTP, UDP, HTTP or RTMP. While it plays, this computer is connected to that address.</source>
        <translation>ネットワークのライブ映像です。音声は再生しません。RTSP、SRT、RTP、UDP、HTTP、RTMP に対応します。再生中、このコンピューターはそのアドレスに接続します。</translation>
    </message>
    <message>
        <source>Address</source>
        <translation>アドレス</translation>
    </message>
    <message>
        <source>User name and password stand before the host, as in rtsp://user:password@host. They are kept in the playlist, and shown nowhere.</source>
        <translation>ユーザー名とパスワードは rtsp://user:password@host のようにホストの前に書きます。プレイリストに保存され、どこにも表示されません。</translation>
    </message>
    <message>
        <source>While it is lost</source>
        <translation>途切れている間</translation>
    </message>
    <message>
        <source>Its last picture</source>
        <translation>最後の映像</translation>
    </message>
    <message>
        <source>Black</source>
        <translation>黒</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>キャンセル</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>追加</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ThresholdPage</name>
    <message>
        <source>%1 of light kept</source>
        <translation>光の %1 を保持</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>要更新</translation>
    </message>
    <message>
        <source>Reading the light transport</source>
        <translation>光輸送の読み込み</translation>
    </message>
    <message>
        <source>Below 95 % of the light, bounces are lost.</source>
        <translation>保持する光が 95 % を下回ると、相互反射が失われます。</translation>
    </message>
    <message>
        <source>Next: groups of pixels that can be solved on their own</source>
        <translation>次：個別に解ける画素グループ</translation>
    </message>
    <message>
        <source>Group into clusters</source>
        <translation>クラスターに分ける</translation>
    </message>
    <message>
        <source>The threshold was chosen for an earlier measurement</source>
        <translation>このしきい値は以前の測定で選んだものです</translation>
    </message>
    <message>
        <source>Look at it again, then go on.</source>
        <translation>もう一度確認してから進んでください。</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>測定済みのデータは無事です。</translation>
    </message>
    <message>
        <source>Threshold</source>
        <translation>しきい値</translation>
    </message>
    <message>
        <source>Choose the faintest light worth keeping. Less is faster and smaller; too little loses the bounces.</source>
        <translation>残す価値のある最も弱い光を選びます。減らすほど高速で小さくなり、減らしすぎると相互反射が失われます。</translation>
    </message>
    <message>
        <source>Camera view</source>
        <translation>カメラ視野</translation>
    </message>
    <message>
        <source>The surface in full light</source>
        <translation>全点灯時の投影面</translation>
    </message>
    <message>
        <source>Pixel %1, %2</source>
        <translation>画素 %1, %2</translation>
    </message>
    <message>
        <source>Projector pixels that light the picked camera pixel</source>
        <translation>選択したカメラ画素を照らすプロジェクター画素</translation>
    </message>
    <message>
        <source>Pick a pixel in the camera view.</source>
        <translation>カメラ視野で画素を選んでください。</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>カメラ</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>プロジェクター</translation>
    </message>
    <message>
        <source>transport</source>
        <translation>輸送値</translation>
    </message>
    <message>
        <source>Transport matrix</source>
        <translation>光輸送行列</translation>
    </message>
    <message>
        <source>click an entry</source>
        <translation>要素をクリック</translation>
    </message>
    <message>
        <source>Light transport matrix, camera pixels down, projector pixels across</source>
        <translation>光輸送行列、縦がカメラ画素、横がプロジェクター画素</translation>
    </message>
    <message>
        <source>Transport value, camera signal a second</source>
        <translation>輸送値（1 秒あたりのカメラ信号）</translation>
    </message>
    <message>
        <source>How much light flows through each connection</source>
        <translation>各結合を通る光の量</translation>
    </message>
    <message>
        <source>drag the cut, or use the arrow keys</source>
        <translation>カット位置をドラッグ、または矢印キー</translation>
    </message>
    <message>
        <source>Connections</source>
        <translation>結合</translation>
    </message>
    <message>
        <source>Cut</source>
        <translation>カット位置</translation>
    </message>
    <message>
        <source>Cut at %1, keeps %2</source>
        <translation>%1 でカット、%2 を保持</translation>
    </message>
    <message>
        <source>Everything is kept</source>
        <translation>すべて保持</translation>
    </message>
    <message>
        <source>Leave out light below</source>
        <translation>除外する光の下限</translation>
    </message>
    <message>
        <source>One value</source>
        <translation>単一の値</translation>
    </message>
    <message>
        <source>What stays</source>
        <translation>残るもの</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>光</translation>
    </message>
    <message>
        <source>Memory</source>
        <translation>メモリ</translation>
    </message>
    <message>
        <source>What is left out is put back in proportion, so that the surface keeps its brightness.</source>
        <translation>除外した分は比例配分で戻すため、投影面の明るさは保たれます。</translation>
    </message>
    <message>
        <source>Picked pixel</source>
        <translation>選択した画素</translation>
    </message>
    <message>
        <source>Lit by</source>
        <translation>照射元</translation>
    </message>
    <message>
        <source>Strongest</source>
        <translation>最も強い照射元</translation>
    </message>
    <message>
        <source>From around it</source>
        <translation>周辺からの光</translation>
    </message>
    <message>
        <source>Light from elsewhere</source>
        <translation>離れた場所からの光</translation>
    </message>
    <message>
        <source>Use suggested, %1</source>
        <translation>推奨値 %1 を使用</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1（全 %2）</translation>
    </message>
    <message>
        <source>Picked pixel %1, %2</source>
        <translation>選択した画素 %1, %2</translation>
    </message>
    <message numerus="yes">
        <source>%n pixel(s)</source>
        <translation>
            <numerusform>%n 画素</numerusform>
        </translation>
    </message>
    <message>
        <source>Cut, camera signal a second</source>
        <translation>カット位置（1 秒あたりのカメラ信号）</translation>
    </message>
    <message>
        <source>Use picked pixel</source>
        <translation>選択した画素を使う</translation>
    </message>
    <message>
        <source>For each camera pixel</source>
        <translation>カメラ画素ごと</translation>
    </message>
    <message>
        <source>Suggested: three times the noise of the measurement.</source>
        <translation>推奨値：測定ノイズの 3 倍。</translation>
    </message>
    <message>
        <source>Suggested: keeps nearly all of the light.</source>
        <translation>推奨値：光をほぼすべて残します。</translation>
    </message>
    <message>
        <source>%1 on average</source>
        <translation>平均 %1</translation>
    </message>
    <message>
        <source>Kind of cut</source>
        <translation>切り方</translation>
    </message>
    <message>
        <source>Share of each pixel</source>
        <translation>画素ごとの割合</translation>
    </message>
    <message>
        <source>Share of the strongest light of each camera pixel, in tenths of a percent</source>
        <translation>各カメラ画素の最も強い光に対する割合、0.1 % 単位</translation>
    </message>
    <message>
        <source>Below %1 of the strongest light that each camera pixel gets</source>
        <translation>各カメラ画素が受ける最も強い光の %1 未満</translation>
    </message>
    <message>
        <source>Of each camera pixel the strongest connection always stays, however high the cut.</source>
        <translation>カット位置がどれほど高くても、カメラの各画素で最も強い接続は必ず残ります。</translation>
    </message>
    <message>
        <source>“%1” is not a cut: type a number, 0 or more. The cut is still %2.</source>
        <translation>「%1」はカット位置になりません。0 以上の数を入力してください。カット位置は %2 のままです。</translation>
    </message>
    <message>
        <source>At three times the noise, %1, only %2 of the light would stay: much faint light adds up. Suggested: keep everything.</source>
        <translation>ノイズの 3 倍（%1）で切ると、光は %2 しか残りません。弱い光も合わされば大きくなります。推奨：すべて残す。</translation>
    </message>
    <message>
        <source>Keep everything</source>
        <translation>すべて残す</translation>
    </message>
    <message>
        <source>Changed: it is applied as soon as you go on.</source>
        <translation>変更済み：次へ進むと適用されます。</translation>
    </message>
    <message>
        <source>What was measured is being read.</source>
        <translation>測定結果を読み込んでいます。</translation>
    </message>
    <message>
        <source>Pick a pixel in a picture.</source>
        <translation>画像で画素を選んでください。</translation>
    </message>
    <message>
        <source>It is in use.</source>
        <translation>使用中です。</translation>
    </message>
    <message>
        <source>No light of the picked pixel was kept.</source>
        <translation>選んだ画素の光は残っていません。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::TidyDialog</name>
    <message>
        <source>All</source>
        <translation>すべて</translation>
    </message>
    <message>
        <source>Of the latest measurement</source>
        <translation>最新の測定の写真</translation>
    </message>
    <message>
        <source>None: results only</source>
        <translation>なし：結果のみ</translation>
    </message>
    <message>
        <source>Only what nothing reads goes, and old files are compressed without loss.</source>
        <translation>使われないものだけを削除し、古いファイルは劣化なしに圧縮します。</translation>
    </message>
    <message>
        <source>Those that were set aside by measuring again go too. Nothing reads them.</source>
        <translation>再測定のときに取り置いた写真も削除します。もう使われません。</translation>
    </message>
    <message>
        <source>All that was measured and computed stays. The photographs go.</source>
        <translation>測定と計算の結果はすべて残り、写真は削除されます。</translation>
    </message>
    <message>
        <source>Showing, checking and reports need results only. Other settings, and better methods of later versions, then have to photograph everything again.</source>
        <translation>上映、点検、レポートには結果だけで足ります。別の設定や、新しい版のより良い方法では、すべて撮り直しになります。</translation>
    </message>
    <message numerus="yes">
        <source>%n photograph(s)</source>
        <translation>
            <numerusform>写真 %n 枚</numerusform>
        </translation>
    </message>
    <message>
        <source>What was freed until then is free. Nothing that is needed is lost.</source>
        <translation>それまでに空けた分は空いたままです。必要なものは失われていません。</translation>
    </message>
    <message>
        <source>Photographs to keep</source>
        <translation>残す写真</translation>
    </message>
    <message>
        <source>This venue is not measured to the end.</source>
        <translation>この会場の測定は終わっていません。</translation>
    </message>
    <message>
        <source>All its photographs stay: going on needs them.</source>
        <translation>続きの測定に要るので、写真はすべて残します。</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>戻る</translation>
    </message>
    <message>
        <source>Freeing the disk</source>
        <translation>ディスクを空けています</translation>
    </message>
    <message>
        <source>%1 will be removed for good.</source>
        <translation>%1を完全に削除します。</translation>
    </message>
    <message>
        <source>%1 will be freed.</source>
        <translation>%1 空きます。</translation>
    </message>
    <message>
        <source>%1 freed, %2 removed</source>
        <translation>%1 空きました。削除：%2</translation>
    </message>
    <message>
        <source>%1 Nothing that is needed is lost.</source>
        <translation>%1必要なものは失われていません。</translation>
    </message>
    <message>
        <source>frees %1</source>
        <translation>%1 空く</translation>
    </message>
    <message>
        <source>nothing to free</source>
        <translation>空ける分なし</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>キャンセル</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>中止</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>閉じる</translation>
    </message>
    <message>
        <source>Free %1…</source>
        <translation>%1 空ける…</translation>
    </message>
    <message>
        <source>Free %1</source>
        <translation>%1 空ける</translation>
    </message>
    <message>
        <source>No photograph goes: everything stays possible.</source>
        <translation>写真は削除されません。できることはこれまでと同じです。</translation>
    </message>
    <message>
        <source>The latest measurement keeps its photographs: everything stays possible.</source>
        <translation>最新の測定の写真は残ります。できることはこれまでと同じです。</translation>
    </message>
    <message>
        <source>Looking up what could be freed. Nothing is removed yet.</source>
        <translation>空けられるものを調べています。まだ何も削除しません。</translation>
    </message>
    <message>
        <source>Free disk space</source>
        <translation>ディスクの空きを増やす</translation>
    </message>
    <message>
        <source>Disk space of %1</source>
        <translation>%1 のディスク使用量</translation>
    </message>
    <message>
        <source>Freeing space was stopped.</source>
        <translation>空きを増やす処理を中止しました。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VenueNetwork</name>
    <message>
        <source>“%1” is no network address of a projector. Write its number or name, as 192.168.1.50.</source>
        <translation>「%1」はプロジェクターのネットワークアドレスではありません。192.168.1.50 のような番号か名前を入力してください。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VenuePage</name>
    <message>
        <source>Unplugged. Plug it in or choose another.</source>
        <translation>接続が外れています。接続するか、別の画面を選んでください。</translation>
    </message>
    <message>
        <source>%1, %2 by %3, chosen</source>
        <translation>%1、%2 × %3、選択中</translation>
    </message>
    <message>
        <source>%1, %2 by %3</source>
        <translation>%1、%2 × %3</translation>
    </message>
    <message>
        <source>Screens</source>
        <translation>画面</translation>
    </message>
    <message>
        <source>Choose the one that shines on the surface. Its pixels are the projector&apos;s.</source>
        <translation>投影面に映している画面を選んでください。その画素がプロジェクターの画素になります。</translation>
    </message>
    <message>
        <source>Identify screens</source>
        <translation>画面を識別</translation>
    </message>
    <message>
        <source>I</source>
        <translation>I</translation>
    </message>
    <message>
        <source>The projector shares your screen</source>
        <translation>プロジェクターと作業画面が同じです</translation>
    </message>
    <message>
        <source>Real devices</source>
        <translation>実際の機器</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>プロジェクター</translation>
    </message>
    <message>
        <source>Glossy corner</source>
        <translation>光沢のある角</translation>
    </message>
    <message>
        <source>Light bounces between two cards</source>
        <translation>2 枚のカードの間で相互反射</translation>
    </message>
    <message>
        <source>Bust before a brick wall</source>
        <translation>れんが壁の前の胸像</translation>
    </message>
    <message>
        <source>Texture, shadow and light between surfaces</source>
        <translation>模様、影、面どうしの相互反射</translation>
    </message>
    <message>
        <source>Many depths</source>
        <translation>さまざまな奥行き</translation>
    </message>
    <message>
        <source>Some surfaces are out of focus</source>
        <translation>一部の面にピントが合わない</translation>
    </message>
    <message>
        <source>Dome</source>
        <translation>ドーム</translation>
    </message>
    <message>
        <source>Every part lights every other part</source>
        <translation>すべての部分が互いを照らす</translation>
    </message>
    <message>
        <source>Wine glass</source>
        <translation>ワイングラス</translation>
    </message>
    <message>
        <source>Light is refracted both ways</source>
        <translation>光が往復とも屈折</translation>
    </message>
    <message>
        <source>Painted wall</source>
        <translation>塗装した壁</translation>
    </message>
    <message>
        <source>Flat, with diamonds; the easiest</source>
        <translation>平面、ひし形模様。最も簡単</translation>
    </message>
    <message>
        <source>%1, a first look</source>
        <translation>%1、お試し</translation>
    </message>
    <message>
        <source>%1, quick</source>
        <translation>%1、高速</translation>
    </message>
    <message>
        <source>%1, usual</source>
        <translation>%1、標準</translation>
    </message>
    <message>
        <source>%1, fine</source>
        <translation>%1、精密</translation>
    </message>
    <message>
        <source>Venue</source>
        <translation>会場</translation>
    </message>
    <message>
        <source>Rehearse in a simulated venue</source>
        <translation>模擬会場でリハーサル</translation>
    </message>
    <message>
        <source>New venue by script</source>
        <translation>スクリプトで新しい会場</translation>
    </message>
    <message>
        <source>New venue</source>
        <translation>新しい会場</translation>
    </message>
    <message>
        <source>Say which screen shines, which programs show and photograph, and where the work is kept.</source>
        <translation>投影する画面、表示と撮影を行うプログラム、作業の保存先を指定します。</translation>
    </message>
    <message>
        <source>Setting up</source>
        <translation>設定中</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1、%2</translation>
    </message>
    <message>
        <source>simulated, %1</source>
        <translation>模擬、%1</translation>
    </message>
    <message>
        <source>by script, %1</source>
        <translation>スクリプト、%1</translation>
    </message>
    <message>
        <source>%1 is open</source>
        <translation>%1 を開いています</translation>
    </message>
    <message>
        <source>Enter opens the highlighted choice</source>
        <translation>Enter で選択中の項目を開きます</translation>
    </message>
    <message>
        <source>Check camera</source>
        <translation>カメラを確認</translation>
    </message>
    <message>
        <source>Start rehearsal</source>
        <translation>リハーサルを開始</translation>
    </message>
    <message>
        <source>Nothing was changed in that folder.</source>
        <translation>そのフォルダーでは何も変更していません。</translation>
    </message>
    <message>
        <source>Give the venue a name.</source>
        <translation>会場の名前を入力してください。</translation>
    </message>
    <message>
        <source>A name cannot hold a slash.</source>
        <translation>名前にスラッシュは使えません。</translation>
    </message>
    <message>
        <source>There is a folder of that name. Choose another name.</source>
        <translation>同じ名前のフォルダーがあります。別の名前にしてください。</translation>
    </message>
    <message>
        <source>Choose the screen that shines on the surface.</source>
        <translation>投影面に映している画面を選んでください。</translation>
    </message>
    <message>
        <source>Free %1 or choose another folder.</source>
        <translation>%1 空けるか、別のフォルダーを選んでください。</translation>
    </message>
    <message>
        <source>Confirm that the room is clear.</source>
        <translation>退避が完了したことを確認してください。</translation>
    </message>
    <message>
        <source>Nothing was measured yet.</source>
        <translation>まだ何も測定していません。</translation>
    </message>
    <message>
        <source>Programs</source>
        <translation>プログラム</translation>
    </message>
    <message>
        <source>Any projector and any camera that a command can drive</source>
        <translation>コマンドで操作できる任意のプロジェクターとカメラ</translation>
    </message>
    <message>
        <source>Photographs {exposure} seconds into the file {output}: float EXR, 16-bit PNG or TIFF</source>
        <translation>{exposure} 秒の露出で撮影し、ファイル {output} に保存：浮動小数点 EXR、16 ビット PNG または TIFF</translation>
    </message>
    <message>
        <source>Projector&apos;s pixels</source>
        <translation>プロジェクターの画素数</translation>
    </message>
    <message>
        <source>Width</source>
        <translation>幅</translation>
    </message>
    <message>
        <source>Height</source>
        <translation>高さ</translation>
    </message>
    <message>
        <source>Rehearsal. Opened %1</source>
        <translation>リハーサル。%1 に使用</translation>
    </message>
    <message>
        <source>Opened %1</source>
        <translation>%1 に使用</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>開く</translation>
    </message>
    <message>
        <source>Open %1</source>
        <translation>%1 を開く</translation>
    </message>
    <message>
        <source>Open a venue</source>
        <translation>会場を開く</translation>
    </message>
    <message>
        <source>Rehearse</source>
        <translation>リハーサル</translation>
    </message>
    <message>
        <source>Learn every step in a simulated venue. No devices needed.</source>
        <translation>模擬会場で全ステップを学べます。機器は不要です。</translation>
    </message>
    <message>
        <source>Continue where you stopped, or change the content.</source>
        <translation>中断したところから続けるか、コンテンツを変更します。</translation>
    </message>
    <message>
        <source>Measure a surface with a projector and a camera at this computer.</source>
        <translation>このコンピューターのプロジェクターとカメラで投影面を測定します。</translation>
    </message>
    <message>
        <source>Projector and camera are driven by programs of yours.</source>
        <translation>お手持ちのプログラムでプロジェクターとカメラを動かします。</translation>
    </message>
    <message>
        <source>Recent</source>
        <translation>最近の会場</translation>
    </message>
    <message>
        <source>No venues yet</source>
        <translation>会場はまだありません</translation>
    </message>
    <message>
        <source>The venues that you measure are listed here, newest first.</source>
        <translation>測定した会場が新しい順に表示されます。</translation>
    </message>
    <message>
        <source>A first rehearsal takes a few minutes.</source>
        <translation>最初のリハーサルは数分で終わります。</translation>
    </message>
    <message>
        <source>This venue</source>
        <translation>この会場</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>名前</translation>
    </message>
    <message>
        <source>Name of the venue</source>
        <translation>会場の名前</translation>
    </message>
    <message>
        <source>Folder</source>
        <translation>フォルダー</translation>
    </message>
    <message>
        <source>Folder that holds the venue</source>
        <translation>会場を保存するフォルダー</translation>
    </message>
    <message>
        <source>Choose a folder</source>
        <translation>フォルダーを選択</translation>
    </message>
    <message>
        <source>Expected</source>
        <translation>見込み</translation>
    </message>
    <message>
        <source>Patterns</source>
        <translation>パターン</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>ディスク</translation>
    </message>
    <message>
        <source>about %1</source>
        <translation>約 %1</translation>
    </message>
    <message>
        <source>Simulated devices</source>
        <translation>模擬機器</translation>
    </message>
    <message>
        <source>Pixels of the simulated projector</source>
        <translation>模擬プロジェクターの画素数</translation>
    </message>
    <message>
        <source>More pixels show finer detail and take longer. The first time, the light of the venue is traced; later it is remembered.</source>
        <translation>画素が多いほど細部まで見えますが、時間がかかります。初回は会場の光を追跡し、以後はその結果を使います。</translation>
    </message>
    <message numerus="yes">
        <source>About %n pattern(s), %1</source>
        <translation>
            <numerusform>パターン約 %n 枚、%1</numerusform>
        </translation>
    </message>
    <message>
        <source>Shows the file {image} and ends as soon as the projector shines it</source>
        <translation>ファイル {image} を表示し、実際に投影された時点で終了</translation>
    </message>
    <message>
        <source>Relief, two projectors</source>
        <translation>レリーフ、プロジェクター 2 台</translation>
    </message>
    <message>
        <source>Each shines into the other&apos;s shadows</source>
        <translation>互いの影を照らします</translation>
    </message>
    <message>
        <source>The projector&apos;s screen</source>
        <translation>プロジェクターの画面</translation>
    </message>
    <message>
        <source>Say which screen the projector is now. What was measured stays.</source>
        <translation>プロジェクターが今どの画面かを指定してください。測定結果は残ります。</translation>
    </message>
    <message>
        <source>Nothing is measured again.</source>
        <translation>測定し直しません。</translation>
    </message>
    <message>
        <source>Use this screen</source>
        <translation>この画面を使う</translation>
    </message>
    <message>
        <source>Change the screen</source>
        <translation>画面を変更</translation>
    </message>
    <message>
        <source>The projector&apos;s screen %1 is not there</source>
        <translation>プロジェクターの画面 %1 がありません</translation>
    </message>
    <message>
        <source>Plug it in, or say which screen the projector is now.</source>
        <translation>接続するか、プロジェクターが今どの画面かを指定してください。</translation>
    </message>
    <message>
        <source>%1 is not the folder of a venue: it has no %2 in it.</source>
        <translation>%1 は会場のフォルダーではありません: 中に %2 がありません。</translation>
    </message>
    <message numerus="yes">
        <source>There are %n venue(s) within it: open one of them.</source>
        <translation>
            <numerusform>中に会場が %n 件あります: いずれかを開いてください。</numerusform>
        </translation>
    </message>
    <message>
        <source>Choose a venue&apos;s own folder. It has the venue&apos;s name.</source>
        <translation>会場のフォルダーを選んでください。会場の名前が付いています。</translation>
    </message>
    <message>
        <source>This folder is not a venue</source>
        <translation>このフォルダーは会場ではありません</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>何も変更されていません。</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>機器は %1 で使用中です。</translation>
    </message>
    <message>
        <source>Choose another screen.</source>
        <translation>別の画面を選んでください。</translation>
    </message>
    <message>
        <source>Only your own screen is there. Plug the projector in, and extend the desktop to it.</source>
        <translation>操作用の画面しかありません。プロジェクターを接続し、デスクトップを拡張してください。</translation>
    </message>
    <message>
        <source>Nothing is measured again</source>
        <translation>測定し直しません</translation>
    </message>
    <message>
        <source>Measured at</source>
        <translation>測定した画面</translation>
    </message>
    <message>
        <source>Used at</source>
        <translation>使用する画面</translation>
    </message>
    <message>
        <source>Pixels</source>
        <translation>ピクセル</translation>
    </message>
    <message>
        <source>A screen is known again by its maker&apos;s names and serial number. Where it tells none, it is known by its connector: then a cable that is plugged in elsewhere has to be said here.</source>
        <translation>画面はメーカー名とシリアル番号で見分けます。それがない場合は端子で見分けるため、ケーブルを別の端子に挿したらここで指定してください。</translation>
    </message>
    <message>
        <source>Is open</source>
        <translation>開いています</translation>
    </message>
    <message>
        <source>Time, by camera</source>
        <translation>所要時間（カメラによる）</translation>
    </message>
    <message>
        <source>Industrial cameras and video devices are fast, still cameras slow.</source>
        <translation>産業用カメラとビデオデバイスは速く、スチルカメラは遅くなります。</translation>
    </message>
    <message>
        <source>%1 to %2</source>
        <translation>%1～%2</translation>
    </message>
    <message>
        <source>%1 free</source>
        <translation>空き %1</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%2 中 %1</translation>
    </message>
    <message>
        <source>Free the disk of what %1 does not need</source>
        <translation>%1 に要らないものをディスクから削除します</translation>
    </message>
    <message>
        <source>Resume</source>
        <translation>再開</translation>
    </message>
    <message>
        <source>Resume %1</source>
        <translation>%1 を再開</translation>
    </message>
    <message>
        <source>Free space…</source>
        <translation>空きを増やす…</translation>
    </message>
    <message>
        <source>Somebody bumps the camera</source>
        <translation>誰かがカメラにぶつかる</translation>
    </message>
    <message>
        <source>A light is switched on</source>
        <translation>照明がつけられる</translation>
    </message>
    <message>
        <source>The camera&apos;s cable comes out</source>
        <translation>カメラのケーブルが抜ける</translation>
    </message>
    <message>
        <source>Surprises</source>
        <translation>不意の出来事</translation>
    </message>
    <message>
        <source>Each comes once while Acquire measures, at a moment that nobody knows. Practise what the wizard says, before it happens in front of a client.</source>
        <translation>それぞれ、光輸送測定の途中で、誰も知らない瞬間に一度だけ起こります。お客様の前で起こる前に、ウィザードの案内に慣れておきましょう。</translation>
    </message>
    <message>
        <source>Measures how a surface changes what is projected on it, and corrects pictures and films until they look right there.</source>
        <translation>投影面が映像をどう変えるかを測定し、そこで正しく見えるように静止画と動画を補正します。</translation>
    </message>
    <message>
        <source>Easy. Measuring takes %1</source>
        <translation>やさしい。測定時間：%1</translation>
    </message>
    <message>
        <source>Medium. Measuring takes %1</source>
        <translation>ふつう。測定時間：%1</translation>
    </message>
    <message>
        <source>Hard. Measuring takes %1</source>
        <translation>難しい。測定時間：%1</translation>
    </message>
    <message>
        <source>Name of %1</source>
        <translation>%1 の名前</translation>
    </message>
    <message>
        <source>Projectors</source>
        <translation>プロジェクター</translation>
    </message>
    <message>
        <source>None chosen yet.</source>
        <translation>まだ選ばれていません。</translation>
    </message>
    <message>
        <source>Add a projector</source>
        <translation>プロジェクターを追加</translation>
    </message>
    <message>
        <source>Projector %1</source>
        <translation>プロジェクター %1</translation>
    </message>
    <message>
        <source>Remove projector %1</source>
        <translation>プロジェクター %1 を削除</translation>
    </message>
    <message>
        <source>%1: choose its screen</source>
        <translation>%1: 画面を選んでください</translation>
    </message>
    <message>
        <source>Cameras</source>
        <translation>カメラ</translation>
    </message>
    <message>
        <source>Camera %1</source>
        <translation>カメラ %1</translation>
    </message>
    <message>
        <source>Remove camera %1</source>
        <translation>カメラ %1 を削除</translation>
    </message>
    <message>
        <source>Add one from the list, or choose it at the next step.</source>
        <translation>一覧から追加するか、次のステップで選んでください。</translation>
    </message>
    <message>
        <source>Content is placed in the view of the first one.</source>
        <translation>コンテンツは最初のカメラの視野に配置します。</translation>
    </message>
    <message>
        <source>Add those that look at the surface.</source>
        <translation>投影面を見ているものを追加してください。</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>削除</translation>
    </message>
    <message>
        <source>Remove %1</source>
        <translation>%1 を削除</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>追加</translation>
    </message>
    <message>
        <source>Add %1</source>
        <translation>%1 を追加</translation>
    </message>
    <message>
        <source>Say which screens shine on the surface, which cameras watch, and where the work is kept.</source>
        <translation>どの画面が投影面を照らし、どのカメラが見て、作業をどこに保存するかを指定します。</translation>
    </message>
    <message numerus="yes">
        <source>%n projector(s)</source>
        <translation>
            <numerusform>プロジェクター %n 台</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n camera(s)</source>
        <translation>
            <numerusform>カメラ %n 台</numerusform>
        </translation>
    </message>
    <message>
        <source>This screen is projector %1 already.</source>
        <translation>この画面はすでにプロジェクター %1 です。</translation>
    </message>
    <message>
        <source>That screen is projector %1. Choose another screen.</source>
        <translation>その画面はプロジェクター %1 です。別の画面を選んでください。</translation>
    </message>
    <message>
        <source>Dome, four projectors</source>
        <translation>ドーム、プロジェクター 4 台</translation>
    </message>
    <message>
        <source>They overlap; two cameras watch</source>
        <translation>重なり合い、カメラ 2 台が見ます</translation>
    </message>
    <message>
        <source>Bust from three sides</source>
        <translation>三方から見る胸像</translation>
    </message>
    <message>
        <source>Two projectors, three cameras: for an audience that walks</source>
        <translation>プロジェクター 2 台、カメラ 3 台: 歩く観客のため</translation>
    </message>
    <message>
        <source>Projector whose screen is changed</source>
        <translation>画面を変更するプロジェクター</translation>
    </message>
    <message>
        <source>Network address (PJLink)</source>
        <translation>ネットワークアドレス (PJLink)</translation>
    </message>
    <message>
        <source>Password, if it has one</source>
        <translation>パスワード（ある場合）</translation>
    </message>
    <message>
        <source>On the network</source>
        <translation>ネットワーク</translation>
    </message>
    <message>
        <source>Optional: a projector with a network address is switched on, and its lamp waited for until it is steady, before anything is measured.</source>
        <translation>任意: ネットワークアドレスのあるプロジェクターは電源が入れられ、測定の前にランプが安定するまで待ちます。</translation>
    </message>
    <message>
        <source>Find projectors</source>
        <translation>プロジェクターを検索</translation>
    </message>
    <message>
        <source>Looking for projectors…</source>
        <translation>プロジェクターを検索しています…</translation>
    </message>
    <message>
        <source>None answers. Only PJLink class 2 can be searched: type the address.</source>
        <translation>応答がありません。検索できるのは PJLink クラス 2 だけです。アドレスを入力してください。</translation>
    </message>
    <message numerus="yes">
        <source>%n answer. Choose from the list of each.</source>
        <translation>
            <numerusform>%n 台が応答しました。それぞれのリストから選んでください。</numerusform>
        </translation>
    </message>
    <message>
        <source>Move to the trash</source>
        <translation>ゴミ箱に移す</translation>
    </message>
    <message>
        <source>Keep it</source>
        <translation>残しておく</translation>
    </message>
    <message>
        <source>Try again then.</source>
        <translation>そのあとでもう一度お試しください。</translation>
    </message>
    <message>
        <source>Nothing of the venue is lost.</source>
        <translation>会場のデータは何も失われていません。</translation>
    </message>
    <message>
        <source>Remove a venue</source>
        <translation>会場を削除</translation>
    </message>
    <message>
        <source>“%1” goes to the trash, with its photographs, results and playlist.</source>
        <translation>「%1」を、写真、結果、プレイリストごとゴミ箱に移します。</translation>
    </message>
    <message>
        <source>Until the trash is emptied it can be taken back from there.</source>
        <translation>ゴミ箱を空にするまでは、そこから元に戻せます。</translation>
    </message>
    <message>
        <source>More</source>
        <translation>その他</translation>
    </message>
    <message>
        <source>More for %1</source>
        <translation>%1 のその他の操作</translation>
    </message>
    <message>
        <source>Rename…</source>
        <translation>名前を変更…</translation>
    </message>
    <message>
        <source>Remove…</source>
        <translation>削除…</translation>
    </message>
    <message>
        <source>Setting up another</source>
        <translation>別の会場を設定中</translation>
    </message>
    <message>
        <source>Allow them</source>
        <translation>許可する</translation>
    </message>
    <message>
        <source>Open without them</source>
        <translation>許可せずに開く</translation>
    </message>
    <message>
        <source>Programs of a venue</source>
        <translation>会場のプログラム</translation>
    </message>
    <message>
        <source>“%1” names programs of its own as projector or camera. They would run on this computer as you, and nobody here has agreed to that yet:</source>
        <translation>「%1」はプロジェクターまたはカメラとして独自のプログラムを指定しています。このコンピューターであなたの権限で実行されますが、まだ誰も許可していません:</translation>
    </message>
    <message>
        <source>None of them was run. Without them everything that was measured can be looked at and shown.</source>
        <translation>どれも実行されていません。許可しなくても、測定済みのものはすべて見て表示できます。</translation>
    </message>
    <message>
        <source>Allow them if you know what they do, or know who made this venue.</source>
        <translation>何をするものか、または誰が作った会場かを知っている場合に許可してください。</translation>
    </message>
    <message>
        <source>No other screen is plugged in.</source>
        <translation>ほかの画面が接続されていません。</translation>
    </message>
    <message>
        <source>The same steps, with a simulated projector and camera. Nothing is projected unless you choose a screen.</source>
        <translation>同じ手順を、模擬のプロジェクターとカメラで行います。画面を選ばない限り、何も投影しません。</translation>
    </message>
    <message>
        <source>Programs of this venue</source>
        <translation>この会場のプログラム</translation>
    </message>
    <message>
        <source>Say which commands drive these devices from now on. What was measured stays.</source>
        <translation>今後これらの機器を動かすコマンドを指定してください。測定結果は残ります。</translation>
    </message>
    <message>
        <source>Use these commands</source>
        <translation>これらのコマンドを使う</translation>
    </message>
    <message>
        <source>Change the programs</source>
        <translation>プログラムを変更</translation>
    </message>
    <message>
        <source>Type another command.</source>
        <translation>別のコマンドを入力してください。</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>カメラ</translation>
    </message>
    <message>
        <source>A program that fails ends with another status than 0. What it says last is told with it. Try it in a terminal, with a file in place of {image} or {output} and seconds in place of {exposure}.</source>
        <translation>失敗したプログラムは 0 以外の状態で終わり、最後の言葉も示されます。{image} や {output} の代わりにファイル、{exposure} の代わりに秒数を入れて、ターミナルで試してください。</translation>
    </message>
    <message>
        <source>Relucent shows the pictures on it, unless a program of yours does.</source>
        <translation>お手持ちのプログラムが表示しない限り、Relucent がそこに画像を表示します。</translation>
    </message>
    <message>
        <source>Not needed with a screen. %1</source>
        <translation>画面を使う場合は不要。%1</translation>
    </message>
    <message>
        <source>Choose the projector&apos;s screen, or type the command that shows.</source>
        <translation>プロジェクターの画面を選ぶか、表示するコマンドを入力してください。</translation>
    </message>
    <message>
        <source>%1, %2, unplugged</source>
        <translation>%1、%2、未接続</translation>
    </message>
    <message>
        <source>As many as the chosen screen has.</source>
        <translation>選んだ画面の画素数と同じです。</translation>
    </message>
    <message>
        <source>Continue</source>
        <translation>続ける</translation>
    </message>
    <message>
        <source>A show plays on %1</source>
        <translation>%1 でショーを再生中</translation>
    </message>
    <message>
        <source>Another program shows it. End it before anything is measured there: Camera has the button.</source>
        <translation>別のプログラムが表示しています。そこで測定する前に終了してください。ボタンは「カメラ」にあります。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VenueTidy</name>
    <message>
        <source>Try again then.</source>
        <translation>そのあとでもう一度お試しください。</translation>
    </message>
    <message>
        <source>%1 is at work. Space can be freed when it has ended.</source>
        <translation>%1 の作業中です。終わってから空きを増やせます。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ViewerPlan</name>
    <message>
        <source>Plan of the cameras and of the viewer, seen from above</source>
        <translation>カメラと観客の平面図、上から見たもの</translation>
    </message>
    <message>
        <source>Camera %1</source>
        <translation>カメラ %1</translation>
    </message>
    <message>
        <source>Viewer</source>
        <translation>観客</translation>
    </message>
    <message>
        <source>%1: %2 m to the left, %3 m from the surface</source>
        <translation>%1: 左へ %2 m、投影面から %3 m</translation>
    </message>
    <message>
        <source>%1: %2 m to the right, %3 m from the surface</source>
        <translation>%1: 右へ %2 m、投影面から %3 m</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VtkView</name>
    <message>
        <source>This view needs OpenGL 3.2, and this computer draws without it. Everything else works: pictures and maps are shown without depth.</source>
        <translation>この表示には OpenGL 3.2 が必要ですが、このコンピューターでは利用できません。ほかはすべて動作し、画像とマップは奥行きなしで表示されます。</translation>
    </message>
    <message>
        <source>For this view, install the graphics card&apos;s driver and start Relucent again.</source>
        <translation>この表示には、グラフィックカードのドライバーをインストールして Relucent を再起動してください。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Wizard</name>
    <message>
        <source>Not applied yet</source>
        <translation>まだ適用されていません</translation>
    </message>
</context>
<context>
    <name>repair.camera-moved</name>
    <message>
        <source>the view of camera {} has moved by {} and {} pixels and turned by {} degrees</source>
        <translation>カメラ {} の視野が {} と {} ピクセル移動し、{} 度回転しました</translation>
    </message>
</context>
<context>
    <name>repair.light-changed</name>
    <message>
        <source>projector {} gives {} % of the red, {} % of the green and {} % of the blue light that it gave</source>
        <translation>プロジェクター {} の光は以前に比べて赤 {} %、緑 {} %、青 {} % です</translation>
    </message>
</context>
<context>
    <name>repair.light-elsewhere</name>
    <message>
        <source>in {} % of the cameras&apos; pixels light arrives otherwise than it did</source>
        <translation>カメラの画素の {} % で、光の届き方が以前と違います</translation>
    </message>
</context>
<context>
    <name>repair.picture-moved</name>
    <message>
        <source>the projected picture has moved by {} and {} pixels as camera {} sees it</source>
        <translation>投影された画像が {} と {} ピクセル移動しました（カメラ {} から見て）</translation>
    </message>
</context>
<context>
    <name>repair.room-brighter</name>
    <message>
        <source>the room is brighter by {} % of the projectors&apos; full light</source>
        <translation>部屋がプロジェクターの全光の {} % だけ明るくなりました</translation>
    </message>
</context>
<context>
    <name>repair.room-darker</name>
    <message>
        <source>the room is darker by {} % of the projectors&apos; full light</source>
        <translation>部屋がプロジェクターの全光の {} % だけ暗くなりました</translation>
    </message>
</context>
<context>
    <name>repair.surface-changed</name>
    <message>
        <source>{} % of what the cameras see is brighter, darker or of another colour than it was</source>
        <translation>カメラに見えるものの {} % が、以前より明るい、暗い、または色が違います</translation>
    </message>
</context>
<context>
    <name>report.cannot-write</name>
    <message>
        <source>the report cannot be written</source>
        <translation>レポートを書き込めません</translation>
    </message>
</context>
<context>
    <name>report.free-some-space</name>
    <message>
        <source>free some space</source>
        <translation>空き容量を増やしてください</translation>
    </message>
</context>
<context>
    <name>sentence.ended</name>
    <message>
        <source>{}.</source>
        <translation>{}。</translation>
    </message>
</context>
<context>
    <name>sentence.explained</name>
    <message>
        <source>{} ({})</source>
        <translation>{}（{}）</translation>
    </message>
</context>
<context>
    <name>sentence.of-place</name>
    <message>
        <source>{}: {}</source>
        <translation>{}：{}</translation>
    </message>
</context>
<context>
    <name>sentence.with-advice</name>
    <message>
        <source>{}; {}</source>
        <translation>{}。{}</translation>
    </message>
</context>
<context>
    <name>session.cannot-end-show</name>
    <message>
        <source>the other program may not be ended from here</source>
        <translation>別のプログラムはここからは終了できません</translation>
    </message>
</context>
<context>
    <name>session.close-other-window</name>
    <message>
        <source>go on there, or close it there first</source>
        <translation>そちらで続けるか、先にそちらで閉じてください</translation>
    </message>
</context>
<context>
    <name>session.end-show-itself</name>
    <message>
        <source>hold Esc on the projector&apos;s picture for two seconds</source>
        <translation>プロジェクターの画面で Esc を 2 秒間押し続けてください</translation>
    </message>
</context>
<context>
    <name>session.open-in-another-window</name>
    <message>
        <source>this venue is open in another window of Relucent</source>
        <translation>この会場は Relucent の別のウィンドウで開かれています</translation>
    </message>
</context>
<context>
    <name>sets.choose-name</name>
    <message>
        <source>choose another name, as day or school class</source>
        <translation>「昼」や「学校の団体」など、別の名前を選んでください</translation>
    </message>
</context>
<context>
    <name>sets.choose-one</name>
    <message>
        <source>choose one of {}</source>
        <translation>{} から選んでください</translation>
    </message>
</context>
<context>
    <name>sets.damaged</name>
    <message>
        <source>the sets of this calibration cannot be read</source>
        <translation>この校正のセットを読み取れません</translation>
    </message>
</context>
<context>
    <name>sets.in-use</name>
    <message>
        <source>the set &apos;{}&apos; is in use</source>
        <translation>セット「{}」は使用中です</translation>
    </message>
</context>
<context>
    <name>sets.name-empty</name>
    <message>
        <source>a set needs a name</source>
        <translation>セットには名前が必要です</translation>
    </message>
</context>
<context>
    <name>sets.name-odd</name>
    <message>
        <source>the name of a set is plain text that neither begins nor ends with a space</source>
        <translation>セットの名前は、先頭と末尾に空白のない普通の文字列です</translation>
    </message>
</context>
<context>
    <name>sets.name-taken</name>
    <message>
        <source>there is a set &apos;{}&apos; already</source>
        <translation>セット「{}」はすでにあります</translation>
    </message>
</context>
<context>
    <name>sets.name-too-long</name>
    <message>
        <source>the name of a set has at most {} bytes</source>
        <translation>セットの名前は最大 {} バイトです</translation>
    </message>
</context>
<context>
    <name>sets.of-newer-version</name>
    <message>
        <source>a newer Relucent wrote the sets of this calibration</source>
        <translation>この校正のセットは、より新しい Relucent が書き込んだものです</translation>
    </message>
</context>
<context>
    <name>sets.remove-section</name>
    <message>
        <source>take &quot;sets&quot; out of the settings in {}, or copy the calibration again from where it was made</source>
        <translation>{} の設定から「sets」を取り除くか、作成元から校正をもう一度コピーしてください</translation>
    </message>
</context>
<context>
    <name>sets.save-first</name>
    <message>
        <source>this calibration has no sets yet: save one first</source>
        <translation>この校正にはまだセットがありません。先に保存してください</translation>
    </message>
</context>
<context>
    <name>sets.unknown</name>
    <message>
        <source>there is no set &apos;{}&apos;</source>
        <translation>セット「{}」はありません</translation>
    </message>
</context>
<context>
    <name>sets.use-another-first</name>
    <message>
        <source>use another one first</source>
        <translation>先に別のものを使ってください</translation>
    </message>
</context>
<context>
    <name>show.allow-commands</name>
    <message>
        <source>look at what it does, then open the venue in the wizard and allow its programs</source>
        <translation>何をするかを確かめてから、ウィザードで会場を開いてプログラムを許可してください</translation>
    </message>
</context>
<context>
    <name>show.cannot-enable-service</name>
    <message>
        <source>the service cannot be switched on ({})</source>
        <translation>サービスを有効にできません（{}）</translation>
    </message>
</context>
<context>
    <name>show.cannot-remove-entry</name>
    <message>
        <source>it cannot be removed ({})</source>
        <translation>削除できません（{}）</translation>
    </message>
</context>
<context>
    <name>show.cannot-write-log</name>
    <message>
        <source>the log cannot be written ({})</source>
        <translation>ログを書き込めません（{}）</translation>
    </message>
</context>
<context>
    <name>show.check-folder-permissions</name>
    <message>
        <source>check the folder&apos;s permissions</source>
        <translation>フォルダーのアクセス権を確認してください</translation>
    </message>
</context>
<context>
    <name>show.choose-another-log-folder</name>
    <message>
        <source>choose another folder with --log</source>
        <translation>--log で別のフォルダーを指定してください</translation>
    </message>
</context>
<context>
    <name>show.engine-lost-device</name>
    <message>
        <source>the engine lost its graphics card</source>
        <translation>エンジンが使用中のデバイスを失いました</translation>
    </message>
</context>
<context>
    <name>show.no-camera</name>
    <message>
        <source>this show has no camera: its calibration names none</source>
        <translation>このショーにはカメラがありません：校正にカメラの指定がありません</translation>
    </message>
</context>
<context>
    <name>show.no-xwayland</name>
    <message>
        <source>in a Wayland session, take QT_QPA_PLATFORM=xcb out of the environment; else take away the desktop&apos;s rules for windows of Relucent, then try again</source>
        <translation>Wayland セッションでは環境から QT_QPA_PLATFORM=xcb を外してください。それ以外では Relucent のウィンドウに対するデスクトップの規則を外してから、再試行してください</translation>
    </message>
</context>
<context>
    <name>show.projector-by-command</name>
    <message>
        <source>this calibration shows pictures by a command of its own, which does not know of the show: stop the show and use relucent-cli verify and perfect</source>
        <translation>この校正は、ショーを知らない独自のコマンドで画像を表示します：ショーを止めて relucent-cli verify と perfect を使ってください</translation>
    </message>
</context>
<context>
    <name>show.restore-resolution</name>
    <message>
        <source>set its resolution back in the desktop&apos;s settings, then try again</source>
        <translation>デスクトップの設定で解像度を元に戻してから、再試行してください</translation>
    </message>
</context>
<context>
    <name>show.screen-asleep</name>
    <message>
        <source>the projector&apos;s screen is asleep and does not wake</source>
        <translation>プロジェクターの画面がスリープ状態から復帰しません</translation>
    </message>
</context>
<context>
    <name>show.screen-size-changed</name>
    <message>
        <source>the projector&apos;s screen has {} pixels now and {} were calibrated</source>
        <translation>プロジェクターの画面は現在 {} 画素ですが、校正時は {} でした</translation>
    </message>
</context>
<context>
    <name>show.start-show-again</name>
    <message>
        <source>start the show again</source>
        <translation>ショーをもう一度開始してください</translation>
    </message>
</context>
<context>
    <name>show.switch-off-power-saving</name>
    <message>
        <source>switch off its power saving and the screen saver in the desktop&apos;s settings, then try again</source>
        <translation>デスクトップの設定で省電力機能とスクリーンセーバーをオフにしてから、再試行してください</translation>
    </message>
</context>
<context>
    <name>show.window-elsewhere</name>
    <message>
        <source>the desktop puts the projector&apos;s picture on the screen {} instead</source>
        <translation>デスクトップがプロジェクターの画像を別の画面 {} に表示しています</translation>
    </message>
</context>
<context>
    <name>stage.adapting-light-transport</name>
    <message>
        <source>fitting the light transport to what is seen</source>
        <translation>光輸送を見えているものに合わせています</translation>
    </message>
</context>
<context>
    <name>stage.algorithm-1</name>
    <message>
        <source>Algorithm 1</source>
        <translation>アルゴリズム 1</translation>
    </message>
</context>
<context>
    <name>stage.assembling-light-transport</name>
    <message>
        <source>Assembling the light transport</source>
        <translation>光輸送の組み立て</translation>
    </message>
</context>
<context>
    <name>stage.awaiting-steady-light</name>
    <message>
        <source>Waiting until the lamps are steady</source>
        <translation>ランプが安定するのを待っています</translation>
    </message>
</context>
<context>
    <name>stage.black-and-full-light</name>
    <message>
        <source>black and full light</source>
        <translation>黒と全点灯</translation>
    </message>
</context>
<context>
    <name>stage.calibrating</name>
    <message>
        <source>Calibrating</source>
        <translation>校正</translation>
    </message>
</context>
<context>
    <name>stage.capped-clusters</name>
    <message>
        <source>Clusters held to a size</source>
        <translation>サイズ制限付きクラスター</translation>
    </message>
</context>
<context>
    <name>stage.capping-clusters</name>
    <message>
        <source>Holding clusters to a size</source>
        <translation>クラスターのサイズ制限</translation>
    </message>
</context>
<context>
    <name>stage.checking-additivity</name>
    <message>
        <source>Checking that the colours of {} add up</source>
        <translation>{} の色の加法性の確認</translation>
    </message>
</context>
<context>
    <name>stage.checking-drift</name>
    <message>
        <source>Checking for drift</source>
        <translation>ドリフトの確認</translation>
    </message>
</context>
<context>
    <name>stage.checking-projector-and-camera</name>
    <message>
        <source>Checking projector and camera</source>
        <translation>プロジェクターとカメラの確認</translation>
    </message>
</context>
<context>
    <name>stage.choosing-camera-pixels</name>
    <message>
        <source>Finding the camera pixels that are needed</source>
        <translation>必要なカメラ画素の確認</translation>
    </message>
</context>
<context>
    <name>stage.clustering-light-transport</name>
    <message>
        <source>Clustering the light transport</source>
        <translation>光輸送のクラスター分け</translation>
    </message>
</context>
<context>
    <name>stage.comparing-cluster-inverses-in-venue</name>
    <message>
        <source>Comparing the inverses of clusters in {}</source>
        <translation>{} のクラスター逆変換の比較</translation>
    </message>
</context>
<context>
    <name>stage.comparing-methods</name>
    <message>
        <source>Comparing the methods</source>
        <translation>方式の比較</translation>
    </message>
</context>
<context>
    <name>stage.comparing-methods-in-venue</name>
    <message>
        <source>Comparing the methods in {}</source>
        <translation>{} の方式の比較</translation>
    </message>
</context>
<context>
    <name>stage.comparing-views</name>
    <message>
        <source>Comparing what the views want</source>
        <translation>各視点が求めるものの比較</translation>
    </message>
</context>
<context>
    <name>stage.compensating</name>
    <message>
        <source>Compensating</source>
        <translation>補正</translation>
    </message>
</context>
<context>
    <name>stage.concluding-measurement</name>
    <message>
        <source>what may be expected of the result</source>
        <translation>結果から期待できること</translation>
    </message>
</context>
<context>
    <name>stage.decoding</name>
    <message>
        <source>Decoding</source>
        <translation>復号</translation>
    </message>
</context>
<context>
    <name>stage.dense-patterns</name>
    <message>
        <source>patterns in blocks of {} px</source>
        <translation>{} pxのブロックのパターン</translation>
    </message>
</context>
<context>
    <name>stage.estimating-light-transport</name>
    <message>
        <source>Estimating the light transport</source>
        <translation>光輸送の推定</translation>
    </message>
</context>
<context>
    <name>stage.estimating-response-and-colours</name>
    <message>
        <source>Estimating response and colours</source>
        <translation>応答と色の推定</translation>
    </message>
</context>
<context>
    <name>stage.evaluating</name>
    <message>
        <source>Evaluating</source>
        <translation>評価</translation>
    </message>
</context>
<context>
    <name>stage.finding-defocus</name>
    <message>
        <source>Finding the defocus</source>
        <translation>ボケの検出</translation>
    </message>
</context>
<context>
    <name>stage.finding-exposure</name>
    <message>
        <source>Finding the exposure</source>
        <translation>露出の決定</translation>
    </message>
</context>
<context>
    <name>stage.finding-exposures</name>
    <message>
        <source>Finding the exposures</source>
        <translation>露出の決定</translation>
    </message>
</context>
<context>
    <name>stage.finding-projector-picture</name>
    <message>
        <source>Looking for the projector&apos;s picture</source>
        <translation>プロジェクターの画像の検出</translation>
    </message>
</context>
<context>
    <name>stage.finding-shadows</name>
    <message>
        <source>Looking for shadows</source>
        <translation>影の検出</translation>
    </message>
</context>
<context>
    <name>stage.finding-uncorrectable-pixels</name>
    <message>
        <source>Looking for what cannot be corrected</source>
        <translation>補正できない部分の検出</translation>
    </message>
</context>
<context>
    <name>stage.finding-what-is-seen</name>
    <message>
        <source>Finding which part of the picture is seen</source>
        <translation>画像のどの部分が見えるかを調べています</translation>
    </message>
</context>
<context>
    <name>stage.fitting-light-spread</name>
    <message>
        <source>Fitting the spread of light</source>
        <translation>光の広がりの当てはめ</translation>
    </message>
</context>
<context>
    <name>stage.forming-patches</name>
    <message>
        <source>Forming patches</source>
        <translation>パッチの形成</translation>
    </message>
</context>
<context>
    <name>stage.inverting-clusters</name>
    <message>
        <source>Inverting the clusters</source>
        <translation>クラスターの逆変換</translation>
    </message>
</context>
<context>
    <name>stage.inverting-light-transport</name>
    <message>
        <source>Inverting the light transport</source>
        <translation>光輸送の逆変換</translation>
    </message>
</context>
<context>
    <name>stage.inverting-venue</name>
    <message>
        <source>Inverting {}</source>
        <translation>{} の逆変換</translation>
    </message>
</context>
<context>
    <name>stage.joining-clusters</name>
    <message>
        <source>Joining clusters</source>
        <translation>クラスターの統合</translation>
    </message>
</context>
<context>
    <name>stage.judging-light</name>
    <message>
        <source>Judging the light</source>
        <translation>光の評価</translation>
    </message>
</context>
<context>
    <name>stage.level-of-tree</name>
    <message numerus="yes">
        <source>level {} of {}: {} patterns</source>
        <comment>level {} of {}: {} pattern</comment>
        <translation>
            <numerusform>階層 {}/{}：パターン {} 枚</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>stage.light-transport</name>
    <message>
        <source>light transport</source>
        <translation>光輸送</translation>
    </message>
</context>
<context>
    <name>stage.linearizing</name>
    <message>
        <source>Linearizing</source>
        <translation>線形化</translation>
    </message>
</context>
<context>
    <name>stage.looking-for-changes</name>
    <message>
        <source>Looking for what has changed</source>
        <translation>変わった部分を探しています</translation>
    </message>
</context>
<context>
    <name>stage.looking-for-hot-pixels</name>
    <message>
        <source>Looking for hot pixels of the camera</source>
        <translation>カメラのホットピクセルの確認</translation>
    </message>
</context>
<context>
    <name>stage.looking-through-camera</name>
    <message>
        <source>Looking through the camera</source>
        <translation>ライブビュー</translation>
    </message>
</context>
<context>
    <name>stage.measuring-brightness-curves</name>
    <message>
        <source>Measuring the brightness curves of {}</source>
        <translation>{} の明るさカーブの測定</translation>
    </message>
</context>
<context>
    <name>stage.measuring-camera</name>
    <message>
        <source>Measuring the camera</source>
        <translation>カメラの測定</translation>
    </message>
</context>
<context>
    <name>stage.measuring-latency</name>
    <message>
        <source>Measuring the latency</source>
        <translation>遅延時間の測定</translation>
    </message>
</context>
<context>
    <name>stage.measuring-light-transport</name>
    <message>
        <source>Measuring the light transport</source>
        <translation>光輸送の測定</translation>
    </message>
</context>
<context>
    <name>stage.measuring-response</name>
    <message>
        <source>Measuring the response</source>
        <translation>応答の測定</translation>
    </message>
</context>
<context>
    <name>stage.measuring-venue</name>
    <message>
        <source>Measuring {}</source>
        <translation>{} の測定</translation>
    </message>
</context>
<context>
    <name>stage.measuring-what-changed</name>
    <message>
        <source>measuring what is no longer as it was</source>
        <translation>以前と違うところを測定しています</translation>
    </message>
</context>
<context>
    <name>stage.opening-devices</name>
    <message>
        <source>Opening the devices</source>
        <translation>機器への接続</translation>
    </message>
</context>
<context>
    <name>stage.perfecting</name>
    <message>
        <source>Correcting the picture by photographs of itself</source>
        <translation>画像をその写真で補正しています</translation>
    </message>
</context>
<context>
    <name>stage.photographing-projections</name>
    <message>
        <source>Photographing the projections</source>
        <translation>投影の撮影</translation>
    </message>
</context>
<context>
    <name>stage.photographing-test-patterns</name>
    <message>
        <source>Photographing test patterns</source>
        <translation>テストパターンの撮影</translation>
    </message>
</context>
<context>
    <name>stage.predicting-held-out-patterns</name>
    <message>
        <source>Predicting held-out patterns</source>
        <translation>検証用パターンの予測</translation>
    </message>
</context>
<context>
    <name>stage.preparing-benchmarks</name>
    <message>
        <source>Preparing the benchmarks</source>
        <translation>ベンチマークの準備</translation>
    </message>
</context>
<context>
    <name>stage.preparing-devices</name>
    <message>
        <source>Preparing the devices</source>
        <translation>機器の準備</translation>
    </message>
</context>
<context>
    <name>stage.preparing-engine</name>
    <message>
        <source>Preparing the engine</source>
        <translation>エンジンの準備</translation>
    </message>
</context>
<context>
    <name>stage.preparing-preview</name>
    <message>
        <source>Preparing the preview</source>
        <translation>プレビューの準備</translation>
    </message>
</context>
<context>
    <name>stage.preparing-venue</name>
    <message>
        <source>Preparing the venue</source>
        <translation>会場の準備</translation>
    </message>
</context>
<context>
    <name>stage.reading-calibration</name>
    <message>
        <source>Reading the calibration</source>
        <translation>校正データの読み込み</translation>
    </message>
</context>
<context>
    <name>stage.reading-light-transport</name>
    <message>
        <source>Reading the light transport</source>
        <translation>光輸送の読み込み</translation>
    </message>
</context>
<context>
    <name>stage.reading-patterns</name>
    <message>
        <source>Reading the patterns</source>
        <translation>パターンの読み込み</translation>
    </message>
</context>
<context>
    <name>stage.reading-photographs</name>
    <message>
        <source>Reading the photographs</source>
        <translation>写真の読み込み</translation>
    </message>
</context>
<context>
    <name>stage.reading-pictures</name>
    <message>
        <source>Reading the pictures</source>
        <translation>画像の読み込み</translation>
    </message>
</context>
<context>
    <name>stage.reading-response</name>
    <message>
        <source>Reading the response</source>
        <translation>応答の読み込み</translation>
    </message>
</context>
<context>
    <name>stage.reading-venue</name>
    <message>
        <source>Reading {}</source>
        <translation>{} の読み込み</translation>
    </message>
</context>
<context>
    <name>stage.remeasuring-flagged-pixels</name>
    <message numerus="yes">
        <source>measuring {} flagged pixels again</source>
        <comment>measuring {} flagged pixel again</comment>
        <translation>
            <numerusform>要確認の {} 画素の再測定</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>stage.scaling-to-flood-image</name>
    <message>
        <source>Scaling to the flood image</source>
        <translation>全点灯画像に合わせた調整</translation>
    </message>
</context>
<context>
    <name>stage.separating-direct-and-indirect-light</name>
    <message>
        <source>Separating direct and indirect light</source>
        <translation>直接光と間接光の分離</translation>
    </message>
</context>
<context>
    <name>stage.sharing-leaves</name>
    <message>
        <source>light that neighbouring pixels share</source>
        <translation>隣り合う画素が共有する光</translation>
    </message>
</context>
<context>
    <name>stage.sharpening</name>
    <message>
        <source>Sharpening</source>
        <translation>鮮鋭化</translation>
    </message>
</context>
<context>
    <name>stage.solving</name>
    <message>
        <source>Solving</source>
        <translation>求解</translation>
    </message>
</context>
<context>
    <name>stage.storing-light-transport</name>
    <message>
        <source>storing the light transport</source>
        <translation>光輸送の保存</translation>
    </message>
</context>
<context>
    <name>stage.switching-projectors-on</name>
    <message>
        <source>Switching the projectors on</source>
        <translation>プロジェクターの電源を入れています</translation>
    </message>
</context>
<context>
    <name>stage.taking-verification-photograph</name>
    <message>
        <source>Taking the verification photograph</source>
        <translation>検証写真の撮影</translation>
    </message>
</context>
<context>
    <name>stage.test-patterns</name>
    <message>
        <source>test patterns</source>
        <translation>テストパターン</translation>
    </message>
</context>
<context>
    <name>stage.timing-engine</name>
    <message>
        <source>Timing the engine</source>
        <translation>エンジンの速度測定</translation>
    </message>
</context>
<context>
    <name>stage.tracing-simulated-venue</name>
    <message>
        <source>tracing the simulated venue</source>
        <translation>模擬会場の光線追跡</translation>
    </message>
</context>
<context>
    <name>stage.windows</name>
    <message>
        <source>Computing the windows of the inverse</source>
        <translation>局所窓</translation>
    </message>
</context>
<context>
    <name>stage.working-out-finest-blocks</name>
    <message>
        <source>working out the finest blocks</source>
        <translation>最も細かいブロックの計算</translation>
    </message>
</context>
<context>
    <name>stage.writing</name>
    <message>
        <source>Writing</source>
        <translation>書き込み</translation>
    </message>
</context>
<context>
    <name>stage.writing-out-light-transport</name>
    <message>
        <source>Writing out the light transport</source>
        <translation>光輸送の書き出し</translation>
    </message>
</context>
<context>
    <name>stage.writing-report</name>
    <message>
        <source>Writing the report</source>
        <translation>レポートの書き込み</translation>
    </message>
</context>
<context>
    <name>stage.writing-results</name>
    <message>
        <source>Writing the results</source>
        <translation>結果の書き込み</translation>
    </message>
</context>
<context>
    <name>stream.address-incomplete</name>
    <message>
        <source>in a stream&apos;s address the host or its port is missing or wrong</source>
        <translation>ストリームのアドレスにホストまたはポートがないか、正しくありません</translation>
    </message>
</context>
<context>
    <name>stream.check-host</name>
    <message>
        <source>check the name in the address, or write the number</source>
        <translation>アドレスの名前を確認するか、番号で書いてください</translation>
    </message>
</context>
<context>
    <name>stream.check-network</name>
    <message>
        <source>check the network and the address</source>
        <translation>ネットワークとアドレスを確認してください</translation>
    </message>
</context>
<context>
    <name>stream.check-path</name>
    <message>
        <source>check what stands behind the host in the address</source>
        <translation>アドレスのホストより後ろの部分を確認してください</translation>
    </message>
</context>
<context>
    <name>stream.check-sender</name>
    <message>
        <source>check the sender, the network, and the address</source>
        <translation>送信元、ネットワーク、アドレスを確認してください</translation>
    </message>
</context>
<context>
    <name>stream.end-other</name>
    <message>
        <source>end that program, or send to another port</source>
        <translation>そのプログラムを終了するか、別のポートに送信してください</translation>
    </message>
</context>
<context>
    <name>stream.ended</name>
    <message>
        <source>it has ended</source>
        <translation>終了しました</translation>
    </message>
</context>
<context>
    <name>stream.host-unknown</name>
    <message>
        <source>its host is not found</source>
        <translation>ホストが見つかりません</translation>
    </message>
</context>
<context>
    <name>stream.list-once</name>
    <message>
        <source>put it into the playlist once</source>
        <translation>プレイリストには1回だけ入れてください</translation>
    </message>
</context>
<context>
    <name>stream.no-memory</name>
    <message>
        <source>there is not enough memory for its pictures</source>
        <translation>映像に必要なメモリが足りません</translation>
    </message>
</context>
<context>
    <name>stream.no-such-path</name>
    <message>
        <source>there is nothing at its path</source>
        <translation>そのパスには何もありません</translation>
    </message>
</context>
<context>
    <name>stream.not-ready</name>
    <message>
        <source>{}: {}</source>
        <translation>{}：{}</translation>
    </message>
</context>
<context>
    <name>stream.not-yet</name>
    <message>
        <source>it has given no picture yet</source>
        <translation>まだ映像が届いていません</translation>
    </message>
</context>
<context>
    <name>stream.open-already</name>
    <message>
        <source>this program plays it already</source>
        <translation>このプログラムで既に再生中です</translation>
    </message>
</context>
<context>
    <name>stream.port-in-use</name>
    <message>
        <source>another program receives at its port</source>
        <translation>別のプログラムがそのポートで受信しています</translation>
    </message>
</context>
<context>
    <name>stream.refused</name>
    <message>
        <source>the connection was refused</source>
        <translation>接続が拒否されました</translation>
    </message>
</context>
<context>
    <name>stream.send-h264</name>
    <message>
        <source>let it be sent as H.264 or Motion JPEG</source>
        <translation>H.264 または Motion JPEG で送信してください</translation>
    </message>
</context>
<context>
    <name>stream.silent</name>
    <message>
        <source>no picture came within {} s</source>
        <translation>{} s 以内に映像が届きませんでした</translation>
    </message>
</context>
<context>
    <name>stream.stalled</name>
    <message>
        <source>no picture has come for {} s</source>
        <translation>{} s の間、映像が届いていません</translation>
    </message>
</context>
<context>
    <name>stream.start-sender</name>
    <message>
        <source>start the sender, and check the port</source>
        <translation>送信元を起動し、ポートを確認してください</translation>
    </message>
</context>
<context>
    <name>stream.start-sender-again</name>
    <message>
        <source>start the sender again</source>
        <translation>送信元を再び起動してください</translation>
    </message>
</context>
<context>
    <name>stream.unknown-hold</name>
    <message>
        <source>the stream&apos;s address ends in an unknown choice</source>
        <translation>ストリームのアドレスの末尾の指定が不明です</translation>
    </message>
</context>
<context>
    <name>stream.unknown-scheme</name>
    <message>
        <source>this is no address of a stream</source>
        <translation>これはストリームのアドレスではありません</translation>
    </message>
</context>
<context>
    <name>stream.unreachable</name>
    <message>
        <source>its host cannot be reached</source>
        <translation>ホストに到達できません</translation>
    </message>
</context>
<context>
    <name>stream.unreadable</name>
    <message>
        <source>it cannot be read ({})</source>
        <translation>読み取れません ({})</translation>
    </message>
</context>
<context>
    <name>stream.unusable</name>
    <message>
        <source>what comes is no video that can be shown</source>
        <translation>届いたものは表示できる映像ではありません</translation>
    </message>
</context>
<context>
    <name>stream.wants-password</name>
    <message>
        <source>it wants another user name and password</source>
        <translation>別のユーザー名とパスワードが必要です</translation>
    </message>
</context>
<context>
    <name>stream.write-address</name>
    <message>
        <source>write it like {}, and in user names and passwords % and two digits for signs like @, : and /</source>
        <translation>{} のように書き、ユーザー名とパスワードの @、:、/ などの記号は % と 2 桁の数字で書いてください</translation>
    </message>
</context>
<context>
    <name>stream.write-hold</name>
    <message>
        <source>write #hold=last or #hold=black</source>
        <translation>#hold=last または #hold=black と書いてください</translation>
    </message>
</context>
<context>
    <name>stream.write-password</name>
    <message>
        <source>write them into the address before the host: {}</source>
        <translation>アドレスのホストの前に書いてください：{}</translation>
    </message>
</context>
<context>
    <name>stream.write-scheme</name>
    <message>
        <source>let it begin with one of {}</source>
        <translation>次のいずれかで始めてください：{}</translation>
    </message>
</context>
<context>
    <name>venue.cannot-open-folder</name>
    <message>
        <source>the folder cannot be opened ({})</source>
        <translation>フォルダーを開けません（{}）</translation>
    </message>
</context>
<context>
    <name>venue.cannot-rename</name>
    <message>
        <source>the folder cannot be renamed ({})</source>
        <translation>フォルダーの名前を変更できません（{}）</translation>
    </message>
</context>
<context>
    <name>venue.no-trash</name>
    <message>
        <source>it cannot be moved to the trash</source>
        <translation>ゴミ箱に移せません</translation>
    </message>
</context>
<context>
    <name>venue.remove-folder-yourself</name>
    <message>
        <source>this disk may have none: remove the folder with the file manager</source>
        <translation>このディスクにはゴミ箱がないかもしれません。ファイルマネージャーでフォルダーを削除してください</translation>
    </message>
</context>
<context>
    <name>venue.used-by-another</name>
    <message>
        <source>another program is working on this venue</source>
        <translation>別のプログラムがこの会場を処理しています</translation>
    </message>
</context>
<context>
    <name>venue.wait-for-another</name>
    <message>
        <source>wait until it has finished, or close it, then try again</source>
        <translation>終わるまで待つか、そのプログラムを閉じてから、もう一度お試しください</translation>
    </message>
</context>
<context>
    <name>view.cannot-write-picture</name>
    <message>
        <source>the picture could not be written</source>
        <translation>画像を書き込めませんでした</translation>
    </message>
</context>
<context>
    <name>view.choose-writable-folder</name>
    <message>
        <source>choose a folder that you may write to, with free space</source>
        <translation>書き込めて空き容量のあるフォルダーを選んでください</translation>
    </message>
</context>
<context>
    <name>wizard.allow-commands</name>
    <message>
        <source>open the venue anew and allow its programs</source>
        <translation>会場を開き直してプログラムを許可してください</translation>
    </message>
</context>
</TS>
