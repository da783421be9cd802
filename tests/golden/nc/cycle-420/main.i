%ANGLE G71 *
; A sloping face, an edge, and the edge in a turned plane.
N10 T30 G17 *
N20 G420 MEASURE ANGLE ~
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
    Q281=+1 *
N30 Q1601 = Q150 *
; an edge
N40 G420 MEASURE ANGLE ~
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
    Q281=+0 *
N50 Q1602 = Q150 *
; in a turned plane
N60 G73 G90 H+2 *
N70 G420 MEASURE ANGLE ~
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
    Q281=+0 *
N80 Q1603 = Q150 *
N99999999 %ANGLE G71 *
