%TSAXIS G71 *
; A face reads Z+5 after cycle 247.
N10 T30 G17 *
N20 G417 DATUM IN TS AXIS ~
    Q263=+50 ~
    Q264=+40 ~
    Q294=+0 ~
    Q320=+0 ~
    Q260=+30 ~
    Q305=+9 ~
    Q333=+5 ~
    Q303=+1 *
N30 D18: SYSREAD Q1601 = ID503 NR9 IDX1 *
N40 D18: SYSREAD Q1602 = ID503 NR9 IDX2 *
N50 D18: SYSREAD Q1603 = ID503 NR9 IDX3 *
N60 G247 DATUM SETTING ~
    Q339=+9 *
N70 G427 MEASURE COORDINATE ~
    Q263=+50 ~
    Q264=+40 ~
    Q261=+5 ~
    Q320=+0 ~
    Q272=+3 ~
    Q267=-1 ~
    Q260=+20 ~
    Q281=+0 *
; a datum table without one: an error
N80 G417 DATUM IN TS AXIS ~
    Q263=+50 ~
    Q264=+40 ~
    Q294=+5 ~
    Q320=+0 ~
    Q260=+30 ~
    Q305=+9 ~
    Q333=+5 ~
    Q303=+0 *
N99999999 %TSAXIS G71 *
