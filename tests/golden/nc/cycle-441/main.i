%FAST G71 *
; A positioning feed and no interruption, then the usual.
N10 T30 G17 *
N20 G441 FAST PROBING ~
    Q396=+2000 ~
    Q397=+0 ~
    Q399=+1 ~
    Q400=+0 *
N30 G427 MEASURE COORDINATE ~
    Q263=+50 ~
    Q264=+40 ~
    Q261=+0 ~
    Q320=+0 ~
    Q272=+3 ~
    Q267=-1 ~
    Q260=+20 ~
    Q281=+2 *
N40 G441 FAST PROBING ~
    Q396=+0 ~
    Q397=+0 ~
    Q399=+1 ~
    Q400=+1 *
N50 G427 MEASURE COORDINATE ~
    Q263=+60 ~
    Q264=+40 ~
    Q261=+0 ~
    Q320=+0 ~
    Q272=+3 ~
    Q267=-1 ~
    Q260=+20 ~
    Q281=+2 *
N99999999 %FAST G71 *
