; G431: a face that rises by 2 in 100 along X; the angle is atan 0.02
%PLANE G71 *
N10 Q97 = 0 *
N20 T30 G17 *
N30 G431 ~
    Q263=+20 ~
    Q264=+20 ~
    Q294=+0 ~
    Q265=+80 ~
    Q266=+20 ~
    Q295=+0 ~
    Q296=+20 ~
    Q297=+60 ~
    Q298=+0 ~
    Q320=+2 ~
    Q260=+30 ~
    Q281=+0 *
N40 Q98 = Q173 + 0.6 * ;(20 - 50) * 0.02
N50 L98,0 *
N60 Q98 = Q174 - 0.6 * ;(80 - 50) * 0.02
N70 L98,0 *
N80 Q98 = Q175 + 0.6 * ;(20 - 50) * 0.02
N90 L98,0 *
N100 Q98 = Q158 - 0 * ;level along Y
N110 L98,0 *
N120 Q98 = Q159 + 1.145762838 * ;- atan 0.02
N130 L98,0 *
N140 M30 *
N150 G98 L98 * ;the figure before counts, and is right to a nanometre
N160 Q97 = Q97 + 1 *
N170 Q98 = ABS Q98 *
N180 D11 P01 +Q98 P02 +0.000001 P03 99 *
N190 G98 L0 *
N200 G98 L99 *
N210 D14 P01 +1000 *
N220 G98 L0 *
N99999999 %PLANE G71 *
