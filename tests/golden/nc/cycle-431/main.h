BEGIN PGM PLANE MM
; A face that slopes in both axes: its angles, and its height at three points.
TOOL CALL 30 Z
TCH PROBE 431 MEASURE PLANE ~
    Q263=+10 ~
    Q264=+10 ~
    Q294=+0 ~
    Q265=+60 ~
    Q266=+10 ~
    Q295=+0 ~
    Q296=+10 ~
    Q297=+50 ~
    Q298=+0 ~
    Q320=+2 ~
    Q260=+30 ~
    Q281=+1
END PGM PLANE MM
