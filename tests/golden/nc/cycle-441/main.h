BEGIN PGM FAST MM
; A positioning feed and no interruption, then the usual.
TOOL CALL 30 Z
TCH PROBE 441 FAST PROBING ~
    Q396=+2000 ~
    Q397=+0 ~
    Q399=+1 ~
    Q400=+0
TCH PROBE 427 MEASURE COORDINATE ~
    Q263=+50 ~
    Q264=+40 ~
    Q261=+0 ~
    Q320=+0 ~
    Q272=+3 ~
    Q267=-1 ~
    Q260=+20 ~
    Q281=+2
TCH PROBE 441 FAST PROBING ~
    Q396=+0 ~
    Q397=+0 ~
    Q399=+1 ~
    Q400=+1
TCH PROBE 427 MEASURE COORDINATE ~
    Q263=+60 ~
    Q264=+40 ~
    Q261=+0 ~
    Q320=+0 ~
    Q272=+3 ~
    Q267=-1 ~
    Q260=+20 ~
    Q281=+2
END PGM FAST MM
