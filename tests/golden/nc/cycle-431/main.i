%PLANE G71 *
; A face that slopes in both axes: its angles, and its height at three points.
N10 T30 G17 *
N20 G431 MEASURE PLANE ~
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
    Q281=+1 *
N99999999 %PLANE G71 *
