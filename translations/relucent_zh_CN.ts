<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="zh_CN">
<context>
    <name>About</name>
    <message>
        <source>About Relucent</source>
        <translation>关于 Relucent</translation>
    </message>
    <message>
        <source>Version %1, with these libraries: %2.</source>
        <translation>版本 %1，使用以下库：%2。</translation>
    </message>
</context>
<context>
    <name>ContentFiles</name>
    <message>
        <source>Pictures and films</source>
        <translation>图片和影片</translation>
    </message>
    <message>
        <source>Pictures</source>
        <translation>图片</translation>
    </message>
    <message>
        <source>All files</source>
        <translation>所有文件</translation>
    </message>
</context>
<context>
    <name>DeviceLabel</name>
    <message>
        <source>Projector %1</source>
        <translation>投影机 %1</translation>
    </message>
    <message>
        <source>Camera %1</source>
        <translation>相机 %1</translation>
    </message>
</context>
<context>
    <name>EndQuestion</name>
    <message>
        <source>A measurement is under way</source>
        <translation>正在测量</translation>
    </message>
    <message>
        <source>%1 in the venue “%2”.</source>
        <translation>场地“%2”中的%1。</translation>
    </message>
    <message>
        <source>Every photograph is on the disk. Opened again, the venue goes on from there.</source>
        <translation>所有照片都在磁盘上。重新打开该场地后，会从中断处继续。</translation>
    </message>
    <message>
        <source>End it for now</source>
        <translation>暂且结束</translation>
    </message>
    <message>
        <source>Go on measuring</source>
        <translation>继续测量</translation>
    </message>
    <message>
        <source>The show of the venue “%1”: the projector&apos;s screen goes dark.</source>
        <translation>场地“%1”的节目：投影机屏幕将变黑。</translation>
    </message>
    <message>
        <source>Playlist and results are on the disk. Open the output again to play the show again.</source>
        <translation>播放列表和结果都在磁盘上。重新打开输出即可再次播放节目。</translation>
    </message>
    <message>
        <source>A measurement and a show are under way</source>
        <translation>正在测量，同时正在播放节目</translation>
    </message>
    <message>
        <source>End both</source>
        <translation>两者都结束</translation>
    </message>
    <message>
        <source>Let both go on</source>
        <translation>两者都继续</translation>
    </message>
    <message>
        <source>A show is playing</source>
        <translation>正在播放节目</translation>
    </message>
    <message>
        <source>End the show</source>
        <translation>结束节目</translation>
    </message>
    <message>
        <source>Go on playing</source>
        <translation>继续播放</translation>
    </message>
    <message>
        <source>The show of the venue “%1”.</source>
        <translation>场地“%1”的放映。</translation>
    </message>
</context>
<context>
    <name>Failure</name>
    <message>
        <source>The computer has no memory left.</source>
        <translation>计算机内存不足。</translation>
    </message>
    <message>
        <source>Close other programs, or choose fewer pixels.</source>
        <translation>请关闭其他程序，或选择较少的像素。</translation>
    </message>
    <message>
        <source>Relucent made a mistake.</source>
        <translation>Relucent 出错了。</translation>
    </message>
    <message>
        <source>What is saved is safe. Copy the details for whoever looks after the program, then try again.</source>
        <translation>已保存的内容是安全的。请复制详细信息交给程序维护人员，然后重试。</translation>
    </message>
    <message>
        <source>What is saved is safe. Try again.</source>
        <translation>已保存的内容是安全的。请重试。</translation>
    </message>
    <message>
        <source>The camera does not see this projector</source>
        <translation>相机看不到这台投影机</translation>
    </message>
    <message>
        <source>A program of this venue failed</source>
        <translation>此场地的某个程序失败了</translation>
    </message>
    <message>
        <source>Another command is typed at the step Venue, by “Change the programs”.</source>
        <translation>可在“场地”步骤通过“更换程序”输入另一条命令。</translation>
    </message>
</context>
<context>
    <name>FullDisk</name>
    <message>
        <source>The disk is full. Measuring has paused.</source>
        <translation>磁盘已满。测量已暂停。</translation>
    </message>
    <message>
        <source>Every photograph is safe. %1 are free, %2 are needed: then measuring goes on by itself.</source>
        <translation>所有照片均已保存。可用空间 %1，需要 %2：腾出空间后，测量会自动继续。</translation>
    </message>
</context>
<context>
    <name>LostDevice</name>
    <message>
        <source>The projector&apos;s screen is unplugged</source>
        <translation>投影机的屏幕已断开</translation>
    </message>
    <message>
        <source>Everything so far is safe. Plug it in again: it goes on by itself.</source>
        <translation>目前的一切都已保存。重新接上后会自动继续。</translation>
    </message>
    <message>
        <source>Everything so far is safe. Push in its cable at both ends, and do not move the tripod: it goes on by itself.</source>
        <translation>目前的一切都已保存。请插紧线缆两端，不要移动三脚架：随后会自动继续。</translation>
    </message>
    <message>
        <source>The camera does not answer</source>
        <translation>相机没有响应</translation>
    </message>
    <message>
        <source>Screen unplugged</source>
        <translation>屏幕已断开</translation>
    </message>
    <message>
        <source>Camera silent</source>
        <translation>相机无响应</translation>
    </message>
    <message>
        <source>%1: its screen is unplugged</source>
        <extracomment>%1 is a projector: its name, or &quot;Projector 2&quot;</extracomment>
        <translation>%1：屏幕已断开</translation>
    </message>
    <message>
        <source>%1 does not answer</source>
        <extracomment>%1 is a camera: its name, or &quot;Camera 2&quot;</extracomment>
        <translation>%1没有响应</translation>
    </message>
    <message>
        <source>Everything so far is safe. Plug it in again, then resume.</source>
        <translation>目前的一切都已保存。重新接上，然后继续。</translation>
    </message>
    <message>
        <source>Everything so far is safe. Push in its cable at both ends, and do not move the tripod, then resume.</source>
        <translation>目前的一切都已保存。请插紧线缆两端，不要移动三脚架，然后继续。</translation>
    </message>
</context>
<context>
    <name>Method</name>
    <message>
        <source>Each pixel&apos;s brightness</source>
        <translation>逐像素亮度</translation>
    </message>
    <message>
        <source>Each pixel on its own</source>
        <translation>逐像素独立</translation>
    </message>
    <message>
        <source>Each pixel, sharpened</source>
        <translation>逐像素锐化</translation>
    </message>
    <message>
        <source>Clusters</source>
        <translation>簇</translation>
    </message>
    <message>
        <source>Windows</source>
        <translation>窗口</translation>
    </message>
    <message>
        <source>All bounces, for films</source>
        <translation>全部反射，用于视频</translation>
    </message>
    <message>
        <source>Uncorrected</source>
        <translation>未补偿</translation>
    </message>
    <message>
        <source>All bounces, solved, for stills</source>
        <translation>完全求解，静态图片</translation>
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
        <translation>%1 十亿</translation>
    </message>
</context>
<context>
    <name>Overlay</name>
    <message>
        <source>%1 frames a second, %2 ms a frame, %3 of %4 late</source>
        <translation>%1 帧/秒，每帧 %2 ms，%4 帧中 %3 帧超时</translation>
    </message>
    <message>
        <source>not compensated</source>
        <translation>未补偿</translation>
    </message>
    <message>
        <source>frozen</source>
        <translation>已定格</translation>
    </message>
    <message>
        <source>test chart: %1</source>
        <translation>测试图卡：%1</translation>
    </message>
    <message numerus="yes">
        <source>compensated, %n step(s), %1 % out of reach</source>
        <translation>
            <numerusform>已补偿，迭代 %n 步，不可达 %1 %</numerusform>
        </translation>
    </message>
    <message>
        <source>still picture</source>
        <translation>静止图像</translation>
    </message>
    <message>
        <source>follows a viewer within %1 ms</source>
        <translation>在 %1 ms 内跟随观众</translation>
    </message>
    <message>
        <source>perfected by photographs</source>
        <translation>已由照片完善</translation>
    </message>
    <message>
        <source>live picture within %1 ms of its arrival</source>
        <translation>实时画面到达后 %1 ms 内</translation>
    </message>
</context>
<context>
    <name>RecentVenues</name>
    <message>
        <source>Nothing measured yet</source>
        <translation>尚未测量</translation>
    </message>
    <message>
        <source>Acquire is next</source>
        <translation>下一步：采集</translation>
    </message>
    <message>
        <source>Ready to play</source>
        <translation>可以播放</translation>
    </message>
    <message>
        <source>Preview out of date</source>
        <translation>预览已过期</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>已测量</translation>
    </message>
    <message numerus="yes">
        <source>Interrupted: %n pattern(s) are safe</source>
        <translation>
            <numerusform>已中断：%n 个图案已安全保存</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Measured; %n newer pattern(s) are safe</source>
        <translation>
            <numerusform>已测量；%n 个更新的图案已安全保存</numerusform>
        </translation>
    </message>
    <message>
        <source>Ended by a change</source>
        <translation>因变化而结束</translation>
    </message>
    <message>
        <source>Stopped at blocks of %1 px</source>
        <translation>在 %1 px 的块处停止</translation>
    </message>
    <message>
        <source>Stopped at %1 px; newer patterns: %2</source>
        <translation>在 %1 px 处停止；更新的图案：%2</translation>
    </message>
    <message>
        <source>A show plays</source>
        <translation>正在播放节目</translation>
    </message>
</context>
<context>
    <name>ScreenChoice</name>
    <message>
        <source>This computer</source>
        <translation>本机</translation>
    </message>
    <message>
        <source>%1, %2 × %3, %4 Hz</source>
        <translation>%1，%2 × %3，%4 Hz</translation>
    </message>
    <message>
        <source>There is no other screen: the patterns cover this window while they are shown. Plug the projector in, and switch the desktop to extended screens, to keep both apart.</source>
        <translation>没有其他屏幕：显示图案时会盖住此窗口。若要分开，请接上投影机，并将桌面切换为扩展模式。</translation>
    </message>
    <message>
        <source>This is the screen that you work on. Choose the projector&apos;s.</source>
        <translation>这是您正在使用的屏幕。请选择投影机的屏幕。</translation>
    </message>
    <message>
        <source>The projector was measured with %1 pixels. Set this screen to that size.</source>
        <translation>投影机是以 %1 像素测量的。请把此屏幕设为该尺寸。</translation>
    </message>
    <message>
        <source>This is another projector than the one that was measured. Its light and its place differ: take a verification photograph, and measure again where that does not look as predicted.</source>
        <translation>这不是测量时的投影机，它的光和位置都不同：请拍一张验证照片，若与预测不符则重新测量。</translation>
    </message>
    <message>
        <source>Measured at %1, used at %2. If it is the same projector in the same place, everything that was measured holds; a verification photograph tells.</source>
        <translation>在 %1 测量，在 %2 使用。如果是同一位置的同一台投影机，所有测量仍然有效；验证照片可以说明。</translation>
    </message>
</context>
<context>
    <name>StoppedEarly</name>
    <message>
        <source>Measuring was stopped at blocks of %1 px</source>
        <translation>测量在 %1 px 的块处停止</translation>
    </message>
    <message>
        <source>All that follows is as coarse. Go on measuring any time.</source>
        <translation>后续结果同样粗略。可随时继续测量。</translation>
    </message>
    <message>
        <source>Go on at Acquire</source>
        <translation>到“采集”继续</translation>
    </message>
    <message>
        <source>What was measured does not fit together</source>
        <translation>测得的结果互不相符</translation>
    </message>
    <message>
        <source>Corrected pictures are expected at %1: that is no better than uncorrected. Measure again.</source>
        <translation>校正后的画面预计为 %1，不比未校正时好。请重新测量。</translation>
    </message>
    <message>
        <source>%1 dB</source>
        <translation>%1 dB</translation>
    </message>
    <message>
        <source>Go to Acquire</source>
        <translation>转到“采集”</translation>
    </message>
    <message>
        <source>Measuring ended because something had changed</source>
        <translation>因为有东西发生变化，测量已结束</translation>
    </message>
    <message>
        <source>What follows is of before. See at Acquire what helps.</source>
        <translation>后续结果来自变化之前。请在“采集”中查看解决办法。</translation>
    </message>
    <message>
        <source>%1 of the view is too bright for the camera</source>
        <translation>画面的 %1 对相机来说太亮</translation>
    </message>
    <message>
        <source>Nothing is corrected there. Close the lens a little, check the camera, then measure again.</source>
        <translation>那里不会得到校正。请稍微收小光圈，检查相机，然后重新测量。</translation>
    </message>
    <message>
        <source>%1 of the view is left out</source>
        <translation>画面的 %1 被排除</translation>
    </message>
    <message>
        <source>Test patterns looked different there from what was measured, and nothing is corrected. See that all stands still, then measure again.</source>
        <translation>那里的测试图案与测量结果不符，不会得到校正。请确保一切静止，然后重新测量。</translation>
    </message>
    <message>
        <source>Measuring was stopped before anything was told apart</source>
        <translation>在分辨出任何位置之前测量已停止</translation>
    </message>
    <message>
        <source>No picture can be corrected by it. Go on measuring, or use the earlier one, at Acquire.</source>
        <translation>无法用它校正任何画面。请到“采集”继续测量，或使用先前的测量。</translation>
    </message>
    <message>
        <source>No picture can be corrected by it. Go on measuring any time.</source>
        <translation>无法用它校正任何画面。可随时继续测量。</translation>
    </message>
    <message>
        <source>Measuring again has not ended</source>
        <translation>重新测量尚未结束</translation>
    </message>
    <message>
        <source>What was measured is out of date: it belongs to earlier settings</source>
        <translation>测量结果已过期：属于以前的设置</translation>
    </message>
    <message>
        <source>It still works, and what you see follows from the earlier measurement, until the new one is ready.</source>
        <translation>在新的测量完成之前，先前的测量仍然可用，您看到的内容也由此得出。</translation>
    </message>
</context>
<context>
    <name>VenueKeeping</name>
    <message>
        <source>It is being measured.</source>
        <translation>正在测量中。</translation>
    </message>
    <message>
        <source>It is open. Open another venue, then come back.</source>
        <translation>它已打开。请先打开另一个场地再回来。</translation>
    </message>
    <message>
        <source>Give the venue a name.</source>
        <translation>请为场地命名。</translation>
    </message>
    <message>
        <source>A name cannot hold a slash.</source>
        <translation>名称不能包含斜杠。</translation>
    </message>
    <message>
        <source>A name cannot begin with a full stop: its folder would be hidden.</source>
        <translation>名称不能以句点开头：其文件夹会被隐藏。</translation>
    </message>
    <message>
        <source>There is a folder of that name. Choose another name.</source>
        <translation>已有同名文件夹。请换一个名称。</translation>
    </message>
    <message>
        <source>Its show starts at log-in. Open it, and remove the installed show at Output first.</source>
        <translation>其节目在登录时开始。请先打开它，在“输出”中移除已安装的节目。</translation>
    </message>
</context>
<context>
    <name>ViewActions</name>
    <message>
        <source>Show everything</source>
        <translation>显示全部</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>保存</translation>
    </message>
    <message>
        <source>Picture as seen</source>
        <translation>所见图像</translation>
    </message>
    <message>
        <source>Save the picture</source>
        <translation>保存图像</translation>
    </message>
    <message>
        <source>Pictures (*.png)</source>
        <translation>图像 (*.png)</translation>
    </message>
    <message>
        <source>Values</source>
        <translation>数值</translation>
    </message>
    <message>
        <source>Save the values</source>
        <translation>保存数值</translation>
    </message>
    <message>
        <source>OpenEXR (*.exr)</source>
        <translation>OpenEXR (*.exr)</translation>
    </message>
    <message>
        <source>Whole screen, save</source>
        <translation>全屏、保存</translation>
    </message>
    <message>
        <source>Whole screen (F11 in the picture)</source>
        <translation>全屏（在图像中按 F11）</translation>
    </message>
</context>
<context>
    <name>WindowProjector</name>
    <message>
        <source>The desktop scales this screen by %1, which blurs every pixel. Set its scale to 100 %.</source>
        <translation>桌面将此屏幕缩放为 %1 倍，每个像素都会模糊。请将缩放设为 100 %。</translation>
    </message>
    <message>
        <source>A venue is being measured</source>
        <translation>正在测量一个场地</translation>
    </message>
</context>
<context>
    <name>acquisition.alarm-skipped</name>
    <message>
        <source>accepted before pattern {}: {}</source>
        <translation>在图案 {} 之前接受：{}</translation>
    </message>
</context>
<context>
    <name>acquisition.ended-by-change</name>
    <message>
        <source>measuring ended with a change: {}; photographs from No. {} on are left out</source>
        <translation>测量因变化而结束：{}；从第 {} 张起的照片不使用</translation>
    </message>
</context>
<context>
    <name>acquisition.light-drifted</name>
    <message>
        <source>The light changed by {} % between the first and the last photograph; this was compensated for, but let the projector warm up before the next time</source>
        <translation>从第一张到最后一张照片，光线变化了 {} %。已作修正，但下次请先让投影机预热</translation>
    </message>
</context>
<context>
    <name>acquisition.overexposed</name>
    <message>
        <source>{} % of the camera pixels are overexposed even at the shortest exposure: close the camera&apos;s aperture a little, then measure again</source>
        <translation>{} % 的相机像素即使用最短曝光也过曝：请稍微收小相机光圈，然后重新测量</translation>
    </message>
</context>
<context>
    <name>acquisition.pixels-flagged</name>
    <message>
        <source>{} % of the camera pixels do not see what was predicted for the test patterns: check that nothing moved or flickered; these pixels are left out of the compensation</source>
        <translation>{} % 的相机像素在测试图案中看到的与预测不符：请检查是否有东西移动或闪烁。这些像素不参与补偿</translation>
    </message>
</context>
<context>
    <name>acquisition.poor-quality</name>
    <message>
        <source>What was measured does not fit together: corrected pictures are expected at {} dB, no better than uncorrected; see that projector, camera and surface stand still and that no other light changes, then measure again</source>
        <translation>测得的结果互不相符：校正后的画面预计只有 {} dB，不比未校正时好；请确认投影机、相机和表面都没有移动，也没有其他光线变化，然后重新测量</translation>
    </message>
</context>
<context>
    <name>acquisition.stopped-early</name>
    <message>
        <source>Measuring was stopped at blocks of {} px: what is finer is missing, and pictures are compensated less sharply; go on measuring any time as long as nothing has moved</source>
        <translation>测量在 {} px 的块处停止：缺少更精细的部分，画面补偿不够清晰；只要没有东西移动，可随时继续测量</translation>
    </message>
</context>
<context>
    <name>acquisition.stopped-with-forecast</name>
    <message numerus="yes">
        <source>Stopped at {} px blocks; {} dB expected, about {} dB with {} more photographs, {}; go on measuring any time as long as nothing has moved</source>
        <comment>Stopped at {} px blocks; {} dB expected, about {} dB with {} more photograph, {}; go on measuring any time as long as nothing has moved</comment>
        <translation>
            <numerusform>在 {} px 块处停止；预期 {} dB，要达到约 {} dB 还需 {} 张照片，{}；只要没有东西移动，随时可以继续测量</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>acquisition.taken-again</name>
    <message numerus="yes">
        <source>{}: {} patterns from No. {} on were photographed again</source>
        <comment>{}: {} pattern from No. {} on was photographed again</comment>
        <translation>
            <numerusform>{0}：从第 {2} 个起重拍了 {1} 个图案</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>alarm.by-resuming</name>
    <message>
        <source>{} by resuming the calibration; {}</source>
        <translation>{}（通过继续校准来重试）；{}</translation>
    </message>
</context>
<context>
    <name>alarm.camera-sees-nothing</name>
    <message>
        <source>the camera sees nothing at all</source>
        <translation>相机什么也看不到</translation>
    </message>
</context>
<context>
    <name>alarm.check-screen</name>
    <message>
        <source>check that the right screen is chosen and nothing covers the picture, then try again</source>
        <translation>请确认所选屏幕正确、图像没有被遮挡，然后重试</translation>
    </message>
</context>
<context>
    <name>alarm.clear-the-view</name>
    <message>
        <source>take away what is in the light or in the view, then try again</source>
        <translation>请移开光路或画面中的遮挡物，然后重试</translation>
    </message>
</context>
<context>
    <name>alarm.lamp-changed</name>
    <message>
        <source>the projector&apos;s light changed by {} % within a few photographs</source>
        <translation>投影机的光在几张照片之内变化了 {} %</translation>
    </message>
</context>
<context>
    <name>alarm.leave-it-as-it-is</name>
    <message>
        <source>leave it as it is now, then try again: measuring begins again</source>
        <translation>保持现在的样子再试：测量会从头开始</translation>
    </message>
</context>
<context>
    <name>alarm.light-flickers</name>
    <message>
        <source>the light flickers or was switched: photographs of one pattern differ by {} %</source>
        <translation>光线闪烁或被开关：同一图案的照片相差 {} %</translation>
    </message>
</context>
<context>
    <name>alarm.light-room-or-measure-again</name>
    <message>
        <source>switch on again what shone when measuring began, then try again; or stop, and measure again in the light as it is now</source>
        <translation>重新打开测量开始时亮着的灯再试；或停止，在现在的光线下重新测量</translation>
    </message>
</context>
<context>
    <name>alarm.moved</name>
    <message>
        <source>a camera or projector has moved: the view of camera {} is shifted by {}, {} pixels and turned by {} degrees</source>
        <translation>相机或投影机移动过：相机 {} 的画面偏移了 {}、{} 像素，旋转了 {} 度</translation>
    </message>
</context>
<context>
    <name>alarm.moved-besides</name>
    <message>
        <source>{}; besides, {}</source>
        <translation>{}；此外，{}</translation>
    </message>
</context>
<context>
    <name>alarm.photograph-dark</name>
    <message>
        <source>one of two photographs of a pattern is dark: the lens was covered, or the projector&apos;s picture gone</source>
        <translation>同一图案的两张照片中有一张是暗的：镜头被遮住，或投影机的画面消失</translation>
    </message>
</context>
<context>
    <name>alarm.photographs-differ</name>
    <message>
        <source>photographs of one pattern differ by {} %: the light flickers, or something moved between them</source>
        <translation>同一图案的照片相差 {} %：光线闪烁，或两次拍摄之间有东西移动</translation>
    </message>
</context>
<context>
    <name>alarm.picture-mirrored</name>
    <message>
        <source>the picture of projector {} appears mirrored</source>
        <translation>投影机 {} 的图像呈镜像</translation>
    </message>
</context>
<context>
    <name>alarm.projector-shows-nothing</name>
    <message>
        <source>the projector shows nothing, though the room&apos;s own light is still seen</source>
        <translation>投影机没有显示，但仍能看到环境光</translation>
    </message>
</context>
<context>
    <name>alarm.put-back-or-measure-again</name>
    <message>
        <source>put it back, then try again; or stop, and measure again without it</source>
        <translation>把它放回去再试；或停止，在没有它的情况下重新测量</translation>
    </message>
</context>
<context>
    <name>alarm.put-it-back</name>
    <message>
        <source>put it back to within half a pixel, then try again</source>
        <translation>请将其复位到相差不超过半个像素，然后重试</translation>
    </message>
</context>
<context>
    <name>alarm.put-it-back-and-restore-light</name>
    <message>
        <source>put it back to within half a pixel and restore the light of the room, then try again</source>
        <translation>请将其复位到相差不超过半个像素，并将房间的灯光恢复原状，然后重试</translation>
    </message>
</context>
<context>
    <name>alarm.restore-room-light</name>
    <message>
        <source>restore the light of the room, keep doors and curtains closed, then try again</source>
        <translation>请将灯光恢复原状，保持门和窗帘关闭，然后重试</translation>
    </message>
</context>
<context>
    <name>alarm.room-brighter</name>
    <message>
        <source>the light of the room became brighter</source>
        <translation>环境光变亮了</translation>
    </message>
</context>
<context>
    <name>alarm.room-darker</name>
    <message>
        <source>the light of the room became darker</source>
        <translation>环境光变暗了</translation>
    </message>
</context>
<context>
    <name>alarm.safe-before-check</name>
    <message>
        <source>every photograph up to the previous check is safe</source>
        <translation>上一次检查之前的照片都是安全的</translation>
    </message>
</context>
<context>
    <name>alarm.safe-before-light-transport</name>
    <message>
        <source>every photograph before the light transport is safe</source>
        <translation>光传输测量之前的照片都是安全的</translation>
    </message>
</context>
<context>
    <name>alarm.something-gone</name>
    <message>
        <source>{} % of the view of camera {} are brighter than before: what stood there is gone</source>
        <translation>画面的 {} %（相机 {}）比之前更亮：原来在那里的东西不见了</translation>
    </message>
</context>
<context>
    <name>alarm.steady-all</name>
    <message>
        <source>see that camera, projector and surface stand still, switch off dimmed and fluorescent lamps and the projector&apos;s power saving, then try again</source>
        <translation>请确认相机、投影机和表面静止不动，关闭调光灯和荧光灯以及投影机的节能功能，然后重试</translation>
    </message>
</context>
<context>
    <name>alarm.switch-off-dimmed-lamps</name>
    <message>
        <source>switch off dimmed and fluorescent lamps and the projector&apos;s power saving, then try again</source>
        <translation>请关闭调光灯和荧光灯以及投影机的节能功能，然后重试</translation>
    </message>
</context>
<context>
    <name>alarm.switch-off-eco-modes</name>
    <message>
        <source>switch off its automatic brightness and eco modes, let it warm up, then try again</source>
        <translation>请关闭投影机的自动亮度和节能模式，待其预热后重试</translation>
    </message>
</context>
<context>
    <name>alarm.switch-off-rear-projection</name>
    <message>
        <source>switch off the projector&apos;s rear or ceiling mode, or allow a mirrored picture, then try again</source>
        <translation>请关闭投影机的背投或吊装模式，或允许镜像图像，然后重试</translation>
    </message>
</context>
<context>
    <name>alarm.uncover-lens</name>
    <message>
        <source>uncover the lens, check that the projector is on, then try again</source>
        <translation>请移开镜头上的遮挡，确认投影机已打开，然后重试</translation>
    </message>
</context>
<context>
    <name>alarm.view-changed</name>
    <message>
        <source>{} % of the view of camera {} look different from before</source>
        <translation>相机 {1} 的画面有 {0} % 与之前不同</translation>
    </message>
</context>
<context>
    <name>alarm.wake-projector</name>
    <message>
        <source>wake the projector, switch off its and the screen&apos;s power saving, then try again</source>
        <translation>请唤醒投影机，关闭投影机和屏幕的节能功能，然后重试</translation>
    </message>
</context>
<context>
    <name>alarm.wrong-picture</name>
    <message>
        <source>projector {} does not show the picture that it is given</source>
        <translation>投影机 {} 没有显示发送给它的图像</translation>
    </message>
</context>
<context>
    <name>calibration.allow-writing-then-resume</name>
    <message>
        <source>check that the folder may be written to, then go on</source>
        <translation>请确认该文件夹可写入，然后继续</translation>
    </message>
</context>
<context>
    <name>calibration.allow-writing-then-retry</name>
    <message>
        <source>check that the folder may be written to, then try again</source>
        <translation>请确认该文件夹可写入，然后重试</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-list-folder</name>
    <message>
        <source>cannot look into the folder ({})</source>
        <translation>无法查看文件夹内容（{}）</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-move-photograph</name>
    <message>
        <source>a photograph cannot be moved ({})</source>
        <translation>无法移动照片（{}）</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-open-folder</name>
    <message>
        <source>cannot open the folder ({})</source>
        <translation>无法打开文件夹（{}）</translation>
    </message>
</context>
<context>
    <name>calibration.cannot-remove-photograph</name>
    <message>
        <source>a photograph cannot be removed ({})</source>
        <translation>无法删除照片（{}）</translation>
    </message>
</context>
<context>
    <name>calibration.check-path-and-permission</name>
    <message>
        <source>check the path and that you may read it</source>
        <translation>请检查路径，并确认您有读取权限</translation>
    </message>
</context>
<context>
    <name>calibration.check-permission-or-name</name>
    <message>
        <source>check that you may read it, or choose another name</source>
        <translation>请确认您有读取权限，或换一个名称</translation>
    </message>
</context>
<context>
    <name>calibration.choose-another-or-copy-again</name>
    <message>
        <source>choose another calibration, or copy it again from where it was measured</source>
        <translation>请选择其他校准数据，或从测量处重新复制</translation>
    </message>
</context>
<context>
    <name>calibration.disk-full</name>
    <message>
        <source>the disk is full</source>
        <translation>磁盘已满</translation>
    </message>
</context>
<context>
    <name>calibration.give-addresses-again</name>
    <message>
        <source>give the projectors&apos; addresses again</source>
        <translation>请重新给出投影机的地址</translation>
    </message>
</context>
<context>
    <name>calibration.make-room-then-resume</name>
    <message>
        <source>every photograph so far is safe: free at least {} MB there, then resume</source>
        <translation>目前为止的照片都是安全的：请在该处至少腾出 {} MB，然后继续</translation>
    </message>
</context>
<context>
    <name>calibration.manifest-damaged</name>
    <message>
        <source>the file that describes the venue is damaged</source>
        <translation>描述场地的文件已损坏</translation>
    </message>
</context>
<context>
    <name>calibration.network-unreadable</name>
    <message>
        <source>the addresses of the projectors on the network cannot be read ({})</source>
        <translation>无法读取网络投影机的地址（{}）</translation>
    </message>
</context>
<context>
    <name>calibration.not-a-calibration</name>
    <message>
        <source>this is not a calibration of Relucent</source>
        <translation>这不是 Relucent 的校准数据</translation>
    </message>
</context>
<context>
    <name>calibration.result-file-missing</name>
    <message>
        <source>a file of the calibration&apos;s {} is missing</source>
        <translation>校准数据“{}”缺少一个文件</translation>
    </message>
</context>
<context>
    <name>calibration.result-file-size-wrong</name>
    <message>
        <source>a file of the calibration&apos;s {} has {} bytes instead of {}</source>
        <translation>校准数据“{}”的一个文件为 {} 字节，应为 {} 字节</translation>
    </message>
</context>
<context>
    <name>cast.check-screen</name>
    <message>
        <source>see whether the screen is on, or the window open</source>
        <translation>检查屏幕是否开启，或窗口是否打开</translation>
    </message>
</context>
<context>
    <name>cast.choice-refused</name>
    <message>
        <source>the desktop no longer gives what was chosen for it</source>
        <translation>桌面不再提供先前所选的内容</translation>
    </message>
</context>
<context>
    <name>cast.choose-again</name>
    <message>
        <source>play it again, and choose there what is shown</source>
        <translation>重新播放，并在其中选择要显示的内容</translation>
    </message>
</context>
<context>
    <name>cast.choose-in-wizard</name>
    <message>
        <source>play it once in the wizard, on Output, and choose there; a show then takes the same</source>
        <translation>在向导的“输出”页播放一次并选择；之后的节目会使用相同的选择</translation>
    </message>
</context>
<context>
    <name>cast.ended</name>
    <message>
        <source>the desktop has ended it</source>
        <translation>桌面已将其结束</translation>
    </message>
</context>
<context>
    <name>cast.install-pipewire</name>
    <message>
        <source>install pipewire and wireplumber, and log in again</source>
        <translation>安装 pipewire 和 wireplumber，然后重新登录</translation>
    </message>
</context>
<context>
    <name>cast.install-portal</name>
    <message>
        <source>install xdg-desktop-portal and its part for this desktop, and log in again</source>
        <translation>安装 xdg-desktop-portal 及其适用于此桌面的部分，然后重新登录</translation>
    </message>
</context>
<context>
    <name>cast.log-in-again</name>
    <message>
        <source>log in again</source>
        <translation>重新登录</translation>
    </message>
</context>
<context>
    <name>cast.no-pipewire</name>
    <message>
        <source>PipeWire, which brings the picture, does not answer</source>
        <translation>传送画面的 PipeWire 没有响应</translation>
    </message>
</context>
<context>
    <name>cast.no-portal</name>
    <message>
        <source>this desktop has no portal that gives the picture of a screen</source>
        <translation>此桌面没有能提供屏幕画面的门户</translation>
    </message>
</context>
<context>
    <name>cast.no-windows</name>
    <message>
        <source>this desktop gives pictures of screens, not of windows</source>
        <translation>此桌面提供屏幕的画面，而不提供窗口的画面</translation>
    </message>
</context>
<context>
    <name>cast.not-chosen</name>
    <message>
        <source>nobody has chosen in the desktop&apos;s dialog what is shown</source>
        <translation>没有人在桌面的对话框中选择要显示的内容</translation>
    </message>
</context>
<context>
    <name>cast.play-screen</name>
    <message>
        <source>play the screen on which the window is</source>
        <translation>播放该窗口所在的屏幕</translation>
    </message>
</context>
<context>
    <name>cast.portal-failed</name>
    <message>
        <source>the desktop&apos;s portal gives no picture ({})</source>
        <translation>桌面的门户没有提供画面（{}）</translation>
    </message>
</context>
<context>
    <name>cast.portal-silent</name>
    <message>
        <source>the desktop&apos;s portal has not answered for {} s</source>
        <translation>桌面的门户已有 {} s 没有响应</translation>
    </message>
</context>
<context>
    <name>cast.refused</name>
    <message>
        <source>it was refused in the desktop&apos;s dialog</source>
        <translation>已在桌面的对话框中被拒绝</translation>
    </message>
</context>
<context>
    <name>cast.unusable</name>
    <message>
        <source>what the desktop sends is no picture that can be shown</source>
        <translation>桌面发送的不是可以显示的画面</translation>
    </message>
</context>
<context>
    <name>cast.update-desktop</name>
    <message>
        <source>update the desktop&apos;s portal and PipeWire</source>
        <translation>更新桌面的门户和 PipeWire</translation>
    </message>
</context>
<context>
    <name>check.colour-wheel</name>
    <message>
        <source>The colours come one after the other, as through a colour wheel ({} % in {} ms): expose whole frames, multiples of {} ms.</source>
        <translation>颜色依次出现，如经过色轮（{1} ms 内 {0} %）：请按整帧曝光（{2} ms 的倍数）。</translation>
    </message>
</context>
<context>
    <name>check.dithering</name>
    <message>
        <source>The projector mixes greys in time, pixel by pixel ({} %): expose several whole frames, and switch its smoothing and 3D modes off.</source>
        <translation>投影机逐像素按时间混合灰阶（{} %）：请按多个整帧曝光，并关闭其平滑和 3D 模式。</translation>
    </message>
</context>
<context>
    <name>check.lamp-flickers</name>
    <message>
        <source>The lamp flickers within a frame, by {} % in {} ms: expose whole frames, multiples of {} ms.</source>
        <translation>灯在一帧内闪烁，{1} ms 内变化 {0} %：请按整帧曝光（{2} ms 的倍数）。</translation>
    </message>
</context>
<context>
    <name>check.light-even</name>
    <message>
        <source>The light is even: no flicker, colour wheel, bands or dithering is seen.</source>
        <translation>光线均匀：未见闪烁、色轮、条纹或抖动。</translation>
    </message>
</context>
<context>
    <name>check.light-unsteady</name>
    <message>
        <source>The light changes by {} % between exposures of whole frames: let the lamp warm up, and switch off dynamic brightness and the lamps in the room.</source>
        <translation>整帧曝光之间光线变化 {} %：请让灯预热，并关闭动态亮度和室内的灯。</translation>
    </message>
</context>
<context>
    <name>check.no-brief-exposure</name>
    <message>
        <source>The camera cannot expose for a part of a frame, or sees too little then: flicker within a frame cannot be detected.</source>
        <translation>相机无法按不足一帧曝光，或此时看到的太少：无法判断帧内闪烁。</translation>
    </message>
</context>
<context>
    <name>check.other-screen-seen</name>
    <message>
        <source>The camera sees {} and not {}.</source>
        <translation>相机看到的是 {}，而不是 {}。</translation>
    </message>
</context>
<context>
    <name>check.picture-takes</name>
    <message>
        <source>A picture takes {} ms to appear: each one is waited for that long.</source>
        <translation>画面出现需要 {} ms：每次都会等待这么久。</translation>
    </message>
</context>
<context>
    <name>check.pictures-late</name>
    <message numerus="yes">
        <source>Pictures arrive {} photographs late: measure the latency, so that it is waited for.</source>
        <comment>Pictures arrive {} photograph late: measure the latency, so that it is waited for.</comment>
        <translation>
            <numerusform>图像晚到 {} 张照片：必须测量延迟并等待。</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>check.rolling-shutter</name>
    <message>
        <source>The camera exposes its rows one after the other (rolling shutter): brief exposures have bands of {} %. Expose whole frames, multiples of {} ms.</source>
        <translation>相机逐行曝光（卷帘快门）：短曝光有 {} % 的条纹。请按整帧曝光（{} ms 的倍数）。</translation>
    </message>
</context>
<context>
    <name>check.screen-mirrored</name>
    <message>
        <source>The picture appears mirrored. If it is not meant to (rear projection, a mirror), switch that off in the projector&apos;s menu.</source>
        <translation>图像呈镜像。如非有意（背投、镜子），请在投影机菜单中关闭镜像。</translation>
    </message>
</context>
<context>
    <name>check.screen-not-seen</name>
    <message>
        <source>The camera does not see {}.</source>
        <translation>相机没有看到 {}。</translation>
    </message>
</context>
<context>
    <name>check.screen-seen</name>
    <message>
        <source>The camera sees {}: {} % of its view follow the test pattern.</source>
        <translation>相机看到了 {}：画面的 {} % 跟随测试图案。</translation>
    </message>
</context>
<context>
    <name>check.white-changes</name>
    <message>
        <source>White changes by {} % from photograph to photograph: expose whole frames of the projector, multiples of {} ms, and switch its dynamic brightness off.</source>
        <translation>各张照片的白场变化 {} %：请按投影机的整帧曝光（{} ms 的倍数），并关闭其动态亮度。</translation>
    </message>
</context>
<context>
    <name>compensation.draw-masks-of-cameras</name>
    <message>
        <source>draw masks in the views of the cameras that measured this calibration</source>
        <translation>请在测量此校准的相机视角中绘制遮罩</translation>
    </message>
</context>
<context>
    <name>compensation.mask-crosses-itself</name>
    <message>
        <source>its outline crosses itself</source>
        <translation>轮廓自相交叉</translation>
    </message>
</context>
<context>
    <name>compensation.mask-encloses-nothing</name>
    <message>
        <source>its outline encloses nothing</source>
        <translation>轮廓没有围住任何部分</translation>
    </message>
</context>
<context>
    <name>compensation.mask-feather-out-of-range</name>
    <message>
        <source>its feather must lie between 0 and half of the view&apos;s larger side</source>
        <translation>羽化须在 0 与视野长边的一半之间</translation>
    </message>
</context>
<context>
    <name>compensation.mask-not-finite</name>
    <message>
        <source>its points must be finite numbers</source>
        <translation>各点必须是有限的数</translation>
    </message>
</context>
<context>
    <name>compensation.mask-of-no-camera</name>
    <message>
        <source>a mask was drawn in the view of camera {}, but there are {} cameras</source>
        <translation>有一个遮罩画在相机 {} 的视角中，但只有 {} 台相机</translation>
    </message>
</context>
<context>
    <name>compensation.mask-outside-view</name>
    <message>
        <source>its points must lie within the view, from 0 to 1 along both sides</source>
        <translation>各点必须在视野之内，两边均为 0 到 1</translation>
    </message>
</context>
<context>
    <name>compensation.mask-point-twice</name>
    <message>
        <source>two points of its outline are the same</source>
        <translation>轮廓上有两个点相同</translation>
    </message>
</context>
<context>
    <name>compensation.mask-too-few-points</name>
    <message>
        <source>its outline needs three points at least</source>
        <translation>轮廓至少需要三个点</translation>
    </message>
</context>
<context>
    <name>compensation.mask-too-many-points</name>
    <message>
        <source>its outline may have {} points at most</source>
        <translation>轮廓最多可有 {} 个点</translation>
    </message>
</context>
<context>
    <name>compensation.masks-cover-everything</name>
    <message>
        <source>the masks cover the whole picture</source>
        <translation>遮罩覆盖了整个画面</translation>
    </message>
</context>
<context>
    <name>compensation.of-mask</name>
    <message>
        <source>mask {}: {}</source>
        <translation>遮罩 {}：{}</translation>
    </message>
</context>
<context>
    <name>compensation.shrink-masks</name>
    <message>
        <source>make a mask smaller, or remove one</source>
        <translation>请缩小或删除一个遮罩</translation>
    </message>
</context>
<context>
    <name>content.choose-picture-folder</name>
    <message>
        <source>choose a folder with PNG, JPEG, TIFF or EXR files</source>
        <translation>请选择含有 PNG、JPEG、TIFF 或 EXR 文件的文件夹</translation>
    </message>
</context>
<context>
    <name>content.choose-supported-picture</name>
    <message>
        <source>choose a PNG, JPEG, TIFF or EXR picture</source>
        <translation>请选择 PNG、JPEG、TIFF 或 EXR 图片</translation>
    </message>
</context>
<context>
    <name>content.connect-capture-device</name>
    <message>
        <source>plug it in, close other programs that use it, and try again</source>
        <translation>请接上设备，关闭使用它的其他程序，然后重试</translation>
    </message>
</context>
<context>
    <name>content.log-in-to-xorg</name>
    <message>
        <source>log in to a desktop, or play files</source>
        <translation>登录桌面，或播放文件</translation>
    </message>
</context>
<context>
    <name>content.no-pictures</name>
    <message>
        <source>no pictures in this folder</source>
        <translation>此文件夹中没有图片</translation>
    </message>
</context>
<context>
    <name>content.no-x-server</name>
    <message>
        <source>the live picture of a screen needs an X server, and none answers</source>
        <translation>屏幕的实时画面需要 X 服务器，但没有响应</translation>
    </message>
</context>
<context>
    <name>content.nothing-captured</name>
    <message>
        <source>the capture device gives no picture</source>
        <translation>采集设备没有给出图像</translation>
    </message>
</context>
<context>
    <name>content.open-first</name>
    <message>
        <source>open it first</source>
        <translation>请先将其打开</translation>
    </message>
</context>
<context>
    <name>content.open-first-or-choose</name>
    <message>
        <source>open it first; there are: {}</source>
        <translation>请先将其打开；现有：{}</translation>
    </message>
</context>
<context>
    <name>content.picture-unreadable</name>
    <message>
        <source>not a picture that can be read</source>
        <translation>不是可读取的图片</translation>
    </message>
</context>
<context>
    <name>content.sequence-empty</name>
    <message>
        <source>the sequence has no pictures</source>
        <translation>图片序列中没有图片</translation>
    </message>
</context>
<context>
    <name>content.unknown-window</name>
    <message>
        <source>there is no window &apos;{}&apos;</source>
        <translation>没有窗口“{}”</translation>
    </message>
</context>
<context>
    <name>device.aim-uncover-and-expose-longer</name>
    <message>
        <source>aim it at the projection, take off its lens cap, and expose longer</source>
        <translation>请将相机对准投影，取下镜头盖，并加长曝光</translation>
    </message>
</context>
<context>
    <name>device.allow-command-more-time</name>
    <message>
        <source>check the device, or allow the command more time: {}</source>
        <translation>请检查设备，或给该命令更多时间：{}</translation>
    </message>
</context>
<context>
    <name>device.another-program-holds-camera</name>
    <message>
        <source>another program holds the camera</source>
        <translation>另一个程序正在占用相机</translation>
    </message>
</context>
<context>
    <name>device.ask-for-fewer-pixels</name>
    <message>
        <source>ask for that or less</source>
        <translation>请指定不大于此的尺寸</translation>
    </message>
</context>
<context>
    <name>device.ask-for-given-size</name>
    <message>
        <source>ask for the size that it gives</source>
        <translation>请指定相机所给出的尺寸</translation>
    </message>
</context>
<context>
    <name>device.ask-for-listed-size</name>
    <message>
        <source>ask for a size that it has: v4l2-ctl --list-formats-ext names them</source>
        <translation>请指定它支持的尺寸：可用 v4l2-ctl --list-formats-ext 列出</translation>
    </message>
</context>
<context>
    <name>device.automatic-exposure-stays</name>
    <message>
        <source>the video device&apos;s automatic exposure cannot be switched off</source>
        <translation>无法关闭视频设备的自动曝光</translation>
    </message>
</context>
<context>
    <name>device.automatic-focus-stays</name>
    <message>
        <source>the video device&apos;s automatic focus cannot be switched off</source>
        <translation>无法关闭视频设备的自动对焦</translation>
    </message>
</context>
<context>
    <name>device.automatic-function-stays</name>
    <message>
        <source>{} cannot be switched off</source>
        <translation>无法关闭 {}</translation>
    </message>
</context>
<context>
    <name>device.automatic-iso</name>
    <message>
        <source>the camera chooses its sensitivity itself (automatic ISO)</source>
        <translation>相机自行选择感光度（自动 ISO）</translation>
    </message>
</context>
<context>
    <name>device.automatic-white-balance-stays</name>
    <message>
        <source>the video device&apos;s automatic white balance cannot be switched off</source>
        <translation>无法关闭视频设备的自动白平衡</translation>
    </message>
</context>
<context>
    <name>device.battery-empty</name>
    <message>
        <source>the camera&apos;s battery seems to be empty ({} % when it was last asked)</source>
        <translation>相机的电池似乎已耗尽（上次查询时为 {} %）</translation>
    </message>
</context>
<context>
    <name>device.battery-low</name>
    <message>
        <source>has {} % left in its battery: a measurement needs a full one or a mains adapter</source>
        <translation>电池剩余 {} %：测量需要充满的电池或电源适配器</translation>
    </message>
</context>
<context>
    <name>device.built-without-genicam</name>
    <message>
        <source>this build of Relucent does not know GenICam cameras</source>
        <translation>此构建的 Relucent 不支持 GenICam 相机</translation>
    </message>
</context>
<context>
    <name>device.built-without-gphoto</name>
    <message>
        <source>this build of Relucent does not know DSLR and mirrorless cameras</source>
        <translation>此构建的 Relucent 不支持单反和无反相机</translation>
    </message>
</context>
<context>
    <name>device.camera-asleep</name>
    <message>
        <source>the camera is there but does not answer, it may be asleep</source>
        <translation>相机已连接但没有响应，可能处于休眠状态</translation>
    </message>
</context>
<context>
    <name>device.camera-command-empty</name>
    <message>
        <source>the camera&apos;s command is empty</source>
        <translation>相机的命令为空</translation>
    </message>
</context>
<context>
    <name>device.camera-command-lacks</name>
    <message>
        <source>the camera&apos;s command does not contain {}</source>
        <translation>相机的命令中缺少 {}</translation>
    </message>
</context>
<context>
    <name>device.camera-given-up</name>
    <message>
        <source>the camera does not answer</source>
        <translation>相机没有响应</translation>
    </message>
</context>
<context>
    <name>device.camera-given-up-advice</name>
    <message>
        <source>push in its cable at both ends and switch it on, then go on: every photograph so far is kept</source>
        <translation>请插紧线缆两端并打开相机电源，然后继续：目前的所有照片均已保留</translation>
    </message>
</context>
<context>
    <name>device.camera-gone</name>
    <message>
        <source>the camera has been unplugged or switched off, or has fallen asleep</source>
        <translation>相机已断开、关机或进入休眠</translation>
    </message>
</context>
<context>
    <name>device.camera-no-longer-answers</name>
    <message>
        <source>the camera no longer answers ({}: {})</source>
        <translation>相机不再响应（{}：{}）</translation>
    </message>
</context>
<context>
    <name>device.camera-not-back</name>
    <message>
        <source>the camera has been gone for {} s: {}</source>
        <translation>相机已失去连接 {} 秒：{}</translation>
    </message>
</context>
<context>
    <name>device.camera-refuses</name>
    <message>
        <source>the camera refuses ({}: {})</source>
        <translation>相机拒绝执行（{}：{}）</translation>
    </message>
</context>
<context>
    <name>device.camera-sends-no-stream</name>
    <message>
        <source>the camera sends no stream</source>
        <translation>相机没有发送数据流</translation>
    </message>
</context>
<context>
    <name>device.camera-size-out-of-range</name>
    <message>
        <source>a camera of {} pixels is impossible: each side is {} to {}</source>
        <translation>不可能有 {} 像素的相机：每边为 {} 至 {}</translation>
    </message>
</context>
<context>
    <name>device.camera-stays-busy</name>
    <message>
        <source>the camera stays busy</source>
        <translation>相机一直处于忙碌状态</translation>
    </message>
</context>
<context>
    <name>device.camera-twice</name>
    <message>
        <source>{} is camera {} and camera {}: choose another camera, or one with a serial number of its own</source>
        <translation>{} 同时是相机 {} 和相机 {}：请选择另一台相机，或有自己序列号的相机</translation>
    </message>
</context>
<context>
    <name>device.cannot-create-temporary-folder</name>
    <message>
        <source>cannot create a temporary folder ({})</source>
        <translation>无法创建临时文件夹（{}）</translation>
    </message>
</context>
<context>
    <name>device.cannot-remove-file</name>
    <message>
        <source>cannot remove the file ({})</source>
        <translation>无法删除文件（{}）</translation>
    </message>
</context>
<context>
    <name>device.cannot-reopen-video-device</name>
    <message>
        <source>the video device cannot be opened again</source>
        <translation>无法重新打开视频设备</translation>
    </message>
</context>
<context>
    <name>device.cannot-start-command</name>
    <message>
        <source>the command cannot be started ({})</source>
        <translation>无法启动命令（{}）</translation>
    </message>
</context>
<context>
    <name>device.cannot-write-recording</name>
    <message>
        <source>the recording cannot be written ({})</source>
        <translation>无法写入记录（{}）</translation>
    </message>
</context>
<context>
    <name>device.card-full</name>
    <message>
        <source>the camera has no room left for a photograph: its memory card is full</source>
        <translation>相机没有空间存放照片：存储卡已满</translation>
    </message>
</context>
<context>
    <name>device.change-or-empty-card</name>
    <message>
        <source>change or empty the memory card</source>
        <translation>请更换或清空存储卡</translation>
    </message>
</context>
<context>
    <name>device.charge-or-change-battery</name>
    <message>
        <source>charge or change the battery, or better, use a mains adapter, and switch the camera on again</source>
        <translation>请充电或更换电池（最好使用电源适配器），然后重新打开相机</translation>
    </message>
</context>
<context>
    <name>device.check-cable-and-power</name>
    <message>
        <source>check its cable and its power</source>
        <translation>请检查线缆和电源</translation>
    </message>
</context>
<context>
    <name>device.check-cable-and-power-saving</name>
    <message>
        <source>check its cable, and switch off its power saving</source>
        <translation>请检查线缆，并关闭其节能功能</translation>
    </message>
</context>
<context>
    <name>device.check-cable-network-and-programs</name>
    <message>
        <source>check the camera&apos;s cable and network card, and that no other program uses it</source>
        <translation>请检查相机的线缆和网卡，并确认没有其他程序在使用相机</translation>
    </message>
</context>
<context>
    <name>device.check-cable-power-address</name>
    <message>
        <source>check its cable, its power and its address; `relucent-cli devices` lists what is there</source>
        <translation>请检查线缆、电源和地址；`relucent-cli devices` 可列出现有设备</translation>
    </message>
</context>
<context>
    <name>device.check-projector-and-aim</name>
    <message>
        <source>check that the projector is on and shows that output, aim the camera at it, and take its cap off; or choose another screen</source>
        <translation>请确认投影机已打开并显示该输出，将相机对准它，取下镜头盖；或选择其他屏幕</translation>
    </message>
</context>
<context>
    <name>device.check-projector-or-aim-another</name>
    <message>
        <source>check that this projector is on and shows that output, and aim a camera at it; or remove it from the venue</source>
        <translation>请检查这台投影机是否已打开并显示该输出，并将一台相机对准它；或将它从场地中移除</translation>
    </message>
</context>
<context>
    <name>device.choose-gain-in-range</name>
    <message>
        <source>choose a gain from {} to {}</source>
        <translation>相机支持的范围为 {} 至 {}</translation>
    </message>
</context>
<context>
    <name>device.choose-offered-iso</name>
    <message>
        <source>choose one of those that it has: {}</source>
        <translation>可选值为 {}</translation>
    </message>
</context>
<context>
    <name>device.choose-or-aim-at-screen</name>
    <message>
        <source>choose {}, or aim the camera at {}</source>
        <translation>请选择 {}，或将相机对准 {}</translation>
    </message>
</context>
<context>
    <name>device.choose-readable-pixel-format</name>
    <message>
        <source>it has {}; unpacked Mono, Bayer and RGB of 8 to 16 bits are read</source>
        <translation>相机的格式为 {}；可读取的是 8 至 16 位的非打包 Mono、Bayer 和 RGB</translation>
    </message>
</context>
<context>
    <name>device.claimed-exposures-invalid</name>
    <message>
        <source>the camera claims exposures of {} to {} s</source>
        <translation>相机报告的曝光范围无效（{} 至 {} 秒）</translation>
    </message>
</context>
<context>
    <name>device.close-menus-and-live-view</name>
    <message>
        <source>close its menus and its playback, and leave live view</source>
        <translation>请关闭相机的菜单和回放，并退出实时取景</translation>
    </message>
</context>
<context>
    <name>device.close-menus-and-restart</name>
    <message>
        <source>close its menus, and switch it off and on</source>
        <translation>请关闭相机的菜单，再关机并重新开机</translation>
    </message>
</context>
<context>
    <name>device.close-other-program</name>
    <message>
        <source>close the other program, a camera viewer or a second Relucent perhaps</source>
        <translation>关闭另一个程序，可能是相机查看器或第二个 Relucent</translation>
    </message>
</context>
<context>
    <name>device.close-other-programs</name>
    <message>
        <source>close other programs and try again</source>
        <translation>请关闭其他程序，然后重试</translation>
    </message>
</context>
<context>
    <name>device.colour-filter-not-bayer</name>
    <message>
        <source>the camera&apos;s colour filter is not a Bayer filter</source>
        <translation>相机的滤色片不是拜耳滤色片</translation>
    </message>
</context>
<context>
    <name>device.command-failed</name>
    <message>
        <source>the command failed with status {}</source>
        <translation>命令失败，退出状态为 {}</translation>
    </message>
</context>
<context>
    <name>device.command-failed-saying</name>
    <message>
        <source>the command failed with status {}, saying &quot;{}&quot;</source>
        <translation>命令失败，退出状态为 {}，输出：“{}”</translation>
    </message>
</context>
<context>
    <name>device.command-killed</name>
    <message>
        <source>the command was killed by signal {}</source>
        <translation>命令被信号 {} 终止</translation>
    </message>
</context>
<context>
    <name>device.command-killed-saying</name>
    <message>
        <source>the command was killed by signal {}, saying &quot;{}&quot;</source>
        <translation>命令被信号 {} 终止，输出：“{}”</translation>
    </message>
</context>
<context>
    <name>device.command-too-long</name>
    <message>
        <source>the command took longer than {} s</source>
        <translation>命令耗时超过 {} 秒</translation>
    </message>
</context>
<context>
    <name>device.command-too-long-saying</name>
    <message>
        <source>the command took longer than {} s, saying &quot;{}&quot;</source>
        <translation>命令耗时超过 {} 秒，输出：“{}”</translation>
    </message>
</context>
<context>
    <name>device.command-without-consent</name>
    <message>
        <source>the calibration runs a program to which nobody at this computer has agreed: {}</source>
        <translation>校准要运行的程序在这台计算机上还没有人同意：{}</translation>
    </message>
</context>
<context>
    <name>device.command-wrote-nothing</name>
    <message>
        <source>the command ended well but wrote nothing, not {}</source>
        <translation>命令正常结束，但没有写入任何内容，应写入 {}</translation>
    </message>
</context>
<context>
    <name>device.command-wrote-something-else</name>
    <message>
        <source>the command ended well but wrote {}, not {}</source>
        <translation>命令正常结束，但写入的是 {}，而不是 {}</translation>
    </message>
</context>
<context>
    <name>device.copy-or-retake-photograph</name>
    <message>
        <source>copy it again, or take the photograph again; a camera newer than this LibRaw needs DNG files</source>
        <translation>请重新复制或重新拍摄；相机若比此 LibRaw 更新，则需使用 DNG 文件</translation>
    </message>
</context>
<context>
    <name>device.delivers-8-bits</name>
    <message>
        <source>delivers 8 bits: dark places stay uncertain</source>
        <translation>输出 8 位：暗处仍不确定</translation>
    </message>
</context>
<context>
    <name>device.develop-linearly</name>
    <message>
        <source>develop the files linearly, as 16-bit TIFF, or use another camera</source>
        <translation>请将文件线性转换为 16 位 TIFF，或换用其他相机</translation>
    </message>
</context>
<context>
    <name>device.exposure-range-invalid</name>
    <message>
        <source>the shortest exposure must be above zero and no longer than the longest</source>
        <translation>最短曝光必须大于零且不长于最长曝光</translation>
    </message>
</context>
<context>
    <name>device.exposure-refused</name>
    <message>
        <source>the camera was asked to expose {} s but exposes {} s</source>
        <translation>要求相机曝光 {} 秒，但它保持 {} 秒</translation>
    </message>
</context>
<context>
    <name>device.exposure-time-cannot-be-set</name>
    <message>
        <source>the camera&apos;s exposure time cannot be set</source>
        <translation>无法设置相机的曝光时间</translation>
    </message>
</context>
<context>
    <name>device.exposure-time-fixed</name>
    <message>
        <source>the camera exposes {} s whatever exposure it is asked for</source>
        <translation>无论指定多长的曝光，相机都保持 {} 秒</translation>
    </message>
</context>
<context>
    <name>device.focuses-by-itself</name>
    <message>
        <source>focuses by itself: switch its lens to manual focus</source>
        <translation>自动对焦：请把镜头切换到手动对焦</translation>
    </message>
</context>
<context>
    <name>device.free-space-or-record-elsewhere</name>
    <message>
        <source>free some space, or record elsewhere</source>
        <translation>请腾出一些空间，或记录到别处</translation>
    </message>
</context>
<context>
    <name>device.free-space-or-set-tmpdir</name>
    <message>
        <source>free some space there, or set TMPDIR to a folder that you may write to</source>
        <translation>请在该处腾出一些空间，或将 TMPDIR 设为您可写入的文件夹</translation>
    </message>
</context>
<context>
    <name>device.gain-out-of-range</name>
    <message>
        <source>a gain of {} is wanted</source>
        <translation>指定的增益为 {}</translation>
    </message>
</context>
<context>
    <name>device.gain-refused</name>
    <message>
        <source>was asked for a gain of {} but uses {}</source>
        <translation>要求增益 {}，却保持 {}</translation>
    </message>
</context>
<context>
    <name>device.genicam-missing</name>
    <message>
        <source>GigE Vision and USB3 Vision cameras: this build lacks Aravis; install libaravis-dev and build again</source>
        <translation>GigE Vision 和 USB3 Vision 相机：此版本缺少 Aravis；请安装 libaravis-dev 后重新构建</translation>
    </message>
</context>
<context>
    <name>device.gphoto-missing</name>
    <message>
        <source>DSLR and mirrorless cameras: this build lacks libgphoto2 or LibRaw; install libgphoto2-dev and libraw-dev and build again</source>
        <translation>单反和无反相机：此版本缺少 libgphoto2 或 LibRaw；请安装 libgphoto2-dev 和 libraw-dev 后重新构建</translation>
    </message>
</context>
<context>
    <name>device.held-by-desktop</name>
    <message>
        <source>another program is using the camera, usually the desktop, which mounts it like a memory stick</source>
        <translation>另一个程序正在占用相机，通常是桌面将其当作 U 盘挂载了</translation>
    </message>
</context>
<context>
    <name>device.install-aravis</name>
    <message>
        <source>install Aravis (libaravis-dev) and build again, or use another kind of camera</source>
        <translation>请安装 Aravis（libaravis-dev）并重新编译，或使用其他类型的相机</translation>
    </message>
</context>
<context>
    <name>device.install-libgphoto2</name>
    <message>
        <source>install libgphoto2 and LibRaw (libgphoto2-dev, libraw-dev) and build again, or use a command</source>
        <translation>请安装 libgphoto2 和 LibRaw（libgphoto2-dev、libraw-dev）并重新编译，或使用命令</translation>
    </message>
</context>
<context>
    <name>device.iso-refused</name>
    <message>
        <source>was asked for ISO {} but uses ISO {}</source>
        <translation>要求 ISO {}，却保持 ISO {}</translation>
    </message>
</context>
<context>
    <name>device.iso-wanted-not-there</name>
    <message>
        <source>ISO {} is wanted and the camera does not have it</source>
        <translation>指定了 ISO {}，但相机没有该值</translation>
    </message>
</context>
<context>
    <name>device.lift-exposure-limits</name>
    <message>
        <source>switch its automatic exposure and its frame rate limit off</source>
        <translation>请关闭相机的自动曝光和帧率限制</translation>
    </message>
</context>
<context>
    <name>device.longest-exposure-overstated</name>
    <message>
        <source>claims exposures up to {} s but reaches only {} s</source>
        <translation>声称曝光可长至 {} s，实际只到 {} s</translation>
    </message>
</context>
<context>
    <name>device.may-fire-flash</name>
    <message>
        <source>may fire its flash: close it</source>
        <translation>可能触发闪光灯：请将其收起</translation>
    </message>
</context>
<context>
    <name>device.may-take-dark-frame</name>
    <message>
        <source>may take a dark frame after long exposures, which doubles their time</source>
        <translation>长曝光后可能再拍一张暗场，时间会加倍</translation>
    </message>
</context>
<context>
    <name>device.may-take-several-photographs</name>
    <message>
        <source>may take several photographs at once: switch it to single shots</source>
        <translation>可能一次拍多张：请切换到单张拍摄</translation>
    </message>
</context>
<context>
    <name>device.mode-dial-not-manual</name>
    <message>
        <source>the camera&apos;s mode dial is set to {}, where the camera chooses exposures itself</source>
        <translation>相机的模式转盘处于 {}，此时曝光由相机自行选择</translation>
    </message>
</context>
<context>
    <name>device.name-camera-by-port</name>
    <message>
        <source>name one by its port: gphoto2:{} or gphoto2:{}</source>
        <translation>请用端口指定其中一台：gphoto2:{} 或 gphoto2:{}</translation>
    </message>
</context>
<context>
    <name>device.name-connected-camera</name>
    <message>
        <source>name that one: gphoto2:{}</source>
        <translation>请指定该相机：gphoto2:{}</translation>
    </message>
</context>
<context>
    <name>device.no-capture-times</name>
    <message>
        <source>does not say when pictures were captured: some are dropped before each photograph</source>
        <translation>不说明图像何时拍摄：每次拍照前会丢弃几张</translation>
    </message>
</context>
<context>
    <name>device.no-contrast</name>
    <message>
        <source>the camera sees no difference between white and black</source>
        <translation>相机看不出白与黑的差别</translation>
    </message>
</context>
<context>
    <name>device.no-focus</name>
    <message>
        <source>the camera could not focus and took no photograph ({})</source>
        <translation>相机未能对焦，没有拍摄照片（{}）</translation>
    </message>
</context>
<context>
    <name>device.no-genicam-camera-answers</name>
    <message>
        <source>no GenICam camera &apos;{}&apos; answers</source>
        <translation>GenICam 相机“{}”没有响应</translation>
    </message>
</context>
<context>
    <name>device.no-photograph-came</name>
    <message>
        <source>a photograph was asked for and none came</source>
        <translation>已要求拍摄，但没有收到照片</translation>
    </message>
</context>
<context>
    <name>device.no-raw-file-sent</name>
    <message>
        <source>the camera sent {} and no raw file</source>
        <translation>相机发送的是 {}，没有 RAW 文件</translation>
    </message>
</context>
<context>
    <name>device.no-raw-files</name>
    <message>
        <source>the camera does not deliver raw files</source>
        <translation>相机不输出 RAW 文件</translation>
    </message>
</context>
<context>
    <name>device.no-readable-pixel-format</name>
    <message>
        <source>none of the camera&apos;s pixel formats can be read</source>
        <translation>相机的像素格式均无法读取</translation>
    </message>
</context>
<context>
    <name>device.no-software-trigger</name>
    <message>
        <source>has no software trigger: each photograph may wait for one more exposure</source>
        <translation>没有软件触发：每张照片可能多等一次曝光</translation>
    </message>
</context>
<context>
    <name>device.no-video-pictures</name>
    <message>
        <source>the video device sends no pictures</source>
        <translation>视频设备没有发送图像</translation>
    </message>
</context>
<context>
    <name>device.only-other-camera-connected</name>
    <message>
        <source>no camera of this name is plugged in, but {} is</source>
        <translation>没有接上此名称的相机，接上的是 {}</translation>
    </message>
</context>
<context>
    <name>device.other-screen-seen</name>
    <message>
        <source>the camera sees {}, not {}</source>
        <translation>相机看到的是 {}，而不是 {}</translation>
    </message>
</context>
<context>
    <name>device.part-of-sensor-lost</name>
    <message>
        <source>the camera does not go back to the part of the sensor that it had</source>
        <translation>相机没有回到原来的传感器区域</translation>
    </message>
</context>
<context>
    <name>device.parts-lost-on-the-way</name>
    <message>
        <source>parts of the photograph were lost on the way</source>
        <translation>照片的一部分在传输中丢失</translation>
    </message>
</context>
<context>
    <name>device.photograph-attempts-failed</name>
    <message>
        <source>{} attempts at a photograph failed: {}</source>
        <translation>尝试拍摄 {} 次均失败：{}</translation>
    </message>
</context>
<context>
    <name>device.photograph-exceeds-sensor</name>
    <message>
        <source>{} pixels are wanted and the camera has {}</source>
        <translation>指定了 {} 像素，但相机有 {}</translation>
    </message>
</context>
<context>
    <name>device.photograph-format-changed</name>
    <message>
        <source>the photograph has {} pixels as {} where {} as {} were agreed</source>
        <translation>照片为 {} 像素（{}），与约定的 {}（{}）不符</translation>
    </message>
</context>
<context>
    <name>device.photograph-larger-than-announced</name>
    <message>
        <source>the photograph is larger than the camera announced</source>
        <translation>照片比相机事先告知的更大</translation>
    </message>
</context>
<context>
    <name>device.photograph-not-finished</name>
    <message>
        <source>the photograph was not finished</source>
        <translation>照片没有完成</translation>
    </message>
</context>
<context>
    <name>device.photograph-size-refused</name>
    <message>
        <source>{} pixels are wanted and the camera gives {}</source>
        <translation>指定了 {} 像素，但相机给出的是 {}</translation>
    </message>
</context>
<context>
    <name>device.photograph-size-unexpected</name>
    <message>
        <source>the photograph has {} pixels where {} were announced</source>
        <translation>照片为 {} 像素，与事先告知的 {} 不符</translation>
    </message>
</context>
<context>
    <name>device.photograph-timed-out</name>
    <message>
        <source>no photograph came within {} s</source>
        <translation>{} 秒内没有收到照片</translation>
    </message>
</context>
<context>
    <name>device.photograph-truncated</name>
    <message>
        <source>a photograph of {} pixels as {} came with {} of {} bytes</source>
        <translation>一张 {} 像素（{}）的照片只收到 {} 字节，应为 {} 字节</translation>
    </message>
</context>
<context>
    <name>device.picture-not-settled</name>
    <message>
        <source>a new picture has not fully appeared after {} frames</source>
        <translation>新图像在 {} 帧后仍未完全显示</translation>
    </message>
</context>
<context>
    <name>device.pixel-format-lost</name>
    <message>
        <source>the camera has forgotten the pixel format that it was set to</source>
        <translation>相机丢失了已设定的像素格式</translation>
    </message>
</context>
<context>
    <name>device.pixel-format-not-offered</name>
    <message>
        <source>the camera has no pixel format {} that can be read</source>
        <translation>相机没有可读取的像素格式 {}</translation>
    </message>
</context>
<context>
    <name>device.projector-command-empty</name>
    <message>
        <source>the projector&apos;s command is empty</source>
        <translation>投影机的命令为空</translation>
    </message>
</context>
<context>
    <name>device.projector-command-lacks</name>
    <message>
        <source>the projector&apos;s command does not contain {}</source>
        <translation>投影机的命令中缺少 {}</translation>
    </message>
</context>
<context>
    <name>device.projector-size-out-of-range</name>
    <message>
        <source>a projector of {} pixels is impossible: each side is {} to {}</source>
        <translation>不可能有 {} 像素的投影机：每边为 {} 至 {}</translation>
    </message>
</context>
<context>
    <name>device.projector-unseen</name>
    <message>
        <source>no camera sees what is shown on {}</source>
        <translation>没有相机看到 {} 上显示的内容</translation>
    </message>
</context>
<context>
    <name>device.push-cable-in</name>
    <message>
        <source>push in the camera&apos;s cable at both ends</source>
        <translation>请插紧相机线缆的两端</translation>
    </message>
</context>
<context>
    <name>device.raw-file-empty</name>
    <message>
        <source>it is empty</source>
        <translation>文件是空的</translation>
    </message>
</context>
<context>
    <name>device.raw-file-incomplete</name>
    <message>
        <source>parts of it are missing</source>
        <translation>文件有部分缺失</translation>
    </message>
</context>
<context>
    <name>device.raw-file-unreadable</name>
    <message>
        <source>the raw file cannot be read ({})</source>
        <translation>无法读取 RAW 文件（{}）</translation>
    </message>
</context>
<context>
    <name>device.raw-file-without-sensor-values</name>
    <message>
        <source>the raw file does not hold the sensor&apos;s own values</source>
        <translation>RAW 文件中没有传感器的原始数值</translation>
    </message>
</context>
<context>
    <name>device.reconnect-same-camera</name>
    <message>
        <source>connect the camera that the measurement was begun with</source>
        <translation>请连接开始测量时所用的相机</translation>
    </message>
</context>
<context>
    <name>device.reconnected-camera-size-differs</name>
    <message>
        <source>the camera came back with {} pixels instead of {}</source>
        <translation>重新连接的相机为 {} 像素，应为 {}</translation>
    </message>
</context>
<context>
    <name>device.release-from-desktop</name>
    <message>
        <source>make the desktop release it with `gio mount -s gphoto2` (or eject it in the file manager) and close photo programs</source>
        <translation>请用 `gio mount -s gphoto2` 让桌面释放相机（或在文件管理器中弹出），并关闭照片程序</translation>
    </message>
</context>
<context>
    <name>device.remove-file-by-hand</name>
    <message>
        <source>remove it by hand, then try again</source>
        <translation>请手动删除，然后重试</translation>
    </message>
</context>
<context>
    <name>device.request-refused</name>
    <message>
        <source>the camera refused what it was asked for ({})</source>
        <translation>相机拒绝了请求（{}）</translation>
    </message>
</context>
<context>
    <name>device.restart-or-change-pixel-format</name>
    <message>
        <source>switch the camera off and on, or choose another of its pixel formats</source>
        <translation>请将相机关机并重新开机，或选择它的其他像素格式</translation>
    </message>
</context>
<context>
    <name>device.restart-with-default-settings</name>
    <message>
        <source>switch it off and on, load its default settings with its maker&apos;s program, and try again</source>
        <translation>请将其关机并重新开机，用厂商的程序载入默认设置，然后重试</translation>
    </message>
</context>
<context>
    <name>device.run-command-in-terminal</name>
    <message>
        <source>run it in a terminal to find out why: {}</source>
        <translation>请在终端中运行以查明原因：{}</translation>
    </message>
</context>
<context>
    <name>device.screen-loses-picture</name>
    <message>
        <source>the projector&apos;s screen keeps losing its picture</source>
        <translation>投影机的屏幕一再丢失图像</translation>
    </message>
</context>
<context>
    <name>device.screen-not-seen</name>
    <message>
        <source>the camera does not see what is shown on {}</source>
        <translation>相机看不到 {} 上显示的内容</translation>
    </message>
</context>
<context>
    <name>device.screen-twice</name>
    <message>
        <source>screen {} is projector {} and projector {}: choose another screen</source>
        <translation>屏幕 {} 同时是投影机 {} 和投影机 {}：请选择另一个屏幕</translation>
    </message>
</context>
<context>
    <name>device.sees-no-colours</name>
    <message>
        <source>sees no colours: brightness can be compensated, colours cannot</source>
        <translation>看不到颜色：可以补偿亮度，不能补偿颜色</translation>
    </message>
</context>
<context>
    <name>device.set-iso-100</name>
    <message>
        <source>set it to ISO 100 by hand</source>
        <translation>请手动将相机设为 ISO 100</translation>
    </message>
</context>
<context>
    <name>device.set-manual-exposure-mode</name>
    <message>
        <source>set its exposure mode to timed and manual, or update its firmware</source>
        <translation>请将其曝光模式设为 Timed（手动），或更新其固件</translation>
    </message>
</context>
<context>
    <name>device.several-cameras-of-model</name>
    <message>
        <source>{} cameras of this model are plugged in</source>
        <translation>接上了 {} 台此型号的相机</translation>
    </message>
</context>
<context>
    <name>device.shortest-exposure-understated</name>
    <message>
        <source>claims exposures from {} s but does not go below {} s</source>
        <translation>声称曝光可短至 {} s，实际只到 {} s</translation>
    </message>
</context>
<context>
    <name>device.simulated-camera-unplugged</name>
    <message>
        <source>the camera&apos;s cable is out</source>
        <translation>相机的线缆已脱落</translation>
    </message>
</context>
<context>
    <name>device.steady-view-and-expose-briefly</name>
    <message>
        <source>check that the camera&apos;s view is steady and its exposure short, and switch the projector&apos;s smoothing of motion off</source>
        <translation>请确认相机画面稳定、曝光够短，并关闭投影机的运动平滑</translation>
    </message>
</context>
<context>
    <name>device.switch-off-automatic-exposure</name>
    <message>
        <source>switch its automatic exposure off; a camera without manual exposure cannot be used</source>
        <translation>请关闭相机的自动曝光；没有手动曝光的相机无法使用</translation>
    </message>
</context>
<context>
    <name>device.switch-off-with-makers-program</name>
    <message>
        <source>switch it off with the camera maker&apos;s program, or use another camera</source>
        <translation>请用相机厂商的程序将其关闭，或换用其他相机</translation>
    </message>
</context>
<context>
    <name>device.switch-off-with-v4l2-ctl</name>
    <message>
        <source>switch it off with v4l2-ctl (--list-ctrls names what it has), or use another camera</source>
        <translation>请用 v4l2-ctl 将其关闭（--list-ctrls 可列出其控制项），或换用其他相机</translation>
    </message>
</context>
<context>
    <name>device.switch-on-and-keep-awake</name>
    <message>
        <source>check its cable, switch it on and disable its automatic power-off</source>
        <translation>请检查线缆，打开相机，并关闭其自动关机功能</translation>
    </message>
</context>
<context>
    <name>device.switch-quality-to-raw</name>
    <message>
        <source>switch its picture quality to RAW by hand; a camera without RAW cannot be used</source>
        <translation>请手动将相机的画质切换为 RAW；没有 RAW 的相机无法使用</translation>
    </message>
</context>
<context>
    <name>device.switch-to-full-size-raw</name>
    <message>
        <source>switch the camera to full-size RAW (no sRAW, mRAW, no linear DNG)</source>
        <translation>请将相机切换为全尺寸 RAW（不要用 sRAW、mRAW 或线性 DNG）</translation>
    </message>
</context>
<context>
    <name>device.switch-to-manual-focus</name>
    <message>
        <source>switch its lens to manual focus</source>
        <translation>请将镜头切换到手动对焦</translation>
    </message>
</context>
<context>
    <name>device.switches-itself-off</name>
    <message>
        <source>switches itself off after a while: switch that off</source>
        <translation>一段时间后会自动关机：请关闭该功能</translation>
    </message>
</context>
<context>
    <name>device.take-photograph-by-hand</name>
    <message>
        <source>switch its lens to manual focus, close its menus, and take a photograph by hand to see what it complains of</source>
        <translation>请将镜头切换到手动对焦，关闭相机的菜单，并手动拍一张照片，查看相机提示什么问题</translation>
    </message>
</context>
<context>
    <name>device.then-go-on</name>
    <message>
        <source>{}, then go on: every photograph so far is kept</source>
        <translation>{}，然后继续：目前为止的照片都已保留</translation>
    </message>
</context>
<context>
    <name>device.trial-photograph-failed</name>
    <message>
        <source>the camera was asked for a photograph and took none</source>
        <translation>已要求相机拍摄，但它没有拍摄</translation>
    </message>
</context>
<context>
    <name>device.turn-dial-or-change-camera</name>
    <message>
        <source>turn its mode dial to M; a camera without manual exposure cannot be used</source>
        <translation>请将相机的模式转盘转到 M；没有 M 的相机无法使用</translation>
    </message>
</context>
<context>
    <name>device.turn-dial-to-m</name>
    <message>
        <source>turn it to M</source>
        <translation>请将转盘转到 M</translation>
    </message>
</context>
<context>
    <name>device.use-manual-exposure-camera</name>
    <message>
        <source>use a camera with manual exposure</source>
        <translation>请使用有手动曝光的相机</translation>
    </message>
</context>
<context>
    <name>device.video-device</name>
    <message>
        <source>video device</source>
        <translation>视频设备</translation>
    </message>
</context>
<context>
    <name>device.video-device-in-use</name>
    <message>
        <source>the video device cannot be opened: another program may be using it</source>
        <translation>无法打开视频设备：可能有其他程序正在使用它</translation>
    </message>
</context>
<context>
    <name>device.video-device-missing</name>
    <message>
        <source>no such video device is plugged in</source>
        <translation>没有接上这样的视频设备</translation>
    </message>
</context>
<context>
    <name>device.video-device-unplugged</name>
    <message>
        <source>the video device has been unplugged</source>
        <translation>视频设备已断开</translation>
    </message>
</context>
<context>
    <name>device.video-exposure-not-settable</name>
    <message>
        <source>the video device has no exposure that can be set</source>
        <translation>视频设备没有可设置的曝光</translation>
    </message>
</context>
<context>
    <name>device.video-size-refused</name>
    <message>
        <source>{} pixels are wanted and the video device gives {}</source>
        <translation>指定了 {} 像素，但视频设备给出的是 {}</translation>
    </message>
</context>
<context>
    <name>device.wake-camera</name>
    <message>
        <source>press its shutter button half way or switch it off and on, and disable its automatic power-off</source>
        <translation>请半按快门按钮，或关机并重新开机，并关闭其自动关机功能</translation>
    </message>
</context>
<context>
    <name>device.write-announced-size</name>
    <message>
        <source>let the command write that size, or begin again with the size that the camera delivers</source>
        <translation>请让命令写入该尺寸，或按相机给出的尺寸重新开始</translation>
    </message>
</context>
<context>
    <name>device.write-photograph-to-output</name>
    <message>
        <source>let it write the photograph to {output}: {}</source>
        <translation>请让命令将照片写入 {output}：{}</translation>
    </message>
</context>
<context>
    <name>disk.cannot-create-folder</name>
    <message>
        <source>cannot create the folder ({})</source>
        <translation>无法创建文件夹（{}）</translation>
    </message>
</context>
<context>
    <name>disk.cannot-open</name>
    <message>
        <source>cannot open ({})</source>
        <translation>无法打开（{}）</translation>
    </message>
</context>
<context>
    <name>disk.cannot-read</name>
    <message>
        <source>cannot read ({})</source>
        <translation>无法读取（{}）</translation>
    </message>
</context>
<context>
    <name>disk.cannot-write</name>
    <message>
        <source>cannot write ({})</source>
        <translation>无法写入（{}）</translation>
    </message>
</context>
<context>
    <name>disk.check-disk-and-cable</name>
    <message>
        <source>check the disk and its cable</source>
        <translation>请检查磁盘及其线缆</translation>
    </message>
</context>
<context>
    <name>disk.check-path</name>
    <message>
        <source>check the path</source>
        <translation>请检查路径</translation>
    </message>
</context>
<context>
    <name>disk.check-path-and-disk</name>
    <message>
        <source>check the path and the disk</source>
        <translation>请检查路径和磁盘</translation>
    </message>
</context>
<context>
    <name>disk.choose-scratch-folder</name>
    <message>
        <source>let the environment variable TMPDIR name a folder on a disk that you may write to; what has been photographed is safe</source>
        <translation>请让环境变量 TMPDIR 指向一个可写入磁盘上的文件夹；已拍摄的照片是安全的</translation>
    </message>
</context>
<context>
    <name>disk.choose-writable-folder</name>
    <message>
        <source>choose a folder that you may write to, or ask for the permission</source>
        <translation>请选择您可写入的文件夹，或申请权限</translation>
    </message>
</context>
<context>
    <name>disk.free-scratch-room</name>
    <message>
        <source>free some space there; what has been photographed is safe</source>
        <translation>请在该处腾出空间；已拍摄的照片是安全的</translation>
    </message>
</context>
<context>
    <name>disk.free-space-or-check-disk</name>
    <message>
        <source>free some space there or check the disk, then try again</source>
        <translation>请在该处腾出一些空间或检查磁盘，然后重试</translation>
    </message>
</context>
<context>
    <name>disk.free-space-or-choose-another</name>
    <message>
        <source>free some space there or choose another disk, then try again</source>
        <translation>请在该处腾出一些空间或选择其他磁盘，然后重试</translation>
    </message>
</context>
<context>
    <name>disk.no-scratch-room</name>
    <message>
        <source>there is no room for intermediate results ({})</source>
        <translation>没有空间存放中间结果（{}）</translation>
    </message>
</context>
<context>
    <name>duration.hours-minutes</name>
    <message>
        <source>{} h {} min</source>
        <translation>{} 小时 {} 分钟</translation>
    </message>
</context>
<context>
    <name>duration.minutes</name>
    <message>
        <source>{} min</source>
        <translation>{} 分钟</translation>
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
        <translation>不到一分钟</translation>
    </message>
</context>
<context>
    <name>engine.compute-on-processor</name>
    <message>
        <source>compute on the processor instead</source>
        <translation>请改用 CPU 处理</translation>
    </message>
</context>
<context>
    <name>engine.graphics-buffer-too-large</name>
    <message>
        <source>the graphics card can hold {} MB in one piece, but {} MB are needed</source>
        <translation>显卡一次只能访问 {} MB，而需要 {} MB</translation>
    </message>
</context>
<context>
    <name>engine.graphics-card-lost</name>
    <message>
        <source>the graphics card was lost</source>
        <translation>显卡已失去响应</translation>
    </message>
</context>
<context>
    <name>engine.graphics-card-unusable</name>
    <message>
        <source>the graphics card cannot be used</source>
        <translation>无法使用显卡</translation>
    </message>
</context>
<context>
    <name>engine.graphics-memory-exhausted</name>
    <message>
        <source>the graphics card has no {} MB of memory left</source>
        <translation>显卡没有 {} MB 的剩余显存</translation>
    </message>
</context>
<context>
    <name>engine.install-driver</name>
    <message>
        <source>install the graphics card&apos;s driver, or compute on the processor</source>
        <translation>请安装显卡驱动程序，或改用 CPU 处理</translation>
    </message>
</context>
<context>
    <name>engine.no-graphics-card</name>
    <message>
        <source>there is no graphics card with OpenGL 4.3 and compute shaders</source>
        <translation>没有支持 OpenGL 4.3 和计算着色器的显卡</translation>
    </message>
</context>
<context>
    <name>engine.no-libegl-or-libopengl</name>
    <message>
        <source>there is no libEGL or no libOpenGL, which open graphics cards without a display</source>
        <translation>缺少 libEGL 或 libOpenGL，没有显示器时需要用它们打开显卡</translation>
    </message>
</context>
<context>
    <name>engine.no-opengl</name>
    <message>
        <source>there is no OpenGL 4.3 with compute shaders</source>
        <translation>没有支持计算着色器的 OpenGL 4.3</translation>
    </message>
</context>
<context>
    <name>import.camera-taken-as-linear</name>
    <message>
        <source>The camera is taken to be linear, and one photograph counts as one second of exposure</source>
        <translation>相机按线性处理，一张照片按一秒曝光计</translation>
    </message>
</context>
<context>
    <name>import.lit-share</name>
    <message>
        <source>The projector lights {} % of the camera&apos;s pixels</source>
        <translation>投影机照亮了 {} % 的相机像素</translation>
    </message>
</context>
<context>
    <name>import.paired-by-time</name>
    <message>
        <source>The photographs were paired with the patterns in the order in which they were taken, from {} to {}, which is not that of their names</source>
        <translation>照片按拍摄顺序（{} 至 {}）与图案配对，该顺序与文件名顺序不同</translation>
    </message>
</context>
<context>
    <name>import.patterns-and-photographs-grey</name>
    <message>
        <source>Patterns and photographs are grey: colours are not told apart, and T&apos;s blocks are neutral</source>
        <translation>图案和照片均为灰度：不区分颜色，T 的各块为中性</translation>
    </message>
</context>
<context>
    <name>import.patterns-black-and-white</name>
    <message>
        <source>The patterns hold black and white only: the projector&apos;s response is assumed to be a gamma of 2.2</source>
        <translation>图案只含黑白：投影机响应按 2.2 次幂处理</translation>
    </message>
</context>
<context>
    <name>import.patterns-grey</name>
    <message>
        <source>The patterns are grey: how colours mix was not measured, and T&apos;s blocks are diagonal</source>
        <translation>图案为灰度：未测量颜色如何混合，T 的各块为对角块</translation>
    </message>
</context>
<context>
    <name>import.photographs-are-jpeg</name>
    <message>
        <source>The photographs are JPEG: they were made linear by the curve of sRGB, which cameras follow only roughly; develop them linearly, as TIFF or EXR, to measure more exactly</source>
        <translation>照片为 JPEG：已按 sRGB 曲线线性化，而相机只是大致遵循该曲线。请以线性方式冲洗为 TIFF 或 EXR，以便更精确地测量</translation>
    </message>
</context>
<context>
    <name>import.photographs-grey</name>
    <message>
        <source>The photographs are grey: what each of the projector&apos;s colours contributes is known in brightness only</source>
        <translation>照片为灰度：投影机各颜色的贡献只知其亮度</translation>
    </message>
</context>
<context>
    <name>linearization.choose-overlapping-exposures</name>
    <message>
        <source>set them to ranges of exposure times that overlap</source>
        <translation>请将各相机的曝光时间设为相互重叠的范围</translation>
    </message>
</context>
<context>
    <name>linearization.halves-brighter-than-whole</name>
    <message>
        <source>{}: two halves of a picture are {} % brighter than the whole; switch off the dynamic iris, dynamic contrast and any picture mode that adapts to the content</source>
        <translation>{}：一幅图像的两半之和比整幅亮 {} %。请关闭动态光圈、动态对比度以及任何随内容变化的图像模式</translation>
    </message>
</context>
<context>
    <name>linearization.halves-darker-than-whole</name>
    <message>
        <source>{}: two halves of a picture are {} % darker than the whole; switch off the dynamic iris, dynamic contrast and any picture mode that adapts to the content</source>
        <translation>{}：一幅图像的两半之和比整幅暗 {} %。请关闭动态光圈、动态对比度以及任何随内容变化的图像模式</translation>
    </message>
</context>
<context>
    <name>linearization.highlights-overexposed</name>
    <message>
        <source>{}: some highlights are overexposed even at {} s, the shortest exposure, and will not be compensated; close the aperture or add a grey filter if they matter</source>
        <translation>{}：即使用最短曝光 {} s，部分高光仍然过曝，将不予补偿。如果它们重要，请收小光圈或加装灰镜</translation>
    </message>
</context>
<context>
    <name>linearization.light-flickers</name>
    <message>
        <source>{}: the light changes by {} % from one photograph to the next; switch off the projector&apos;s dynamic lamp modes and other lamps nearby, and choose exposure times that are multiples of the mains period</source>
        <translation>{}：光线在相邻照片之间变化 {} %。请关闭投影机的动态灯光模式和附近的其他灯，并选择为市电周期整数倍的曝光时间</translation>
    </message>
</context>
<context>
    <name>linearization.no-common-exposure</name>
    <message>
        <source>the cameras have no exposure time in common</source>
        <translation>各相机没有共同的曝光时间</translation>
    </message>
</context>
<context>
    <name>linearization.overexposed</name>
    <message>
        <source>{}: the projection is overexposed even at {} s, the shortest exposure; close the aperture, lower the gain or add a grey filter</source>
        <translation>{}：即使用最短曝光 {} s，投影仍然过曝。请收小光圈、降低增益或加装灰镜</translation>
    </message>
</context>
<context>
    <name>linearization.response-uneven</name>
    <message>
        <source>{}: the brightness curves are not the same everywhere in its picture, by up to {} % of white; switch off uniformity correction, local dimming and edge blending in the projector</source>
        <translation>{}：亮度曲线在画面各处不一致，相差最多为白色的 {} %。请在投影机中关闭均匀性校正、局部调光和边缘融合</translation>
    </message>
</context>
<context>
    <name>linearization.underexposed</name>
    <message>
        <source>{}: the projection reaches only {} % of the camera&apos;s range at {} s, the longest exposure; open the aperture or raise the gain</source>
        <translation>{0}：用最长曝光 {2} s，投影也只达到相机量程的 {1} %。请开大光圈或提高增益</translation>
    </message>
</context>
<context>
    <name>linearization.white-brighter-than-colours</name>
    <message>
        <source>{}: white is {} % brighter than red, green and blue together; switch off the white segment (often called brilliant colour or bright mode) and choose a picture mode for video or sRGB</source>
        <translation>{}：白色比红、绿、蓝之和亮 {} %。请关闭白色段（常称为“极致色彩”或“明亮模式”），并选择视频或 sRGB 图像模式</translation>
    </message>
</context>
<context>
    <name>linearization.white-darker-than-colours</name>
    <message>
        <source>{}: white is {} % darker than red, green and blue together; switch off power saving, colour management and dynamic picture modes</source>
        <translation>{}：白色比红、绿、蓝之和暗 {} %。请关闭节能、色彩管理和动态图像模式</translation>
    </message>
</context>
<context>
    <name>masks.draw-again</name>
    <message>
        <source>draw it again, or correct the file</source>
        <translation>请重新绘制，或改正文件</translation>
    </message>
</context>
<context>
    <name>masks.unknown-key</name>
    <message>
        <source>mask {} has &quot;{}&quot;, which this version does not know</source>
        <translation>遮罩 {} 含有“{}”，此版本不认识</translation>
    </message>
</context>
<context>
    <name>masks.unreadable</name>
    <message>
        <source>mask {} cannot be read: it needs points as [[x, y], ...], and may have camera, outline and feather</source>
        <translation>无法读取遮罩 {}：它需要形如 [[x, y], ...] 的 points，还可以有 camera、outline 和 feather</translation>
    </message>
</context>
<context>
    <name>night.hours-began</name>
    <message>
        <source>the show&apos;s hours began before it was done</source>
        <translation>尚未完成，演出时间就开始了</translation>
    </message>
</context>
<context>
    <name>night.missed</name>
    <message>
        <source>it could not begin within two hours of its time: the show did not run, or the computer slept</source>
        <translation>未能在预定时间后的两小时内开始：演出没有运行，或计算机处于休眠</translation>
    </message>
</context>
<context>
    <name>night.not-as-predicted</name>
    <message>
        <source>the picture has a colour error of {} where {} was predicted, and no repair helped</source>
        <translation>图像的颜色误差为 {}，预测为 {}，修复也没有帮助</translation>
    </message>
</context>
<context>
    <name>night.part-not-as-predicted</name>
    <message>
        <source>a part of the surface looks otherwise than predicted, by a colour error of {}, and no repair helped</source>
        <translation>表面的一部分与预测不同，色差为 {}，修复无效</translation>
    </message>
</context>
<context>
    <name>night.too-long</name>
    <message>
        <source>it was not done within six hours</source>
        <translation>六小时内没有完成</translation>
    </message>
</context>
<context>
    <name>perfect.camera-blinded</name>
    <message>
        <source>something blinds the camera: {} of its view is overexposed</source>
        <translation>有光线直射相机：画面的 {} 过曝</translation>
    </message>
</context>
<context>
    <name>perfect.camera-moved</name>
    <message>
        <source>the view of camera {} has moved by {}, {} pixels since the venue was measured</source>
        <translation>相机 {} 的视野自测量以来移动了 {}、{} 像素</translation>
    </message>
</context>
<context>
    <name>perfect.light-missing</name>
    <message>
        <source>light is missing: is the lens covered, or a projector asleep?</source>
        <translation>光线不足：镜头是否被遮挡，或投影机是否休眠？</translation>
    </message>
</context>
<context>
    <name>perfect.something-else</name>
    <message>
        <source>the camera sees something else than expected: did somebody stand in the light, or did the room&apos;s light change?</source>
        <translation>相机看到的与预期不同：是否有人站在光中，或室内光线变了？</translation>
    </message>
</context>
<context>
    <name>pjlink.address-twice</name>
    <message>
        <source>projectors {} and {} have the same address, {}</source>
        <translation>投影机 {} 和 {} 的地址相同：{}</translation>
    </message>
</context>
<context>
    <name>pjlink.cannot-search</name>
    <message>
        <source>projectors cannot be searched ({})</source>
        <translation>无法搜索投影机（{}）</translation>
    </message>
</context>
<context>
    <name>pjlink.check-address-and-port</name>
    <message>
        <source>check the address and the port of the projector</source>
        <translation>请检查投影机的地址和端口</translation>
    </message>
</context>
<context>
    <name>pjlink.check-lens</name>
    <message>
        <source>check lens caps, shutter and input of the projector, and where the camera looks</source>
        <translation>请检查镜头盖、投影机的快门和输入，以及相机的朝向</translation>
    </message>
</context>
<context>
    <name>pjlink.check-network</name>
    <message>
        <source>check its address, its network cable, and that PJLink and the network in standby are switched on in its menu</source>
        <translation>请检查其地址和网线，并确认其菜单中已开启 PJLink 和待机网络</translation>
    </message>
</context>
<context>
    <name>pjlink.check-own-network</name>
    <message>
        <source>check this computer&apos;s network, or give the projector&apos;s address</source>
        <translation>请检查本机网络，或给出投影机的地址</translation>
    </message>
</context>
<context>
    <name>pjlink.choose-class-one-authentication</name>
    <message>
        <source>choose the authentication of PJLink class 1 in its menu, or none</source>
        <translation>请在其菜单中选择 PJLink 1 类认证，或不认证</translation>
    </message>
</context>
<context>
    <name>pjlink.closed</name>
    <message>
        <source>it closed the connection</source>
        <translation>它关闭了连接</translation>
    </message>
</context>
<context>
    <name>pjlink.end-dimming</name>
    <message>
        <source>switch off its dynamic contrast, lamp dimming and eco modes, and daylight in the room; or measure without waiting for its lamp</source>
        <translation>请关闭其动态对比度、灯泡调光和节能模式，并遮挡室内日光；或不等待灯泡直接测量</translation>
    </message>
</context>
<context>
    <name>pjlink.frozen</name>
    <message>
        <source>projector {} freezes its picture: end that in its menu</source>
        <translation>投影机 {} 冻结了画面：请在其菜单中取消</translation>
    </message>
</context>
<context>
    <name>pjlink.give-password</name>
    <message>
        <source>give the PJLink password that is set in its menu</source>
        <translation>请给出其菜单中设置的 PJLink 密码</translation>
    </message>
</context>
<context>
    <name>pjlink.light-drifts</name>
    <message>
        <source>the light of projector {} still drifts by {} % within {} s after {} s</source>
        <translation>投影机 {0} 的光在 {3} 秒后仍在 {2} 秒内漂移 {1} %</translation>
    </message>
</context>
<context>
    <name>pjlink.light-unseen</name>
    <message>
        <source>no camera sees light of projector {}</source>
        <translation>没有相机看到投影机 {} 的光</translation>
    </message>
</context>
<context>
    <name>pjlink.look-at-projector</name>
    <message>
        <source>look at its lamps and its menu</source>
        <translation>请查看其指示灯和菜单</translation>
    </message>
</context>
<context>
    <name>pjlink.more-than-projectors</name>
    <message>
        <source>projector {} on the network is none of the {} that there are</source>
        <translation>网络上的投影机 {} 不在现有的 {} 台之中</translation>
    </message>
</context>
<context>
    <name>pjlink.newer-authentication</name>
    <message>
        <source>the projector at {} asks for its password in a way that this version does not know</source>
        <translation>位于 {} 的投影机以本版本不支持的方式要求密码</translation>
    </message>
</context>
<context>
    <name>pjlink.no-answer</name>
    <message>
        <source>the projector at {} does not answer ({})</source>
        <translation>位于 {} 的投影机没有应答（{}）</translation>
    </message>
</context>
<context>
    <name>pjlink.no-signal</name>
    <message>
        <source>projector {} has no signal at its input {}: choose the input of this computer</source>
        <translation>投影机 {} 的输入 {} 没有信号：请选择本机所接的输入</translation>
    </message>
</context>
<context>
    <name>pjlink.not-native</name>
    <message>
        <source>projector {} receives {} pixels and has {}: it scales the picture, which blurs the compensation; send it its own size</source>
        <translation>投影机 {} 收到 {} 像素，而自身为 {}：它会缩放画面，使补偿模糊；请按其自身尺寸发送</translation>
    </message>
</context>
<context>
    <name>pjlink.not-on</name>
    <message>
        <source>projector {} was told to switch on and is not on after {} s</source>
        <translation>已令投影机 {} 开机，{} 秒后仍未开启</translation>
    </message>
</context>
<context>
    <name>pjlink.not-pjlink</name>
    <message>
        <source>what answers at {} does not speak PJLink</source>
        <translation>位于 {} 的应答者不支持 PJLink</translation>
    </message>
</context>
<context>
    <name>pjlink.open-shutter-by-hand</name>
    <message>
        <source>open it at the projector, and start again</source>
        <translation>请在投影机上打开，然后重新开始</translation>
    </message>
</context>
<context>
    <name>pjlink.other-signal</name>
    <message>
        <source>projector {} receives {} pixels where {} are sent: something between scales the picture, or it shows another input</source>
        <translation>投影机 {} 收到 {} 像素，而发送的是 {}：中间有设备缩放画面，或它显示的是另一输入</translation>
    </message>
</context>
<context>
    <name>pjlink.own-failure</name>
    <message>
        <source>the projector at {} reports a failure of its own</source>
        <translation>位于 {} 的投影机报告自身故障</translation>
    </message>
</context>
<context>
    <name>pjlink.part-cover</name>
    <message>
        <source>cover open</source>
        <translation>盖子打开</translation>
    </message>
</context>
<context>
    <name>pjlink.part-fan</name>
    <message>
        <source>fan</source>
        <translation>风扇</translation>
    </message>
</context>
<context>
    <name>pjlink.part-filter</name>
    <message>
        <source>filter</source>
        <translation>滤网</translation>
    </message>
</context>
<context>
    <name>pjlink.part-lamp</name>
    <message>
        <source>lamp</source>
        <translation>灯泡</translation>
    </message>
</context>
<context>
    <name>pjlink.part-other</name>
    <message>
        <source>something else</source>
        <translation>其他</translation>
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
        <translation>投影机 {} 报告错误：{}</translation>
    </message>
</context>
<context>
    <name>pjlink.reports-warning</name>
    <message>
        <source>projector {} warns: {}</source>
        <translation>投影机 {} 警告：{}</translation>
    </message>
</context>
<context>
    <name>pjlink.shutter-stays-closed</name>
    <message>
        <source>the shutter of projector {} does not open</source>
        <translation>投影机 {} 的快门打不开</translation>
    </message>
</context>
<context>
    <name>pjlink.still-warming</name>
    <message>
        <source>projector {} is still warming up or cooling down after {} s</source>
        <translation>投影机 {} 在 {} 秒后仍在预热或冷却</translation>
    </message>
</context>
<context>
    <name>pjlink.switch-on-by-hand</name>
    <message>
        <source>look at its lamps and its menu, switch it on by hand, and start again</source>
        <translation>请查看其指示灯和菜单，手动开机，然后重新开始</translation>
    </message>
</context>
<context>
    <name>pjlink.too-slow</name>
    <message>
        <source>nothing complete came in time</source>
        <translation>未及时收到完整应答</translation>
    </message>
</context>
<context>
    <name>pjlink.wants-password</name>
    <message>
        <source>the projector at {} asks for a password</source>
        <translation>位于 {} 的投影机要求密码</translation>
    </message>
</context>
<context>
    <name>pjlink.wrong-password</name>
    <message>
        <source>the projector at {} refuses the password</source>
        <translation>位于 {} 的投影机拒绝该密码</translation>
    </message>
</context>
<context>
    <name>reduction.binned</name>
    <message>
        <source>of the camera&apos;s {} pixels, {} are made: of the part around what is lit, every {} become one</source>
        <translation>相机的 {} 个像素合成为 {}：在被照亮部分及其周围，每 {} 个像素合为一个</translation>
    </message>
</context>
<context>
    <name>reduction.binned-for-memory</name>
    <message>
        <source>of the camera&apos;s {} pixels, {} are made: every {} become one, as there is memory for no more</source>
        <translation>相机的 {} 个像素合成为 {}：每 {} 个像素合为一个，因为内存容不下更多</translation>
    </message>
</context>
<context>
    <name>reduction.cropped</name>
    <message>
        <source>of the camera&apos;s {} pixels, the {} around what is lit are used</source>
        <translation>在相机的 {} 个像素中，使用被照亮部分及其周围的 {}</translation>
    </message>
</context>
<context>
    <name>reduction.fewer-camera-pixels</name>
    <message>
        <source>choose fewer camera pixels: automatic ones are as many as fit</source>
        <translation>请选择较少的相机像素：自动选择时，用到内存容得下为止</translation>
    </message>
</context>
<context>
    <name>reduction.memory-too-little</name>
    <message>
        <source>measuring would take {} GB of memory, and {} GB may be taken</source>
        <translation>测量需要 {} GB 内存，而可用的是 {} GB</translation>
    </message>
</context>
<context>
    <name>reduction.more-memory-or-smaller-projector</name>
    <message>
        <source>use a computer or a limit with more memory, or a projector signal of fewer pixels</source>
        <translation>请使用内存更大的电脑或更高的内存上限，或像素较少的投影机信号</translation>
    </message>
</context>
<context>
    <name>reduction.other-size</name>
    <message>
        <source>the camera delivers {} pixels where {} were calibrated</source>
        <translation>相机提供 {} 个像素，而校准时为 {}</translation>
    </message>
</context>
<context>
    <name>reduction.restore-camera-size</name>
    <message>
        <source>set the camera to the size that it had, or calibrate again</source>
        <translation>将相机设为原来的尺寸，或重新校准</translation>
    </message>
</context>
<context>
    <name>relucent::gui::AcquirePage</name>
    <message>
        <source>Paused, %1</source>
        <translation>已暂停，%1</translation>
    </message>
    <message>
        <source>Measuring, %1</source>
        <translation>正在测量，%1</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s), %1</source>
        <translation>
            <numerusform>%n 个图案，%1</numerusform>
        </translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>已测量</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>已过期</translation>
    </message>
    <message>
        <source>Stopped by a failure</source>
        <translation>因故障停止</translation>
    </message>
    <message>
        <source>Waiting for you. Nothing is being projected.</source>
        <translation>正在等待您的操作。当前没有投影。</translation>
    </message>
    <message>
        <source>Every photograph is saved. Threshold opens when the last is taken.</source>
        <translation>每张照片都会保存。拍完最后一张后打开“阈值”。</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>设备正由“%1”使用。</translation>
    </message>
    <message>
        <source>Measured in %1</source>
        <translation>测量用时 %1</translation>
    </message>
    <message>
        <source>Leave the room dark and still, then start.</source>
        <translation>保持场内黑暗、静止，然后开始。</translation>
    </message>
    <message>
        <source>Show threshold</source>
        <translation>查看阈值</translation>
    </message>
    <message>
        <source>Resume</source>
        <translation>继续</translation>
    </message>
    <message>
        <source>Start measuring</source>
        <translation>开始测量</translation>
    </message>
    <message>
        <source>Stop and keep</source>
        <translation>停止并保留</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>暂停</translation>
    </message>
    <message>
        <source>This measurement belongs to earlier settings</source>
        <translation>此测量属于以前的设置</translation>
    </message>
    <message>
        <source>It still works and stays until the new one is ready.</source>
        <translation>它仍可使用，并会保留到新的测量完成。</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>重新测量</translation>
    </message>
    <message>
        <source>The last session ended before it was finished</source>
        <translation>上次测量未完成就已结束</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>没有任何更改。</translation>
    </message>
    <message>
        <source>Fineness</source>
        <translation>精细度</translation>
    </message>
    <message>
        <source>Acquire</source>
        <translation>采集</translation>
    </message>
    <message>
        <source>Measure how every projector pixel lights every camera pixel. Leave the room dark and still.</source>
        <translation>测量投影机的每个像素如何照亮相机的每个像素。请保持场内黑暗、静止。</translation>
    </message>
    <message>
        <source>Sent to the projector</source>
        <translation>发送到投影机</translation>
    </message>
    <message>
        <source>Seen by the camera</source>
        <translation>相机所见</translation>
    </message>
    <message>
        <source>Pattern that the projector shows</source>
        <translation>投影机显示的图案</translation>
    </message>
    <message>
        <source>Last photograph</source>
        <translation>最近一张照片</translation>
    </message>
    <message>
        <source>Appears when measuring begins. Nothing is projected before you start.</source>
        <translation>测量开始后显示。开始之前不会投影。</translation>
    </message>
    <message>
        <source>How finely</source>
        <translation>精细程度</translation>
    </message>
    <message>
        <source>Fast</source>
        <translation>快速</translation>
    </message>
    <message>
        <source>a first look; misses weak bounces</source>
        <translation>初步了解，会漏掉弱间接反射</translation>
    </message>
    <message>
        <source>Usual</source>
        <translation>常规</translation>
    </message>
    <message>
        <source>suits most surfaces</source>
        <translation>适合多数表面</translation>
    </message>
    <message>
        <source>Fine</source>
        <translation>精细</translation>
    </message>
    <message>
        <source>glass, gloss, deep corners</source>
        <translation>玻璃、光泽面、深角落</translation>
    </message>
    <message>
        <source>Disk still needed</source>
        <translation>还需磁盘空间</translation>
    </message>
    <message>
        <source>Watching</source>
        <translation>监测</translation>
    </message>
    <message>
        <source>Paused</source>
        <translation>已暂停</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>正在测量</translation>
    </message>
    <message>
        <source>about %1</source>
        <translation>约 %1</translation>
    </message>
    <message>
        <source>alarm beyond</source>
        <translation>超出即报警</translation>
    </message>
    <message>
        <source>taken again</source>
        <translation>重拍</translation>
    </message>
    <message>
        <source>During the measurement</source>
        <translation>测量期间</translation>
    </message>
    <message>
        <source>light that would spoil photographs</source>
        <translation>会破坏照片的光</translation>
    </message>
    <message>
        <source>Minutes</source>
        <translation>分钟</translation>
    </message>
    <message>
        <source>Room light, % of full light</source>
        <translation>环境光，占全亮的 %</translation>
    </message>
    <message>
        <source>Room light during the measurement</source>
        <translation>测量期间的环境光</translation>
    </message>
    <message>
        <source>Taken again</source>
        <translation>重拍</translation>
    </message>
    <message numerus="yes">
        <source>About %n pattern(s), %1. Leave the room dark and still.</source>
        <translation>
            <numerusform>约 %n 个图案，%1。请保持房间黑暗且无人走动。</numerusform>
        </translation>
    </message>
    <message>
        <source>What was measured</source>
        <translation>测量结果</translation>
    </message>
    <message>
        <source>Patterns</source>
        <translation>图案</translation>
    </message>
    <message>
        <source>Error of the test patterns</source>
        <translation>测试图案的误差</translation>
    </message>
    <message>
        <source>Continue anyway</source>
        <translation>仍然继续</translation>
    </message>
    <message>
        <source>Found while measuring</source>
        <translation>测量中的发现</translation>
    </message>
    <message numerus="yes">
        <source>Begins in %n second(s)</source>
        <translation>
            <numerusform>%n 秒后开始</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Measuring begins in %n second(s). Leave the room dark and still.</source>
        <translation>
            <numerusform>测量将在 %n 秒后开始。请保持房间黑暗、静止。</numerusform>
        </translation>
    </message>
    <message>
        <source>Start now</source>
        <translation>立即开始</translation>
    </message>
    <message>
        <source>Not now</source>
        <translation>暂不开始</translation>
    </message>
    <message numerus="yes">
        <source>Compared with the start every %n pattern(s). What changed is photographed again; if that does not help, the measurement pauses and asks.</source>
        <translation>
            <numerusform>每 %n 个图案与开始时比较一次。有变化的部分会重新拍摄；若仍无效，测量会暂停并询问。</numerusform>
        </translation>
    </message>
    <message>
        <source>Start</source>
        <translation>开始</translation>
    </message>
    <message>
        <source>Leave the room first</source>
        <translation>先离开房间</translation>
    </message>
    <message>
        <source>Time to leave the room before measuring begins</source>
        <translation>测量开始前离开房间的时间</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>A sound when it ends or needs me</source>
        <translation>结束或需要我时发出声音</translation>
    </message>
    <message>
        <source>Ready</source>
        <translation>就绪</translation>
    </message>
    <message>
        <source>Dark enough</source>
        <translation>足够暗</translation>
    </message>
    <message>
        <source>Room light is %1 of full light, limit %2.</source>
        <translation>室内光为全光的 %1，上限 %2。</translation>
    </message>
    <message>
        <source>It is too bright here</source>
        <translation>这里太亮</translation>
    </message>
    <message>
        <source>Room light is %1 of full light. Cover windows and lamps: less light, less noise.</source>
        <translation>室内光为全光的 %1。请遮住窗户和灯：光越少，噪声越小。</translation>
    </message>
    <message>
        <source>Needs %1 of %2.</source>
        <translation>需要 %1，可用 %2。</translation>
    </message>
    <message>
        <source>Room on the disk</source>
        <translation>磁盘空间足够</translation>
    </message>
    <message>
        <source>The disk is too full</source>
        <translation>磁盘空间不足</translation>
    </message>
    <message>
        <source>Floodlight image</source>
        <translation>全光图像</translation>
    </message>
    <message>
        <source>the projector fully white</source>
        <translation>投影机全白</translation>
    </message>
    <message>
        <source>The surface in the projector&apos;s full light</source>
        <translation>投影机全光下的表面</translation>
    </message>
    <message>
        <source>%1 px</source>
        <translation>%1 px</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 / %2</translation>
    </message>
    <message>
        <source>Level %1 of %2, %3 of %4 patterns.</source>
        <translation>第 %1 级，共 %2 级；图案 %3 / %4。</translation>
    </message>
    <message>
        <source>Patterns for each block size</source>
        <translation>各块大小的图案</translation>
    </message>
    <message>
        <source>blocks are divided only where light needs it</source>
        <translation>仅在光线需要处细分块</translation>
    </message>
    <message>
        <source>Stopped at %1 px</source>
        <translation>停于 %1 px</translation>
    </message>
    <message>
        <source>Measuring was stopped at blocks of %1 px</source>
        <translation>测量在 %1 px 的块处停止</translation>
    </message>
    <message>
        <source>Finer light is missing. Go on any time, if nothing has moved.</source>
        <translation>缺少更精细的光。只要没有东西移动，可随时继续。</translation>
    </message>
    <message numerus="yes">
        <source>%1 dB expected, about %2 dB with %n more photograph(s), %3. Go on any time, if nothing has moved.</source>
        <translation>
            <numerusform>预期 %1 dB，再拍 %n 张照片约为 %2 dB，%3。只要没有东西移动，随时可以继续。</numerusform>
        </translation>
    </message>
    <message>
        <source>Pictures expected at</source>
        <translation>画面预期</translation>
    </message>
    <message>
        <source>rough</source>
        <translation>粗糙</translation>
    </message>
    <message>
        <source>fair</source>
        <translation>尚可</translation>
    </message>
    <message>
        <source>good</source>
        <translation>良好</translation>
    </message>
    <message>
        <source>very good</source>
        <translation>很好</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1，%2</translation>
    </message>
    <message>
        <source>%1 dB</source>
        <translation>%1 dB</translation>
    </message>
    <message>
        <source>dB says how close the picture comes to the one wanted, where it can be reached at all: 20 dB looks rough, 30 dB good, and every 6 dB halve what is off.</source>
        <translation>dB 表示在可达到的范围内，画面与所需画面有多接近：20 dB 看起来粗糙，30 dB 良好，每增加 6 dB 偏差减半。</translation>
    </message>
    <message>
        <source>Compensated so far</source>
        <translation>目前的补偿</translation>
    </message>
    <message>
        <source>A picture, compensated with what is measured so far</source>
        <translation>用目前测得的数据补偿的画面</translation>
    </message>
    <message>
        <source>Appears after the first patterns, and grows sharper.</source>
        <translation>在最初的图案之后出现，并逐渐变得清晰。</translation>
    </message>
    <message>
        <source>Expected now</source>
        <translation>目前预期</translation>
    </message>
    <message>
        <source>Blocks of %1 px. Expected now: %2. In the end: %3.</source>
        <translation>%1 px 块。目前预期：%2。最终：%3。</translation>
    </message>
    <message>
        <source>In the end</source>
        <translation>最终</translation>
    </message>
    <message>
        <source>Waiting for room on the disk. Nothing is being projected.</source>
        <translation>正在等待磁盘空间。当前没有投影。</translation>
    </message>
    <message>
        <source>Go on now</source>
        <translation>立即继续</translation>
    </message>
    <message>
        <source>Photographs to keep</source>
        <translation>要保留的照片</translation>
    </message>
    <message>
        <source>Photographs to keep once all is measured</source>
        <translation>全部测量完成后要保留的照片</translation>
    </message>
    <message>
        <source>All</source>
        <translation>全部</translation>
    </message>
    <message>
        <source>Of the latest measurement</source>
        <translation>最近一次测量的</translation>
    </message>
    <message>
        <source>None: results only</source>
        <translation>不保留：仅结果</translation>
    </message>
    <message>
        <source>Those that were set aside by measuring again are removed once all is measured.</source>
        <translation>重新测量时搁置的照片，会在全部测量完成后删除。</translation>
    </message>
    <message>
        <source>Removed once all is measured. Other settings then have to photograph everything again.</source>
        <translation>全部测量完成后删除。之后用其他设置需要重新拍摄全部照片。</translation>
    </message>
    <message>
        <source>Measuring with other settings then needs fewer new photographs.</source>
        <translation>用其他设置测量时，需要的新照片会更少。</translation>
    </message>
    <message>
        <source>Those of the last measurement were removed: all are taken again.</source>
        <translation>上次测量的照片已删除：全部照片将重新拍摄。</translation>
    </message>
    <message>
        <source>Waiting for the projector&apos;s screen.</source>
        <translation>正在等待投影机屏幕。</translation>
    </message>
    <message>
        <source>Every photograph is saved. The earlier measurement is used until the new one is ready.</source>
        <translation>每张照片都会保存。新测量完成前使用之前的测量。</translation>
    </message>
    <message>
        <source>To go on measuring, confirm that the room is clear.</source>
        <translation>要继续测量，请确认已清场。</translation>
    </message>
    <message>
        <source>Takes every photograph again. What is measured stays until then.</source>
        <translation>重新拍摄所有照片。在此之前保留已测结果。</translation>
    </message>
    <message>
        <source>Measuring again has not ended</source>
        <translation>重新测量尚未结束</translation>
    </message>
    <message>
        <source>Measuring with these settings.</source>
        <translation>正在用这些设置测量。</translation>
    </message>
    <message>
        <source>Waiting for the camera.</source>
        <translation>正在等待相机。</translation>
    </message>
    <message>
        <source>Keep the earlier one</source>
        <translation>保留之前的</translation>
    </message>
    <message>
        <source>The earlier measurement is used again, with all that followed from it.</source>
        <translation>重新使用之前的测量及其后续的全部结果。</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>已测得的数据是安全的。</translation>
    </message>
    <message>
        <source>Paused, about %1 left</source>
        <translation>已暂停，剩余约 %1</translation>
    </message>
    <message>
        <source>%1 of about %2</source>
        <translation>%1 / 约 %2</translation>
    </message>
    <message>
        <source>About %1 left</source>
        <translation>剩余约 %1</translation>
    </message>
    <message>
        <source>Ends near %1. %2</source>
        <translation>约 %1 结束。%2</translation>
    </message>
    <message>
        <source>Put the camera back</source>
        <translation>把相机放回原位</translation>
    </message>
    <message>
        <source>Test patterns are predicted from the measurement, then photographed: this is how far the two differ, the photographs&apos; noise included.</source>
        <translation>先由测量结果预测测试图案，再拍照：这是两者之差，包括照片的噪声。</translation>
    </message>
    <message>
        <source>%1; light right within about %2</source>
        <translation>%1；光的误差约 %2</translation>
    </message>
    <message>
        <source>Reading, %1</source>
        <translation>读取中，%1</translation>
    </message>
    <message>
        <source>Waiting for your answer. Every photograph is saved.</source>
        <translation>正在等待您的回答。每张照片都已保存。</translation>
    </message>
    <message>
        <source>Go on measuring</source>
        <translation>继续测量</translation>
    </message>
    <message>
        <source>Answer</source>
        <translation>回答</translation>
    </message>
    <message>
        <source>Try again</source>
        <translation>重试</translation>
    </message>
    <message>
        <source>The camera is back at its place</source>
        <translation>相机已回到原位</translation>
    </message>
    <message>
        <source>It had moved while it measured, and looks again where it looked.</source>
        <translation>它在测量时移动过，现在又对准原来的位置。</translation>
    </message>
    <message numerus="yes">
        <source>“%1” photographs %n pattern(s) again, from No. %2 on, and goes on from there.</source>
        <translation>
            <numerusform>“%1”从第 %2 个起重拍 %n 个图案，并从那里继续。</numerusform>
        </translation>
    </message>
    <message>
        <source>“%1” looks once more, and goes on.</source>
        <translation>“%1”再检查一次并继续。</translation>
    </message>
    <message>
        <source>“%1” keeps all as it is: what changed will be wrong, and the report says so.</source>
        <translation>“%1”保持现状：有变化的地方会不正确，报告中会注明。</translation>
    </message>
    <message>
        <source>Measuring waits for your answer.</source>
        <translation>测量正在等待您的回答。</translation>
    </message>
    <message>
        <source>Kept photographs are read first.</source>
        <translation>先读取已保留的照片。</translation>
    </message>
    <message>
        <source>Nothing is being projected.</source>
        <translation>当前没有投影。</translation>
    </message>
    <message>
        <source>Reading</source>
        <translation>正在读取</translation>
    </message>
    <message>
        <source>Reading, under a minute left</source>
        <translation>正在读取，剩余不到一分钟</translation>
    </message>
    <message>
        <source>Reading, about %1 left</source>
        <translation>正在读取，剩余约 %1</translation>
    </message>
    <message>
        <source>Paused, under a minute left</source>
        <translation>已暂停，剩余不到一分钟</translation>
    </message>
    <message>
        <source>Under a minute left</source>
        <translation>剩余不到一分钟</translation>
    </message>
    <message>
        <source>%1 expected</source>
        <translation>预计 %1</translation>
    </message>
    <message>
        <source>To measure again, confirm that the room is clear.</source>
        <translation>要重新测量，请确认已清场。</translation>
    </message>
    <message>
        <source>%1, %2 a minute</source>
        <translation>%1，每分钟 %2</translation>
    </message>
    <message>
        <source>all projectors fully white</source>
        <translation>所有投影机全白</translation>
    </message>
    <message>
        <source>Reading what was measured</source>
        <translation>正在读取测量结果</translation>
    </message>
    <message>
        <source>The camera is at its place</source>
        <translation>相机在原位</translation>
    </message>
    <message>
        <source>It looks where it looked. Perhaps the light flickered.</source>
        <translation>它仍看着原来的位置。可能是光线闪烁。</translation>
    </message>
    <message>
        <source>Ended by a change</source>
        <translation>因变化而结束</translation>
    </message>
    <message>
        <source>Put right what changed, then go on measuring.</source>
        <translation>请先恢复发生变化的部分，然后继续测量。</translation>
    </message>
    <message>
        <source>Measure again as it stands now, or put it back and go on measuring.</source>
        <translation>按现在的位置重新测量，或放回原位后继续测量。</translation>
    </message>
    <message>
        <source>Measuring was stopped at blocks of %1 px: something had changed</source>
        <translation>测量停止于 %1 px 的块：有东西发生了变化</translation>
    </message>
    <message>
        <source>Measuring ended, and something had changed</source>
        <translation>测量已结束，但有东西发生了变化</translation>
    </message>
    <message>
        <source>What was photographed since the look before is left out, all before it is kept.</source>
        <translation>上一次检查之后拍摄的内容不使用，之前的全部保留。</translation>
    </message>
    <message>
        <source>Working out, %1</source>
        <translation>正在计算，%1</translation>
    </message>
    <message>
        <source>Working out the result</source>
        <translation>正在计算结果</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s)</source>
        <translation>
            <numerusform>%n 个图案</numerusform>
        </translation>
    </message>
    <message>
        <source>Waits for an answer</source>
        <translation>等待回答</translation>
    </message>
    <message>
        <source>%1 too bright</source>
        <translation>%1 太亮</translation>
    </message>
    <message>
        <source>%1 left out</source>
        <translation>%1 被排除</translation>
    </message>
    <message>
        <source>Waiting for your answer.</source>
        <translation>正在等待您的回答。</translation>
    </message>
    <message>
        <source>Stop and keep this one</source>
        <translation>停止并保留这次</translation>
    </message>
    <message>
        <source>Going on has not ended</source>
        <translation>继续测量尚未结束</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s) expected, %1 of them checks; known exactly as each level begins</source>
        <translation>
            <numerusform>预计 %n 个图案，其中 %1 个为检查；每级开始时才确切知道</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s), %1 of them checks</source>
        <translation>
            <numerusform>%n 个图案，其中 %1 个为检查</numerusform>
        </translation>
    </message>
    <message>
        <source>Ending</source>
        <translation>正在结束</translation>
    </message>
    <message>
        <source>Measure with these settings</source>
        <translation>按此设置测量</translation>
    </message>
    <message>
        <source>Use the earlier one</source>
        <translation>使用较早的测量</translation>
    </message>
    <message>
        <source>Waiting</source>
        <translation>等待中</translation>
    </message>
    <message>
        <source>Waiting, under a minute left</source>
        <translation>等待中，剩余不到一分钟</translation>
    </message>
    <message>
        <source>Waiting, about %1 left</source>
        <translation>等待中，剩余约 %1</translation>
    </message>
    <message>
        <source>Keep the new ones</source>
        <translation>保留新的</translation>
    </message>
    <message>
        <source>Keep the earlier measurement?</source>
        <translation>保留之前的测量？</translation>
    </message>
    <message>
        <source>The new photographs are set aside and not used again: measuring again then takes every photograph again.</source>
        <translation>新照片将移到一边，不再使用：重新测量时会重拍所有照片。</translation>
    </message>
    <message>
        <source>The earlier measurement, and all that followed from it.</source>
        <translation>之前的测量及其后续的全部结果。</translation>
    </message>
    <message numerus="yes">
        <source>%n pattern(s) kept</source>
        <translation>
            <numerusform>已保留 %n 个图案</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The photographs of %n pattern(s) are read first. Then measuring goes on where it ended.</source>
        <translation>
            <numerusform>先读取 %n 个图案的照片，然后从中断处继续测量。</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The photographs of %n pattern(s) are safe. Resuming gives the same result as if nothing had happened.</source>
        <translation>
            <numerusform>%n 个图案的照片已保存。继续测量，结果与未中断时相同。</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The new photographs of %n pattern(s) are safe: resume any time. Until then the earlier measurement is used.</source>
        <translation>
            <numerusform>%n 个图案的新照片已保存：可随时恢复。在此之前使用之前的测量。</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The photographs of %n pattern(s) are on the disk. The pattern under way is not counted.</source>
        <translation>
            <numerusform>%n 个图案的照片已写入磁盘。正在拍摄的图案不计在内。</numerusform>
        </translation>
    </message>
    <message>
        <source>Photographs</source>
        <translation>照片</translation>
    </message>
    <message numerus="yes">
        <source>Reading the photographs of %n pattern(s): %1.</source>
        <translation>
            <numerusform>正在读取 %n 个图案的照片：%1。</numerusform>
        </translation>
    </message>
    <message>
        <source>Keep the new one</source>
        <translation>保留新的测量</translation>
    </message>
    <message>
        <source>Use the earlier measurement?</source>
        <translation>使用较早的测量？</translation>
    </message>
    <message>
        <source>%1; lit, within the dashes: %2 of the view</source>
        <translation>%1；照亮部分（虚线内）：视野的 %2</translation>
    </message>
    <message>
        <source>Stopped after %1</source>
        <translation>在 %1 后停止</translation>
    </message>
    <message>
        <source>Stopped early: light finer than blocks of %1 px is missing.</source>
        <translation>提前停止：缺少比 %1 px 的块更细的光。</translation>
    </message>
    <message>
        <source>Again, not ended</source>
        <translation>重测未结束</translation>
    </message>
    <message>
        <source>What was measured cannot be read</source>
        <translation>无法读取测得的内容</translation>
    </message>
    <message>
        <source>Use the earlier measurement, or measure again.</source>
        <translation>请使用之前的测量，或重新测量。</translation>
    </message>
    <message>
        <source>Measure again.</source>
        <translation>请重新测量。</translation>
    </message>
    <message>
        <source>%1 dB expected: what was measured does not fit together, and pictures are no better than uncorrected.</source>
        <translation>预计 %1 dB：测得的内容互不吻合，画面不会比未校正时更好。</translation>
    </message>
    <message>
        <source>%1 dB expected. Go on any time, if nothing has moved.</source>
        <translation>预计 %1 dB。如果没有东西移动过，可随时继续。</translation>
    </message>
    <message>
        <source>What was measured cannot be read.</source>
        <translation>无法读取测得的内容。</translation>
    </message>
    <message>
        <source>%1: what was photographed since the check before is taken again.</source>
        <translation>%1：上次检查以来拍摄的内容正在重新拍摄。</translation>
    </message>
    <message>
        <source>The light of the room was another one, too: see that it is as it was.</source>
        <translation>房间的灯光也不同了：请确认已恢复原状。</translation>
    </message>
    <message>
        <source>Ending: what is begun is photographed to its end, and test patterns. Then all of it is kept.</source>
        <translation>正在结束：已开始的部分会拍完，再拍测试图案，然后全部保留。</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the patterns flash.</source>
        <translation>请确认已清场：图案会闪烁。</translation>
    </message>
    <message>
        <source>%1: all patterns are taken again, from the first.</source>
        <translation>%1：所有图案从第一个开始重新拍摄。</translation>
    </message>
    <message>
        <source>Measured in %1, and repaired since</source>
        <translation>测量用时 %1，之后已修复</translation>
    </message>
    <message>
        <source>Photographs of the repair since</source>
        <translation>之后修复的照片数</translation>
    </message>
    <message>
        <source>Stopped too early</source>
        <translation>停止过早</translation>
    </message>
</context>
<context>
    <name>relucent::gui::AcquisitionTrace</name>
    <message>
        <source>the light flickered</source>
        <translation>光线闪烁</translation>
    </message>
    <message>
        <source>the room light changed</source>
        <translation>环境光变化</translation>
    </message>
    <message>
        <source>the projector&apos;s light changed</source>
        <translation>投影机的光变化</translation>
    </message>
    <message>
        <source>the camera or the projector moved</source>
        <translation>相机或投影机移动</translation>
    </message>
    <message>
        <source>the picture was not the one sent</source>
        <translation>不是发送的图像</translation>
    </message>
    <message>
        <source>the camera saw nothing</source>
        <translation>相机什么也没看到</translation>
    </message>
    <message>
        <source>the projector showed nothing</source>
        <translation>投影机没有显示</translation>
    </message>
    <message>
        <source>too bright, shorter exposure</source>
        <translation>过亮，缩短曝光</translation>
    </message>
    <message>
        <source>does not fit what was seen before</source>
        <translation>与之前所见不符</translation>
    </message>
    <message>
        <source>No. %1</source>
        <translation>第 %1 个</translation>
    </message>
    <message>
        <source>No. %1 to %2</source>
        <translation>第 %1 至 %2 个</translation>
    </message>
    <message>
        <source>Room light</source>
        <translation>环境光</translation>
    </message>
    <message>
        <source>Camera and view</source>
        <translation>相机与画面</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>投影机</translation>
    </message>
    <message>
        <source>Flicker</source>
        <translation>闪烁</translation>
    </message>
    <message>
        <source>Room light steady</source>
        <translation>环境光稳定</translation>
    </message>
    <message>
        <source>Room light changed</source>
        <translation>环境光已变化</translation>
    </message>
    <message>
        <source>%1 of full light, changed by %2 since the start.</source>
        <translation>占全亮的 %1，自开始以来变化 %2。</translation>
    </message>
    <message>
        <source>Camera still</source>
        <translation>相机静止</translation>
    </message>
    <message>
        <source>The view changed</source>
        <translation>画面已变化</translation>
    </message>
    <message>
        <source>The view differs by %1 from the first.</source>
        <translation>画面与最初相差 %1。</translation>
    </message>
    <message>
        <source>Projector steady</source>
        <translation>投影机稳定</translation>
    </message>
    <message>
        <source>The projector&apos;s light changed</source>
        <translation>投影机的光已变化</translation>
    </message>
    <message>
        <source>Its light drifted by %1 and is corrected.</source>
        <translation>其光漂移了 %1，已校正。</translation>
    </message>
    <message>
        <source>No flicker</source>
        <translation>无闪烁</translation>
    </message>
    <message>
        <source>Photographs of one pattern agree within %1.</source>
        <translation>同一图案的照片相差不超过 %1。</translation>
    </message>
    <message>
        <source>No difference between photographs of one pattern was found.</source>
        <translation>同一图案的照片之间没有差异。</translation>
    </message>
    <message>
        <source>The camera or the projector moved</source>
        <translation>相机或投影机移动了</translation>
    </message>
    <message>
        <source>The picture is not the one sent</source>
        <translation>画面不是所发送的图像</translation>
    </message>
    <message>
        <source>The camera sees nothing</source>
        <translation>相机什么也看不到</translation>
    </message>
    <message>
        <source>The projector shows nothing</source>
        <translation>投影机没有画面</translation>
    </message>
    <message>
        <source>Put right</source>
        <translation>已处理</translation>
    </message>
    <message>
        <source>Looked at again at the next check.</source>
        <translation>下次检查时再看。</translation>
    </message>
    <message>
        <source>the light flickered, or something moved</source>
        <translation>光线闪烁，或有东西移动</translation>
    </message>
    <message>
        <source>The light flickers, or something moves</source>
        <translation>光线闪烁，或有东西在移动</translation>
    </message>
    <message>
        <source>Not known while the view has changed.</source>
        <translation>视野不同时无法判断。</translation>
    </message>
    <message>
        <source>The light flickers, or was switched</source>
        <translation>光线闪烁或被开关</translation>
    </message>
    <message>
        <source>Photographed again</source>
        <translation>已重新拍摄</translation>
    </message>
    <message>
        <source>dark: lens covered for a moment?</source>
        <translation>过暗：镜头曾被短暂遮挡？</translation>
    </message>
    <message>
        <source>Found since the last check.</source>
        <translation>在上次检查之后发现。</translation>
    </message>
    <message>
        <source>something in the view changed</source>
        <translation>画面中有东西变了</translation>
    </message>
    <message>
        <source>Something in the view changed</source>
        <translation>画面中有东西变了</translation>
    </message>
    <message>
        <source>Not known while the camera sees nothing.</source>
        <translation>相机什么都看不到时无法得知。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ActionBar</name>
    <message>
        <source>Progress of the measurement</source>
        <translation>测量进度</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>返回</translation>
    </message>
    <message>
        <source>Show where</source>
        <translation>在哪里</translation>
    </message>
</context>
<context>
    <name>relucent::gui::CameraPage</name>
    <message>
        <source>Choose</source>
        <translation>选择</translation>
    </message>
    <message>
        <source>Choose %1</source>
        <translation>选择 %1</translation>
    </message>
    <message>
        <source>Choose the one that looks at the surface.</source>
        <translation>请选择对准表面的那台。</translation>
    </message>
    <message>
        <source>Looking for cameras</source>
        <translation>正在查找相机</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>没有任何更改。</translation>
    </message>
    <message>
        <source>Checking</source>
        <translation>正在检查</translation>
    </message>
    <message>
        <source>Checked %1</source>
        <translation>检查于 %1</translation>
    </message>
    <message>
        <source>Choose the camera that looks at the surface.</source>
        <translation>请选择对准表面的相机。</translation>
    </message>
    <message>
        <source>Opening the devices</source>
        <translation>正在打开设备</translation>
    </message>
    <message>
        <source>%1 is too bright in every exposure.</source>
        <translation>视野的 %1 在各档曝光下都过亮。</translation>
    </message>
    <message>
        <source>Look through the camera first.</source>
        <translation>请先查看相机画面。</translation>
    </message>
    <message>
        <source>Next: test patterns for the projector&apos;s response</source>
        <translation>下一步：用测试图案测量投影机的响应</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>暂停</translation>
    </message>
    <message>
        <source>Check again</source>
        <translation>重新检查</translation>
    </message>
    <message>
        <source>Choose another camera</source>
        <translation>选择其他相机</translation>
    </message>
    <message>
        <source>Focus area</source>
        <translation>对焦区域</translation>
    </message>
    <message>
        <source>Nothing is measured at this step, so nothing is lost.</source>
        <translation>此步骤不做测量，因此不会丢失数据。</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>相机</translation>
    </message>
    <message>
        <source>Frame the surface, focus, and let the exposures cover its brightest and darkest parts.</source>
        <translation>取景、对焦，并让各档曝光覆盖表面的最亮和最暗部分。</translation>
    </message>
    <message>
        <source>Focus, %1 of best</source>
        <translation>对焦，为最佳值的 %1</translation>
    </message>
    <message>
        <source>Camera view</source>
        <translation>相机视图</translation>
    </message>
    <message>
        <source>What the camera sees now</source>
        <translation>相机当前所见</translation>
    </message>
    <message>
        <source>The camera is not being looked through.</source>
        <translation>当前未查看相机画面。</translation>
    </message>
    <message>
        <source>Light in this exposure: red, green, blue</source>
        <translation>此曝光的光量：红、绿、蓝</translation>
    </message>
    <message>
        <source>Signal</source>
        <translation>信号</translation>
    </message>
    <message>
        <source>Focus</source>
        <translation>对焦</translation>
    </message>
    <message>
        <source>Turn the lens until the bar stays at the mark: the best so far.</source>
        <translation>转动对焦环，直到指示条停在标记处，即目前最佳。</translation>
    </message>
    <message>
        <source>Exposures</source>
        <translation>曝光</translation>
    </message>
    <message>
        <source>Checks</source>
        <translation>检查</translation>
    </message>
    <message>
        <source>Signal, share of full</source>
        <translation>信号，占满量程的比例</translation>
    </message>
    <message>
        <source>Pixels</source>
        <translation>像素</translation>
    </message>
    <message>
        <source>The camera sees the projector</source>
        <translation>相机能看到投影机</translation>
    </message>
    <message>
        <source>White and black differ as they should.</source>
        <translation>白与黑的差别正常。</translation>
    </message>
    <message>
        <source>Bright parts are covered</source>
        <translation>亮部已覆盖</translation>
    </message>
    <message>
        <source>%1 is too bright in every exposure</source>
        <translation>视野的 %1 在各档曝光下都过亮</translation>
    </message>
    <message>
        <source>Close the lens a little, or shade lamps in the view.</source>
        <translation>请略收光圈，或遮挡视野中的灯。</translation>
    </message>
    <message>
        <source>Dark parts are covered</source>
        <translation>暗部已覆盖</translation>
    </message>
    <message>
        <source>%1 is too dark in every exposure</source>
        <translation>视野的 %1 在各档曝光下都过暗</translation>
    </message>
    <message>
        <source>The projector may not reach there. Where it should, open the lens.</source>
        <translation>投影机可能照不到那里。若应照到，请开大光圈。</translation>
    </message>
    <message>
        <source>Keep exposures</source>
        <translation>保留曝光</translation>
    </message>
    <message>
        <source>too bright to tell</source>
        <translation>过亮，无法判断</translation>
    </message>
    <message>
        <source>Too bright %1</source>
        <translation>过亮 %1</translation>
    </message>
    <message>
        <source>Too dark %1</source>
        <translation>过暗 %1</translation>
    </message>
    <message>
        <source>No camera is chosen yet</source>
        <translation>尚未选择相机</translation>
    </message>
    <message>
        <source>Camera pixels</source>
        <translation>相机像素</translation>
    </message>
    <message>
        <source>As many as needed: %1</source>
        <translation>按需要：%1</translation>
    </message>
    <message>
        <source>All: %1</source>
        <translation>全部：%1</translation>
    </message>
    <message>
        <source>%1 become one: %2</source>
        <translation>%1 合为一个：%2</translation>
    </message>
    <message>
        <source>Camera pixels that are used</source>
        <translation>使用的相机像素</translation>
    </message>
    <message>
        <source>Memory</source>
        <translation>内存</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>磁盘</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>时间</translation>
    </message>
    <message>
        <source>More camera pixels than projector pixels show nothing more. The photographs that prove the result stay as large as they are.</source>
        <translation>相机像素多于投影机像素并不会显示更多内容。用来验证结果的照片保持原有大小。</translation>
    </message>
    <message>
        <source>Mark what is sharp</source>
        <translation>标出清晰处</translation>
    </message>
    <message>
        <source>Checked before. Check again if camera or projector were moved.</source>
        <translation>已检查过。如果移动过相机或投影机，请重新检查。</translation>
    </message>
    <message>
        <source>Continue</source>
        <translation>继续</translation>
    </message>
    <message>
        <source>Exposure times</source>
        <translation>曝光时间</translation>
    </message>
    <message>
        <source>The projector&apos;s picture: the camera sees %1 of it</source>
        <translation>投影画面：相机看到其中的 %1</translation>
    </message>
    <message>
        <source>at the left</source>
        <translation>左侧</translation>
    </message>
    <message>
        <source>at the right</source>
        <translation>右侧</translation>
    </message>
    <message>
        <source>at the top</source>
        <translation>上方</translation>
    </message>
    <message>
        <source>at the bottom</source>
        <translation>下方</translation>
    </message>
    <message>
        <source>Missing are places within it: in shadow, or too dark for the camera.</source>
        <translation>内部有看不到的地方：在阴影中，或对相机来说太暗。</translation>
    </message>
    <message>
        <source>Missing: %1. Aim the camera there, or move it back.</source>
        <translation>看不到：%1。请将相机朝向那里，或后移。</translation>
    </message>
    <message>
        <source>%1 of the projector&apos;s picture is seen</source>
        <translation>看到投影画面的 %1</translation>
    </message>
    <message>
        <source>%1 of projector %2&apos;s picture is seen</source>
        <translation>看到投影机 %2 画面的 %1</translation>
    </message>
    <message>
        <source>Every exposure is a multiple of %1</source>
        <translation>每次曝光都是 %1 的倍数</translation>
    </message>
    <message>
        <source>The projector&apos;s light changes as quickly as that: each photograph has all of it.</source>
        <translation>投影机的光以此周期变化：每张照片都包含完整周期。</translation>
    </message>
    <message>
        <source>Allow any exposure</source>
        <translation>允许任意曝光</translation>
    </message>
    <message>
        <source>Exposures shorter than %1 flicker</source>
        <translation>短于 %1 的曝光会闪烁</translation>
    </message>
    <message>
        <source>The projector&apos;s light changes within that time.</source>
        <translation>投影机的光在这段时间内会变化。</translation>
    </message>
    <message>
        <source>Use multiples of %1</source>
        <translation>使用 %1 的倍数</translation>
    </message>
    <message>
        <source>Checked before</source>
        <translation>已检查过</translation>
    </message>
    <message>
        <source>These exposures are kept. “Check again” looks through the camera.</source>
        <translation>这些曝光已保存。“重新检查”会通过相机查看。</translation>
    </message>
    <message>
        <source>Not checked yet</source>
        <translation>尚未检查</translation>
    </message>
    <message>
        <source>Missing: %1. A simulated camera stays where it stands: go on, what it does not see is left as it is.</source>
        <translation>缺少：%1。模拟相机的位置不变：请继续，它看不到的部分保持原样。</translation>
    </message>
    <message>
        <source>Exposures as measured</source>
        <translation>按测量时的曝光</translation>
    </message>
    <message>
        <source>Camera %1: %2 is too bright in every exposure.</source>
        <translation>相机 %1：%2 在所有曝光中都过亮。</translation>
    </message>
    <message>
        <source>What %1 sees now</source>
        <translation>%1 现在看到的画面</translation>
    </message>
    <message>
        <source>Focus %1</source>
        <translation>对焦 %1</translation>
    </message>
    <message numerus="yes">
        <source>%n projector(s): %1</source>
        <translation>
            <numerusform>%n 台投影机：%1</numerusform>
        </translation>
    </message>
    <message>
        <source>Light</source>
        <translation>光量</translation>
    </message>
    <message>
        <source>Overlap</source>
        <translation>重叠</translation>
    </message>
    <message>
        <source>how many projectors light each place</source>
        <translation>每处由几台投影机照亮</translation>
    </message>
    <message>
        <source>Checks done</source>
        <translation>检查完毕</translation>
    </message>
    <message>
        <source>%1 of every picture is seen</source>
        <translation>每个画面都可见 %1</translation>
    </message>
    <message>
        <source>Exposures, kept</source>
        <translation>曝光（已保留）</translation>
    </message>
    <message>
        <source>Check again to look with another one.</source>
        <translation>要用其他曝光查看，请再次检查。</translation>
    </message>
    <message>
        <source>Exposures, paused</source>
        <translation>曝光（已暂停）</translation>
    </message>
    <message>
        <source>places within it</source>
        <translation>内部的一些地方</translation>
    </message>
    <message>
        <source>All of the view, by one exposure or another.</source>
        <translation>整个视野，由这种或那种曝光覆盖。</translation>
    </message>
    <message>
        <source>All but %1 of the view, by one exposure or another.</source>
        <translation>视野中仅 %1 除外，由这种或那种曝光覆盖。</translation>
    </message>
    <message>
        <source>%1 too bright</source>
        <translation>%1 太亮</translation>
    </message>
    <message>
        <source>Keep the former camera</source>
        <translation>保留原来的相机</translation>
    </message>
    <message>
        <source>exposure %1, click to judge focus</source>
        <translation>曝光 %1，单击判断对焦</translation>
    </message>
    <message>
        <source>Checks under way</source>
        <translation>正在检查</translation>
    </message>
    <message>
        <source>Stop the checks</source>
        <translation>停止检查</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the checks begin with that.</source>
        <translation>请确认已清场：确认后检查随即开始。</translation>
    </message>
    <message>
        <source>as it was seen last, exposure %1</source>
        <translation>上次看到的画面，曝光 %1</translation>
    </message>
    <message>
        <source>%1 of full light was too bright in every exposure. “Check again” looks through the camera.</source>
        <translation>全光下有 %1 在每种曝光下都过亮。“重新检查”会通过相机查看。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::CameraRows</name>
    <message>
        <source>Cameras</source>
        <translation>相机</translation>
    </message>
    <message>
        <source>Look again</source>
        <translation>重新查找</translation>
    </message>
    <message>
        <source>Looking for cameras</source>
        <translation>正在查找相机</translation>
    </message>
    <message>
        <source>Cannot be used: %1</source>
        <translation>无法使用：%1</translation>
    </message>
    <message numerus="yes">
        <source>%1 pixels, %n bit(s), exposures %2 to %3</source>
        <translation>
            <numerusform>%1 像素，%n 位，曝光 %2 至 %3</numerusform>
        </translation>
    </message>
    <message>
        <source>Recommended: it tells faint light apart best</source>
        <translation>推荐：最能分辨微弱的光</translation>
    </message>
    <message>
        <source>Fewer bits: faint light is told apart less well</source>
        <translation>位数较少：微弱的光分辨较差</translation>
    </message>
    <message>
        <source>Recommended: its exposures cover most, from bright to dark</source>
        <translation>推荐：曝光范围从亮到暗最广</translation>
    </message>
    <message>
        <source>Fewer exposures: bright and dark are harder to cover</source>
        <translation>曝光范围较窄：较难兼顾明暗</translation>
    </message>
    <message>
        <source>Recommended: it has most pixels</source>
        <translation>推荐：像素最多</translation>
    </message>
    <message>
        <source>Fewer pixels than the first</source>
        <translation>像素比第一台少</translation>
    </message>
    <message>
        <source>As suitable as the first</source>
        <translation>与第一台同样合适</translation>
    </message>
    <message>
        <source>No camera answers. Check its cable and its power, and close other programs that use it.</source>
        <translation>没有相机响应。请检查线缆和电源，并关闭正在使用它的其他程序。</translation>
    </message>
    <message>
        <source>These are found here: webcams and other video devices, industrial cameras by GigE Vision or USB3 Vision, and still cameras on USB.</source>
        <translation>这里能找到：网络摄像头和其他视频设备、GigE Vision 或 USB3 Vision 工业相机，以及 USB 连接的照相机。</translation>
    </message>
    <message>
        <source>Any other is driven by a program of yours: go Back and choose “New venue by script”. The guide (F1) tells how cameras are set up.</source>
        <translation>其他相机可由您自己的程序驱动：请“返回”并选择“用脚本新建场地”。指南 (F1) 说明如何设置相机。</translation>
    </message>
    <message>
        <source>Any other is driven by a program of yours. The guide (F1) tells how cameras are set up.</source>
        <translation>其他相机可由您自己的程序驱动。指南 (F1) 说明如何设置相机。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ClusterPage</name>
    <message>
        <source>What is measured is safe.</source>
        <translation>已测得的数据是安全的。</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>已过期</translation>
    </message>
    <message>
        <source>Grouping again</source>
        <translation>正在重新聚类</translation>
    </message>
    <message>
        <source>Grouping</source>
        <translation>正在聚类</translation>
    </message>
    <message>
        <source>Reading the light transport</source>
        <translation>正在读取光传输</translation>
    </message>
    <message>
        <source>Preview content</source>
        <translation>预览内容</translation>
    </message>
    <message>
        <source>The clusters that are kept belong to an earlier threshold</source>
        <translation>已保存的簇属于以前的阈值</translation>
    </message>
    <message>
        <source>What you see here has been grouped again. Going on keeps it.</source>
        <translation>此处显示的是重新聚类的结果。继续即保存。</translation>
    </message>
    <message>
        <source>Cluster</source>
        <translation>聚类</translation>
    </message>
    <message>
        <source>Cluster map</source>
        <translation>簇图</translation>
    </message>
    <message>
        <source>click a pixel</source>
        <translation>单击一个像素</translation>
    </message>
    <message>
        <source>Error map</source>
        <translation>误差图</translation>
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
        <translation>簇的大小</translation>
    </message>
    <message>
        <source>Projector pixels in the cluster</source>
        <translation>簇内的投影机像素数</translation>
    </message>
    <message>
        <source>Clusters</source>
        <translation>簇</translation>
    </message>
    <message>
        <source>%1, %2: in no cluster</source>
        <translation>%1, %2：不属于任何簇</translation>
    </message>
    <message>
        <source>Error map, median %1</source>
        <translation>误差图，中位数 %1</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>距离</translation>
    </message>
    <message>
        <source>small, sharp</source>
        <translation>小，清晰</translation>
    </message>
    <message>
        <source>large, fast</source>
        <translation>大，快速</translation>
    </message>
    <message>
        <source>Share of the brightest</source>
        <translation>占最亮值的比例</translation>
    </message>
    <message>
        <source>more detail</source>
        <translation>更多细节</translation>
    </message>
    <message>
        <source>more speed</source>
        <translation>更快</translation>
    </message>
    <message>
        <source>Largest cluster</source>
        <translation>最大簇</translation>
    </message>
    <message>
        <source>fast</source>
        <translation>快速</translation>
    </message>
    <message>
        <source>exact</source>
        <translation>精确</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>结果</translation>
    </message>
    <message>
        <source>Light kept in clusters</source>
        <translation>簇内保留的光量</translation>
    </message>
    <message>
        <source>Median error</source>
        <translation>误差中位数</translation>
    </message>
    <message>
        <source>%1 px</source>
        <translation>%1 px</translation>
    </message>
    <message>
        <source>%1 of light</source>
        <translation>光量的 %1</translation>
    </message>
    <message numerus="yes">
        <source>%n cluster(s)</source>
        <translation>
            <numerusform>%n 个簇</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n cluster(s), median %1 px</source>
        <translation>
            <numerusform>%n 个簇，中位数 %1 px</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1, %2: %n projector pixel(s), error %3</source>
        <translation>
            <numerusform>%1, %2：%n 个投影机像素，误差 %3</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Cluster map, %n cluster(s), largest %1</source>
        <translation>
            <numerusform>簇图，%n 个簇，最大 %1</numerusform>
        </translation>
    </message>
    <message>
        <source>95 % of pixels below</source>
        <translation>95 % 的像素低于</translation>
    </message>
    <message numerus="yes">
        <source>%1, %2: %n projector pixel(s)</source>
        <translation>
            <numerusform>%1, %2：%n 个投影机像素</numerusform>
        </translation>
    </message>
    <message>
        <source>error</source>
        <translation>误差</translation>
    </message>
    <message>
        <source>limit %1</source>
        <translation>上限 %1</translation>
    </message>
    <message>
        <source>over %1</source>
        <translation>超过 %1</translation>
    </message>
    <message>
        <source>about %1</source>
        <translation>约 %1</translation>
    </message>
    <message>
        <source>Cut off by the size limit</source>
        <translation>被上限切掉</translation>
    </message>
    <message>
        <source>Films, frames a second</source>
        <translation>视频，每秒帧数</translation>
    </message>
    <message>
        <source>What this computer manages in Full HD with the light that Threshold keeps. The groups make no difference to it: films are solved in overlapping windows.</source>
        <translation>本机用阈值保留的光在全高清下能达到的速度。与分组无关：视频在相互重叠的窗口中求解。</translation>
    </message>
    <message>
        <source>Without a size limit, one cluster would cover %1 of the picture.</source>
        <translation>没有大小上限时，一个簇会占画面的 %1。</translation>
    </message>
    <message>
        <source>The surface is blurred across neighbouring pixels, so groups join up. The limit keeps them apart.</source>
        <translation>表面在相邻像素间模糊，各组因而相连。上限使它们分开。</translation>
    </message>
    <message>
        <source>The clusters that are kept belong to an earlier measurement</source>
        <translation>已保存的簇属于以前的测量</translation>
    </message>
    <message>
        <source>Films are shown by “All bounces, for films”, whatever the clusters are. Clusters tell which places light each other, and can be compared at Preview.</source>
        <translation>视频始终用“全部反射，用于视频”显示，与簇无关。簇说明哪些位置互相照亮，可在预览中比较。</translation>
    </message>
    <message>
        <source>See which parts of the surface light each other, and split them into groups that can be solved on their own.</source>
        <translation>查看表面哪些部分互相照亮，并分成可各自求解的组。</translation>
    </message>
    <message>
        <source>Grouped anew</source>
        <translation>已重新分组</translation>
    </message>
    <message>
        <source>Changed: it is applied as soon as you go on.</source>
        <translation>已更改：继续后即生效。</translation>
    </message>
    <message>
        <source>What was measured is too coarse to group. Go on measuring.</source>
        <translation>测量过于粗略，无法分组。请继续测量。</translation>
    </message>
    <message>
        <source>No light is strong enough to group.</source>
        <translation>没有足够强的光可以分组。</translation>
    </message>
    <message>
        <source>Reliefs need OpenGL, which is not there.</source>
        <translation>立体显示需要 OpenGL，但此处没有。</translation>
    </message>
    <message>
        <source>An error of %1 is normal here.</source>
        <translation>此处误差 %1 属正常。</translation>
    </message>
    <message>
        <source>Grouping drops the blur of the lens on purpose: little where it is sharp, 70 to 80 % where it is blurred. Look for patches that stand out from their surroundings.</source>
        <translation>聚类会有意舍弃镜头的模糊：清晰处很少，模糊处为 70 至 80 %。请查看与周围明显不同的斑块。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::CornerView</name>
    <message>
        <source>Top left corner, %1, %2.</source>
        <translation>左上角，%1, %2。</translation>
    </message>
    <message>
        <source>Top right corner, %1, %2.</source>
        <translation>右上角，%1, %2。</translation>
    </message>
    <message>
        <source>Bottom right corner, %1, %2.</source>
        <translation>右下角，%1, %2。</translation>
    </message>
    <message>
        <source>Bottom left corner, %1, %2.</source>
        <translation>左下角，%1, %2。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::DevicePage</name>
    <message>
        <source>A show is playing</source>
        <translation>节目正在播放</translation>
    </message>
    <message>
        <source>What is begun here shines in its place. The show is seen again once it has ended.</source>
        <translation>在此开始的工作会代替节目投影。结束后节目重新显示。</translation>
    </message>
    <message>
        <source>Another program plays a show of this venue</source>
        <translation>另一个程序正在播放此场地的节目</translation>
    </message>
    <message>
        <source>The show plays on.</source>
        <translation>节目继续播放。</translation>
    </message>
    <message>
        <source>End that show</source>
        <translation>结束那个节目</translation>
    </message>
    <message>
        <source>End the show</source>
        <translation>结束节目</translation>
    </message>
    <message>
        <source>Let it play</source>
        <translation>让它继续播放</translation>
    </message>
    <message>
        <source>The show that another program plays of this venue: the projector&apos;s screen goes dark.</source>
        <translation>另一个程序播放的此场地节目：投影机的屏幕会变黑。</translation>
    </message>
    <message>
        <source>Venue and playlist stay. An installed show starts again at the next log-in.</source>
        <translation>场地和播放列表保留。已安装的节目会在下次登录时重新开始。</translation>
    </message>
    <message>
        <source>Its pictures shine on the projector whatever is shown from here, and may come between patterns that are measured.</source>
        <translation>无论此处显示什么，它的画面都会出现在投影机上，也可能插到被测量的图案之间。</translation>
    </message>
    <message>
        <source>It is ending</source>
        <translation>正在结束</translation>
    </message>
    <message>
        <source>The show that another program plays of another venue: the projector&apos;s screen goes dark.</source>
        <translation>另一个程序播放的另一场地的节目：投影机的屏幕将变暗。</translation>
    </message>
    <message>
        <source>Another program plays a show of another venue on this projector</source>
        <translation>另一个程序正在此投影机上播放另一场地的节目</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged. Plug it in again: the show comes back by itself.</source>
        <translation>投影机的屏幕已断开。重新接上后，节目会自动恢复。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::DeviceSelector</name>
    <message>
        <source>Projector that is shown</source>
        <translation>所显示的投影机</translation>
    </message>
    <message>
        <source>Camera that is shown</source>
        <translation>所显示的相机</translation>
    </message>
</context>
<context>
    <name>relucent::gui::EndingDialog</name>
    <message>
        <source>Ending</source>
        <translation>正在结束</translation>
    </message>
    <message>
        <source>Ending…</source>
        <translation>正在结束…</translation>
    </message>
    <message>
        <source>Everything that was measured is safe. The devices finish what they are doing, which can take half a minute; then this window closes by itself.</source>
        <translation>所有测量结果都是安全的。设备正在完成手头的工作，可能需要半分钟；之后此窗口会自动关闭。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::FailureDialog</name>
    <message>
        <source>The disk did not do what was asked</source>
        <translation>磁盘未完成所要求的操作</translation>
    </message>
    <message>
        <source>The memory is full</source>
        <translation>内存已满</translation>
    </message>
    <message>
        <source>A file cannot be read</source>
        <translation>文件无法读取</translation>
    </message>
    <message>
        <source>This cannot be done as it is</source>
        <translation>在当前情况下无法执行</translation>
    </message>
    <message>
        <source>The computation failed</source>
        <translation>计算失败</translation>
    </message>
    <message>
        <source>What happened</source>
        <translation>发生了什么</translation>
    </message>
    <message>
        <source>What is safe</source>
        <translation>哪些是安全的</translation>
    </message>
    <message>
        <source>What to do</source>
        <translation>怎么办</translation>
    </message>
    <message>
        <source>Copy details</source>
        <translation>复制详细信息</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>关闭</translation>
    </message>
    <message>
        <source>What it ends</source>
        <translation>将会结束</translation>
    </message>
    <message>
        <source>What happens</source>
        <translation>将会发生什么</translation>
    </message>
    <message>
        <source>A device did not do what was asked</source>
        <translation>一台设备未完成所要求的操作</translation>
    </message>
</context>
<context>
    <name>relucent::gui::FlashConsent</name>
    <message>
        <source>The projector shows patterns that change as quickly as the devices can, perhaps more than 3 times a second.</source>
        <translation>投影机以设备允许的最快速度切换图案，可能每秒超过 3 次。</translation>
    </message>
    <message>
        <source>The room is clear</source>
        <translation>已清场</translation>
    </message>
    <message>
        <source>Flashing light</source>
        <translation>闪光</translation>
    </message>
    <message>
        <source>The room is clear and everyone here knows</source>
        <translation>已清场，且在场人员均已知悉</translation>
    </message>
    <message>
        <source>Flashing light can cause seizures. Clear the room and cover the entrance.</source>
        <translation>闪光可能诱发癫痫。请清场，并遮挡入口。</translation>
    </message>
    <message numerus="yes">
        <source>The projector shows patterns that change about %n time(s) a second, and at times more often.</source>
        <translation>
            <numerusform>投影机显示的图案每秒变化约 %n 次，有时更快。</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>relucent::gui::HelpWindow</name>
    <message>
        <source>Help</source>
        <translation>帮助</translation>
    </message>
    <message>
        <source>Search the guide</source>
        <translation>搜索指南</translation>
    </message>
    <message>
        <source>Pages of the guide</source>
        <translation>指南页面</translation>
    </message>
    <message>
        <source>The page</source>
        <translation>页面内容</translation>
    </message>
    <message>
        <source>No page holds these words.</source>
        <translation>没有页面包含这些词。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::IdentifyOverlay</name>
    <message>
        <source>%1, %2 × %3, %4 Hz</source>
        <translation>%1，%2 × %3，%4 Hz</translation>
    </message>
    <message>
        <source>Lines sharp? Then this is the projector&apos;s own resolution.</source>
        <translation>线条清晰吗？清晰则说明这是投影机的原生分辨率。</translation>
    </message>
    <message>
        <source>Screen %1</source>
        <translation>屏幕 %1</translation>
    </message>
</context>
<context>
    <name>relucent::gui::LinearizePage</name>
    <message>
        <source>The photographs of this step are still in the folder.</source>
        <translation>此步骤的照片仍在文件夹中。</translation>
    </message>
    <message>
        <source>Measuring, %1</source>
        <translation>正在测量，%1</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>已测量</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>已过期</translation>
    </message>
    <message>
        <source>Stopped by a failure</source>
        <translation>因故障停止</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>设备正由“%1”使用。</translation>
    </message>
    <message>
        <source>The colours do not add up. Continuing is recorded in the report.</source>
        <translation>三色之和与白色不符。若继续，将记入报告。</translation>
    </message>
    <message>
        <source>Measured in %1</source>
        <translation>测量用时 %1</translation>
    </message>
    <message>
        <source>Plan acquisition</source>
        <translation>规划采集</translation>
    </message>
    <message>
        <source>Continue anyway</source>
        <translation>仍然继续</translation>
    </message>
    <message>
        <source>Measure response</source>
        <translation>测量响应</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>停止</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>重新测量</translation>
    </message>
    <message>
        <source>These curves belong to earlier settings</source>
        <translation>这些曲线属于以前的设置</translation>
    </message>
    <message>
        <source>They still work and stay until the new ones are measured.</source>
        <translation>它们仍可使用，并会保留到新曲线测完。</translation>
    </message>
    <message>
        <source>Levels</source>
        <translation>色阶数</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>没有任何更改。</translation>
    </message>
    <message>
        <source>Try again</source>
        <translation>重试</translation>
    </message>
    <message>
        <source>Every photograph that was taken is on the disk. Trying again goes on from there.</source>
        <translation>已拍摄的照片都在磁盘上。重试会从中断处继续。</translation>
    </message>
    <message>
        <source>Linearize</source>
        <translation>线性化</translation>
    </message>
    <message>
        <source>Measure how much light each step of the projector&apos;s three colours really gives.</source>
        <translation>测量投影机三种颜色的每个色阶实际发出多少光。</translation>
    </message>
    <message>
        <source>Red</source>
        <translation>红</translation>
    </message>
    <message>
        <source>Green</source>
        <translation>绿</translation>
    </message>
    <message>
        <source>Blue</source>
        <translation>蓝</translation>
    </message>
    <message>
        <source>Sent to the projector</source>
        <translation>发送到投影机</translation>
    </message>
    <message>
        <source>Seen by the camera</source>
        <translation>相机所见</translation>
    </message>
    <message>
        <source>Pattern that the projector shows</source>
        <translation>投影机显示的图案</translation>
    </message>
    <message>
        <source>Last photograph</source>
        <translation>最近一张照片</translation>
    </message>
    <message>
        <source>Appears when measuring begins.</source>
        <translation>测量开始后显示。</translation>
    </message>
    <message>
        <source>%1, photograph %2</source>
        <translation>%1，第 %2 张照片</translation>
    </message>
    <message>
        <source>Response of the projector</source>
        <translation>投影机的响应</translation>
    </message>
    <message>
        <source>Level sent to the projector</source>
        <translation>发送到投影机的色阶</translation>
    </message>
    <message>
        <source>Light, % of full</source>
        <translation>光量，占全亮的 %</translation>
    </message>
    <message>
        <source>Light of every level, three colours</source>
        <translation>三种颜色各色阶的光量</translation>
    </message>
    <message>
        <source>as it is measured</source>
        <translation>测量过程中</translation>
    </message>
    <message numerus="yes">
        <source>%n level(s) a colour, drift removed</source>
        <translation>
            <numerusform>每色 %n 个色阶，已去除漂移</numerusform>
        </translation>
    </message>
    <message>
        <source>not measured yet</source>
        <translation>尚未测量</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>结果</translation>
    </message>
    <message>
        <source>Exposures</source>
        <translation>曝光</translation>
    </message>
    <message>
        <source>Chosen for this venue</source>
        <translation>为此场地选定</translation>
    </message>
    <message>
        <source>Measure with</source>
        <translation>测量方式</translation>
    </message>
    <message>
        <source>Levels a colour</source>
        <translation>每色色阶数</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>正在测量</translation>
    </message>
    <message>
        <source>Not measured yet</source>
        <translation>尚未测量</translation>
    </message>
    <message>
        <source>Whether the colours add up, the camera is linear and every level is brighter than the one below is told when all levels are measured.</source>
        <translation>所有色阶测完后，将说明三色之和是否与白色相符、相机是否线性、每个色阶是否都比低一级的亮。</translation>
    </message>
    <message>
        <source>The colours add up</source>
        <translation>三色之和与白色相符</translation>
    </message>
    <message>
        <source>Red, green and blue together give white within %1.</source>
        <translation>红、绿、蓝之和与白色相差不超过 %1。</translation>
    </message>
    <message>
        <source>The colours do not add up</source>
        <translation>三色之和与白色不符</translation>
    </message>
    <message>
        <source>White differs by %1 from its colours. Turn off “brilliant” or “dynamic” in the projector&apos;s menu, then measure again.</source>
        <translation>白色与三色之和相差 %1。请在投影机菜单中关闭“亮彩”或“动态”模式，然后重新测量。</translation>
    </message>
    <message>
        <source>The camera is linear</source>
        <translation>相机是线性的</translation>
    </message>
    <message>
        <source>The camera&apos;s curve is known</source>
        <translation>相机的曲线已知</translation>
    </message>
    <message>
        <source>Doubling the exposure doubles the signal.</source>
        <translation>曝光加倍，信号也加倍。</translation>
    </message>
    <message>
        <source>Its photographs are brought back to linear light.</source>
        <translation>它的照片会还原为线性光。</translation>
    </message>
    <message>
        <source>Curves rise everywhere</source>
        <translation>曲线处处上升</translation>
    </message>
    <message>
        <source>No level is darker than the one below it.</source>
        <translation>没有色阶比低一级的更暗。</translation>
    </message>
    <message>
        <source>Found while measuring</source>
        <translation>测量中的发现</translation>
    </message>
    <message numerus="yes">
        <source>About %n test pattern(s)</source>
        <translation>
            <numerusform>约 %n 个测试图案</numerusform>
        </translation>
    </message>
    <message>
        <source>Go on now</source>
        <translation>立即继续</translation>
    </message>
    <message>
        <source>Measuring with these settings. Stop to change them.</source>
        <translation>正在用这些设置测量。要更改请先停止。</translation>
    </message>
    <message>
        <source>Keep the earlier one</source>
        <translation>保留之前的</translation>
    </message>
    <message>
        <source>The earlier curves are used again, with all that followed from them.</source>
        <translation>重新使用之前的曲线及其后续的全部结果。</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>已测得的数据是安全的。</translation>
    </message>
    <message>
        <source>Black level</source>
        <translation>黑电平</translation>
    </message>
    <message>
        <source>Contrast</source>
        <translation>对比度</translation>
    </message>
    <message>
        <source>%1 of full light</source>
        <translation>全光的 %1</translation>
    </message>
    <message>
        <source>Colours within %1</source>
        <translation>颜色误差 %1</translation>
    </message>
    <message>
        <source>How far each level&apos;s light is from the fitted curve</source>
        <translation>每级的光与拟合曲线之差</translation>
    </message>
    <message>
        <source>within ±%1</source>
        <translation>在 ±%1 以内</translation>
    </message>
    <message>
        <source>One test pattern shows many levels side by side, so few patterns are enough.</source>
        <translation>一个测试图案并排显示许多级，因此只需少量图案。</translation>
    </message>
    <message>
        <source>Off the curve</source>
        <translation>与曲线的偏差</translation>
    </message>
    <message>
        <source>Residuals: what was photographed, less the curve that was fitted to it.</source>
        <translation>残差：拍摄值减去拟合曲线。</translation>
    </message>
    <message>
        <source>Off the curve, % of full</source>
        <translation>与曲线的偏差，满值的 %</translation>
    </message>
    <message>
        <source>Stopping after the photograph under way.</source>
        <translation>在当前照片之后停止。</translation>
    </message>
    <message>
        <source>To measure again, confirm that the room is clear.</source>
        <translation>要重新测量，请确认已清场。</translation>
    </message>
    <message>
        <source>Colours off by %1</source>
        <translation>颜色偏差 %1</translation>
    </message>
    <message>
        <source>The photographs contradict each other. See that nothing covers the lens, then measure again.</source>
        <translation>照片相互矛盾。请确认没有东西遮挡镜头，然后重新测量。</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the patterns flash.</source>
        <translation>请确认已清场：图案会闪烁。</translation>
    </message>
    <message>
        <source>The photographs contradict each other</source>
        <translation>照片相互矛盾</translation>
    </message>
    <message>
        <source>White differs by %1 from its colours, and levels by up to %2 from their curve: no picture mode does that. Something covered the lens or the picture, or the light changed. Nothing else is told from these photographs; measure again.</source>
        <translation>白色与各颜色之和相差 %1，各级与其曲线最多相差 %2：没有任何画面模式会造成这种情况。有东西遮住了镜头或画面，或者光线发生了变化。从这些照片无法得出其他结论；请重新测量。</translation>
    </message>
    <message>
        <source>The camera sees hardly any light of the projector</source>
        <translation>相机几乎看不到投影机的光</translation>
    </message>
    <message>
        <source>See that nothing covers the lens or the picture. What is photographed meanwhile is lost: stop, and measure again.</source>
        <translation>请确认没有东西遮挡镜头或画面。此间拍摄的照片无效：请停止并重新测量。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MainWindow</name>
    <message>
        <source>Dim pictures</source>
        <translation>调暗图像</translation>
    </message>
    <message>
        <source>Pictures dimmed</source>
        <translation>图像已调暗</translation>
    </message>
    <message>
        <source>Settings</source>
        <translation>设置</translation>
    </message>
    <message>
        <source>Help</source>
        <translation>帮助</translation>
    </message>
    <message>
        <source>F1</source>
        <translation>F1</translation>
    </message>
    <message>
        <source>Less light from this screen falls into the room (F9)</source>
        <translation>减少本屏幕落入场内的光 (F9)</translation>
    </message>
    <message>
        <source>Undone: %1</source>
        <translation>已撤销：%1</translation>
    </message>
    <message>
        <source>Nothing to undo here</source>
        <translation>此处没有可撤销的操作</translation>
    </message>
    <message>
        <source>Done again: %1</source>
        <translation>已重做：%1</translation>
    </message>
    <message>
        <source>Nothing to do again</source>
        <translation>没有可重做的操作</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MaskEditing</name>
    <message>
        <source>This is no mask: %1.</source>
        <translation>这不是遮罩：%1。</translation>
    </message>
    <message>
        <source>New mask</source>
        <translation>新遮罩</translation>
    </message>
    <message>
        <source>Outline of a mask</source>
        <translation>遮罩的轮廓</translation>
    </message>
    <message>
        <source>Feather of a mask</source>
        <translation>遮罩的羽化</translation>
    </message>
    <message>
        <source>Removed mask</source>
        <translation>删除的遮罩</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MaskView</name>
    <message numerus="yes">
        <source>Drawing a mask: %n point(s). Space sets one at %1, %2. Return closes it, Escape leaves it.</source>
        <translation>
            <numerusform>正在绘制遮罩：%n 个点。空格在 %1，%2 处放置一点。回车闭合，Escape 取消。</numerusform>
        </translation>
    </message>
    <message>
        <source>Point %1 of %2, %3, %4.</source>
        <translation>第 %1 点，共 %2 点，%3，%4。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::MatrixView</name>
    <message>
        <source>camera %1
projector %2</source>
        <translation>相机 %1
投影机 %2</translation>
    </message>
    <message>
        <source>%1
%2</source>
        <translation>%1
%2</translation>
    </message>
    <message>
        <source>transport</source>
        <translation>传输值</translation>
    </message>
    <message>
        <source>projector x, y</source>
        <translation>投影机 x, y</translation>
    </message>
    <message>
        <source>projector line</source>
        <translation>投影机像素行</translation>
    </message>
    <message>
        <source>camera x, y</source>
        <translation>相机 x, y</translation>
    </message>
    <message>
        <source>camera line</source>
        <translation>相机像素行</translation>
    </message>
    <message>
        <source>%1 across, %2 down</source>
        <translation>横向：%1，纵向：%2</translation>
    </message>
</context>
<context>
    <name>relucent::gui::NameDialog</name>
    <message>
        <source>Name</source>
        <translation>名称</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>取消</translation>
    </message>
    <message>
        <source>Type a name.</source>
        <translation>请输入名称。</translation>
    </message>
    <message>
        <source>It has this name.</source>
        <translation>已经是这个名称。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Nights</name>
    <message>
        <source>The venue was as it was measured.</source>
        <translation>场地与测量时一样。</translation>
    </message>
    <message>
        <source>Repaired.</source>
        <translation>已修复。</translation>
    </message>
    <message>
        <source>Something has changed, and no better picture came of a repair.</source>
        <translation>有变化，但修复没有得到更好的图像。</translation>
    </message>
    <message>
        <source>%1 dB</source>
        <translation>%1 dB</translation>
    </message>
    <message>
        <source>Photographed</source>
        <translation>实拍</translation>
    </message>
    <message>
        <source>Predicted</source>
        <translation>预测</translation>
    </message>
    <message>
        <source>Repaired</source>
        <translation>已修复</translation>
    </message>
    <message>
        <source>Alarm</source>
        <translation>警报</translation>
    </message>
    <message>
        <source>Days before the last night</source>
        <translation>距最后一夜的天数</translation>
    </message>
    <message>
        <source>Colour error ΔE</source>
        <translation>颜色误差 ΔE</translation>
    </message>
    <message numerus="yes">
        <source>%n night(s).</source>
        <translation>
            <numerusform>%n 夜。</numerusform>
        </translation>
    </message>
    <message>
        <source>Photographed: %1 to %2, last %3.</source>
        <translation>实拍：%1 至 %2，最后 %3。</translation>
    </message>
    <message>
        <source>Repairs: %1. Alarms: %2.</source>
        <translation>修复：%1。警报：%2。</translation>
    </message>
    <message>
        <source>Left out: %1</source>
        <translation>已略过：%1</translation>
    </message>
    <message>
        <source>Alarm: %1</source>
        <translation>警报：%1</translation>
    </message>
    <message numerus="yes">
        <source>%n picture(s) perfected.</source>
        <translation>
            <numerusform>已完善 %n 张图片。</numerusform>
        </translation>
    </message>
    <message>
        <source>Photographed: %1, predicted: %2.</source>
        <translation>实拍：%1，预测：%2。</translation>
    </message>
    <message>
        <source>Nobody was told: %1</source>
        <translation>未能通知任何人：%1</translation>
    </message>
    <message>
        <source>Quality, dB</source>
        <translation>质量，dB</translation>
    </message>
</context>
<context>
    <name>relucent::gui::NightsDialog</name>
    <message>
        <source>Quality over weeks</source>
        <translation>数周以来的质量</translation>
    </message>
    <message>
        <source>Colour error</source>
        <translation>颜色误差</translation>
    </message>
    <message>
        <source>What the photograph of each night&apos;s proof came to, beside what was predicted.</source>
        <translation>每夜验证照片的结果，以及预测值。</translation>
    </message>
    <message>
        <source>Quality of the picture, night by night</source>
        <translation>每夜的图像质量</translation>
    </message>
    <message>
        <source>What came of each night, the last one first</source>
        <translation>每夜的结果，最近的在前</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>关闭</translation>
    </message>
    <message>
        <source>Quality</source>
        <translation>质量</translation>
    </message>
    <message>
        <source>Colour error: CIEDE2000, less is better. Quality: peak signal-to-noise ratio, PSNR, in dB; more is better.</source>
        <translation>颜色误差：CIEDE2000，越小越好。质量：峰值信噪比（PSNR），单位 dB，越大越好。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::NightsPart</name>
    <message>
        <source>Every night</source>
        <translation>每夜</translation>
    </message>
    <message>
        <source>Quality over weeks</source>
        <translation>数周以来的质量</translation>
    </message>
    <message>
        <source>A chart of all nights, and what came of each.</source>
        <translation>所有夜晚的图表，以及每夜的结果。</translation>
    </message>
    <message>
        <source>There was no night yet</source>
        <translation>还没有夜间记录</translation>
    </message>
    <message>
        <source>Somebody has to look, %1</source>
        <translation>需要有人查看，%1</translation>
    </message>
    <message>
        <source>Left out, %1</source>
        <translation>已略过，%1</translation>
    </message>
    <message>
        <source>All is well, %1</source>
        <translation>一切正常，%1</translation>
    </message>
    <message>
        <source>Look after the picture</source>
        <translation>维护画面</translation>
    </message>
    <message>
        <source>never</source>
        <translation>从不</translation>
    </message>
    <message>
        <source>at %1</source>
        <translation>%1</translation>
    </message>
    <message>
        <source>A show can look after the picture by itself at night: it checks, repairs, perfects and proves, and tells here what came of it. Its camera has to stay where it is.</source>
        <translation>节目可在夜间自行维护画面：检查、修复、完善并验证，并在此说明结果。其相机必须留在原位。</translation>
    </message>
    <message>
        <source>No show of a rehearsal is looked after.</source>
        <translation>演练的节目不做维护。</translation>
    </message>
    <message>
        <source>The installed show has its first one at %1, if it plays by then. Its camera has to stay where it is.</source>
        <translation>已安装的节目若届时在播放，第一次将在 %1 进行。它的相机必须留在原处。</translation>
    </message>
    <message>
        <source>A night is under way</source>
        <translation>夜间维护正在进行</translation>
    </message>
    <message>
        <source>The show makes way while its picture is looked after. What comes of it is told here.</source>
        <translation>在维护画面期间，节目会让出投影。结果会显示在这里。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::NudgeDialog</name>
    <message>
        <source>fits</source>
        <translation>吻合</translation>
    </message>
    <message>
        <source>Turn the camera to the right and down.</source>
        <translation>把相机转向右下方。</translation>
    </message>
    <message>
        <source>Turn the camera to the right and up.</source>
        <translation>把相机转向右上方。</translation>
    </message>
    <message>
        <source>Turn the camera to the left and down.</source>
        <translation>把相机转向左下方。</translation>
    </message>
    <message>
        <source>Turn the camera to the left and up.</source>
        <translation>把相机转向左上方。</translation>
    </message>
    <message>
        <source>Turn the camera to the right.</source>
        <translation>把相机向右转。</translation>
    </message>
    <message>
        <source>Turn the camera to the left.</source>
        <translation>把相机向左转。</translation>
    </message>
    <message>
        <source>Turn the camera down.</source>
        <translation>把相机向下转。</translation>
    </message>
    <message>
        <source>Turn the camera up.</source>
        <translation>把相机向上转。</translation>
    </message>
    <message>
        <source>Tilt the camera clockwise.</source>
        <translation>把相机顺时针倾斜。</translation>
    </message>
    <message>
        <source>Tilt the camera anticlockwise.</source>
        <translation>把相机逆时针倾斜。</translation>
    </message>
    <message>
        <source>What the camera saw, and what it sees now</source>
        <translation>相机原来看到的和现在看到的</translation>
    </message>
    <message>
        <source>The projector shows full light. Left of the line stands what the camera saw when the venue was measured, right of it what it sees now.</source>
        <translation>投影机显示全光。线的左边是测量时相机看到的，右边是现在看到的。</translation>
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
        <translation>倾斜</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>关闭</translation>
    </message>
    <message>
        <source>Opening the devices</source>
        <translation>正在打开设备</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>已测量</translation>
    </message>
    <message>
        <source>Now</source>
        <translation>现在</translation>
    </message>
    <message>
        <source>%1 px to the right</source>
        <translation>向右 %1 px</translation>
    </message>
    <message>
        <source>%1 px to the left</source>
        <translation>向左 %1 px</translation>
    </message>
    <message>
        <source>%1 px down</source>
        <translation>向下 %1 px</translation>
    </message>
    <message>
        <source>%1 px up</source>
        <translation>向上 %1 px</translation>
    </message>
    <message>
        <source>%1°</source>
        <translation>%1°</translation>
    </message>
    <message>
        <source>Looking through the camera</source>
        <translation>正在查看相机画面</translation>
    </message>
    <message>
        <source>The camera looks where it looked.</source>
        <translation>相机朝向与原来一致。</translation>
    </message>
    <message>
        <source>Fasten it, look once more, and close this window.</source>
        <translation>固定好，再看一次，然后关闭此窗口。</translation>
    </message>
    <message>
        <source>The arrow shows where. If the projector was bumped instead, move its picture the other way.</source>
        <translation>箭头指示方向。如果被碰动的是投影机，请把它的画面朝相反方向移动。</translation>
    </message>
    <message>
        <source>What is seen is not the view that was measured.</source>
        <translation>看到的不是测量时的画面。</translation>
    </message>
    <message>
        <source>Turn the camera until both halves look alike. If they do, the light or the surface has changed.</source>
        <translation>转动相机直到两半看起来一样。如果已经一样，则是光线或表面变了。</translation>
    </message>
    <message>
        <source>Put the camera back</source>
        <translation>把相机放回原位</translation>
    </message>
    <message>
        <source>In a rehearsal it comes back by itself while you look.</source>
        <translation>排练时，它会在您观看时自行回到原位。</translation>
    </message>
    <message>
        <source>%1° clockwise</source>
        <translation>顺时针 %1°</translation>
    </message>
    <message>
        <source>%1° anticlockwise</source>
        <translation>逆时针 %1°</translation>
    </message>
    <message>
        <source>If the projector was bumped instead, move its picture the other way.</source>
        <translation>如果被碰的是投影机，请把它的画面向相反方向移动。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputPage</name>
    <message>
        <source>Projector&apos;s screen</source>
        <translation>投影机的屏幕</translation>
    </message>
    <message>
        <source>This screen</source>
        <translation>此屏幕</translation>
    </message>
    <message>
        <source>%1: measured ΔE %2, predicted %3</source>
        <translation>%1：实测 ΔE %2，预测 %3</translation>
    </message>
    <message>
        <source>Not photographed yet</source>
        <translation>尚未拍摄</translation>
    </message>
    <message>
        <source>One photograph shows whether the surface looks as predicted.</source>
        <translation>一张照片即可显示表面是否与预测相符。</translation>
    </message>
    <message>
        <source>Corrected</source>
        <translation>补偿后</translation>
    </message>
    <message>
        <source>Original</source>
        <translation>原图</translation>
    </message>
    <message>
        <source>%1 of the picture can be reached.</source>
        <translation>画面的 %1 可达。</translation>
    </message>
    <message>
        <source>The surface looks as predicted</source>
        <translation>表面与预测相符</translation>
    </message>
    <message>
        <source>The camera or projector may have moved.</source>
        <translation>相机或投影机可能移动过。</translation>
    </message>
    <message>
        <source>Error of the test patterns: %1, when measured %2. %3 of the view changed.</source>
        <translation>测试图案的误差：%1，测量时为 %2。视野的 %3 有变化。</translation>
    </message>
    <message>
        <source>The measurement still holds</source>
        <translation>测量仍然有效</translation>
    </message>
    <message>
        <source>Verification</source>
        <translation>验证</translation>
    </message>
    <message>
        <source>Take verification photograph</source>
        <translation>拍摄验证照片</translation>
    </message>
    <message>
        <source>Ctrl+Shift+V</source>
        <translation>Ctrl+Shift+V</translation>
    </message>
    <message>
        <source>Check for drift</source>
        <translation>检查漂移</translation>
    </message>
    <message>
        <source>Photographs the test patterns of the measurement again, ten or so.</source>
        <translation>重新拍摄测量时的测试图案，十张左右。</translation>
    </message>
    <message>
        <source>Hand over</source>
        <translation>交付</translation>
    </message>
    <message>
        <source>Save report</source>
        <translation>保存报告</translation>
    </message>
    <message>
        <source>Installed. The show starts at the next log-in, without camera or wizard.</source>
        <translation>已安装。下次登录时节目自动开始，无需相机或向导。</translation>
    </message>
    <message>
        <source>Playlist</source>
        <translation>播放列表</translation>
    </message>
    <message>
        <source>The picture stands in its middle, pixel for pixel.</source>
        <translation>画面按原始像素居中显示。</translation>
    </message>
    <message>
        <source>Still pictures: %1</source>
        <translation>静态图片：%1</translation>
    </message>
    <message>
        <source>Films and cross-fades use windows and steps, which are quick enough.</source>
        <translation>视频和交叉淡化使用“窗口与迭代”，其速度足够快。</translation>
    </message>
    <message>
        <source>Make the list again.</source>
        <translation>请重新创建列表。</translation>
    </message>
    <message>
        <source>Black</source>
        <translation>黑场</translation>
    </message>
    <message>
        <source>Frozen</source>
        <translation>已定格</translation>
    </message>
    <message>
        <source>Playing</source>
        <translation>正在播放</translation>
    </message>
    <message>
        <source>Add a picture or a film to the playlist.</source>
        <translation>请将图片或视频添加到播放列表。</translation>
    </message>
    <message>
        <source>Choose the projector&apos;s screen.</source>
        <translation>请选择投影机的屏幕。</translation>
    </message>
    <message>
        <source>Playing. Hold A to compare.</source>
        <translation>正在播放。按住 A 可对比。</translation>
    </message>
    <message>
        <source>Take a verification photograph, or install without proof.</source>
        <translation>请拍摄验证照片，或不经验证直接安装。</translation>
    </message>
    <message>
        <source>Nothing is projected before you open the output.</source>
        <translation>打开输出之前不会投影。</translation>
    </message>
    <message>
        <source>Install show</source>
        <translation>安装节目</translation>
    </message>
    <message>
        <source>Install without proof</source>
        <translation>不验证直接安装</translation>
    </message>
    <message>
        <source>Open output</source>
        <translation>打开输出</translation>
    </message>
    <message>
        <source>Play</source>
        <translation>播放</translation>
    </message>
    <message>
        <source>Freeze</source>
        <translation>定格</translation>
    </message>
    <message>
        <source>Show again</source>
        <translation>恢复显示</translation>
    </message>
    <message>
        <source>Close output</source>
        <translation>关闭输出</translation>
    </message>
    <message>
        <source>Add to the playlist</source>
        <translation>添加到播放列表</translation>
    </message>
    <message>
        <source>Remove from the playlist</source>
        <translation>从播放列表移除</translation>
    </message>
    <message>
        <source>Order of the playlist</source>
        <translation>播放列表顺序</translation>
    </message>
    <message>
        <source>Repeat</source>
        <translation>循环</translation>
    </message>
    <message>
        <source>Cross-fade</source>
        <translation>交叉淡化</translation>
    </message>
    <message>
        <source>The calibration is as it was.</source>
        <translation>校准数据保持不变。</translation>
    </message>
    <message>
        <source>Output</source>
        <translation>输出</translation>
    </message>
    <message>
        <source>Play corrected content, prove that it works with one photograph, and hand the venue over.</source>
        <translation>播放补偿后的内容，用一张照片验证效果，然后交付场地。</translation>
    </message>
    <message>
        <source>Playback</source>
        <translation>播放</translation>
    </message>
    <message>
        <source>frames a second</source>
        <translation>帧/秒</translation>
    </message>
    <message>
        <source>frame time</source>
        <translation>帧时间</translation>
    </message>
    <message>
        <source>frames late</source>
        <translation>超时帧</translation>
    </message>
    <message>
        <source>Seconds</source>
        <translation>秒</translation>
    </message>
    <message>
        <source>Frame time, ms</source>
        <translation>帧时间，ms</translation>
    </message>
    <message>
        <source>Frame times of the last minute</source>
        <translation>最近一分钟的帧时间</translation>
    </message>
    <message>
        <source>%1 ms</source>
        <translation>%1 ms</translation>
    </message>
    <message>
        <source>closed</source>
        <translation>已关闭</translation>
    </message>
    <message>
        <source>on %1</source>
        <translation>运行于 %1</translation>
    </message>
    <message>
        <source>still picture, on %1</source>
        <translation>静态图片，运行于 %1</translation>
    </message>
    <message>
        <source>On the projector now</source>
        <translation>投影机当前画面</translation>
    </message>
    <message>
        <source>What the projector shows</source>
        <translation>投影机显示的内容</translation>
    </message>
    <message>
        <source>Photograph of the surface</source>
        <translation>表面的照片</translation>
    </message>
    <message>
        <source>What was wanted at the left of the divider, the photograph at the right</source>
        <translation>分隔线左侧为目标，右侧为照片</translation>
    </message>
    <message>
        <source>No verification photograph has been taken.</source>
        <translation>尚未拍摄验证照片。</translation>
    </message>
    <message>
        <source>Photograph against wanted</source>
        <translation>照片与目标对比</translation>
    </message>
    <message>
        <source>colour difference</source>
        <translation>色差</translation>
    </message>
    <message>
        <source>Colour difference between the photograph and what was wanted</source>
        <translation>照片与目标之间的色差</translation>
    </message>
    <message>
        <source>A verification photograph shows here what is left to see.</source>
        <translation>拍摄验证照片后，此处显示剩余的差异。</translation>
    </message>
    <message>
        <source>taken %1</source>
        <translation>拍摄于 %1</translation>
    </message>
    <message>
        <source>Wanted</source>
        <translation>目标</translation>
    </message>
    <message>
        <source>Photograph</source>
        <translation>照片</translation>
    </message>
    <message>
        <source>Delete removes an item, Ctrl+Up and Ctrl+Down move it. Files can be dropped here.</source>
        <translation>Delete 移除条目，Ctrl+Up 和 Ctrl+Down 移动条目。可将文件拖放到此处。</translation>
    </message>
    <message>
        <source>%1, playing</source>
        <translation>%1，正在播放</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>添加</translation>
    </message>
    <message>
        <source>Add files to the playlist</source>
        <translation>将文件添加到播放列表</translation>
    </message>
    <message>
        <source>Move up</source>
        <translation>上移</translation>
    </message>
    <message>
        <source>Move down</source>
        <translation>下移</translation>
    </message>
    <message>
        <source>Cross-fade, tenths of a second</source>
        <translation>交叉淡化，单位为十分之一秒</translation>
    </message>
    <message>
        <source>Add pictures or films</source>
        <translation>添加图片或视频</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>Skipped: %1</source>
        <translation>已跳过：%1</translation>
    </message>
    <message>
        <source>This screen&apos;s resolution is not that of the projector that was measured.</source>
        <translation>此屏幕的分辨率与测量时的投影机不同。</translation>
    </message>
    <message>
        <source>Written to %1, and for paper to report.pdf beside it.</source>
        <translation>已写入 %1，打印用的 report.pdf 在其旁边。</translation>
    </message>
    <message>
        <source>The projector is another screen now</source>
        <translation>投影机现在是另一个屏幕</translation>
    </message>
    <message>
        <source>Show installed</source>
        <translation>节目已安装</translation>
    </message>
    <message>
        <source>Installed at %1: the show starts at the next log-in. Hold A to compare.</source>
        <translation>已于 %1 安装：下次登录时开始播放。按住 A 可比较。</translation>
    </message>
    <message>
        <source>The output will cover this window. Esc closes the output.</source>
        <translation>输出将盖住此窗口。按 Esc 关闭输出。</translation>
    </message>
    <message>
        <source>Install again</source>
        <translation>重新安装</translation>
    </message>
    <message>
        <source>The projector&apos;s screen %1 is not there. Plug it in, or choose another.</source>
        <translation>投影机的屏幕 %1 不在。请接上，或选择另一个。</translation>
    </message>
    <message>
        <source>Choose a screen for projector %1.</source>
        <translation>请为投影机 %1 选择屏幕。</translation>
    </message>
    <message numerus="yes">
        <source>Each of the %n projector(s) needs a screen of its own. Plug in another one.</source>
        <translation>
            <numerusform>%n 台投影机各需要一个屏幕。请再接上一个。</numerusform>
        </translation>
    </message>
    <message>
        <source>There is one screen only. Plug the projector in and extend the desktop to it, or choose this screen.</source>
        <translation>只有一个屏幕。请接上投影机并把桌面扩展到它，或选择此屏幕。</translation>
    </message>
    <message>
        <source>still picture, %1 of the pixels at their limit</source>
        <translation>静态图像，%1 的像素达到极限</translation>
    </message>
    <message>
        <source>%1 fps, %2 ms, %3 of the pixels at their limit</source>
        <translation>%1 fps，%2 ms，%3 的像素达到极限</translation>
    </message>
    <message>
        <source>Screen unplugged</source>
        <translation>屏幕已断开</translation>
    </message>
    <message>
        <source>The surface does not look as predicted. Find out whether something moved.</source>
        <translation>表面与预测不符。请检查是否有东西移动过。</translation>
    </message>
    <message>
        <source>Something has changed since it was measured. Measure again, then install.</source>
        <translation>测量后有变化。请重新测量，然后安装。</translation>
    </message>
    <message>
        <source>Install anyway</source>
        <translation>仍然安装</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>重新测量</translation>
    </message>
    <message>
        <source>Aim again</source>
        <translation>重新对准</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged</source>
        <translation>投影机的屏幕已断开</translation>
    </message>
    <message>
        <source>Nothing is lost. Plug it in again: the show comes back by itself.</source>
        <translation>没有丢失任何内容。重新接上后，节目会自动恢复。</translation>
    </message>
    <message>
        <source>The camera&apos;s view has moved by %1 px sideways and %2 px up or down.</source>
        <translation>相机视野左右移动了 %1 px，上下移动了 %2 px。</translation>
    </message>
    <message>
        <source>Shows full light, and where the camera has to be turned to look where it looked.</source>
        <translation>显示全光，并指出相机应转向何处才能回到原来的视野。</translation>
    </message>
    <message>
        <source>Limit for %1 frames a second: %2 ms</source>
        <translation>每秒 %1 帧的上限：%2 ms</translation>
    </message>
    <message>
        <source>the processor</source>
        <translation>处理器</translation>
    </message>
    <message>
        <source>Next test chart (T)</source>
        <translation>下一个测试图卡 (T)</translation>
    </message>
    <message>
        <source>Figures over the picture (O)</source>
        <translation>在画面上显示数值 (O)</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>设备正由“%1”使用。</translation>
    </message>
    <message>
        <source>Put the camera back</source>
        <translation>把相机放回原位</translation>
    </message>
    <message>
        <source>On this page only</source>
        <translation>仅在此页面</translation>
    </message>
    <message>
        <source>The photograph is out of date</source>
        <translation>照片已过期</translation>
    </message>
    <message>
        <source>Another venue&apos;s show starts at log-in. Installing this one replaces it.</source>
        <translation>登录时会启动另一个场地的节目。安装本节目会将其替换。</translation>
    </message>
    <message>
        <source>Another venue&apos;s show starts at log-in. This is a rehearsal, which is not installed.</source>
        <translation>登录时会启动另一个场地的节目。这里是演练，不能安装。</translation>
    </message>
    <message>
        <source>Once installed, the show starts at every log-in, without camera or wizard.</source>
        <translation>安装后，每次登录时节目自动开始，无需相机或向导。</translation>
    </message>
    <message>
        <source>This is a rehearsal with simulated devices: its show is not installed. That of a real venue starts at every log-in.</source>
        <translation>这是使用模拟设备的演练：其节目不能安装。真实场地的节目会在每次登录时自动开始。</translation>
    </message>
    <message>
        <source>Remove installed show</source>
        <translation>移除已安装的节目</translation>
    </message>
    <message>
        <source>It does not start at log-in any more. Venue and playlist stay.</source>
        <translation>登录时不再启动。场地和播放列表会保留。</translation>
    </message>
    <message>
        <source>Proof out of date</source>
        <translation>验证已过期</translation>
    </message>
    <message>
        <source>Take a verification photograph: it proves that the venue is measured well.</source>
        <translation>请拍摄验证照片：它能证明场地测量得好。</translation>
    </message>
    <message>
        <source>This rehearsal plays on this page only: nothing is projected.</source>
        <translation>此演练仅在此页面播放：不投影任何内容。</translation>
    </message>
    <message>
        <source>Black: the show goes on unseen until you show it again.</source>
        <translation>黑场：节目在不可见的状态下继续，直到您再次显示。</translation>
    </message>
    <message>
        <source>Frozen: this picture stands until you press Play.</source>
        <translation>已定格：画面保持不变，直到您按“播放”。</translation>
    </message>
    <message>
        <source>Rehearsed to the end. A simulated venue is not installed. Hold A to compare.</source>
        <translation>演练已完成。模拟场地不能安装。按住 A 可对比。</translation>
    </message>
    <message>
        <source>The verification photograph is out of date</source>
        <translation>验证照片已过期</translation>
    </message>
    <message>
        <source>taken %1, out of date</source>
        <translation>拍摄于 %1，已过期</translation>
    </message>
    <message>
        <source>No screen chosen</source>
        <translation>未选择屏幕</translation>
    </message>
    <message>
        <source>%1, unplugged</source>
        <translation>%1，已断开</translation>
    </message>
    <message>
        <source>Not to be proved yet</source>
        <translation>尚不能验证</translation>
    </message>
    <message>
        <source>What it was taken of has been measured or chosen anew since, or is another set. Take it again to prove what is shown now.</source>
        <translation>拍摄之后又重新测量或更改过，或属于另一个方案。请重新拍摄，以验证现在显示的内容。</translation>
    </message>
    <message>
        <source>As predicted, but errors are plain to see</source>
        <translation>与预测相符，但误差明显可见</translation>
    </message>
    <message>
        <source>Nothing has moved: the prediction itself is coarse. Measuring finer or darker content helps.</source>
        <translation>没有东西移动：预测本身较粗糙。更细的测量或较暗的内容会有帮助。</translation>
    </message>
    <message>
        <source>Waiting for the projector&apos;s screen to come back.</source>
        <translation>正在等待投影机的屏幕恢复。</translation>
    </message>
    <message>
        <source>What plays is not what was measured or chosen last. Show that first.</source>
        <translation>正在播放的不是最近测量或选择的结果。请先显示它。</translation>
    </message>
    <message>
        <source>Look at it first</source>
        <translation>先查看</translation>
    </message>
    <message>
        <source>What was measured or chosen since is not on the projector yet.</source>
        <translation>之后测量或选择的内容尚未投影。</translation>
    </message>
    <message>
        <source>What was measured or chosen since is not on the projector yet. Steps that are out of date count with what was chosen there before.</source>
        <translation>之后测量或选择的内容尚未投影。已过期的步骤沿用以前的选择。</translation>
    </message>
    <message>
        <source>The screen %1 is unplugged. Nothing is projected.</source>
        <translation>屏幕 %1 已断开。当前没有投影。</translation>
    </message>
    <message>
        <source>Camera %1: %2, as predicted</source>
        <translation>相机 %1：%2，与预测一致</translation>
    </message>
    <message>
        <source>Camera %1: %2, not as predicted</source>
        <translation>相机 %1：%2，与预测不符</translation>
    </message>
    <message>
        <source>The view of camera %3 has moved by %1 px sideways and %2 px up or down.</source>
        <translation>相机 %3 的画面横向移动了 %1 px，纵向移动了 %2 px。</translation>
    </message>
    <message>
        <source>Camera %1 or a projector may have moved.</source>
        <translation>相机 %1 或某台投影机可能移动了。</translation>
    </message>
    <message>
        <source>Something has changed. Repair the calibration.</source>
        <translation>有些东西变了。请修复校准。</translation>
    </message>
    <message>
        <source>Something has changed since it was measured. Repair the calibration: only that is measured again.</source>
        <translation>测量之后有些东西变了。请修复校准：只重新测量变化的部分。</translation>
    </message>
    <message>
        <source>Repair the calibration</source>
        <translation>修复校准</translation>
    </message>
    <message>
        <source>Nothing to repair</source>
        <translation>无需修复</translation>
    </message>
    <message>
        <source>The venue is as it was measured.</source>
        <translation>场地与测量时一样。</translation>
    </message>
    <message>
        <source>Not repaired</source>
        <translation>未修复</translation>
    </message>
    <message>
        <source>No better picture came of it: the measurement is used as before.</source>
        <translation>图像没有因此变好：仍照旧使用原来的测量。</translation>
    </message>
    <message>
        <source>Repaired, %1</source>
        <translation>已修复，%1</translation>
    </message>
    <message>
        <source>Colour error of a photographed picture: %1 before, %2 now.</source>
        <translation>所拍图像的颜色误差：之前 %1，现在 %2。</translation>
    </message>
    <message>
        <source>Finds what has changed, measures only that again, and keeps it if a photograph of the picture is better by it.</source>
        <translation>找出变化之处，只重新测量这些，如果所拍图像因此更好就保留。</translation>
    </message>
    <message>
        <source>Use the measurement before</source>
        <translation>使用之前的测量</translation>
    </message>
    <message>
        <source>Takes the repair back.</source>
        <translation>撤销修复。</translation>
    </message>
    <message>
        <source>arrival to light</source>
        <translation>从到达到投影</translation>
    </message>
    <message>
        <source>From a live picture&apos;s arrival at this computer until the projectors have it: the longest of the last five seconds. The way there is not in it.</source>
        <translation>实时画面从到达本机到交给投影机的时间：最近五秒内的最大值。传到本机所用的时间不计在内。</translation>
    </message>
    <message>
        <source>Connecting to %1</source>
        <translation>正在连接 %1</translation>
    </message>
    <message>
        <source>Lost: %1. %2</source>
        <translation>已中断：%1。%2</translation>
    </message>
    <message>
        <source>Add a stream</source>
        <translation>添加网络流</translation>
    </message>
    <message>
        <source>A live picture from the network, as cameras and encoders send it.</source>
        <translation>来自网络的实时画面，由摄像机或编码器发送。</translation>
    </message>
    <message>
        <source>Nothing has moved: of the light only %1 is kept at Threshold, so that bounces are missing, in the prediction too. Keep more of it.</source>
        <translation>没有任何移动：“阈值”只保留了 %1 的光，因此缺少反射光，预测中也一样。请保留更多。</translation>
    </message>
    <message>
        <source>The show of another venue will no longer start at log-in.</source>
        <translation>登录时将不再启动另一个场地的节目。</translation>
    </message>
    <message>
        <source>The show of this venue will no longer start at log-in.</source>
        <translation>登录时将不再启动此场地的节目。</translation>
    </message>
    <message>
        <source>Venue and playlist stay. It can be installed again from its venue&apos;s Output.</source>
        <translation>场地和播放列表会保留。可在该场地的“输出”中重新安装。</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>移除</translation>
    </message>
    <message>
        <source>Keep</source>
        <translation>保留</translation>
    </message>
    <message>
        <source>To end it, hold Esc for two seconds at the projector&apos;s screen.</source>
        <translation>要结束它，请在投影机屏幕上按住 Esc 两秒。</translation>
    </message>
    <message>
        <source>Test chart</source>
        <translation>测试图卡</translation>
    </message>
    <message>
        <source>A test chart is on the surface. T shows the next one, then the playlist.</source>
        <translation>表面上正显示测试图卡。按 T 显示下一个，然后回到播放列表。</translation>
    </message>
    <message>
        <source>Show the playlist</source>
        <translation>显示播放列表</translation>
    </message>
    <message>
        <source>A test chart is on the surface</source>
        <translation>表面上正显示测试图卡</translation>
    </message>
    <message>
        <source>The playlist runs on unseen until you show it again.</source>
        <translation>播放列表在不可见的状态下继续，直到您再次显示。</translation>
    </message>
    <message>
        <source>Times of sets</source>
        <translation>方案的时间</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>方案</translation>
    </message>
    <message>
        <source>Times of the day…</source>
        <translation>时间安排…</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1：%2</translation>
    </message>
    <message>
        <source>The installed show plays this one all day.</source>
        <translation>已安装的节目全天使用此方案。</translation>
    </message>
    <message>
        <source>The picture is being perfected.</source>
        <translation>正在完善图片。</translation>
    </message>
    <message>
        <source>The output is being opened.</source>
        <translation>正在打开输出。</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged.</source>
        <translation>投影机的屏幕已断开。</translation>
    </message>
    <message>
        <source>There is nothing else on the list.</source>
        <translation>列表中没有其他项目。</translation>
    </message>
    <message>
        <source>The playlist is empty.</source>
        <translation>播放列表为空。</translation>
    </message>
    <message>
        <source>There is no other set.</source>
        <translation>没有其他方案。</translation>
    </message>
    <message>
        <source>The show changes by itself, here too: %1</source>
        <translation>节目会自行切换，此处也一样：%1</translation>
    </message>
    <message>
        <source>Choose in the desktop&apos;s dialog what to show as %1</source>
        <translation>请在桌面的对话框中选择 %1 显示的内容</translation>
    </message>
    <message>
        <source>Add a screen or window</source>
        <translation>添加屏幕或窗口</translation>
    </message>
    <message>
        <source>The live picture of a screen of this computer, or of a window on it.</source>
        <translation>本机某个屏幕或其上窗口的实时画面。</translation>
    </message>
    <message>
        <source>A screen, chosen in the desktop&apos;s dialog</source>
        <translation>屏幕（在桌面的对话框中选择）</translation>
    </message>
    <message>
        <source>A window, chosen in the desktop&apos;s dialog</source>
        <translation>窗口（在桌面的对话框中选择）</translation>
    </message>
    <message>
        <source>Screen %1</source>
        <translation>屏幕 %1</translation>
    </message>
    <message>
        <source>Window %1</source>
        <translation>窗口 %1</translation>
    </message>
    <message>
        <source>There is no desktop whose screens could be shown.</source>
        <translation>没有可以显示其屏幕的桌面。</translation>
    </message>
    <message>
        <source>The camera is back at its place</source>
        <translation>相机已回到原位</translation>
    </message>
    <message>
        <source>Put the camera back, or repair the calibration.</source>
        <translation>请把相机放回原位，或修复校准。</translation>
    </message>
    <message>
        <source>Perfecting</source>
        <translation>正在精修</translation>
    </message>
    <message>
        <source>Photographing</source>
        <translation>正在拍摄</translation>
    </message>
    <message>
        <source>Checking for drift</source>
        <translation>正在检查漂移</translation>
    </message>
    <message>
        <source>Repairing</source>
        <translation>正在修复</translation>
    </message>
    <message>
        <source>The output is closed. Patterns to be photographed are projected.</source>
        <translation>输出已关闭。正在投影用于拍摄的图案。</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>停止</translation>
    </message>
    <message>
        <source>Not as predicted</source>
        <translation>与预测不符</translation>
    </message>
    <message>
        <source>The output is closed. The devices are in use at %1.</source>
        <translation>输出已关闭。设备正由“%1”使用。</translation>
    </message>
    <message>
        <source>Show the current correction</source>
        <translation>显示当前补偿</translation>
    </message>
    <message>
        <source>The projector still shows another correction. Show the current one, then take the photograph.</source>
        <translation>投影机仍在显示其他补偿。请先显示当前的补偿，再拍照。</translation>
    </message>
    <message>
        <source>Another correction</source>
        <translation>其他补偿</translation>
    </message>
    <message>
        <source>The camera&apos;s view has moved. Put it back, then photograph again.</source>
        <translation>相机视野移动了。请将其放回原位，然后重新拍照。</translation>
    </message>
    <message>
        <source>The show still plays another correction</source>
        <translation>节目仍在使用其他补偿</translation>
    </message>
    <message>
        <source>Another correction plays. Show the current one first.</source>
        <translation>正在播放其他补偿。请先显示当前的补偿。</translation>
    </message>
    <message>
        <source>Another correction still plays.</source>
        <translation>仍在播放其他补偿。</translation>
    </message>
    <message>
        <source>Covered by %1</source>
        <translation>被%1遮住</translation>
    </message>
    <message>
        <source>The projector shows the light of another step: %1</source>
        <translation>投影机正在显示另一步骤的光：%1</translation>
    </message>
    <message>
        <source>The show goes on behind it, and is seen again when that has ended.</source>
        <translation>节目在其后继续，结束后会重新显示。</translation>
    </message>
    <message>
        <source>The light of another step is before the show.</source>
        <translation>另一步骤的光显示在节目之前。</translation>
    </message>
    <message>
        <source>Time of a picture</source>
        <translation>图片的显示时间</translation>
    </message>
    <message>
        <source>%1, skipped</source>
        <translation>%1，已跳过</translation>
    </message>
    <message>
        <source>Seconds that the chosen picture stands</source>
        <translation>所选图片显示的秒数</translation>
    </message>
    <message>
        <source> s</source>
        <translation> s</translation>
    </message>
    <message>
        <source>Picture stands for</source>
        <translation>图片显示时间</translation>
    </message>
    <message>
        <source>Photographed %1.</source>
        <translation>拍摄于 %1。</translation>
    </message>
    <message>
        <source>Photographed %1, before the last check for drift.</source>
        <translation>拍摄于 %1，早于最近一次漂移检查。</translation>
    </message>
    <message>
        <source>The surface looked as predicted then</source>
        <translation>当时表面与预测相符</translation>
    </message>
    <message>
        <source>Checked %1.</source>
        <translation>检查于 %1。</translation>
    </message>
    <message>
        <source>Hold A for the original, Ctrl+P freezes, B makes it black, T shows test charts, O figures.</source>
        <translation>按住 A 显示原图，Ctrl+P 定格，B 变黑，T 显示测试图卡，O 显示数值。</translation>
    </message>
    <message>
        <source>No program here opens it: open it by hand, or take it to another computer.</source>
        <translation>此处没有可打开它的程序：请手动打开，或将其带到另一台计算机。</translation>
    </message>
    <message>
        <source>Picture: %1</source>
        <translation>图片：%1</translation>
    </message>
    <message>
        <source>The check was ended: the room is not said to be clear</source>
        <translation>检查已结束：不再确认已清场</translation>
    </message>
    <message>
        <source>It came to no result. Check again when the room is clear.</source>
        <translation>没有得出结果。清场后请再次检查。</translation>
    </message>
    <message>
        <source>The repair was ended: the room is not said to be clear</source>
        <translation>修复已结束：不再确认已清场</translation>
    </message>
    <message>
        <source>The measurement is used as before. Repair again when the room is clear.</source>
        <translation>测量照旧使用。清场后请再次修复。</translation>
    </message>
    <message>
        <source>The output is closed. A picture to be photographed is projected.</source>
        <translation>输出已关闭。正在投影用于拍摄的图片。</translation>
    </message>
    <message>
        <source>The room is brighter by %1 of full light.</source>
        <translation>房间变亮了全亮光的 %1。</translation>
    </message>
    <message>
        <source>The room is darker by %1 of full light.</source>
        <translation>房间变暗了全亮光的 %1。</translation>
    </message>
    <message>
        <source>The projector gives %1 of the light that it gave.</source>
        <translation>投影机的光为之前的 %1。</translation>
    </message>
    <message>
        <source>The output is closed. Nothing is projected from here.</source>
        <translation>输出已关闭。此处没有投影任何内容。</translation>
    </message>
    <message>
        <source>A photograph is being taken.</source>
        <translation>正在拍照。</translation>
    </message>
    <message>
        <source>Slowly, as the room is not said to be clear: nothing flashes.</source>
        <translation>因未确认清场而缓慢进行：不会闪烁。</translation>
    </message>
    <message>
        <source>It plays this playlist with the measurement that is in use by then.</source>
        <translation>届时会以当时使用的测量播放此播放列表。</translation>
    </message>
    <message>
        <source>The output is closed here. Another program plays a show of this venue.</source>
        <translation>此处的输出已关闭。另一个程序正在播放此场地的节目。</translation>
    </message>
    <message>
        <source>Hardly anything fits. Put the camera back or repair the calibration; if neither helps, aim and measure again.</source>
        <translation>几乎全都不符。请把相机放回原位或修复校准；若都无效，请重新对准并测量。</translation>
    </message>
    <message>
        <source>Almost nothing of the projector&apos;s light is seen. Look at the lens and at the projector, then check again.</source>
        <translation>几乎看不到投影机的光。请检查镜头和投影机，然后再检查一次。</translation>
    </message>
    <message>
        <source>Installed. The show starts at the next log-in, without wizard. The camera stays: at night it looks after the picture.</source>
        <translation>已安装。节目会在下次登录时开始，无需向导。相机留在原处：夜间由它照看画面。</translation>
    </message>
    <message>
        <source>Another program plays</source>
        <translation>另一个程序正在播放</translation>
    </message>
    <message>
        <source>Hardly anything fits. Put the camera back, repair the calibration, or aim and measure again.</source>
        <translation>几乎全都不符。请把相机放回原位、修复校准，或重新对准并测量。</translation>
    </message>
    <message>
        <source>Another program plays a show of this venue.</source>
        <translation>另一个程序正在播放此场地的节目。</translation>
    </message>
    <message>
        <source>The room&apos;s light has changed. Restore it and check again, or repair the calibration.</source>
        <translation>室内光线变了。请恢复原状后再检查，或修复校准。</translation>
    </message>
    <message>
        <source>The camera looks elsewhere</source>
        <translation>相机对着别处</translation>
    </message>
    <message>
        <source>It was left %1 px from where it looked when it was measured. Put it back, or repair the calibration.</source>
        <translation>它停在距测量时所对位置 %1 px 处。请放回原位，或修复校准。</translation>
    </message>
    <message>
        <source>Put the camera back, or measure again.</source>
        <translation>请把相机放回原位，或重新测量。</translation>
    </message>
    <message>
        <source>Something has changed. Measure again.</source>
        <translation>有些东西变了。请重新测量。</translation>
    </message>
    <message>
        <source>Hardly anything fits. Put the camera back, or aim and measure again.</source>
        <translation>几乎全都不符。请把相机放回原位，或重新对准并测量。</translation>
    </message>
    <message>
        <source>Keep the repaired one</source>
        <translation>保留修复后的</translation>
    </message>
    <message>
        <source>Use the measurement before?</source>
        <translation>使用之前的测量？</translation>
    </message>
    <message>
        <source>What was repaired is measured again if you repair once more.</source>
        <translation>如果再次修复，已修复的部分将重新测量。</translation>
    </message>
    <message>
        <source>The measurement from before the repair is used as it was, with all that followed from it.</source>
        <translation>将按原样使用修复之前的测量，以及由它得出的一切。</translation>
    </message>
    <message>
        <source>Screen %1, which this plays on</source>
        <translation>屏幕 %1（正在其上播放）</translation>
    </message>
    <message>
        <source>They are larger than predicted. A check for drift tells whether something has moved.</source>
        <translation>误差大于预测。检查漂移可知是否有东西移动了。</translation>
    </message>
    <message>
        <source>Once installed, the show starts at every log-in, without wizard. The camera stays: at night it looks after the picture.</source>
        <translation>安装后，每次登录时节目自动开始，无需向导。相机保留：它在夜间照看画面。</translation>
    </message>
    <message>
        <source>Take a verification photograph. What was found before is not settled.</source>
        <translation>请拍摄验证照片。之前发现的情况尚未解决。</translation>
    </message>
    <message>
        <source>The surface did not look as predicted. Open the output: it leads to what helps.</source>
        <translation>表面看起来与预测不符。请打开输出：它会引导您找到解决办法。</translation>
    </message>
    <message>
        <source>Black: the frozen picture stands unseen until you show it again.</source>
        <translation>黑屏：冻结的画面不可见，直到再次显示。</translation>
    </message>
    <message>
        <source>still picture, perfected by photographs</source>
        <translation>静态图像，已由照片完善</translation>
    </message>
    <message>
        <source>Nothing has moved: part of the picture is out of the projector&apos;s reach, in a shadow, darker than its black or brighter than its white there. Another picture, or another place for it, helps.</source>
        <translation>没有东西移动：图片的一部分超出投影机的能力，处在阴影中、比该处的黑更暗或比该处的白更亮。换一张图片或换个位置会有帮助。</translation>
    </message>
    <message>
        <source>Errors are plain to see</source>
        <translation>误差明显可见</translation>
    </message>
    <message>
        <source>The frozen picture stands unseen until you show it again.</source>
        <translation>冻结的画面仍在，重新显示之前看不到。</translation>
    </message>
    <message>
        <source>The output is closed here. Another program plays a show of another venue on this projector.</source>
        <translation>此处的输出已关闭。另一个程序正在此投影机上播放另一场地的节目。</translation>
    </message>
    <message>
        <source>Another program plays a show of another venue on this projector.</source>
        <translation>另一个程序正在此投影机上播放另一场地的节目。</translation>
    </message>
    <message>
        <source>Two shows at once</source>
        <translation>两个节目同时进行</translation>
    </message>
    <message>
        <source>The output is open here and in another program: whose picture is seen is not known. End one.</source>
        <translation>此处与另一个程序都打开了输出：不知道看到的是谁的画面。请结束其中一个。</translation>
    </message>
    <message>
        <source>Perhaps under another program&apos;s picture</source>
        <translation>可能在另一个程序的画面之下</translation>
    </message>
    <message>
        <source>Black: the test chart stands unseen. T shows the next one, then the playlist.</source>
        <translation>黑屏：测试图仍在但看不到。按 T 显示下一张，然后是播放列表。</translation>
    </message>
    <message>
        <source>Hide the figures</source>
        <translation>隐藏数字</translation>
    </message>
    <message>
        <source>Figures are on the surface</source>
        <translation>表面上显示着数字</translation>
    </message>
    <message>
        <source>Whoever is in the room reads them over the picture.</source>
        <translation>在场的人会在图像上看到它们。</translation>
    </message>
    <message>
        <source>Installed as it is. %1</source>
        <translation>已按现状安装。%1</translation>
    </message>
    <message>
        <source>Confirm that the room is clear: the patterns flash.</source>
        <translation>请确认已清场：图案会闪烁。</translation>
    </message>
    <message>
        <source>No picture has come yet: black</source>
        <translation>尚未收到画面：黑屏</translation>
    </message>
    <message>
        <source>The live picture is lost: black</source>
        <translation>实时画面已丢失：黑屏</translation>
    </message>
    <message>
        <source>The live picture is lost: its last one stands</source>
        <translation>实时画面已丢失：停留在最后一帧</translation>
    </message>
    <message>
        <source>A film plays to its end.</source>
        <translation>影片会播放到结束。</translation>
    </message>
    <message>
        <source>A part of the surface looks otherwise than predicted, by ΔE %1.</source>
        <translation>表面的一部分与预测不同，ΔE %1。</translation>
    </message>
    <message>
        <source>Installed, but the show cannot start with what was measured last.</source>
        <translation>已安装，但用最后一次测量无法开始节目。</translation>
    </message>
    <message>
        <source>Go on measuring, or use the earlier one, at Acquire.</source>
        <translation>请到“采集”继续测量，或使用先前的测量。</translation>
    </message>
    <message>
        <source>Go on measuring at Acquire.</source>
        <translation>请到“采集”继续测量。</translation>
    </message>
    <message>
        <source>What was measured is too coarse to place content. Go on measuring.</source>
        <translation>测量过于粗略，无法放置内容。请继续测量。</translation>
    </message>
    <message>
        <source>Not all was decided on what is measured now</source>
        <translation>并非所有选择都基于当前的测量</translation>
    </message>
    <message>
        <source>Steps that are out of date count with what was chosen there before.</source>
        <translation>已过期的步骤按之前在那里选择的内容计算。</translation>
    </message>
    <message>
        <source>The test patterns fit, the photograph does not</source>
        <translation>测试图案相符，照片不符</translation>
    </message>
    <message>
        <source>Few patterns can miss a small part. Where another photograph differs, too, a repair looks closer.</source>
        <translation>少量图案可能漏掉小的部分。如果再拍一张仍不相符，修复会更仔细地检查。</translation>
    </message>
    <message>
        <source>This picture was perfected after the photograph.</source>
        <translation>这张图片在拍照之后经过了完善。</translation>
    </message>
    <message>
        <source>In the camera&apos;s picture it is %1 from the left and %2 from the top.</source>
        <translation>它位于相机画面中距左侧 %1、距顶部 %2 处。</translation>
    </message>
    <message>
        <source>What was found before may have come of that: a photograph shows what is left of it.</source>
        <translation>此前的发现可能由此而来：验证照片会显示还剩下什么。</translation>
    </message>
    <message>
        <source>Black. %1</source>
        <translation>黑场。%1</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputPlaylist</name>
    <message>
        <source>Demonstration picture</source>
        <translation>演示图片</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputProjection</name>
    <message>
        <source>Open the output again.</source>
        <translation>请重新打开输出。</translation>
    </message>
    <message>
        <source>Relucent is projecting</source>
        <translation>Relucent 正在投影</translation>
    </message>
    <message>
        <source>%1, shown without OpenGL</source>
        <translation>%1，不用 OpenGL 显示</translation>
    </message>
    <message>
        <source>The output goes on as before.</source>
        <translation>输出照旧进行。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::OutputProof</name>
    <message>
        <source>No venue is open.</source>
        <translation>没有打开的场地。</translation>
    </message>
    <message>
        <source>A photograph is being taken.</source>
        <translation>正在拍照。</translation>
    </message>
    <message>
        <source>Drift is being checked.</source>
        <translation>正在检查漂移。</translation>
    </message>
    <message>
        <source>It is being repaired.</source>
        <translation>正在修复。</translation>
    </message>
    <message>
        <source>The report is being written.</source>
        <translation>正在写报告。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Perfecting</name>
    <message>
        <source>%1 The picture is shown as before. Try again.</source>
        <translation>%1 图片仍按原样显示。请重试。</translation>
    </message>
    <message>
        <source>The photographs found nothing better. The picture is shown as before.</source>
        <translation>照片未找到更好的结果。图片仍按原样显示。</translation>
    </message>
    <message>
        <source>The picture is being perfected</source>
        <translation>正在完善图片</translation>
    </message>
    <message numerus="yes">
        <source>%n photograph(s) by now. Keep the room as it is.</source>
        <translation>
            <numerusform>目前 %n 张照片。请保持室内不变。</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1: %2 before, %3 now, by %n photograph(s).</source>
        <translation>
            <numerusform>%1：之前 %2，现在 %3，共 %n 张照片。</numerusform>
        </translation>
    </message>
    <message>
        <source>This picture is perfected</source>
        <translation>此图片已完善</translation>
    </message>
    <message>
        <source>The picture is as it was</source>
        <translation>图片保持原样</translation>
    </message>
    <message>
        <source>Not perfected</source>
        <translation>未完善</translation>
    </message>
    <message>
        <source>A picture that stands can be corrected by photographs of itself, some eight of them. It is kept for this venue, placed as it is now.</source>
        <translation>静止图片可用其自身的照片（约八张）校正。结果按当前位置为此场地保存。</translation>
    </message>
    <message>
        <source>Perfect a picture</source>
        <translation>完善图片</translation>
    </message>
    <message>
        <source>Perfect this picture</source>
        <translation>完善此图片</translation>
    </message>
    <message>
        <source>Stop and keep the best</source>
        <translation>停止并保留最佳</translation>
    </message>
    <message>
        <source>Show it as before</source>
        <translation>恢复原来的显示</translation>
    </message>
    <message>
        <source>What the photographs corrected is dropped.</source>
        <translation>照片所作的校正将被丢弃。</translation>
    </message>
    <message>
        <source>Perfect it again</source>
        <translation>再次完善</translation>
    </message>
    <message>
        <source>No venue is open.</source>
        <translation>没有打开的场地。</translation>
    </message>
    <message>
        <source>The picture is being perfected.</source>
        <translation>正在完善图片。</translation>
    </message>
    <message>
        <source>perfected, %1 before, %2 now.</source>
        <translation>已完善，之前 %1，现在 %2。</translation>
    </message>
    <message>
        <source>Tried last, %1: %2</source>
        <translation>上次尝试，%1：%2</translation>
    </message>
    <message>
        <source>Slowly, as the room is not said to be clear: nothing flashes.</source>
        <translation>因未确认清场而缓慢进行：不会闪烁。</translation>
    </message>
    <message>
        <source>Picture: %1</source>
        <translation>图片：%1</translation>
    </message>
    <message>
        <source>Not perfected since it changed</source>
        <translation>更改后尚未完善</translation>
    </message>
    <message>
        <source>It was perfected for an earlier measurement, for another set, with other light or masks, or placed otherwise. That is kept, and is of no use now: perfect it once more.</source>
        <translation>它是为先前的测量、另一个方案、其他光照或遮罩，或另一种放置完善的。那些结果仍保留，但现在不适用：请再完善一次。</translation>
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
        <translation>按 Esc 返回</translation>
    </message>
</context>
<context>
    <name>relucent::gui::PreviewPage</name>
    <message>
        <source>Demonstration picture</source>
        <translation>演示图片</translation>
    </message>
    <message>
        <source>Content</source>
        <translation>内容</translation>
    </message>
    <message>
        <source>Change</source>
        <translation>更换</translation>
    </message>
    <message>
        <source>Whole</source>
        <translation>完整</translation>
    </message>
    <message>
        <source>Fill</source>
        <translation>填充</translation>
    </message>
    <message>
        <source>Stretch</source>
        <translation>拉伸</translation>
    </message>
    <message>
        <source>Place automatically</source>
        <translation>自动放置</translation>
    </message>
    <message>
        <source>In the largest upright rectangle that can be reached</source>
        <translation>放入可达范围内最大的正立矩形</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>光量</translation>
    </message>
    <message>
        <source>May stay too dark</source>
        <translation>允许过暗</translation>
    </message>
    <message>
        <source>Share of the content that may stay too dark, percent</source>
        <translation>内容中允许过暗的比例，百分比</translation>
    </message>
    <message>
        <source>Lift of the blacks</source>
        <translation>黑位提升</translation>
    </message>
    <message>
        <source>Lift of the blacks, percent</source>
        <translation>黑位提升，百分比</translation>
    </message>
    <message>
        <source>Reach</source>
        <translation>可达范围</translation>
    </message>
    <message>
        <source>Can be reached</source>
        <translation>可达</translation>
    </message>
    <message>
        <source>Too dark to reach</source>
        <translation>过暗，达不到</translation>
    </message>
    <message>
        <source>Never black enough</source>
        <translation>始终不够黑</translation>
    </message>
    <message>
        <source>Colour error</source>
        <translation>色差</translation>
    </message>
    <message>
        <source>Part of the picture gets no light from this projector.</source>
        <translation>画面的一部分得不到此投影机的光。</translation>
    </message>
    <message>
        <source>A second could fill it.</source>
        <translation>再加一台即可补上。</translation>
    </message>
    <message>
        <source>Choose a picture</source>
        <translation>选择图片</translation>
    </message>
    <message>
        <source>Fit</source>
        <translation>适配</translation>
    </message>
    <message>
        <source>Brightness</source>
        <translation>亮度</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>已测得的数据是安全的。</translation>
    </message>
    <message>
        <source>Picture</source>
        <translation>图片</translation>
    </message>
    <message>
        <source>The picture of before stays.</source>
        <translation>保留之前的图片。</translation>
    </message>
    <message>
        <source>Preparing the preview</source>
        <translation>正在准备预览</translation>
    </message>
    <message>
        <source>The corners cross over. Drag them apart.</source>
        <translation>四角交叉了。请将它们拖开。</translation>
    </message>
    <message>
        <source>Corners</source>
        <translation>四角</translation>
    </message>
    <message>
        <source>Automatic place</source>
        <translation>自动放置</translation>
    </message>
    <message>
        <source>Preparing</source>
        <translation>正在准备</translation>
    </message>
    <message>
        <source>%1 in reach</source>
        <translation>可达 %1</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>已过期</translation>
    </message>
    <message>
        <source>The preview is not prepared.</source>
        <translation>预览尚未准备好。</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>设备正由“%1”使用。</translation>
    </message>
    <message>
        <source>Predicting</source>
        <translation>正在预测</translation>
    </message>
    <message>
        <source>Predicted from the measurement. Nothing is projected now.</source>
        <translation>根据测量预测。当前没有投影。</translation>
    </message>
    <message>
        <source>Preview</source>
        <translation>预览</translation>
    </message>
    <message>
        <source>Place the content in the camera&apos;s view and see what the audience will see before you project it.</source>
        <translation>将内容放入相机视图，在投影前查看观众将看到的效果。</translation>
    </message>
    <message>
        <source>Audience view</source>
        <translation>观众视图</translation>
    </message>
    <message>
        <source>Reachable light</source>
        <translation>可达光量</translation>
    </message>
    <message>
        <source>Difference</source>
        <translation>差异</translation>
    </message>
    <message>
        <source>What the audience will see, uncorrected at the left of the divider and corrected at the right</source>
        <translation>观众将看到的画面：分隔线左侧未补偿，右侧已补偿</translation>
    </message>
    <message>
        <source>Colour difference between what is wanted and what is predicted</source>
        <translation>目标与预测之间的色差</translation>
    </message>
    <message>
        <source>Methods</source>
        <translation>方法</translation>
    </message>
    <message>
        <source>predicted for this content; click one to use it</source>
        <translation>针对此内容的预测；单击即可选用</translation>
    </message>
    <message>
        <source>Comparison of methods</source>
        <translation>方法比较</translation>
    </message>
    <message>
        <source>Method</source>
        <translation>方法</translation>
    </message>
    <message>
        <source>Notes</source>
        <translation>备注</translation>
    </message>
    <message>
        <source>blind to bounces</source>
        <translation>不计间接反射</translation>
    </message>
    <message>
        <source>limit of this venue</source>
        <translation>此场地的极限</translation>
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
        <translation>未补偿</translation>
    </message>
    <message>
        <source>Corrected, predicted</source>
        <translation>补偿后，预测</translation>
    </message>
    <message>
        <source>of white</source>
        <translation>相对白色</translation>
    </message>
    <message>
        <source>The larger this share, the brighter the picture, and the more of it stays too dark.</source>
        <translation>此比例越大，画面越亮，亮度不足的部分也越多。</translation>
    </message>
    <message>
        <source>Part of the picture gets no light from any projector.</source>
        <translation>画面的一部分得不到任何投影机的光。</translation>
    </message>
    <message>
        <source>Another one could fill it.</source>
        <translation>再加一台可以补上。</translation>
    </message>
    <message>
        <source>Go to output</source>
        <translation>前往输出</translation>
    </message>
    <message>
        <source>under 1 ms</source>
        <translation>不到 1 ms</translation>
    </message>
    <message>
        <source>Uncorrected, too</source>
        <translation>同样未校正</translation>
    </message>
    <message>
        <source>What was measured is too coarse to place content. Go on measuring.</source>
        <translation>测量过于粗略，无法放置内容。请继续测量。</translation>
    </message>
    <message>
        <source>All of it can be reached</source>
        <translation>全部可达</translation>
    </message>
    <message>
        <source>no note</source>
        <translation>无备注</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is unplugged.</source>
        <translation>投影机的屏幕已断开。</translation>
    </message>
    <message>
        <source>On the surface now: the corrected picture.</source>
        <translation>当前在表面上：补偿后的画面。</translation>
    </message>
    <message>
        <source>On the surface now: the uncorrected picture.</source>
        <translation>当前在表面上：未补偿的画面。</translation>
    </message>
    <message>
        <source>Stop shining</source>
        <translation>停止投射</translation>
    </message>
    <message>
        <source>Shine on surface</source>
        <translation>投到表面</translation>
    </message>
    <message>
        <source>Shows this picture on the surface until you stop it or leave.</source>
        <translation>在表面上显示此画面，直到您停止或离开。</translation>
    </message>
    <message>
        <source>Show uncorrected</source>
        <translation>显示未补偿</translation>
    </message>
    <message>
        <source>Show corrected</source>
        <translation>显示已补偿</translation>
    </message>
    <message>
        <source>There is no preview yet.</source>
        <translation>尚无预览。</translation>
    </message>
    <message>
        <source>The projector&apos;s screen is not there. Plug it in and extend the desktop to it.</source>
        <translation>找不到投影机的屏幕。请接上并将桌面扩展到它。</translation>
    </message>
    <message>
        <source>The brightest light that can be reached; hatched where the content is out of reach</source>
        <translation>可达到的最亮光；内容无法达到之处为斜线</translation>
    </message>
    <message>
        <source>Hatched: %1 cannot be reached</source>
        <translation>斜线：%1 无法达到</translation>
    </message>
    <message>
        <source>It has been measured again since the content was placed</source>
        <translation>放置内容之后又测量过</translation>
    </message>
    <message>
        <source>The threshold has been changed since the content was placed</source>
        <translation>放置内容之后更改过阈值</translation>
    </message>
    <message>
        <source>What you see here is predicted anew. Going to the output keeps it.</source>
        <translation>这里显示的是重新预测的结果。前往输出即保存。</translation>
    </message>
    <message>
        <source>Still picture</source>
        <translation>静态图片</translation>
    </message>
    <message>
        <source>How long a still picture takes to be solved, once. Films always play by “All bounces, for films” in the quicker show engine: how fast is said at Cluster.</source>
        <translation>静态图片计算一次所需的时间。视频始终在更快的播放引擎中用“全部反射，用于视频”播放：速度见“聚类”。</translation>
    </message>
    <message>
        <source>Of this content, where it can be reached. What Acquire expects is a mean of other pictures: the two may differ by some dB.</source>
        <translation>此内容在可达范围内的数值。测量时的预期是其他图片的平均值：两者可能相差几 dB。</translation>
    </message>
    <message>
        <source>blind to light between clusters</source>
        <translation>不计簇间的光</translation>
    </message>
    <message>
        <source>recommended</source>
        <translation>推荐</translation>
    </message>
    <message>
        <source>Compare</source>
        <translation>比较</translation>
    </message>
    <message>
        <source>Hide</source>
        <translation>隐藏</translation>
    </message>
    <message>
        <source>This content comes to %1. Acquire expected %2 on average of three other pictures, by the recommended method.</source>
        <translation>此内容可达 %1。“采集”的预期是 %2：另外三张图片在推荐方法下的平均值。</translation>
    </message>
    <message>
        <source>Place of a camera</source>
        <translation>相机的位置</translation>
    </message>
    <message>
        <source>no content</source>
        <translation>没有内容</translation>
    </message>
    <message>
        <source>%1 dB, ΔE %2</source>
        <translation>%1 dB，ΔE %2</translation>
    </message>
    <message>
        <source>%1, counts %2</source>
        <translation>%1，占 %2</translation>
    </message>
    <message>
        <source>Views</source>
        <translation>视角</translation>
    </message>
    <message>
        <source>On the surface</source>
        <translation>贴合表面</translation>
    </message>
    <message>
        <source>Upright from here</source>
        <translation>此处看端正</translation>
    </message>
    <message>
        <source>Weight of this view</source>
        <translation>此视角的权重</translation>
    </message>
    <message>
        <source>Weight of the shown view, percent</source>
        <translation>所示视角的权重，百分比</translation>
    </message>
    <message>
        <source>For one viewer who moves</source>
        <translation>为一位走动的观众</translation>
    </message>
    <message>
        <source>Where the viewer stands, from the first camera to the last</source>
        <translation>观众所站的位置，从第一台相机到最后一台</translation>
    </message>
    <message>
        <source>Place in this view</source>
        <translation>在此视角中的位置</translation>
    </message>
    <message>
        <source>Weight of a view</source>
        <translation>视角的权重</translation>
    </message>
    <message>
        <source>Drag the cameras to where they stand, then move the viewer.</source>
        <translation>请将相机拖到其所在位置，然后移动观众。</translation>
    </message>
    <message>
        <source>As little as hides where projectors end</source>
        <translation>刚好隐藏投影机边缘的最小值</translation>
    </message>
    <message>
        <source>Place of the viewer</source>
        <translation>观众的位置</translation>
    </message>
    <message>
        <source>Contradiction</source>
        <translation>矛盾</translation>
    </message>
    <message>
        <source>How much worse a view is because of what the other views ask for</source>
        <translation>因其他视角的要求，此视角变差的程度</translation>
    </message>
    <message>
        <source>Comparing the views</source>
        <translation>正在比较各视角</translation>
    </message>
    <message>
        <source>Visibly worse because of other views: %1</source>
        <translation>因其他视角而明显变差：%1</translation>
    </message>
    <message>
        <source>Visibly worse because of other views</source>
        <translation>因其他视角而明显变差</translation>
    </message>
    <message>
        <source>Even</source>
        <translation>统一</translation>
    </message>
    <message>
        <source>One white for all pictures, as bright as most of the surface can show it.</source>
        <translation>所有画面使用同一个白色，亮度以大部分表面能够显示为准。</translation>
    </message>
    <message>
        <source>By picture</source>
        <translation>按画面</translation>
    </message>
    <message>
        <source>Each picture has the white at which the least of it is lost: dark ones become brighter, bright ones dimmer.</source>
        <translation>每幅画面使用损失最少的白色：暗的画面变亮，亮的画面变暗。</translation>
    </message>
    <message>
        <source>By region</source>
        <translation>按区域</translation>
    </message>
    <message>
        <source>The same for each part of the picture, smoothly from one to the next: the least is lost of all.</source>
        <translation>对画面的每个部分同样处理，并平滑过渡：损失最少。</translation>
    </message>
    <message>
        <source>How bright white is</source>
        <translation>白色的亮度</translation>
    </message>
    <message>
        <source>The picture is shown as before.</source>
        <translation>图片仍按原样显示。</translation>
    </message>
    <message>
        <source>Bright</source>
        <translation>明亮</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show are as bright as can be: white on a yellow wall turns yellow.</source>
        <translation>表面无法显示的颜色尽可能亮：黄墙上的白色会变黄。</translation>
    </message>
    <message>
        <source>Between</source>
        <translation>居中</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show become somewhat dimmer and shift less.</source>
        <translation>表面无法显示的颜色稍微变暗，偏色更少。</translation>
    </message>
    <message>
        <source>True</source>
        <translation>忠实</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show are dimmed until their hue is right: for faces and logos.</source>
        <translation>表面无法显示的颜色会调暗到色相正确：适合人脸和标志。</translation>
    </message>
    <message>
        <source>Colours out of reach</source>
        <translation>无法达到的颜色</translation>
    </message>
    <message>
        <source>Colours that the surface cannot show</source>
        <translation>表面无法显示的颜色</translation>
    </message>
    <message>
        <source>Uncertainty</source>
        <translation>不确定度</translation>
    </message>
    <message>
        <source>95 of 100 pixels come within this of what is predicted, in percent of white. More photographs or longer exposures make it smaller.</source>
        <translation>100 个像素中有 95 个与预测的偏差不超过此值，以白色的百分比表示。更多照片或更长曝光会使其变小。</translation>
    </message>
    <message>
        <source>How far the light may be from what is predicted, by the measurement&apos;s noise</source>
        <translation>由于测量噪声，光可能偏离预测多少</translation>
    </message>
    <message>
        <source>95 of 100 pixels come within the value shown, on average %1 of white</source>
        <translation>100 个像素中有 95 个在所示数值以内，平均为白色的 %1</translation>
    </message>
    <message>
        <source>Quality</source>
        <translation>质量</translation>
    </message>
    <message>
        <source>Detail kept</source>
        <translation>保留的细节</translation>
    </message>
    <message>
        <source>Peak signal-to-noise ratio, PSNR: 20 dB looks rough, 30 dB good.</source>
        <translation>峰值信噪比（PSNR）：20 dB 显得粗糙，30 dB 良好。</translation>
    </message>
    <message>
        <source>Structural similarity, SSIM: 1 is all of it.</source>
        <translation>结构相似度（SSIM）：1 表示全部保留。</translation>
    </message>
    <message>
        <source>What of it is shown</source>
        <translation>显示的内容</translation>
    </message>
    <message>
        <source>Mask %1</source>
        <translation>遮罩 %1</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1，%2</translation>
    </message>
    <message>
        <source>Masks</source>
        <translation>遮罩</translation>
    </message>
    <message>
        <source>No light falls on these parts: doors, windows, where visitors sit.</source>
        <translation>这些部分不受光照：门、窗、观众的座位。</translation>
    </message>
    <message>
        <source>Draw a mask</source>
        <translation>绘制遮罩</translation>
    </message>
    <message>
        <source>Click points in the picture, and the first one again to close. With the keyboard: arrow keys, Space, Return; Escape leaves it.</source>
        <translation>在画面中点击各点，再次点击第一个点即可闭合。用键盘：方向键、空格、回车；Escape 取消。</translation>
    </message>
    <message>
        <source>Straight</source>
        <translation>直线</translation>
    </message>
    <message>
        <source>Curved</source>
        <translation>曲线</translation>
    </message>
    <message>
        <source>How the points of the mask are joined</source>
        <translation>遮罩各点的连接方式</translation>
    </message>
    <message>
        <source>Feather</source>
        <translation>羽化</translation>
    </message>
    <message>
        <source>How far beyond the mask the light comes back, thousandths of the view</source>
        <translation>遮罩之外光恢复的范围，视野的千分之几</translation>
    </message>
    <message>
        <source>Remove the mask</source>
        <translation>删除遮罩</translation>
    </message>
    <message>
        <source>Stop drawing</source>
        <translation>停止绘制</translation>
    </message>
    <message>
        <source>errors weighed as an eye does</source>
        <translation>误差按人眼加权</translation>
    </message>
    <message>
        <source>No venue is open.</source>
        <translation>没有打开的场地。</translation>
    </message>
    <message>
        <source>The sets are as they were.</source>
        <translation>方案保持原样。</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>方案</translation>
    </message>
    <message>
        <source>Without a name</source>
        <translation>未命名</translation>
    </message>
    <message>
        <source>More</source>
        <translation>更多</translation>
    </message>
    <message>
        <source>More for the set</source>
        <translation>方案的更多操作</translation>
    </message>
    <message>
        <source>Save as…</source>
        <translation>另存为…</translation>
    </message>
    <message>
        <source>Rename…</source>
        <translation>重命名…</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>移除</translation>
    </message>
    <message>
        <source>It is placed automatically.</source>
        <translation>已自动放置。</translation>
    </message>
    <message>
        <source>A picture is on the surface.</source>
        <translation>表面上正显示图片。</translation>
    </message>
    <message>
        <source>The output is open. Close it first.</source>
        <translation>输出已打开。请先关闭。</translation>
    </message>
    <message>
        <source>Shine on %1</source>
        <translation>投到 %1</translation>
    </message>
    <message>
        <source>A rehearsal has no surface: this lights the screen %1 until you stop it or leave.</source>
        <translation>排练没有表面：在您停止或离开之前，这会点亮屏幕 %1。</translation>
    </message>
    <message>
        <source>Part of the picture lies where the view is left out.</source>
        <translation>画面的一部分位于被排除的区域。</translation>
    </message>
    <message>
        <source>It stays uncorrected. Acquire says why.</source>
        <translation>那里保持未校正。原因见“采集”。</translation>
    </message>
    <message>
        <source>Predicted from the measurement. The output stays as it is.</source>
        <translation>根据测量预测。输出保持不变。</translation>
    </message>
    <message>
        <source>The content was placed on another measurement or threshold</source>
        <translation>内容是在另一次测量或另一个阈值上放置的</translation>
    </message>
    <message>
        <source>To shine on the surface, close the output first.</source>
        <translation>要投到表面上，请先关闭输出。</translation>
    </message>
    <message>
        <source>Uncorrected, in blocks of %1 px</source>
        <translation>未校正，以 %1 px 的块显示</translation>
    </message>
    <message>
        <source>Predicted from the measurement. Another program&apos;s show is projected.</source>
        <translation>根据测量预测。正在投影另一个程序的节目。</translation>
    </message>
    <message>
        <source>The preview is being prepared.</source>
        <translation>正在准备预览。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::RenameDialog</name>
    <message>
        <source>Rename a venue</source>
        <translation>重命名场地</translation>
    </message>
    <message>
        <source>Its folder has the same name and is renamed with it. A show that starts at log-in follows.</source>
        <translation>其文件夹同名，会一并重命名。登录时开始的节目也会随之更新。</translation>
    </message>
    <message>
        <source>Rename</source>
        <translation>重命名</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Session</name>
    <message>
        <source>%1 is at work. What is chosen here can be kept when that has ended.</source>
        <translation>%1正在进行。结束后才能保留此处的选择。</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>设备正用于“%1”。</translation>
    </message>
    <message>
        <source>Confirm that the room is clear.</source>
        <translation>请确认已清场。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::SetNameDialog</name>
    <message>
        <source>Save as a set</source>
        <translation>另存为方案</translation>
    </message>
    <message>
        <source>Rename a set</source>
        <translation>重命名方案</translation>
    </message>
    <message>
        <source>Day, night, school class</source>
        <translation>白天、夜晚、学生团体</translation>
    </message>
    <message>
        <source>What you see becomes this set, and is changed in it from now on.</source>
        <translation>您看到的内容成为此方案，今后的更改都在其中进行。</translation>
    </message>
    <message>
        <source>Playlists and controllers that call it by its present name have to be changed, too.</source>
        <translation>以当前名称调用它的播放列表和控制器也须更改。</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>保存</translation>
    </message>
    <message>
        <source>Rename</source>
        <translation>重命名</translation>
    </message>
    <message>
        <source>There is a set of this name already.</source>
        <translation>已有同名方案。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::SetTimesDialog</name>
    <message>
        <source>Sets by the time of the day</source>
        <translation>按时间切换方案</translation>
    </message>
    <message>
        <source>From each time on the installed show plays that set, every day, until the next time.</source>
        <translation>已安装的节目每天从每个时间起使用该方案，直到下一个时间。</translation>
    </message>
    <message>
        <source>From this time on</source>
        <translation>从此时间起</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>方案</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>添加</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>移除</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>取消</translation>
    </message>
    <message>
        <source>Apply</source>
        <translation>应用</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1：%2</translation>
    </message>
    <message>
        <source>There are no times yet.</source>
        <translation>还没有时间。</translation>
    </message>
    <message>
        <source>Type a time of the day, such as %1.</source>
        <translation>请输入一天中的时间，例如 %1。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::SettingsDialog</name>
    <message>
        <source>Settings</source>
        <translation>设置</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>关闭</translation>
    </message>
    <message>
        <source>Look</source>
        <translation>外观</translation>
    </message>
    <message>
        <source>Dark</source>
        <translation>深色</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>浅色</translation>
    </message>
    <message>
        <source>Theme. The dark one is for the dark room.</source>
        <translation>主题。深色适合在暗处使用。</translation>
    </message>
    <message>
        <source>Dim pictures: the laptop is room light</source>
        <translation>调暗图像：笔记本屏幕也是环境光</translation>
    </message>
    <message>
        <source>As the computer</source>
        <translation>跟随系统</translation>
    </message>
    <message>
        <source>Language</source>
        <translation>语言</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>测量</translation>
    </message>
    <message>
        <source>As quickly as the devices can, after a consent</source>
        <translation>设备允许的最快速度，须经同意</translation>
    </message>
    <message numerus="yes">
        <source>At most %n change(s) a second</source>
        <translation>
            <numerusform>每秒最多变化 %n 次</numerusform>
        </translation>
    </message>
    <message>
        <source>Flashing light of the projector</source>
        <translation>投影机的闪光</translation>
    </message>
    <message>
        <source>More than three changes a second can cause seizures. Slower measuring needs no consent.</source>
        <translation>每秒变化超过三次可能诱发癫痫。放慢测量则无需同意。</translation>
    </message>
    <message>
        <source>A sound when a measurement ends</source>
        <translation>测量结束时播放提示音</translation>
    </message>
    <message>
        <source>New venues</source>
        <translation>新场地</translation>
    </message>
    <message>
        <source>Folder for new venues</source>
        <translation>新场地的文件夹</translation>
    </message>
    <message>
        <source>Choose a folder</source>
        <translation>选择文件夹</translation>
    </message>
    <message>
        <source>Folder</source>
        <translation>文件夹</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Show</name>
    <message>
        <source>A show is playing.</source>
        <translation>正在播放节目。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StatusPage</name>
    <message>
        <source>State</source>
        <translation>状态</translation>
    </message>
    <message>
        <source>Updated</source>
        <translation>更新时间</translation>
    </message>
    <message>
        <source>Computed on</source>
        <translation>计算设备</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>帧数</translation>
    </message>
    <message>
        <source>Late frames</source>
        <translation>迟到的帧</translation>
    </message>
    <message>
        <source>Frames per second</source>
        <translation>每秒帧数</translation>
    </message>
    <message>
        <source>Time per frame (ms)</source>
        <translation>每帧时间（毫秒）</translation>
    </message>
    <message>
        <source>Delay behind the viewer (ms)</source>
        <translation>相对观众的延迟（毫秒）</translation>
    </message>
    <message>
        <source>Clipped share</source>
        <translation>截断比例</translation>
    </message>
    <message>
        <source>Steps</source>
        <translation>步数</translation>
    </message>
    <message>
        <source>Perfected</source>
        <translation>已完善</translation>
    </message>
    <message>
        <source>Item</source>
        <translation>项目</translation>
    </message>
    <message>
        <source>Items skipped</source>
        <translation>跳过的项目</translation>
    </message>
    <message>
        <source>Failures</source>
        <translation>失败次数</translation>
    </message>
    <message>
        <source>Most memory used (bytes)</source>
        <translation>最高内存占用（字节）</translation>
    </message>
    <message>
        <source>Displays</source>
        <translation>显示器</translation>
    </message>
    <message>
        <source>Connector</source>
        <translation>接口</translation>
    </message>
    <message>
        <source>Shining</source>
        <translation>正在投射</translation>
    </message>
    <message>
        <source>Drawn by</source>
        <translation>绘制方式</translation>
    </message>
    <message>
        <source>Projectors</source>
        <translation>投影机</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>投影机</translation>
    </message>
    <message>
        <source>Address</source>
        <translation>地址</translation>
    </message>
    <message>
        <source>Answers</source>
        <translation>应答</translation>
    </message>
    <message>
        <source>Problem</source>
        <translation>问题</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>名称</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>型号</translation>
    </message>
    <message>
        <source>Power</source>
        <translation>电源</translation>
    </message>
    <message>
        <source>Shutter</source>
        <translation>快门</translation>
    </message>
    <message>
        <source>Lamp hours</source>
        <translation>灯泡小时数</translation>
    </message>
    <message>
        <source>Filter hours</source>
        <translation>滤网小时数</translation>
    </message>
    <message>
        <source>Input</source>
        <translation>输入</translation>
    </message>
    <message>
        <source>Signal</source>
        <translation>信号</translation>
    </message>
    <message>
        <source>Own pixels</source>
        <translation>自身像素</translation>
    </message>
    <message>
        <source>Remarks</source>
        <translation>备注</translation>
    </message>
    <message>
        <source>yes</source>
        <translation>是</translation>
    </message>
    <message>
        <source>no</source>
        <translation>否</translation>
    </message>
    <message>
        <source>Relucent: %1</source>
        <translation>Relucent：%1</translation>
    </message>
    <message>
        <source>Alarm</source>
        <translation>警报</translation>
    </message>
    <message>
        <source>Last night</source>
        <translation>上一夜</translation>
    </message>
    <message>
        <source>When</source>
        <translation>时间</translation>
    </message>
    <message>
        <source>Outcome</source>
        <translation>结果</translation>
    </message>
    <message>
        <source>Pictures perfected</source>
        <translation>已完善的图片</translation>
    </message>
    <message>
        <source>Colour error (ΔE)</source>
        <translation>颜色误差（ΔE）</translation>
    </message>
    <message>
        <source>Predicted colour error (ΔE)</source>
        <translation>预测的颜色误差（ΔE）</translation>
    </message>
    <message>
        <source>Nobody was told</source>
        <translation>未能通知任何人</translation>
    </message>
    <message>
        <source>Next night</source>
        <translation>下一夜</translation>
    </message>
    <message>
        <source>Somebody has to look</source>
        <translation>需要有人查看</translation>
    </message>
    <message>
        <source>Watched by camera</source>
        <translation>由相机监视</translation>
    </message>
    <message>
        <source>Photographs</source>
        <translation>照片</translation>
    </message>
    <message>
        <source>Photographs used</source>
        <translation>已采用的照片</translation>
    </message>
    <message>
        <source>Share that can be told</source>
        <translation>可判断的比例</translation>
    </message>
    <message>
        <source>Time per photograph (ms)</source>
        <translation>每张照片用时（毫秒）</translation>
    </message>
    <message>
        <source>What has changed</source>
        <translation>发生的变化</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>类型</translation>
    </message>
    <message>
        <source>How much</source>
        <translation>程度</translation>
    </message>
    <message>
        <source>What happened</source>
        <translation>发生了什么</translation>
    </message>
    <message>
        <source>What to do</source>
        <translation>该怎么做</translation>
    </message>
    <message>
        <source>Delay of the live picture (ms)</source>
        <translation>实时画面的延迟（毫秒）</translation>
    </message>
    <message>
        <source>Streams</source>
        <translation>网络流</translation>
    </message>
    <message>
        <source>Losses</source>
        <translation>中断次数</translation>
    </message>
    <message>
        <source>Pixels</source>
        <translation>像素</translation>
    </message>
    <message>
        <source>Time from the sender, by its clock (ms)</source>
        <translation>自发送端起的时间，按其时钟（毫秒）</translation>
    </message>
    <message>
        <source>Set</source>
        <translation>方案</translation>
    </message>
    <message>
        <source>Black</source>
        <translation>黑场</translation>
    </message>
    <message>
        <source>Frozen</source>
        <translation>已定格</translation>
    </message>
    <message>
        <source>Corrected</source>
        <translation>补偿后</translation>
    </message>
    <message>
        <source>Brightness</source>
        <translation>亮度</translation>
    </message>
    <message>
        <source>Test chart</source>
        <translation>测试图卡</translation>
    </message>
    <message>
        <source>starting</source>
        <translation>正在启动</translation>
    </message>
    <message>
        <source>playing</source>
        <translation>正在播放</translation>
    </message>
    <message>
        <source>resting until its hours</source>
        <translation>休息，等待播放时段</translation>
    </message>
    <message>
        <source>photographing</source>
        <translation>正在拍摄</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>失败</translation>
    </message>
    <message>
        <source>stopped</source>
        <translation>已停止</translation>
    </message>
    <message>
        <source>connecting</source>
        <translation>正在连接</translation>
    </message>
    <message>
        <source>asking whether it may</source>
        <translation>正在请求许可</translation>
    </message>
    <message>
        <source>lost</source>
        <translation>已中断</translation>
    </message>
    <message>
        <source>opening</source>
        <translation>正在打开</translation>
    </message>
    <message>
        <source>watching</source>
        <translation>正在监视</translation>
    </message>
    <message>
        <source>paused</source>
        <translation>已暂停</translation>
    </message>
    <message>
        <source>no camera</source>
        <translation>没有相机</translation>
    </message>
    <message>
        <source>no calibration</source>
        <translation>没有校准</translation>
    </message>
    <message>
        <source>black, until somebody ends it</source>
        <translation>黑场，直到有人结束</translation>
    </message>
    <message>
        <source>test chart</source>
        <translation>测试图</translation>
    </message>
    <message>
        <source>frozen, until somebody ends it</source>
        <translation>定格，直到有人结束</translation>
    </message>
    <message>
        <source>playing, but no display shows it</source>
        <translation>正在播放，但没有屏幕显示</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StatusStrip</name>
    <message>
        <source>Projector</source>
        <translation>投影机</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>相机</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>磁盘</translation>
    </message>
    <message>
        <source>none chosen</source>
        <translation>未选择</translation>
    </message>
    <message>
        <source>%1 free</source>
        <translation>可用 %1</translation>
    </message>
    <message>
        <source>simulated</source>
        <translation>模拟</translation>
    </message>
    <message>
        <source>by script</source>
        <translation>脚本</translation>
    </message>
    <message>
        <source>%1, in use</source>
        <translation>%1，使用中</translation>
    </message>
    <message>
        <source>Saved %1</source>
        <translation>保存于 %1</translation>
    </message>
    <message>
        <source>Room light</source>
        <translation>室内光</translation>
    </message>
    <message>
        <source>%1, unplugged</source>
        <translation>%1，未接上</translation>
    </message>
    <message>
        <source>%1 of full light, steady</source>
        <translation>全光的 %1，稳定</translation>
    </message>
    <message>
        <source>%1 of full light, changed</source>
        <translation>全光的 %1，已变化</translation>
    </message>
    <message>
        <source>%1, silent</source>
        <translation>%1，无响应</translation>
    </message>
    <message numerus="yes">
        <source>%n screen(s)</source>
        <translation>
            <numerusform>%n 个屏幕</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n with %1, %2</source>
        <comment>projectors and their pixels</comment>
        <translation>
            <numerusform>%n 台，%1，%2</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n, simulated</source>
        <comment>cameras</comment>
        <translation>
            <numerusform>%n 台，模拟</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n camera(s)</source>
        <translation>
            <numerusform>%n 台相机</numerusform>
        </translation>
    </message>
    <message>
        <source>none in use</source>
        <translation>未使用</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StepRail</name>
    <message>
        <source>locked</source>
        <translation>已锁定</translation>
    </message>
    <message>
        <source>done</source>
        <translation>已完成</translation>
    </message>
    <message>
        <source>out of date</source>
        <translation>已过期</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>失败</translation>
    </message>
    <message>
        <source>current</source>
        <translation>当前</translation>
    </message>
    <message>
        <source>open</source>
        <translation>待完成</translation>
    </message>
    <message>
        <source>Step %1, %2, %3</source>
        <translation>步骤 %1，%2，%3</translation>
    </message>
    <message>
        <source>No venue open</source>
        <translation>未打开场地</translation>
    </message>
    <message>
        <source>stopped early</source>
        <translation>提前停止</translation>
    </message>
    <message>
        <source>under way</source>
        <translation>进行中</translation>
    </message>
    <message>
        <source>doubtful</source>
        <translation>存疑</translation>
    </message>
    <message>
        <source>Opens once %1 is done.</source>
        <translation>完成“%1”后打开。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::StreamDialog</name>
    <message>
        <source>Add a stream</source>
        <translation>添加网络流</translation>
    </message>
    <message>
        <source>A live picture from the network, without its sound: RTSP, SRT, RTP, UDP, HTTP or RTMP. While it plays, this computer is connected to that address.</source>
        <translation>来自网络的实时画面，不含声音：RTSP、SRT、RTP、UDP、HTTP 或 RTMP。播放期间，本机与该地址保持连接。</translation>
    </message>
    <message>
        <source>Address</source>
        <translation>地址</translation>
    </message>
    <message>
        <source>User name and password stand before the host, as in rtsp://user:password@host. They are kept in the playlist, and shown nowhere.</source>
        <translation>用户名和密码写在主机之前，例如 rtsp://user:password@host。它们保存在播放列表中，不会显示在任何地方。</translation>
    </message>
    <message>
        <source>While it is lost</source>
        <translation>中断期间</translation>
    </message>
    <message>
        <source>Its last picture</source>
        <translation>最后的画面</translation>
    </message>
    <message>
        <source>Black</source>
        <translation>黑</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>取消</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>添加</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ThresholdPage</name>
    <message>
        <source>%1 of light kept</source>
        <translation>保留光量 %1</translation>
    </message>
    <message>
        <source>Out of date</source>
        <translation>已过期</translation>
    </message>
    <message>
        <source>Reading the light transport</source>
        <translation>正在读取光传输</translation>
    </message>
    <message>
        <source>Below 95 % of the light, bounces are lost.</source>
        <translation>光量低于 95 % 时会丢失间接反射。</translation>
    </message>
    <message>
        <source>Next: groups of pixels that can be solved on their own</source>
        <translation>下一步：可独立求解的像素组</translation>
    </message>
    <message>
        <source>Group into clusters</source>
        <translation>开始聚类</translation>
    </message>
    <message>
        <source>The threshold was chosen for an earlier measurement</source>
        <translation>阈值是为以前的测量选定的</translation>
    </message>
    <message>
        <source>Look at it again, then go on.</source>
        <translation>请重新查看，然后继续。</translation>
    </message>
    <message>
        <source>What is measured is safe.</source>
        <translation>已测得的数据是安全的。</translation>
    </message>
    <message>
        <source>Threshold</source>
        <translation>阈值</translation>
    </message>
    <message>
        <source>Choose the faintest light worth keeping. Less is faster and smaller; too little loses the bounces.</source>
        <translation>选择值得保留的最弱的光。保留越少，越快越小；太少会丢失间接反射。</translation>
    </message>
    <message>
        <source>Camera view</source>
        <translation>相机视图</translation>
    </message>
    <message>
        <source>The surface in full light</source>
        <translation>全亮时的表面</translation>
    </message>
    <message>
        <source>Pixel %1, %2</source>
        <translation>像素 %1, %2</translation>
    </message>
    <message>
        <source>Projector pixels that light the picked camera pixel</source>
        <translation>照亮所选相机像素的投影机像素</translation>
    </message>
    <message>
        <source>Pick a pixel in the camera view.</source>
        <translation>请在相机视图中选取一个像素。</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>相机</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>投影机</translation>
    </message>
    <message>
        <source>transport</source>
        <translation>传输值</translation>
    </message>
    <message>
        <source>Transport matrix</source>
        <translation>传输矩阵</translation>
    </message>
    <message>
        <source>click an entry</source>
        <translation>单击一个元素</translation>
    </message>
    <message>
        <source>Light transport matrix, camera pixels down, projector pixels across</source>
        <translation>光传输矩阵，纵向为相机像素，横向为投影机像素</translation>
    </message>
    <message>
        <source>Transport value, camera signal a second</source>
        <translation>传输值，每秒相机信号</translation>
    </message>
    <message>
        <source>How much light flows through each connection</source>
        <translation>各连接传输的光量</translation>
    </message>
    <message>
        <source>drag the cut, or use the arrow keys</source>
        <translation>拖动阈值线，或用方向键</translation>
    </message>
    <message>
        <source>Connections</source>
        <translation>连接数</translation>
    </message>
    <message>
        <source>Cut</source>
        <translation>阈值</translation>
    </message>
    <message>
        <source>Cut at %1, keeps %2</source>
        <translation>阈值 %1，保留 %2</translation>
    </message>
    <message>
        <source>Everything is kept</source>
        <translation>全部保留</translation>
    </message>
    <message>
        <source>Leave out light below</source>
        <translation>舍弃低于此值的光</translation>
    </message>
    <message>
        <source>One value</source>
        <translation>统一值</translation>
    </message>
    <message>
        <source>What stays</source>
        <translation>保留部分</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>光量</translation>
    </message>
    <message>
        <source>Memory</source>
        <translation>内存</translation>
    </message>
    <message>
        <source>What is left out is put back in proportion, so that the surface keeps its brightness.</source>
        <translation>舍弃的光会按比例补回，使表面亮度保持不变。</translation>
    </message>
    <message>
        <source>Picked pixel</source>
        <translation>所选像素</translation>
    </message>
    <message>
        <source>Lit by</source>
        <translation>照亮它的</translation>
    </message>
    <message>
        <source>Strongest</source>
        <translation>最强</translation>
    </message>
    <message>
        <source>From around it</source>
        <translation>来自其周围</translation>
    </message>
    <message>
        <source>Light from elsewhere</source>
        <translation>来自别处的光</translation>
    </message>
    <message>
        <source>Use suggested, %1</source>
        <translation>使用建议值 %1</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 / %2</translation>
    </message>
    <message>
        <source>Picked pixel %1, %2</source>
        <translation>所选像素 %1, %2</translation>
    </message>
    <message numerus="yes">
        <source>%n pixel(s)</source>
        <translation>
            <numerusform>%n 个像素</numerusform>
        </translation>
    </message>
    <message>
        <source>Cut, camera signal a second</source>
        <translation>阈值，每秒相机信号</translation>
    </message>
    <message>
        <source>Use picked pixel</source>
        <translation>使用所选像素</translation>
    </message>
    <message>
        <source>For each camera pixel</source>
        <translation>每个相机像素</translation>
    </message>
    <message>
        <source>Suggested: three times the noise of the measurement.</source>
        <translation>建议：测量噪声的三倍。</translation>
    </message>
    <message>
        <source>Suggested: keeps nearly all of the light.</source>
        <translation>建议：几乎保留全部光。</translation>
    </message>
    <message>
        <source>%1 on average</source>
        <translation>平均 %1</translation>
    </message>
    <message>
        <source>Kind of cut</source>
        <translation>截断方式</translation>
    </message>
    <message>
        <source>Share of each pixel</source>
        <translation>每像素占比</translation>
    </message>
    <message>
        <source>Share of the strongest light of each camera pixel, in tenths of a percent</source>
        <translation>占每个相机像素最强光的比例，以千分之一计</translation>
    </message>
    <message>
        <source>Below %1 of the strongest light that each camera pixel gets</source>
        <translation>低于每个相机像素所受最强光的 %1</translation>
    </message>
    <message>
        <source>Of each camera pixel the strongest connection always stays, however high the cut.</source>
        <translation>无论阈值多高，每个相机像素最强的连接始终保留。</translation>
    </message>
    <message>
        <source>“%1” is not a cut: type a number, 0 or more. The cut is still %2.</source>
        <translation>“%1”不是阈值：请输入 0 或更大的数。阈值仍为 %2。</translation>
    </message>
    <message>
        <source>At three times the noise, %1, only %2 of the light would stay: much faint light adds up. Suggested: keep everything.</source>
        <translation>按噪声的三倍（%1）截断，只剩 %2 的光：许多微弱的光合起来并不少。建议：全部保留。</translation>
    </message>
    <message>
        <source>Keep everything</source>
        <translation>全部保留</translation>
    </message>
    <message>
        <source>Changed: it is applied as soon as you go on.</source>
        <translation>已更改：继续后即生效。</translation>
    </message>
    <message>
        <source>What was measured is being read.</source>
        <translation>正在读取测量结果。</translation>
    </message>
    <message>
        <source>Pick a pixel in a picture.</source>
        <translation>请在图片中选择一个像素。</translation>
    </message>
    <message>
        <source>It is in use.</source>
        <translation>正在使用。</translation>
    </message>
    <message>
        <source>No light of the picked pixel was kept.</source>
        <translation>所选像素的光没有保留。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::TidyDialog</name>
    <message>
        <source>All</source>
        <translation>全部</translation>
    </message>
    <message>
        <source>Of the latest measurement</source>
        <translation>最近一次测量的照片</translation>
    </message>
    <message>
        <source>None: results only</source>
        <translation>无：仅保留结果</translation>
    </message>
    <message>
        <source>Only what nothing reads goes, and old files are compressed without loss.</source>
        <translation>只删除没有用到的内容，旧文件无损压缩。</translation>
    </message>
    <message>
        <source>Those that were set aside by measuring again go too. Nothing reads them.</source>
        <translation>重新测量时搁置的照片也会删除。它们不再有用。</translation>
    </message>
    <message>
        <source>All that was measured and computed stays. The photographs go.</source>
        <translation>测量和计算的结果全部保留，照片删除。</translation>
    </message>
    <message>
        <source>Showing, checking and reports need results only. Other settings, and better methods of later versions, then have to photograph everything again.</source>
        <translation>放映、检查和报告只需要结果。之后若用其他设置，或新版本更好的方法，则需要重新拍摄全部照片。</translation>
    </message>
    <message numerus="yes">
        <source>%n photograph(s)</source>
        <translation>
            <numerusform>%n 张照片</numerusform>
        </translation>
    </message>
    <message>
        <source>What was freed until then is free. Nothing that is needed is lost.</source>
        <translation>此前腾出的空间已经腾出。需要的内容没有丢失。</translation>
    </message>
    <message>
        <source>Photographs to keep</source>
        <translation>要保留的照片</translation>
    </message>
    <message>
        <source>This venue is not measured to the end.</source>
        <translation>此场地尚未测量完毕。</translation>
    </message>
    <message>
        <source>All its photographs stay: going on needs them.</source>
        <translation>照片全部保留：继续测量需要它们。</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>返回</translation>
    </message>
    <message>
        <source>Freeing the disk</source>
        <translation>正在腾出磁盘空间</translation>
    </message>
    <message>
        <source>%1 will be removed for good.</source>
        <translation>将永久删除 %1。</translation>
    </message>
    <message>
        <source>%1 will be freed.</source>
        <translation>将腾出 %1。</translation>
    </message>
    <message>
        <source>%1 freed, %2 removed</source>
        <translation>已腾出 %1，删除 %2</translation>
    </message>
    <message>
        <source>%1 Nothing that is needed is lost.</source>
        <translation>%1需要的内容没有丢失。</translation>
    </message>
    <message>
        <source>frees %1</source>
        <translation>腾出 %1</translation>
    </message>
    <message>
        <source>nothing to free</source>
        <translation>没有可腾出的</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>取消</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>停止</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>关闭</translation>
    </message>
    <message>
        <source>Free %1…</source>
        <translation>腾出 %1…</translation>
    </message>
    <message>
        <source>Free %1</source>
        <translation>腾出 %1</translation>
    </message>
    <message>
        <source>No photograph goes: everything stays possible.</source>
        <translation>不删除照片：一切操作照旧可行。</translation>
    </message>
    <message>
        <source>The latest measurement keeps its photographs: everything stays possible.</source>
        <translation>最近一次测量的照片保留：一切操作照旧可行。</translation>
    </message>
    <message>
        <source>Looking up what could be freed. Nothing is removed yet.</source>
        <translation>正在查找可以腾出的空间。尚未删除任何内容。</translation>
    </message>
    <message>
        <source>Free disk space</source>
        <translation>释放磁盘空间</translation>
    </message>
    <message>
        <source>Disk space of %1</source>
        <translation>%1 的磁盘空间</translation>
    </message>
    <message>
        <source>Freeing space was stopped.</source>
        <translation>释放空间已停止。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VenueNetwork</name>
    <message>
        <source>“%1” is no network address of a projector. Write its number or name, as 192.168.1.50.</source>
        <translation>“%1”不是投影机的网络地址。请写其数字地址或名称，例如 192.168.1.50。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VenuePage</name>
    <message>
        <source>Unplugged. Plug it in or choose another.</source>
        <translation>已断开。请重新接上或另选一个。</translation>
    </message>
    <message>
        <source>%1, %2 by %3, chosen</source>
        <translation>%1，%2 × %3，已选择</translation>
    </message>
    <message>
        <source>%1, %2 by %3</source>
        <translation>%1，%2 × %3</translation>
    </message>
    <message>
        <source>Screens</source>
        <translation>屏幕</translation>
    </message>
    <message>
        <source>Choose the one that shines on the surface. Its pixels are the projector&apos;s.</source>
        <translation>请选择照射表面的那个。其像素就是投影机的像素。</translation>
    </message>
    <message>
        <source>Identify screens</source>
        <translation>识别屏幕</translation>
    </message>
    <message>
        <source>I</source>
        <translation>I</translation>
    </message>
    <message>
        <source>The projector shares your screen</source>
        <translation>投影机与您共用屏幕</translation>
    </message>
    <message>
        <source>Real devices</source>
        <translation>真实设备</translation>
    </message>
    <message>
        <source>Projector</source>
        <translation>投影机</translation>
    </message>
    <message>
        <source>Glossy corner</source>
        <translation>光泽转角</translation>
    </message>
    <message>
        <source>Light bounces between two cards</source>
        <translation>光在两张卡片之间反射</translation>
    </message>
    <message>
        <source>Bust before a brick wall</source>
        <translation>砖墙前的胸像</translation>
    </message>
    <message>
        <source>Texture, shadow and light between surfaces</source>
        <translation>纹理、阴影和表面之间的光</translation>
    </message>
    <message>
        <source>Many depths</source>
        <translation>多种深度</translation>
    </message>
    <message>
        <source>Some surfaces are out of focus</source>
        <translation>部分表面离焦</translation>
    </message>
    <message>
        <source>Dome</source>
        <translation>穹顶</translation>
    </message>
    <message>
        <source>Every part lights every other part</source>
        <translation>每一部分都照亮其他各部分</translation>
    </message>
    <message>
        <source>Wine glass</source>
        <translation>葡萄酒杯</translation>
    </message>
    <message>
        <source>Light is refracted both ways</source>
        <translation>光沿两个方向折射</translation>
    </message>
    <message>
        <source>Painted wall</source>
        <translation>彩绘墙面</translation>
    </message>
    <message>
        <source>Flat, with diamonds; the easiest</source>
        <translation>平面，有菱形图案；最容易</translation>
    </message>
    <message>
        <source>%1, a first look</source>
        <translation>%1，初步了解</translation>
    </message>
    <message>
        <source>%1, quick</source>
        <translation>%1，快速</translation>
    </message>
    <message>
        <source>%1, usual</source>
        <translation>%1，常规</translation>
    </message>
    <message>
        <source>%1, fine</source>
        <translation>%1，精细</translation>
    </message>
    <message>
        <source>Venue</source>
        <translation>场地</translation>
    </message>
    <message>
        <source>Rehearse in a simulated venue</source>
        <translation>在模拟场地中演练</translation>
    </message>
    <message>
        <source>New venue by script</source>
        <translation>用脚本新建场地</translation>
    </message>
    <message>
        <source>New venue</source>
        <translation>新建场地</translation>
    </message>
    <message>
        <source>Say which screen shines, which programs show and photograph, and where the work is kept.</source>
        <translation>指定照射的屏幕、显示和拍摄的程序，以及数据的保存位置。</translation>
    </message>
    <message>
        <source>Setting up</source>
        <translation>正在设置</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1，%2</translation>
    </message>
    <message>
        <source>simulated, %1</source>
        <translation>模拟，%1</translation>
    </message>
    <message>
        <source>by script, %1</source>
        <translation>脚本，%1</translation>
    </message>
    <message>
        <source>%1 is open</source>
        <translation>“%1”已打开</translation>
    </message>
    <message>
        <source>Enter opens the highlighted choice</source>
        <translation>按 Enter 打开突出显示的选项</translation>
    </message>
    <message>
        <source>Check camera</source>
        <translation>检查相机</translation>
    </message>
    <message>
        <source>Start rehearsal</source>
        <translation>开始演练</translation>
    </message>
    <message>
        <source>Nothing was changed in that folder.</source>
        <translation>该文件夹中没有任何更改。</translation>
    </message>
    <message>
        <source>Give the venue a name.</source>
        <translation>请为场地命名。</translation>
    </message>
    <message>
        <source>A name cannot hold a slash.</source>
        <translation>名称不能包含斜杠。</translation>
    </message>
    <message>
        <source>There is a folder of that name. Choose another name.</source>
        <translation>已有同名文件夹。请换一个名称。</translation>
    </message>
    <message>
        <source>Choose the screen that shines on the surface.</source>
        <translation>请选择照射表面的屏幕。</translation>
    </message>
    <message>
        <source>Free %1 or choose another folder.</source>
        <translation>请腾出 %1，或选择其他文件夹。</translation>
    </message>
    <message>
        <source>Confirm that the room is clear.</source>
        <translation>请确认已清场。</translation>
    </message>
    <message>
        <source>Nothing was measured yet.</source>
        <translation>尚未做任何测量。</translation>
    </message>
    <message>
        <source>Programs</source>
        <translation>程序</translation>
    </message>
    <message>
        <source>Any projector and any camera that a command can drive</source>
        <translation>可用命令驱动的任何投影机和相机</translation>
    </message>
    <message>
        <source>Photographs {exposure} seconds into the file {output}: float EXR, 16-bit PNG or TIFF</source>
        <translation>曝光 {exposure} 秒，拍摄到文件 {output}：浮点 EXR、16 位 PNG 或 TIFF</translation>
    </message>
    <message>
        <source>Projector&apos;s pixels</source>
        <translation>投影机的像素</translation>
    </message>
    <message>
        <source>Width</source>
        <translation>宽度</translation>
    </message>
    <message>
        <source>Height</source>
        <translation>高度</translation>
    </message>
    <message>
        <source>Rehearsal. Opened %1</source>
        <translation>演练。打开于 %1</translation>
    </message>
    <message>
        <source>Opened %1</source>
        <translation>打开于 %1</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>打开</translation>
    </message>
    <message>
        <source>Open %1</source>
        <translation>打开 %1</translation>
    </message>
    <message>
        <source>Open a venue</source>
        <translation>打开场地</translation>
    </message>
    <message>
        <source>Rehearse</source>
        <translation>演练</translation>
    </message>
    <message>
        <source>Learn every step in a simulated venue. No devices needed.</source>
        <translation>在模拟场地中学习每个步骤。无需设备。</translation>
    </message>
    <message>
        <source>Continue where you stopped, or change the content.</source>
        <translation>从上次停止处继续，或更换内容。</translation>
    </message>
    <message>
        <source>Measure a surface with a projector and a camera at this computer.</source>
        <translation>用连接到本机的投影机和相机测量表面。</translation>
    </message>
    <message>
        <source>Projector and camera are driven by programs of yours.</source>
        <translation>投影机和相机由您自己的程序驱动。</translation>
    </message>
    <message>
        <source>Recent</source>
        <translation>最近打开</translation>
    </message>
    <message>
        <source>No venues yet</source>
        <translation>尚无场地</translation>
    </message>
    <message>
        <source>The venues that you measure are listed here, newest first.</source>
        <translation>您测量的场地会列在这里，最新的在前。</translation>
    </message>
    <message>
        <source>A first rehearsal takes a few minutes.</source>
        <translation>首次演练需要几分钟。</translation>
    </message>
    <message>
        <source>This venue</source>
        <translation>此场地</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>名称</translation>
    </message>
    <message>
        <source>Name of the venue</source>
        <translation>场地名称</translation>
    </message>
    <message>
        <source>Folder</source>
        <translation>文件夹</translation>
    </message>
    <message>
        <source>Folder that holds the venue</source>
        <translation>存放场地的文件夹</translation>
    </message>
    <message>
        <source>Choose a folder</source>
        <translation>选择文件夹</translation>
    </message>
    <message>
        <source>Expected</source>
        <translation>预计</translation>
    </message>
    <message>
        <source>Patterns</source>
        <translation>图案</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>磁盘</translation>
    </message>
    <message>
        <source>about %1</source>
        <translation>约 %1</translation>
    </message>
    <message>
        <source>Simulated devices</source>
        <translation>模拟设备</translation>
    </message>
    <message>
        <source>Pixels of the simulated projector</source>
        <translation>模拟投影机的像素</translation>
    </message>
    <message>
        <source>More pixels show finer detail and take longer. The first time, the light of the venue is traced; later it is remembered.</source>
        <translation>像素越多，细节越精细，耗时越长。首次会追踪场地的光线，之后直接沿用。</translation>
    </message>
    <message numerus="yes">
        <source>About %n pattern(s), %1</source>
        <translation>
            <numerusform>约 %n 个图案，%1</numerusform>
        </translation>
    </message>
    <message>
        <source>Shows the file {image} and ends as soon as the projector shines it</source>
        <translation>显示文件 {image}，投影机实际投出后即结束</translation>
    </message>
    <message>
        <source>Relief, two projectors</source>
        <translation>浮雕，两台投影机</translation>
    </message>
    <message>
        <source>Each shines into the other&apos;s shadows</source>
        <translation>彼此照亮对方的阴影</translation>
    </message>
    <message>
        <source>The projector&apos;s screen</source>
        <translation>投影机的屏幕</translation>
    </message>
    <message>
        <source>Say which screen the projector is now. What was measured stays.</source>
        <translation>请说明投影机现在是哪个屏幕。测量结果保留。</translation>
    </message>
    <message>
        <source>Nothing is measured again.</source>
        <translation>不会重新测量。</translation>
    </message>
    <message>
        <source>Use this screen</source>
        <translation>使用此屏幕</translation>
    </message>
    <message>
        <source>Change the screen</source>
        <translation>更换屏幕</translation>
    </message>
    <message>
        <source>The projector&apos;s screen %1 is not there</source>
        <translation>投影机的屏幕 %1 不在</translation>
    </message>
    <message>
        <source>Plug it in, or say which screen the projector is now.</source>
        <translation>请接上，或说明投影机现在是哪个屏幕。</translation>
    </message>
    <message>
        <source>%1 is not the folder of a venue: it has no %2 in it.</source>
        <translation>%1 不是场地文件夹：其中没有 %2。</translation>
    </message>
    <message numerus="yes">
        <source>There are %n venue(s) within it: open one of them.</source>
        <translation>
            <numerusform>其中有 %n 个场地：请打开其中之一。</numerusform>
        </translation>
    </message>
    <message>
        <source>Choose a venue&apos;s own folder. It has the venue&apos;s name.</source>
        <translation>请选择场地自己的文件夹，它以场地命名。</translation>
    </message>
    <message>
        <source>This folder is not a venue</source>
        <translation>此文件夹不是场地</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>没有任何更改。</translation>
    </message>
    <message>
        <source>The devices are in use at %1.</source>
        <translation>设备正用于“%1”。</translation>
    </message>
    <message>
        <source>Choose another screen.</source>
        <translation>请选择另一个屏幕。</translation>
    </message>
    <message>
        <source>Only your own screen is there. Plug the projector in, and extend the desktop to it.</source>
        <translation>只有您自己的屏幕。请接上投影机，并把桌面扩展到它。</translation>
    </message>
    <message>
        <source>Nothing is measured again</source>
        <translation>不会重新测量</translation>
    </message>
    <message>
        <source>Measured at</source>
        <translation>测量于</translation>
    </message>
    <message>
        <source>Used at</source>
        <translation>用于</translation>
    </message>
    <message>
        <source>Pixels</source>
        <translation>像素</translation>
    </message>
    <message>
        <source>A screen is known again by its maker&apos;s names and serial number. Where it tells none, it is known by its connector: then a cable that is plugged in elsewhere has to be said here.</source>
        <translation>屏幕按制造商和序列号识别。若没有，则按接口识别：线缆换插别处时须在此说明。</translation>
    </message>
    <message>
        <source>Is open</source>
        <translation>已打开</translation>
    </message>
    <message>
        <source>Time, by camera</source>
        <translation>时间（视相机而定）</translation>
    </message>
    <message>
        <source>Industrial cameras and video devices are fast, still cameras slow.</source>
        <translation>工业相机和视频设备快，照相机慢。</translation>
    </message>
    <message>
        <source>%1 to %2</source>
        <translation>%1 至 %2</translation>
    </message>
    <message>
        <source>%1 free</source>
        <translation>可用 %1</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 / %2</translation>
    </message>
    <message>
        <source>Free the disk of what %1 does not need</source>
        <translation>清除磁盘上 %1 不需要的内容</translation>
    </message>
    <message>
        <source>Resume</source>
        <translation>继续</translation>
    </message>
    <message>
        <source>Resume %1</source>
        <translation>继续 %1</translation>
    </message>
    <message>
        <source>Free space…</source>
        <translation>释放空间…</translation>
    </message>
    <message>
        <source>Somebody bumps the camera</source>
        <translation>有人碰到相机</translation>
    </message>
    <message>
        <source>A light is switched on</source>
        <translation>有人打开灯</translation>
    </message>
    <message>
        <source>The camera&apos;s cable comes out</source>
        <translation>相机线缆脱落</translation>
    </message>
    <message>
        <source>Surprises</source>
        <translation>意外情况</translation>
    </message>
    <message>
        <source>Each comes once while Acquire measures, at a moment that nobody knows. Practise what the wizard says, before it happens in front of a client.</source>
        <translation>每种情况在“采集”测量期间出现一次，时间无人知晓。在客户面前发生之前，先练习应对向导的提示。</translation>
    </message>
    <message>
        <source>Measures how a surface changes what is projected on it, and corrects pictures and films until they look right there.</source>
        <translation>测量表面如何改变投在上面的画面，并校正图片和影片，使其在那里看起来正确。</translation>
    </message>
    <message>
        <source>Easy. Measuring takes %1</source>
        <translation>容易。测量需要%1</translation>
    </message>
    <message>
        <source>Medium. Measuring takes %1</source>
        <translation>中等。测量需要%1</translation>
    </message>
    <message>
        <source>Hard. Measuring takes %1</source>
        <translation>困难。测量需要%1</translation>
    </message>
    <message>
        <source>Name of %1</source>
        <translation>%1 的名称</translation>
    </message>
    <message>
        <source>Projectors</source>
        <translation>投影机</translation>
    </message>
    <message>
        <source>None chosen yet.</source>
        <translation>尚未选择。</translation>
    </message>
    <message>
        <source>Add a projector</source>
        <translation>添加投影机</translation>
    </message>
    <message>
        <source>Projector %1</source>
        <translation>投影机 %1</translation>
    </message>
    <message>
        <source>Remove projector %1</source>
        <translation>移除投影机 %1</translation>
    </message>
    <message>
        <source>%1: choose its screen</source>
        <translation>%1：请选择其屏幕</translation>
    </message>
    <message>
        <source>Cameras</source>
        <translation>相机</translation>
    </message>
    <message>
        <source>Camera %1</source>
        <translation>相机 %1</translation>
    </message>
    <message>
        <source>Remove camera %1</source>
        <translation>移除相机 %1</translation>
    </message>
    <message>
        <source>Add one from the list, or choose it at the next step.</source>
        <translation>从列表中添加一台，或在下一步选择。</translation>
    </message>
    <message>
        <source>Content is placed in the view of the first one.</source>
        <translation>内容放置在第一台相机的视角中。</translation>
    </message>
    <message>
        <source>Add those that look at the surface.</source>
        <translation>请添加对着表面的相机。</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>移除</translation>
    </message>
    <message>
        <source>Remove %1</source>
        <translation>移除 %1</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>添加</translation>
    </message>
    <message>
        <source>Add %1</source>
        <translation>添加 %1</translation>
    </message>
    <message>
        <source>Say which screens shine on the surface, which cameras watch, and where the work is kept.</source>
        <translation>指定哪些屏幕照在表面上、哪些相机观看，以及工作保存在哪里。</translation>
    </message>
    <message numerus="yes">
        <source>%n projector(s)</source>
        <translation>
            <numerusform>%n 台投影机</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n camera(s)</source>
        <translation>
            <numerusform>%n 台相机</numerusform>
        </translation>
    </message>
    <message>
        <source>This screen is projector %1 already.</source>
        <translation>此屏幕已是投影机 %1。</translation>
    </message>
    <message>
        <source>That screen is projector %1. Choose another screen.</source>
        <translation>该屏幕是投影机 %1。请选择另一个。</translation>
    </message>
    <message>
        <source>Dome, four projectors</source>
        <translation>穹顶，四台投影机</translation>
    </message>
    <message>
        <source>They overlap; two cameras watch</source>
        <translation>互相重叠，两台相机观看</translation>
    </message>
    <message>
        <source>Bust from three sides</source>
        <translation>三面观看的胸像</translation>
    </message>
    <message>
        <source>Two projectors, three cameras: for an audience that walks</source>
        <translation>两台投影机、三台相机：适合走动的观众</translation>
    </message>
    <message>
        <source>Projector whose screen is changed</source>
        <translation>要更改屏幕的投影机</translation>
    </message>
    <message>
        <source>Network address (PJLink)</source>
        <translation>网络地址（PJLink）</translation>
    </message>
    <message>
        <source>Password, if it has one</source>
        <translation>密码（如有）</translation>
    </message>
    <message>
        <source>On the network</source>
        <translation>网络</translation>
    </message>
    <message>
        <source>Optional: a projector with a network address is switched on, and its lamp waited for until it is steady, before anything is measured.</source>
        <translation>可选：有网络地址的投影机会被开机，并在测量前等待其灯泡稳定。</translation>
    </message>
    <message>
        <source>Find projectors</source>
        <translation>查找投影机</translation>
    </message>
    <message>
        <source>Looking for projectors…</source>
        <translation>正在查找投影机…</translation>
    </message>
    <message>
        <source>None answers. Only PJLink class 2 can be searched: type the address.</source>
        <translation>没有应答。只能搜索 PJLink 2 类：请输入地址。</translation>
    </message>
    <message numerus="yes">
        <source>%n answer. Choose from the list of each.</source>
        <translation>
            <numerusform>%n 台应答。请在各自的列表中选择。</numerusform>
        </translation>
    </message>
    <message>
        <source>Move to the trash</source>
        <translation>移到回收站</translation>
    </message>
    <message>
        <source>Keep it</source>
        <translation>保留它</translation>
    </message>
    <message>
        <source>Try again then.</source>
        <translation>之后请重试。</translation>
    </message>
    <message>
        <source>Nothing of the venue is lost.</source>
        <translation>场地的内容没有任何丢失。</translation>
    </message>
    <message>
        <source>Remove a venue</source>
        <translation>移除场地</translation>
    </message>
    <message>
        <source>“%1” goes to the trash, with its photographs, results and playlist.</source>
        <translation>“%1”将连同照片、结果和播放列表移到回收站。</translation>
    </message>
    <message>
        <source>Until the trash is emptied it can be taken back from there.</source>
        <translation>在清空回收站之前，可以从那里恢复。</translation>
    </message>
    <message>
        <source>More</source>
        <translation>更多</translation>
    </message>
    <message>
        <source>More for %1</source>
        <translation>%1 的更多操作</translation>
    </message>
    <message>
        <source>Rename…</source>
        <translation>重命名…</translation>
    </message>
    <message>
        <source>Remove…</source>
        <translation>移除…</translation>
    </message>
    <message>
        <source>Setting up another</source>
        <translation>正在设置另一个</translation>
    </message>
    <message>
        <source>Allow them</source>
        <translation>允许</translation>
    </message>
    <message>
        <source>Open without them</source>
        <translation>不用它们打开</translation>
    </message>
    <message>
        <source>Programs of a venue</source>
        <translation>场地的程序</translation>
    </message>
    <message>
        <source>“%1” names programs of its own as projector or camera. They would run on this computer as you, and nobody here has agreed to that yet:</source>
        <translation>“%1”指定了自己的程序作为投影机或相机。它们将以您的身份在这台计算机上运行，而这里还没有人同意：</translation>
    </message>
    <message>
        <source>None of them was run. Without them everything that was measured can be looked at and shown.</source>
        <translation>它们都没有运行。不用它们也可以查看和放映所有测得的内容。</translation>
    </message>
    <message>
        <source>Allow them if you know what they do, or know who made this venue.</source>
        <translation>如果您知道它们做什么，或知道是谁建立了这个场地，请允许。</translation>
    </message>
    <message>
        <source>No other screen is plugged in.</source>
        <translation>没有接上其他屏幕。</translation>
    </message>
    <message>
        <source>The same steps, with a simulated projector and camera. Nothing is projected unless you choose a screen.</source>
        <translation>步骤相同，使用模拟的投影机和相机。除非您选择屏幕，否则不会投影。</translation>
    </message>
    <message>
        <source>Programs of this venue</source>
        <translation>此场地的程序</translation>
    </message>
    <message>
        <source>Say which commands drive these devices from now on. What was measured stays.</source>
        <translation>请说明今后由哪些命令驱动这些设备。测量结果保留。</translation>
    </message>
    <message>
        <source>Use these commands</source>
        <translation>使用这些命令</translation>
    </message>
    <message>
        <source>Change the programs</source>
        <translation>更换程序</translation>
    </message>
    <message>
        <source>Type another command.</source>
        <translation>请输入另一条命令。</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>相机</translation>
    </message>
    <message>
        <source>A program that fails ends with another status than 0. What it says last is told with it. Try it in a terminal, with a file in place of {image} or {output} and seconds in place of {exposure}.</source>
        <translation>失败的程序以非 0 的状态结束，其最后的输出会一并显示。请在终端中试运行，用文件代替 {image} 或 {output}，用秒数代替 {exposure}。</translation>
    </message>
    <message>
        <source>Relucent shows the pictures on it, unless a program of yours does.</source>
        <translation>除非由您的程序显示，否则 Relucent 会在其上显示图片。</translation>
    </message>
    <message>
        <source>Not needed with a screen. %1</source>
        <translation>使用屏幕时不需要。%1</translation>
    </message>
    <message>
        <source>Choose the projector&apos;s screen, or type the command that shows.</source>
        <translation>请选择投影机的屏幕，或输入用于显示的命令。</translation>
    </message>
    <message>
        <source>%1, %2, unplugged</source>
        <translation>%1，%2，已拔出</translation>
    </message>
    <message>
        <source>As many as the chosen screen has.</source>
        <translation>与所选屏幕的像素数相同。</translation>
    </message>
    <message>
        <source>Continue</source>
        <translation>继续</translation>
    </message>
    <message>
        <source>A show plays on %1</source>
        <translation>%1 上正在播放节目</translation>
    </message>
    <message>
        <source>Another program shows it. End it before anything is measured there: Camera has the button.</source>
        <translation>另一个程序正在显示。在那里测量之前请先结束它：按钮在“相机”页。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VenueTidy</name>
    <message>
        <source>Try again then.</source>
        <translation>之后请重试。</translation>
    </message>
    <message>
        <source>%1 is at work. Space can be freed when it has ended.</source>
        <translation>%1 正在工作。结束后可以释放空间。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::ViewerPlan</name>
    <message>
        <source>Plan of the cameras and of the viewer, seen from above</source>
        <translation>相机和观众的平面图，俯视</translation>
    </message>
    <message>
        <source>Camera %1</source>
        <translation>相机 %1</translation>
    </message>
    <message>
        <source>Viewer</source>
        <translation>观众</translation>
    </message>
    <message>
        <source>%1: %2 m to the left, %3 m from the surface</source>
        <translation>%1：向左 %2 m，距表面 %3 m</translation>
    </message>
    <message>
        <source>%1: %2 m to the right, %3 m from the surface</source>
        <translation>%1：向右 %2 m，距表面 %3 m</translation>
    </message>
</context>
<context>
    <name>relucent::gui::VtkView</name>
    <message>
        <source>This view needs OpenGL 3.2, and this computer draws without it. Everything else works: pictures and maps are shown without depth.</source>
        <translation>此视图需要 OpenGL 3.2，但这台计算机的绘图不支持。其他功能均正常：图像和分布图以平面方式显示。</translation>
    </message>
    <message>
        <source>For this view, install the graphics card&apos;s driver and start Relucent again.</source>
        <translation>要使用此视图，请安装显卡驱动并重新启动 Relucent。</translation>
    </message>
</context>
<context>
    <name>relucent::gui::Wizard</name>
    <message>
        <source>Not applied yet</source>
        <translation>尚未应用</translation>
    </message>
</context>
<context>
    <name>repair.camera-moved</name>
    <message>
        <source>the view of camera {} has moved by {} and {} pixels and turned by {} degrees</source>
        <translation>相机 {} 的视野移动了 {} 和 {} 像素，并转动了 {} 度</translation>
    </message>
</context>
<context>
    <name>repair.light-changed</name>
    <message>
        <source>projector {} gives {} % of the red, {} % of the green and {} % of the blue light that it gave</source>
        <translation>投影机 {} 的光为原来的：红 {} %、绿 {} %、蓝 {} %</translation>
    </message>
</context>
<context>
    <name>repair.light-elsewhere</name>
    <message>
        <source>in {} % of the cameras&apos; pixels light arrives otherwise than it did</source>
        <translation>在 {} % 的相机像素中，光到达的方式与以前不同</translation>
    </message>
</context>
<context>
    <name>repair.picture-moved</name>
    <message>
        <source>the projected picture has moved by {} and {} pixels as camera {} sees it</source>
        <translation>投影画面移动了 {} 和 {} 像素（从相机 {} 看）</translation>
    </message>
</context>
<context>
    <name>repair.room-brighter</name>
    <message>
        <source>the room is brighter by {} % of the projectors&apos; full light</source>
        <translation>房间变亮了，相当于投影机全光的 {} %</translation>
    </message>
</context>
<context>
    <name>repair.room-darker</name>
    <message>
        <source>the room is darker by {} % of the projectors&apos; full light</source>
        <translation>房间变暗了，相当于投影机全光的 {} %</translation>
    </message>
</context>
<context>
    <name>repair.surface-changed</name>
    <message>
        <source>{} % of what the cameras see is brighter, darker or of another colour than it was</source>
        <translation>相机所见的 {} % 比以前更亮、更暗或颜色不同</translation>
    </message>
</context>
<context>
    <name>report.cannot-write</name>
    <message>
        <source>the report cannot be written</source>
        <translation>无法写入报告</translation>
    </message>
</context>
<context>
    <name>report.free-some-space</name>
    <message>
        <source>free some space</source>
        <translation>请腾出一些空间</translation>
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
        <translation>不允许从此处结束另一个程序</translation>
    </message>
</context>
<context>
    <name>session.close-other-window</name>
    <message>
        <source>go on there, or close it there first</source>
        <translation>请在那里继续，或先在那里关闭它</translation>
    </message>
</context>
<context>
    <name>session.end-show-itself</name>
    <message>
        <source>hold Esc on the projector&apos;s picture for two seconds</source>
        <translation>在投影机画面上按住 Esc 两秒</translation>
    </message>
</context>
<context>
    <name>session.open-in-another-window</name>
    <message>
        <source>this venue is open in another window of Relucent</source>
        <translation>此场地已在 Relucent 的另一个窗口中打开</translation>
    </message>
</context>
<context>
    <name>sets.choose-name</name>
    <message>
        <source>choose another name, as day or school class</source>
        <translation>请选择其他名称，如“白天”或“学生团体”</translation>
    </message>
</context>
<context>
    <name>sets.choose-one</name>
    <message>
        <source>choose one of {}</source>
        <translation>请从 {} 中选择</translation>
    </message>
</context>
<context>
    <name>sets.damaged</name>
    <message>
        <source>the sets of this calibration cannot be read</source>
        <translation>无法读取此校准的方案</translation>
    </message>
</context>
<context>
    <name>sets.in-use</name>
    <message>
        <source>the set &apos;{}&apos; is in use</source>
        <translation>方案“{}”正在使用</translation>
    </message>
</context>
<context>
    <name>sets.name-empty</name>
    <message>
        <source>a set needs a name</source>
        <translation>方案需要名称</translation>
    </message>
</context>
<context>
    <name>sets.name-odd</name>
    <message>
        <source>the name of a set is plain text that neither begins nor ends with a space</source>
        <translation>方案名称为纯文本，首尾不能有空格</translation>
    </message>
</context>
<context>
    <name>sets.name-taken</name>
    <message>
        <source>there is a set &apos;{}&apos; already</source>
        <translation>已有方案“{}”</translation>
    </message>
</context>
<context>
    <name>sets.name-too-long</name>
    <message>
        <source>the name of a set has at most {} bytes</source>
        <translation>方案名称最多 {} 字节</translation>
    </message>
</context>
<context>
    <name>sets.of-newer-version</name>
    <message>
        <source>a newer Relucent wrote the sets of this calibration</source>
        <translation>此校准的方案由更新版本的 Relucent 写入</translation>
    </message>
</context>
<context>
    <name>sets.remove-section</name>
    <message>
        <source>take &quot;sets&quot; out of the settings in {}, or copy the calibration again from where it was made</source>
        <translation>请从 {} 的设置中去掉“sets”，或从制作处重新复制校准</translation>
    </message>
</context>
<context>
    <name>sets.save-first</name>
    <message>
        <source>this calibration has no sets yet: save one first</source>
        <translation>此校准还没有方案：请先保存一个</translation>
    </message>
</context>
<context>
    <name>sets.unknown</name>
    <message>
        <source>there is no set &apos;{}&apos;</source>
        <translation>没有方案“{}”</translation>
    </message>
</context>
<context>
    <name>sets.use-another-first</name>
    <message>
        <source>use another one first</source>
        <translation>请先使用其他方案</translation>
    </message>
</context>
<context>
    <name>show.allow-commands</name>
    <message>
        <source>look at what it does, then open the venue in the wizard and allow its programs</source>
        <translation>先看它做什么，再在向导中打开场地并允许其程序</translation>
    </message>
</context>
<context>
    <name>show.cannot-enable-service</name>
    <message>
        <source>the service cannot be switched on ({})</source>
        <translation>无法启用服务（{}）</translation>
    </message>
</context>
<context>
    <name>show.cannot-remove-entry</name>
    <message>
        <source>it cannot be removed ({})</source>
        <translation>无法删除（{}）</translation>
    </message>
</context>
<context>
    <name>show.cannot-write-log</name>
    <message>
        <source>the log cannot be written ({})</source>
        <translation>无法写入日志（{}）</translation>
    </message>
</context>
<context>
    <name>show.check-folder-permissions</name>
    <message>
        <source>check the folder&apos;s permissions</source>
        <translation>请检查该文件夹的权限</translation>
    </message>
</context>
<context>
    <name>show.choose-another-log-folder</name>
    <message>
        <source>choose another folder with --log</source>
        <translation>请用 --log 指定其他文件夹</translation>
    </message>
</context>
<context>
    <name>show.engine-lost-device</name>
    <message>
        <source>the engine lost its graphics card</source>
        <translation>引擎失去了它使用的设备</translation>
    </message>
</context>
<context>
    <name>show.no-camera</name>
    <message>
        <source>this show has no camera: its calibration names none</source>
        <translation>此演出没有相机：其校准未指定相机</translation>
    </message>
</context>
<context>
    <name>show.no-xwayland</name>
    <message>
        <source>in a Wayland session, take QT_QPA_PLATFORM=xcb out of the environment; else take away the desktop&apos;s rules for windows of Relucent, then try again</source>
        <translation>在 Wayland 会话中，请从环境中去掉 QT_QPA_PLATFORM=xcb；否则请去掉桌面对 Relucent 窗口的规则，然后重试</translation>
    </message>
</context>
<context>
    <name>show.projector-by-command</name>
    <message>
        <source>this calibration shows pictures by a command of its own, which does not know of the show: stop the show and use relucent-cli verify and perfect</source>
        <translation>此校准用自己的命令显示图片，该命令不了解演出：请停止演出，使用 relucent-cli verify 和 perfect</translation>
    </message>
</context>
<context>
    <name>show.restore-resolution</name>
    <message>
        <source>set its resolution back in the desktop&apos;s settings, then try again</source>
        <translation>请在桌面设置中恢复其分辨率，然后重试</translation>
    </message>
</context>
<context>
    <name>show.screen-asleep</name>
    <message>
        <source>the projector&apos;s screen is asleep and does not wake</source>
        <translation>投影机的屏幕处于休眠状态，无法唤醒</translation>
    </message>
</context>
<context>
    <name>show.screen-size-changed</name>
    <message>
        <source>the projector&apos;s screen has {} pixels now and {} were calibrated</source>
        <translation>投影机的屏幕现在为 {} 像素，校准时为 {}</translation>
    </message>
</context>
<context>
    <name>show.start-show-again</name>
    <message>
        <source>start the show again</source>
        <translation>请重新启动节目</translation>
    </message>
</context>
<context>
    <name>show.switch-off-power-saving</name>
    <message>
        <source>switch off its power saving and the screen saver in the desktop&apos;s settings, then try again</source>
        <translation>请在桌面设置中关闭节能功能和屏幕保护程序，然后重试</translation>
    </message>
</context>
<context>
    <name>show.window-elsewhere</name>
    <message>
        <source>the desktop puts the projector&apos;s picture on the screen {} instead</source>
        <translation>桌面把投影机的画面放到了屏幕 {} 上</translation>
    </message>
</context>
<context>
    <name>stage.adapting-light-transport</name>
    <message>
        <source>fitting the light transport to what is seen</source>
        <translation>使光传输与所见相符</translation>
    </message>
</context>
<context>
    <name>stage.algorithm-1</name>
    <message>
        <source>Algorithm 1</source>
        <translation>算法 1</translation>
    </message>
</context>
<context>
    <name>stage.assembling-light-transport</name>
    <message>
        <source>Assembling the light transport</source>
        <translation>正在组装光传输</translation>
    </message>
</context>
<context>
    <name>stage.awaiting-steady-light</name>
    <message>
        <source>Waiting until the lamps are steady</source>
        <translation>等待灯泡稳定</translation>
    </message>
</context>
<context>
    <name>stage.black-and-full-light</name>
    <message>
        <source>black and full light</source>
        <translation>黑场和全亮</translation>
    </message>
</context>
<context>
    <name>stage.calibrating</name>
    <message>
        <source>Calibrating</source>
        <translation>正在校准</translation>
    </message>
</context>
<context>
    <name>stage.capped-clusters</name>
    <message>
        <source>Clusters held to a size</source>
        <translation>限定大小的簇</translation>
    </message>
</context>
<context>
    <name>stage.capping-clusters</name>
    <message>
        <source>Holding clusters to a size</source>
        <translation>正在限制簇的大小</translation>
    </message>
</context>
<context>
    <name>stage.checking-additivity</name>
    <message>
        <source>Checking that the colours of {} add up</source>
        <translation>正在检查三色之和：{}</translation>
    </message>
</context>
<context>
    <name>stage.checking-drift</name>
    <message>
        <source>Checking for drift</source>
        <translation>正在检查漂移</translation>
    </message>
</context>
<context>
    <name>stage.checking-projector-and-camera</name>
    <message>
        <source>Checking projector and camera</source>
        <translation>正在检查投影机和相机</translation>
    </message>
</context>
<context>
    <name>stage.choosing-camera-pixels</name>
    <message>
        <source>Finding the camera pixels that are needed</source>
        <translation>正在查找所需的相机像素</translation>
    </message>
</context>
<context>
    <name>stage.clustering-light-transport</name>
    <message>
        <source>Clustering the light transport</source>
        <translation>正在对光传输聚类</translation>
    </message>
</context>
<context>
    <name>stage.comparing-cluster-inverses-in-venue</name>
    <message>
        <source>Comparing the inverses of clusters in {}</source>
        <translation>正在比较簇的逆矩阵：{}</translation>
    </message>
</context>
<context>
    <name>stage.comparing-methods</name>
    <message>
        <source>Comparing the methods</source>
        <translation>正在比较各方法</translation>
    </message>
</context>
<context>
    <name>stage.comparing-methods-in-venue</name>
    <message>
        <source>Comparing the methods in {}</source>
        <translation>正在比较各方法：{}</translation>
    </message>
</context>
<context>
    <name>stage.comparing-views</name>
    <message>
        <source>Comparing what the views want</source>
        <translation>正在比较各视点的要求</translation>
    </message>
</context>
<context>
    <name>stage.compensating</name>
    <message>
        <source>Compensating</source>
        <translation>正在补偿</translation>
    </message>
</context>
<context>
    <name>stage.concluding-measurement</name>
    <message>
        <source>what may be expected of the result</source>
        <translation>结果的预期质量</translation>
    </message>
</context>
<context>
    <name>stage.decoding</name>
    <message>
        <source>Decoding</source>
        <translation>正在解码</translation>
    </message>
</context>
<context>
    <name>stage.dense-patterns</name>
    <message>
        <source>patterns in blocks of {} px</source>
        <translation>{} 像素方块的图案</translation>
    </message>
</context>
<context>
    <name>stage.estimating-light-transport</name>
    <message>
        <source>Estimating the light transport</source>
        <translation>正在估计光传输</translation>
    </message>
</context>
<context>
    <name>stage.estimating-response-and-colours</name>
    <message>
        <source>Estimating response and colours</source>
        <translation>正在估计响应和颜色</translation>
    </message>
</context>
<context>
    <name>stage.evaluating</name>
    <message>
        <source>Evaluating</source>
        <translation>正在评估</translation>
    </message>
</context>
<context>
    <name>stage.finding-defocus</name>
    <message>
        <source>Finding the defocus</source>
        <translation>正在测定离焦</translation>
    </message>
</context>
<context>
    <name>stage.finding-exposure</name>
    <message>
        <source>Finding the exposure</source>
        <translation>正在确定曝光</translation>
    </message>
</context>
<context>
    <name>stage.finding-exposures</name>
    <message>
        <source>Finding the exposures</source>
        <translation>正在确定曝光</translation>
    </message>
</context>
<context>
    <name>stage.finding-projector-picture</name>
    <message>
        <source>Looking for the projector&apos;s picture</source>
        <translation>正在查找投影机的画面</translation>
    </message>
</context>
<context>
    <name>stage.finding-shadows</name>
    <message>
        <source>Looking for shadows</source>
        <translation>正在查找阴影</translation>
    </message>
</context>
<context>
    <name>stage.finding-uncorrectable-pixels</name>
    <message>
        <source>Looking for what cannot be corrected</source>
        <translation>正在查找无法补偿之处</translation>
    </message>
</context>
<context>
    <name>stage.finding-what-is-seen</name>
    <message>
        <source>Finding which part of the picture is seen</source>
        <translation>正在查找看到画面的哪一部分</translation>
    </message>
</context>
<context>
    <name>stage.fitting-light-spread</name>
    <message>
        <source>Fitting the spread of light</source>
        <translation>正在拟合光的扩散</translation>
    </message>
</context>
<context>
    <name>stage.forming-patches</name>
    <message>
        <source>Forming patches</source>
        <translation>正在划分图块</translation>
    </message>
</context>
<context>
    <name>stage.inverting-clusters</name>
    <message>
        <source>Inverting the clusters</source>
        <translation>正在对各簇求逆</translation>
    </message>
</context>
<context>
    <name>stage.inverting-light-transport</name>
    <message>
        <source>Inverting the light transport</source>
        <translation>正在对光传输求逆</translation>
    </message>
</context>
<context>
    <name>stage.inverting-venue</name>
    <message>
        <source>Inverting {}</source>
        <translation>正在求逆：{}</translation>
    </message>
</context>
<context>
    <name>stage.joining-clusters</name>
    <message>
        <source>Joining clusters</source>
        <translation>正在合并簇</translation>
    </message>
</context>
<context>
    <name>stage.judging-light</name>
    <message>
        <source>Judging the light</source>
        <translation>正在评估光线</translation>
    </message>
</context>
<context>
    <name>stage.level-of-tree</name>
    <message numerus="yes">
        <source>level {} of {}: {} patterns</source>
        <comment>level {} of {}: {} pattern</comment>
        <translation>
            <numerusform>第 {} 层，共 {} 层：{} 个图案</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>stage.light-transport</name>
    <message>
        <source>light transport</source>
        <translation>光传输</translation>
    </message>
</context>
<context>
    <name>stage.linearizing</name>
    <message>
        <source>Linearizing</source>
        <translation>正在线性化</translation>
    </message>
</context>
<context>
    <name>stage.looking-for-changes</name>
    <message>
        <source>Looking for what has changed</source>
        <translation>正在寻找变化</translation>
    </message>
</context>
<context>
    <name>stage.looking-for-hot-pixels</name>
    <message>
        <source>Looking for hot pixels of the camera</source>
        <translation>正在查找相机的热像素</translation>
    </message>
</context>
<context>
    <name>stage.looking-through-camera</name>
    <message>
        <source>Looking through the camera</source>
        <translation>正在查看相机画面</translation>
    </message>
</context>
<context>
    <name>stage.measuring-brightness-curves</name>
    <message>
        <source>Measuring the brightness curves of {}</source>
        <translation>正在测量亮度曲线：{}</translation>
    </message>
</context>
<context>
    <name>stage.measuring-camera</name>
    <message>
        <source>Measuring the camera</source>
        <translation>正在测量相机</translation>
    </message>
</context>
<context>
    <name>stage.measuring-latency</name>
    <message>
        <source>Measuring the latency</source>
        <translation>正在测量延迟</translation>
    </message>
</context>
<context>
    <name>stage.measuring-light-transport</name>
    <message>
        <source>Measuring the light transport</source>
        <translation>正在测量光传输</translation>
    </message>
</context>
<context>
    <name>stage.measuring-response</name>
    <message>
        <source>Measuring the response</source>
        <translation>正在测量响应</translation>
    </message>
</context>
<context>
    <name>stage.measuring-venue</name>
    <message>
        <source>Measuring {}</source>
        <translation>正在测量：{}</translation>
    </message>
</context>
<context>
    <name>stage.measuring-what-changed</name>
    <message>
        <source>measuring what is no longer as it was</source>
        <translation>正在测量已与以前不同之处</translation>
    </message>
</context>
<context>
    <name>stage.opening-devices</name>
    <message>
        <source>Opening the devices</source>
        <translation>正在打开设备</translation>
    </message>
</context>
<context>
    <name>stage.perfecting</name>
    <message>
        <source>Correcting the picture by photographs of itself</source>
        <translation>正在用图片自身的照片校正</translation>
    </message>
</context>
<context>
    <name>stage.photographing-projections</name>
    <message>
        <source>Photographing the projections</source>
        <translation>正在拍摄投影</translation>
    </message>
</context>
<context>
    <name>stage.photographing-test-patterns</name>
    <message>
        <source>Photographing test patterns</source>
        <translation>正在拍摄测试图案</translation>
    </message>
</context>
<context>
    <name>stage.predicting-held-out-patterns</name>
    <message>
        <source>Predicting held-out patterns</source>
        <translation>正在预测预留图案</translation>
    </message>
</context>
<context>
    <name>stage.preparing-benchmarks</name>
    <message>
        <source>Preparing the benchmarks</source>
        <translation>正在准备基准测试</translation>
    </message>
</context>
<context>
    <name>stage.preparing-devices</name>
    <message>
        <source>Preparing the devices</source>
        <translation>正在准备设备</translation>
    </message>
</context>
<context>
    <name>stage.preparing-engine</name>
    <message>
        <source>Preparing the engine</source>
        <translation>正在准备引擎</translation>
    </message>
</context>
<context>
    <name>stage.preparing-preview</name>
    <message>
        <source>Preparing the preview</source>
        <translation>正在准备预览</translation>
    </message>
</context>
<context>
    <name>stage.preparing-venue</name>
    <message>
        <source>Preparing the venue</source>
        <translation>正在准备场地</translation>
    </message>
</context>
<context>
    <name>stage.reading-calibration</name>
    <message>
        <source>Reading the calibration</source>
        <translation>正在读取校准数据</translation>
    </message>
</context>
<context>
    <name>stage.reading-light-transport</name>
    <message>
        <source>Reading the light transport</source>
        <translation>正在读取光传输</translation>
    </message>
</context>
<context>
    <name>stage.reading-patterns</name>
    <message>
        <source>Reading the patterns</source>
        <translation>正在读取图案</translation>
    </message>
</context>
<context>
    <name>stage.reading-photographs</name>
    <message>
        <source>Reading the photographs</source>
        <translation>正在读取照片</translation>
    </message>
</context>
<context>
    <name>stage.reading-pictures</name>
    <message>
        <source>Reading the pictures</source>
        <translation>正在读取图片</translation>
    </message>
</context>
<context>
    <name>stage.reading-response</name>
    <message>
        <source>Reading the response</source>
        <translation>正在读取响应</translation>
    </message>
</context>
<context>
    <name>stage.reading-venue</name>
    <message>
        <source>Reading {}</source>
        <translation>正在读取：{}</translation>
    </message>
</context>
<context>
    <name>stage.remeasuring-flagged-pixels</name>
    <message numerus="yes">
        <source>measuring {} flagged pixels again</source>
        <comment>measuring {} flagged pixel again</comment>
        <translation>
            <numerusform>正在重新测量 {} 个存疑像素</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>stage.scaling-to-flood-image</name>
    <message>
        <source>Scaling to the flood image</source>
        <translation>正在按全亮图像缩放</translation>
    </message>
</context>
<context>
    <name>stage.separating-direct-and-indirect-light</name>
    <message>
        <source>Separating direct and indirect light</source>
        <translation>正在分离直接光与间接光</translation>
    </message>
</context>
<context>
    <name>stage.sharing-leaves</name>
    <message>
        <source>light that neighbouring pixels share</source>
        <translation>相邻像素共享的光</translation>
    </message>
</context>
<context>
    <name>stage.sharpening</name>
    <message>
        <source>Sharpening</source>
        <translation>正在锐化</translation>
    </message>
</context>
<context>
    <name>stage.solving</name>
    <message>
        <source>Solving</source>
        <translation>正在求解</translation>
    </message>
</context>
<context>
    <name>stage.storing-light-transport</name>
    <message>
        <source>storing the light transport</source>
        <translation>保存光传输</translation>
    </message>
</context>
<context>
    <name>stage.switching-projectors-on</name>
    <message>
        <source>Switching the projectors on</source>
        <translation>正在打开投影机</translation>
    </message>
</context>
<context>
    <name>stage.taking-verification-photograph</name>
    <message>
        <source>Taking the verification photograph</source>
        <translation>正在拍摄验证照片</translation>
    </message>
</context>
<context>
    <name>stage.test-patterns</name>
    <message>
        <source>test patterns</source>
        <translation>测试图案</translation>
    </message>
</context>
<context>
    <name>stage.timing-engine</name>
    <message>
        <source>Timing the engine</source>
        <translation>正在测试引擎耗时</translation>
    </message>
</context>
<context>
    <name>stage.tracing-simulated-venue</name>
    <message>
        <source>tracing the simulated venue</source>
        <translation>正在追踪模拟场地的光线</translation>
    </message>
</context>
<context>
    <name>stage.windows</name>
    <message>
        <source>Computing the windows of the inverse</source>
        <translation>窗口</translation>
    </message>
</context>
<context>
    <name>stage.working-out-finest-blocks</name>
    <message>
        <source>working out the finest blocks</source>
        <translation>计算最精细的块</translation>
    </message>
</context>
<context>
    <name>stage.writing</name>
    <message>
        <source>Writing</source>
        <translation>正在写入</translation>
    </message>
</context>
<context>
    <name>stage.writing-out-light-transport</name>
    <message>
        <source>Writing out the light transport</source>
        <translation>正在展开光传输</translation>
    </message>
</context>
<context>
    <name>stage.writing-report</name>
    <message>
        <source>Writing the report</source>
        <translation>正在写入报告</translation>
    </message>
</context>
<context>
    <name>stage.writing-results</name>
    <message>
        <source>Writing the results</source>
        <translation>正在写入结果</translation>
    </message>
</context>
<context>
    <name>stream.address-incomplete</name>
    <message>
        <source>in a stream&apos;s address the host or its port is missing or wrong</source>
        <translation>网络流地址中的主机或端口缺失或有误</translation>
    </message>
</context>
<context>
    <name>stream.check-host</name>
    <message>
        <source>check the name in the address, or write the number</source>
        <translation>请检查地址中的名称，或改写数字地址</translation>
    </message>
</context>
<context>
    <name>stream.check-network</name>
    <message>
        <source>check the network and the address</source>
        <translation>请检查网络和地址</translation>
    </message>
</context>
<context>
    <name>stream.check-path</name>
    <message>
        <source>check what stands behind the host in the address</source>
        <translation>请检查地址中主机之后的部分</translation>
    </message>
</context>
<context>
    <name>stream.check-sender</name>
    <message>
        <source>check the sender, the network, and the address</source>
        <translation>请检查发送端、网络和地址</translation>
    </message>
</context>
<context>
    <name>stream.end-other</name>
    <message>
        <source>end that program, or send to another port</source>
        <translation>请结束该程序，或发送到另一个端口</translation>
    </message>
</context>
<context>
    <name>stream.ended</name>
    <message>
        <source>it has ended</source>
        <translation>它已结束</translation>
    </message>
</context>
<context>
    <name>stream.host-unknown</name>
    <message>
        <source>its host is not found</source>
        <translation>找不到它的主机</translation>
    </message>
</context>
<context>
    <name>stream.list-once</name>
    <message>
        <source>put it into the playlist once</source>
        <translation>请只在播放列表中放入一次</translation>
    </message>
</context>
<context>
    <name>stream.no-memory</name>
    <message>
        <source>there is not enough memory for its pictures</source>
        <translation>内存不足以容纳其画面</translation>
    </message>
</context>
<context>
    <name>stream.no-such-path</name>
    <message>
        <source>there is nothing at its path</source>
        <translation>该路径下没有内容</translation>
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
        <translation>它尚未给出画面</translation>
    </message>
</context>
<context>
    <name>stream.open-already</name>
    <message>
        <source>this program plays it already</source>
        <translation>本程序已在播放它</translation>
    </message>
</context>
<context>
    <name>stream.port-in-use</name>
    <message>
        <source>another program receives at its port</source>
        <translation>另一个程序正在其端口上接收</translation>
    </message>
</context>
<context>
    <name>stream.refused</name>
    <message>
        <source>the connection was refused</source>
        <translation>连接被拒绝</translation>
    </message>
</context>
<context>
    <name>stream.send-h264</name>
    <message>
        <source>let it be sent as H.264 or Motion JPEG</source>
        <translation>请以 H.264 或 Motion JPEG 发送</translation>
    </message>
</context>
<context>
    <name>stream.silent</name>
    <message>
        <source>no picture came within {} s</source>
        <translation>{} s 内没有收到画面</translation>
    </message>
</context>
<context>
    <name>stream.stalled</name>
    <message>
        <source>no picture has come for {} s</source>
        <translation>已有 {} s 没有收到画面</translation>
    </message>
</context>
<context>
    <name>stream.start-sender</name>
    <message>
        <source>start the sender, and check the port</source>
        <translation>请启动发送端并检查端口</translation>
    </message>
</context>
<context>
    <name>stream.start-sender-again</name>
    <message>
        <source>start the sender again</source>
        <translation>请重新启动发送端</translation>
    </message>
</context>
<context>
    <name>stream.unknown-hold</name>
    <message>
        <source>the stream&apos;s address ends in an unknown choice</source>
        <translation>网络流地址末尾的选项未知</translation>
    </message>
</context>
<context>
    <name>stream.unknown-scheme</name>
    <message>
        <source>this is no address of a stream</source>
        <translation>这不是网络流的地址</translation>
    </message>
</context>
<context>
    <name>stream.unreachable</name>
    <message>
        <source>its host cannot be reached</source>
        <translation>无法连接到它的主机</translation>
    </message>
</context>
<context>
    <name>stream.unreadable</name>
    <message>
        <source>it cannot be read ({})</source>
        <translation>无法读取（{}）</translation>
    </message>
</context>
<context>
    <name>stream.unusable</name>
    <message>
        <source>what comes is no video that can be shown</source>
        <translation>收到的不是可以显示的视频</translation>
    </message>
</context>
<context>
    <name>stream.wants-password</name>
    <message>
        <source>it wants another user name and password</source>
        <translation>它要求另外的用户名和密码</translation>
    </message>
</context>
<context>
    <name>stream.write-address</name>
    <message>
        <source>write it like {}, and in user names and passwords % and two digits for signs like @, : and /</source>
        <translation>请写成 {} 的形式，用户名和密码中的 @、:、/ 等符号写成 % 加两位数字</translation>
    </message>
</context>
<context>
    <name>stream.write-hold</name>
    <message>
        <source>write #hold=last or #hold=black</source>
        <translation>请写 #hold=last 或 #hold=black</translation>
    </message>
</context>
<context>
    <name>stream.write-password</name>
    <message>
        <source>write them into the address before the host: {}</source>
        <translation>请写在地址中主机之前：{}</translation>
    </message>
</context>
<context>
    <name>stream.write-scheme</name>
    <message>
        <source>let it begin with one of {}</source>
        <translation>请以下列之一开头：{}</translation>
    </message>
</context>
<context>
    <name>venue.cannot-open-folder</name>
    <message>
        <source>the folder cannot be opened ({})</source>
        <translation>无法打开该文件夹（{}）</translation>
    </message>
</context>
<context>
    <name>venue.cannot-rename</name>
    <message>
        <source>the folder cannot be renamed ({})</source>
        <translation>无法重命名该文件夹（{}）</translation>
    </message>
</context>
<context>
    <name>venue.no-trash</name>
    <message>
        <source>it cannot be moved to the trash</source>
        <translation>无法移到回收站</translation>
    </message>
</context>
<context>
    <name>venue.remove-folder-yourself</name>
    <message>
        <source>this disk may have none: remove the folder with the file manager</source>
        <translation>此磁盘可能没有回收站：请用文件管理器删除该文件夹</translation>
    </message>
</context>
<context>
    <name>venue.used-by-another</name>
    <message>
        <source>another program is working on this venue</source>
        <translation>另一个程序正在处理此场地</translation>
    </message>
</context>
<context>
    <name>venue.wait-for-another</name>
    <message>
        <source>wait until it has finished, or close it, then try again</source>
        <translation>请等待其完成或将其关闭，然后重试</translation>
    </message>
</context>
<context>
    <name>view.cannot-write-picture</name>
    <message>
        <source>the picture could not be written</source>
        <translation>无法写入图像</translation>
    </message>
</context>
<context>
    <name>view.choose-writable-folder</name>
    <message>
        <source>choose a folder that you may write to, with free space</source>
        <translation>请选择您可写入且有可用空间的文件夹</translation>
    </message>
</context>
<context>
    <name>wizard.allow-commands</name>
    <message>
        <source>open the venue anew and allow its programs</source>
        <translation>重新打开场地并允许其程序</translation>
    </message>
</context>
</TS>
