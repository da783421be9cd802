; run: failed line 4: Touch point inaccessible: nothing within DIST = 20 mm of the start
%BAD G71 *
N10 T30 G17 *
N20 G427 MEASURE COORDINATE ~
    Q263=+50 ~
    Q264=+40 ~
    Q261=+0 ~
    Q272=+3 ~
    Q267=-1 ~
    Q260=+20 *
N99999999 %BAD G71 *
