%TABLE G71 *
; B levels a sloping face; the second time nothing is left, and B reads 0.
N10 T30 G17 *
N20 G403 ROT IN ROTARY AXIS ~
    Q263=+50 ~
    Q264=+100 ~
    Q265=+150 ~
    Q266=+100 ~
    Q272=+3 ~
    Q267=-1 ~
    Q261=+0 ~
    Q320=+2 ~
    Q260=+30 ~
    Q301=+1 ~
    Q312=+0 ~
    Q337=+0 ~
    Q305=+0 ~
    Q303=+1 ~
    Q380=+0 *
N30 D18: SYSREAD Q1601 = ID270 NR1 IDX5 *
N40 G403 ROT IN ROTARY AXIS ~
    Q263=+50 ~
    Q264=+100 ~
    Q265=+150 ~
    Q266=+100 ~
    Q272=+3 ~
    Q267=-1 ~
    Q261=+0 ~
    Q320=+2 ~
    Q260=+30 ~
    Q301=+1 ~
    Q312=+5 ~
    Q337=+1 ~
    Q305=+0 ~
    Q303=+1 ~
    Q380=+0 *
N50 D18: SYSREAD Q1602 = ID270 NR1 IDX5 *
N99999999 %TABLE G71 *
