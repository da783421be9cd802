BEGIN PGM ANGLE MM
; A sloping face, an edge, and the edge in a turned plane.
TOOL CALL 30 Z
TCH PROBE 420 MEASURE ANGLE ~
    Q263=+10 ~
    Q264=+20 ~
    Q265=+60 ~
    Q266=+20 ~
    Q272=+3 ~
    Q267=-1 ~
    Q261=+0 ~
    Q320=+2 ~
    Q260=+30 ~
    Q301=+1 ~
    Q281=+1
Q1601 = Q150
; an edge
TCH PROBE 420 MEASURE ANGLE ~
    Q263=+120 ~
    Q264=+0 ~
    Q265=+180 ~
    Q266=+0 ~
    Q272=+2 ~
    Q267=+1 ~
    Q261=-10 ~
    Q320=+0 ~
    Q260=+30 ~
    Q301=+0 ~
    Q281=+0
Q1602 = Q150
; in a turned plane
CYCL DEF 10.0 ROTATION
CYCL DEF 10.1 ROT+2
TCH PROBE 420 MEASURE ANGLE ~
    Q263=+120 ~
    Q264=-5 ~
    Q265=+180 ~
    Q266=-5 ~
    Q272=+2 ~
    Q267=+1 ~
    Q261=-10 ~
    Q320=+0 ~
    Q260=+30 ~
    Q301=+0 ~
    Q281=+0
Q1603 = Q150
END PGM ANGLE MM
